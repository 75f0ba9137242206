#include "Table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace atrapos::bench {

double Row::fractionOfBound(const Peaks& peaks) const {
  double us = usefulFlops / peaks.gflops * 1e-3;
  if (footprint > static_cast<double>(lastCacheBytes())) us = std::max(us, bytes / peaks.readGBs * 1e-3);
  return us / usPerPoint;
}

double speedupVsSacado(const Row& row, const std::vector<Row>& all) {
  for (const Row& r : all)
    if (r.method == "sacado" && r.law == row.law && r.order == row.order)
      return r.usPerPoint / row.usPerPoint;
  return 0;
}

std::string tableHeader() {
  return fmt::format("{:<23}{:>6}{:>9}  {:<15}{:>13}{:>9}{:>9}{:>12}{:>12}{:>10}", "law", "order", "points",
                     "method", "us_per_point", "gflops", "GB/s", "vs_sacado", "B/pt/order", "of_bound");
}

std::string tableLine(const Row& row, const std::vector<Row>& all, const Peaks& peaks) {
  const double speedup = speedupVsSacado(row, all);
  std::string line = fmt::format("{:<23}{:>6}{:>9}  {:<15}{:>13.4g}{:>9.3g}{:>9.3g}{:>12}", row.law,
                                 row.order, row.points, row.method, row.usPerPoint, row.gflops(),
                                 row.gbytesPerSecond(), speedup > 0 ? fmt::format("{:.4g}", speedup) : "-");
  if (row.boundApplies)
    line += fmt::format("{:>12.0f}{:>10.2f}", row.bytes / (row.order + 1), row.fractionOfBound(peaks));
  return line;
}

void writeCsv(const std::string& file, const std::vector<Row>& rows) {
  std::ofstream out(file);
  out << "law,order,points,method,us_per_point,gflops,gbytes_per_s,speedup_vs_sacado\n";
  for (const Row& row : rows)
    out << fmt::format("{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g}\n", row.law, row.order, row.points,
                       row.method, row.usPerPoint, row.gflops(), row.gbytesPerSecond(),
                       speedupVsSacado(row, rows));
  if (!out.flush()) throw std::runtime_error(file + ": cannot be written");
}

}  // namespace atrapos::bench
