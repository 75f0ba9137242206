#pragma once

#include <string>
#include <vector>

#include "machine/OutputFile.hpp"
#include "restart/RestartRecord.hpp"

namespace atrapos {

/// A table of comma-separated values that grows by rows; each is with the system when append returns. On
/// several ranks the first one writes, the others' calls do nothing.
class Table {
 public:
  /// Throws FileError where the file cannot be written.
  /// `append`: goes on with the table of that header which is there.
  Table(const std::string& file, const std::string& header, bool append = false);

  void append(const std::string& row);

  /// Takes over the rows of an earlier table up to a step of a branch, which are in its columns `step` and
  /// `branch`. Throws std::invalid_argument, one line, where that table has another header, or other rows
  /// than those that `mark` was taken of.
  void copyFrom(const std::string& file, const RestartPlace& last, const Mark& mark);

  /// The rows so far.
  const Mark& mark() const { return mark_; }
  void sync() const { out_.sync(); }  ///< until it would outlast a loss of power
  void rename(const std::string& file) {
    if (writes_) out_.rename(file);
  }

 private:
  void count(const std::string& row);

  std::string header_;
  bool writes_;
  OutputFile out_;
  Mark mark_;
  Digest digest_;
};

/// path.csv: one row per output point.
struct PathRow {
  int step = 0;
  double pathLength = 0, loadFactor = 0;
  std::vector<double> monitors;
  long long negative = -1;  ///< negative eigenvalues of the tangent; -1: not known
  int branch = 0;
  double residual = 0;  ///< relative
};
std::string pathHeader(const std::vector<std::string>& monitors);
std::string text(const PathRow& row);

/// points.csv: one row per limit, bifurcation or Hopf point.
struct PointRow {
  int step = 0, branch = 0;
  double pathLength = 0, loadFactor = 0;
  std::string kind;
  int negativeChange = 0, nullity = 0;
  double uncertainty = 0;
  std::vector<double> monitors{};
  double frequency = 0;  ///< angular, of a Hopf point
};
/// PointRow::kind of a Hopf point.
constexpr const char* hopfKind = "hopf";

/// steps.csv: one row per step.
struct StepRow {
  int step = 0, branch = 0, order = 0;
  double radius = 0, length = 0, pathLength = 0, loadFactor = 0, residual = 0;
  int cutBacks = 0, corrections = 0, contacts = 0, changes = 0;
  bool rational = false;
  long long negative = -1;
  std::vector<double> terms;  ///< |U_k| length^k, k = 1, 2, ...
};
std::string stepHeader();
std::string text(const StepRow& row);

std::string pointHeader(const std::vector<std::string>& monitors);
std::string text(const PointRow& row);
/// The limit points of the load factor in a points.csv. Throws as TableFile.
std::vector<PointRow> limitPointsOf(const std::string& file);
/// Its Hopf points. Throws as TableFile.
std::vector<PointRow> hopfPointsOf(const std::string& file);

}  // namespace atrapos
