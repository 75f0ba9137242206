#include "chart/ChartPlot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "output/Files.hpp"
#include "output/Gnuplot.hpp"

namespace atrapos::chart {
namespace {

/// A range of an axis with some room beside what stands there.
std::string range(const char* axis, const std::vector<PlottedCurve>& curves,
                  std::vector<double> PlottedCurve::*values) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const PlottedCurve& curve : curves)
    for (const double value : curve.*values) {
      least = std::min(least, value);
      most = std::max(most, value);
    }
  if (most == 0) return "";
  constexpr double room = 1.6, decades = 100;
  std::string text = fmt::format("set {}range [{:.6g}:{:.6g}]\n", axis, least / room, most * room);
  if (most / least > decades) return text + fmt::format("set {}tics autofreq\n", axis);
  // Powers of ten alone would be one number or none.
  std::string tics;
  for (int power = -12; power < 12; ++power)
    for (const int digit : {1, 2, 5}) {
      const double at = digit * std::pow(10.0, power);
      if (at > least / room && at < most * room) tics += fmt::format("{}{:g}", tics.empty() ? "" : ", ", at);
    }
  return text + fmt::format("set {}tics ({})\n", axis, tics);
}

std::string styleOf(std::size_t curve) {
  return fmt::format("with linespoints lw 2 pt {} ps 1 lc rgb '{}'", 4 + curve % 10, plotColour(curve));
}

std::string panel(const std::vector<PlottedCurve>& curves, bool inSeconds, double origin) {
  std::string plots;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const auto& work = inSeconds ? curves[c].seconds : curves[c].factorizations;
    if (work.empty() || curves[c].errors.empty()) continue;
    plots += fmt::format("{}$curve_{} using {}:3 notitle {}", plots.empty() ? "" : ", \\\n  ", c,
                         inSeconds ? 1 : 2, styleOf(c));
  }
  return range("x", curves, inSeconds ? &PlottedCurve::seconds : &PlottedCurve::factorizations) +
         range("y", curves, &PlottedCurve::errors) +
         fmt::format("set size 0.5,0.8\nset origin {},0.16\nset xlabel '{}'\nplot {}\n", origin,
                     inSeconds ? "seconds" : "factorizations", plots.empty() ? "1/0 notitle" : plots);
}

/// Rows of names below the panels.
std::string legend(const std::vector<PlottedCurve>& curves) {
  std::string plots;
  for (std::size_t c = 0; c < curves.size(); ++c)
    plots +=
        fmt::format("{}1/0 title {} {}", c == 0 ? "" : ", \\\n  ", gnuplotText(curves[c].name), styleOf(c));
  return "set size 1,0.16\nset origin 0,0\nset lmargin 0\nset rmargin 0\nset tmargin 0\nset bmargin 0\nunset "
         "border\n"
         "unset tics\nunset grid\nunset xlabel\nunset ylabel\nunset logscale\nset xrange [0:1]\nset yrange "
         "[0:1]\n"
         "set key center center horizontal maxcols 3 Left reverse samplen 2.5\nplot " +
         plots + '\n';
}

}  // namespace

std::string plotChart(const std::string& title, const std::string& errorLabel,
                      const std::vector<PlottedCurve>& curves, const std::string& folder,
                      const std::string& name) {
  std::string data;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    data += fmt::format("$curve_{} << EOD\n", c);
    for (std::size_t i = 0; i < curves[c].errors.size(); ++i)
      data += fmt::format(
          "{:.6g} {} {:.6g}\n", curves[c].seconds[i],
          curves[c].factorizations.empty() ? "NaN" : fmt::format("{:g}", curves[c].factorizations[i]),
          curves[c].errors[i]);
    data += "EOD\n";
  }
  const auto drawing = [&](const std::string& file) {
    return pictureHead(file, title) +
           fmt::format("set logscale xy\nset format y '%.0e'\nset ylabel {}\n", gnuplotText(errorLabel)) +
           panel(curves, true, 0) + panel(curves, false, 0.5) + legend(curves) +
           "unset multiplot\nset output\n";
  };
  constexpr int width = 980, height = 560;
  replaceFile(folder + '/' + name + ".gp", pictureScript(name, width, height, data, drawing));
  return runGnuplot(folder, name + ".gp");
}

}  // namespace atrapos::chart
