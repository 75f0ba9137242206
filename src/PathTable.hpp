#pragma once

#include <fstream>
#include <string>
#include <vector>

namespace atrapos {

/// path.csv: one row per output point, on disk when append returns.
class PathTable {
 public:
  PathTable(const std::string& file, const std::vector<std::string>& monitors);

  void append(int step, double pathLength, double loadFactor, const std::vector<double>& monitors,
              double residual);

 private:
  std::string file_;
  std::ofstream out_;
};

/// Draws path.csv as path.png with gnuplot: the load factor over each monitor. The script stays beside the
/// table as path.gp. Returns an empty text, or one line that says why there is no picture.
std::string plotPath(const std::string& directory, const std::string& title,
                     const std::vector<std::string>& monitors);

}  // namespace atrapos
