#include "output/PathPlot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "machine/Ranks.hpp"
#include "output/Files.hpp"
#include "output/Gnuplot.hpp"

namespace atrapos {
namespace {

const char* colour(int branch) {
  static const char* colours[] = {"#1f5fa8", "#c0392b", "#2e8b57", "#8e44ad",
                                  "#d68910", "#117a8b", "#7f8c8d"};
  return colours[branch % 7];
}

/// One panel; columns of path.csv and points.csv that are its abscissa.
std::string panel(const std::string& name, int column, int pointColumn, int stability, int branches) {
  std::string script = fmt::format("set xlabel {}\nplot ", gnuplotText(name));
  for (int b = 0; b < branches; ++b) {
    const auto curve = [&](const std::string& where, const std::string& style) {
      script += fmt::format("'path.csv' skip 1 using {}:(${} == {}{} ? $3 : NaN) {} lc rgb '{}', \\\n  ",
                            column, stability + 1, b, where, style, colour(b));
    };
    // A thin line through everything, a thick one where the state is stable or nothing is known: NaN breaks
    // it at the others, as long as NaN is not declared to be a missing value.
    curve("", "with lines lw 1 dt 3");
    curve(fmt::format(" && ${} <= 0", stability), "with lines lw 2");
    curve("", "with points pt 7 ps 0.3");
  }
  // Bifurcation points have null vectors, limit points have none.
  script += fmt::format(
      "'points.csv' skip 1 using {0}:($7 > 0 ? $4 : NaN) with points pt 5 ps 1 lc rgb 'black', \\\n"
      "  '' skip 1 using {0}:(strcol(5) eq 'maximum' || strcol(5) eq 'minimum' ? $4 : NaN) with points pt 6 "
      "ps 1.2 lc rgb 'black'\n",
      pointColumn);
  return script;
}

}  // namespace

std::string plotPath(const std::string& directory, const std::string& title,
                     const std::vector<std::string>& monitors, int branches) {
  if (!ranks::isFirst()) return "";
  constexpr int most = 36;  // more are neither seen nor drawn in a second
  const int shown = std::min<int>(most, static_cast<int>(monitors.size())), plots = std::max(1, shown);
  const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(plots))));
  const int rows = (plots + columns - 1) / columns;
  std::string script = fmt::format(
      "set terminal pngcairo noenhanced size {},{} font 'sans,11'\nset output 'path.png'\n"
      "set encoding utf8\nset datafile separator ','\nset grid\nset key off\n"
      "set multiplot layout {},{} title {}\nset ylabel 'load factor'\n",
      480 * columns, 400 * rows + 40, rows, columns, gnuplotText(title));
  const int stability = 4 + static_cast<int>(monitors.size());
  if (monitors.empty()) script += panel("path length", 2, 3, stability, branches);
  for (int m = 0; m < shown; ++m) script += panel(monitors[m], 4 + m, 9 + m, stability, branches);
  script += "unset multiplot\n";
  replaceFile(directory + "/path.gp", script);

  const std::string why = runGnuplot(directory, "path.gp");
  if (!why.empty()) return "path.png not drawn: " + why;
  return shown == static_cast<int>(monitors.size())
             ? ""
             : fmt::format("path.png shows the first {} of {} monitors", shown, monitors.size());
}

}  // namespace atrapos
