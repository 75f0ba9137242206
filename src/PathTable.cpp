#include "PathTable.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "Files.hpp"

namespace atrapos {

PathTable::PathTable(const std::string& file, const std::vector<std::string>& monitors)
    : file_(file), out_(file, std::ios::trunc) {
  out_ << "step,path_length,load_factor";
  for (const auto& name : monitors) out_ << ',' << name;
  out_ << ",residual\n";
  out_.flush();
  if (!out_) throw std::runtime_error(fmt::format("{}: cannot be written", file));
}

void PathTable::append(int step, double pathLength, double loadFactor, const std::vector<double>& monitors,
                       double residual) {
  // 17 digits: a double read back is the same double.
  std::string row = fmt::format("{},{:.17g},{:.17g}", step, pathLength, loadFactor);
  for (double m : monitors) row += fmt::format(",{:.17g}", m);
  out_ << row << fmt::format(",{:.3e}\n", residual);
  out_.flush();
  if (!out_) throw std::runtime_error(fmt::format("{}: cannot be written (disk full?)", file_));
}

std::string plotPath(const std::string& directory, const std::string& title,
                     const std::vector<std::string>& monitors) {
  const auto quoted = [](std::string text) {
    std::replace(text.begin(), text.end(), '"', '\'');
    std::replace(text.begin(), text.end(), '\\', '/');
    return text;
  };
  const int plots = std::max<int>(1, static_cast<int>(monitors.size()));
  const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(plots))));
  const int rows = (plots + columns - 1) / columns;
  std::string script = fmt::format(
      "set terminal pngcairo noenhanced size {},{} font 'sans,11'\nset output 'path.png'\n"
      "set datafile separator ','\nset grid\nset key off\nset multiplot layout {},{} title \"{}\"\n"
      "set ylabel 'load factor'\n",
      480 * columns, 400 * rows + 40, rows, columns, quoted(title));
  // Every output point is a dot of the line; the ends of steps are circles.
  const auto panel = [&](int column, const std::string& name) {
    script += fmt::format(
        "set xlabel \"{}\"\nplot 'path.csv' skip 1 using {}:3 with lines lw 2 lc rgb '#1f5fa8', \\\n"
        "  '' skip 1 using {}:3:($1) with points pt 7 ps 0.4 lc rgb '#1f5fa8'\n",
        quoted(name), column, column);
  };
  if (monitors.empty()) panel(2, "path length");
  for (std::size_t m = 0; m < monitors.size(); ++m) panel(4 + static_cast<int>(m), monitors[m]);
  script += "unset multiplot\n";
  replaceFile(directory + "/path.gp", script);

  std::string shellSafe = "'";
  for (char c : directory) shellSafe += c == '\'' ? std::string("'\\''") : std::string(1, c);
  shellSafe += "'";
  const int status = std::system(("cd " + shellSafe + " && gnuplot path.gp >/dev/null 2>&1").c_str());
  if (status == -1 || !WIFEXITED(status)) return "path.png not drawn: gnuplot could not be started";
  if (WEXITSTATUS(status) == 127) return "path.png not drawn: gnuplot is not installed (path.gp draws it)";
  if (WEXITSTATUS(status) != 0) return "path.png not drawn: gnuplot failed (see path.gp)";
  return "";
}

}  // namespace atrapos
