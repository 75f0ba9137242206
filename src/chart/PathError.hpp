#pragma once

#include <memory>
#include <string>
#include <vector>

#include "chart/Chart.hpp"

namespace atrapos::chart {

/// The quantity `over` and a monitor, by its place in the chart's, in the rows of path.csv, those of the path
/// and not of its branches. Throws std::invalid_argument, one line, where the table lacks a column.
struct PathRows {
  std::vector<double> over, monitor;
};
PathRows readPath(const std::string& table, const Chart& chart, std::size_t monitor);

/// The exact monitor as a function of the quantity `over`.
class ReferenceCurve {
 public:
  virtual ~ReferenceCurve() = default;
  /// Not a number where nothing is known.
  virtual double operator()(double x) const = 0;

  /// Of points with ascending or descending x: cubics through the four nearest, or as many as there are, of a
  /// stretch, or where these lie unevenly, cubics with limited slopes; a point given twice is a corner, where
  /// two stretches meet. Throws std::invalid_argument, one line that begins with `what`, where x turns back.
  static std::unique_ptr<ReferenceCurve> ofPoints(std::vector<double> x, std::vector<double> y,
                                                  const std::string& what);
  /// Of a run: a step ends where the next one begins, and that is no corner. Throws std::invalid_argument,
  /// one line.
  static std::unique_ptr<ReferenceCurve> ofPath(const std::string& table, const Chart& chart,
                                                std::size_t monitor);
  /// What a chart asks for of a monitor, by its place in the chart's; `ownPath`: path.csv of the run that it
  /// may name. Throws std::invalid_argument, one line.
  static std::unique_ptr<ReferenceCurve> of(const Chart& chart, const std::string& ownPath,
                                            std::size_t monitor);
  /// Throws std::invalid_argument, one line.
  static std::unique_ptr<ReferenceCurve> ofFormula(const std::string& formula, const std::string& over);
};

struct PathError {
  double largest = 0, at = 0;  ///< |monitor - reference| and where it is, in `over`
};

/// The error of the monitor over the rows of a path, and over the curve through them where the chart asks for
/// that. Throws std::invalid_argument, one line that begins with `what`, where the reference knows no row, or
/// a curve through the rows turns back.
PathError errorOf(const PathRows& rows, const std::string& what, const Chart& chart,
                  const ReferenceCurve& reference);

/// The error of a path by its path.csv, against the references of all monitors: of several the largest of
/// |monitor - reference| over the range of the monitor's values. Throws std::invalid_argument, one line.
PathError errorOf(const std::string& table, const Chart& chart,
                  const std::vector<std::unique_ptr<ReferenceCurve>>& references);

}  // namespace atrapos::chart
