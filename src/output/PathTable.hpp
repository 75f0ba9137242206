#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "restart/RestartRecord.hpp"

namespace atrapos {

/// A table of comma-separated values that grows by rows; each is on disk when append returns. On several
/// ranks the first one writes, the others' calls do nothing.
class Table {
 public:
  /// Throws std::runtime_error where the file cannot be written.
  /// `append`: goes on with the table of that header which is there.
  Table(const std::string& file, const std::string& header, bool append = false);

  void append(const std::string& row);

  /// Takes over the rows of an earlier table up to a step of a branch, which are in its columns `step` and
  /// `branch`. Throws std::invalid_argument, one line, where that table has another header.
  void copyFrom(const std::string& file, const RestartPlace& last);

 private:
  std::string file_, header_;
  bool writes_;
  std::ofstream out_;
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

/// points.csv: one row per limit or bifurcation point.
struct PointRow {
  int step = 0, branch = 0;
  double pathLength = 0, loadFactor = 0;
  std::string kind;
  int negativeChange = 0, nullity = 0;
  double uncertainty = 0;
  std::vector<double> monitors{};
};
std::string pointHeader(const std::vector<std::string>& monitors);
std::string text(const PointRow& row);

}  // namespace atrapos
