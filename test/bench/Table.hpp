#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "Machine.hpp"

namespace atrapos::bench {

/// One line of the table.
struct Row {
  std::string law;
  int order = 0;
  std::size_t points = 0;
  std::string method;
  double usPerPoint = 0;      ///< one core, all orders 0..order
  double usefulFlops = 0;     ///< a point, all orders (OperationCount.hpp)
  double bytes = 0;           ///< a point, all orders: histories (peers: input series) read and written
  double footprint = 0;       ///< bytes that all points' histories (input series) take
  bool boundApplies = false;  ///< atrapos and hand: their bytes are what must be moved

  double gflops() const { return usefulFlops / usPerPoint * 1e-3; }
  double gbytesPerSecond() const { return bytes / usPerPoint * 1e-3; }
  /// Least time over the time taken, in (0, 1]: arithmetic at the peak, and what is out of cache at the read
  /// rate.
  double fractionOfBound(const Peaks& peaks) const;
};

/// How many times faster than Sacado re-evaluated at every order, of the same law and order; 0 where that was
/// not run.
double speedupVsSacado(const Row& row, const std::vector<Row>& all);

std::string tableHeader();
std::string tableLine(const Row& row, const std::vector<Row>& all, const Peaks& peaks);

/// Header and one line a row; throws std::runtime_error where the file cannot be written.
void writeCsv(const std::string& file, const std::vector<Row>& rows);

}  // namespace atrapos::bench
