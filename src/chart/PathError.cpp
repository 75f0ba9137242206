#include "chart/PathError.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "atrapos/formula/Builder.hpp"
#include "atrapos/formula/Parse.hpp"
#include "output/TableFile.hpp"

namespace atrapos::chart {
namespace {

/// Points of a stretch without corners.
struct Stretch {
  std::vector<double> x, y;

  /// Cubics through the points next to it.
  double at(double place) const {
    const std::size_t n = x.size();
    const auto above = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), place) - x.begin());
    const std::size_t i = std::clamp<std::size_t>(above, 1, std::max<std::size_t>(n, 2) - 1) - 1;
    return n > 2 && isUneven(i) ? limited(i, place) : lagrange(i, place);
  }

  /// Whether lengths next to those between points i and i + 1 differ much, as where a path has a corner: then
  /// polynomials swing.
  bool isUneven(std::size_t i) const {
    constexpr double much = 30;
    const std::size_t from = i > 0 ? i - 1 : i, to = std::min(i + 2, x.size() - 1);
    double least = x[i + 1] - x[i], most = least;
    for (std::size_t k = from; k < to; ++k) {
      least = std::min(least, x[k + 1] - x[k]);
      most = std::max(most, x[k + 1] - x[k]);
    }
    return most > much * least;
  }

  double secant(std::size_t i) const { return (y[i + 1] - y[i]) / (x[i + 1] - x[i]); }

  /// Slope at a point: that of the parabola through its neighbours, limited as Fritsch and Carlson (1980) do,
  /// so that nothing swings between points.
  double slope(std::size_t i) const {
    if (i == 0) return secant(0);
    if (i + 1 == x.size()) return secant(i - 1);
    const double before = secant(i - 1), behind = secant(i), h = x[i] - x[i - 1], k = x[i + 1] - x[i];
    if (before * behind <= 0) return 0;
    const double most = 3 * std::min(std::abs(before), std::abs(behind));
    return std::clamp((k * before + h * behind) / (h + k), -most, most);
  }

  double limited(std::size_t i, double place) const {
    const double h = x[i + 1] - x[i], t = (place - x[i]) / h, d = secant(i), from = slope(i),
                 to = slope(i + 1);
    return y[i] + h * t * (from + t * (3 * d - 2 * from - to + t * (from + to - 2 * d)));
  }

  /// Lagrange's polynomial through the points around i and i + 1, in Neville's form.
  double lagrange(std::size_t i, double place) const {
    const std::size_t n = x.size(), count = std::min<std::size_t>(4, n);
    const std::size_t first = std::min(i < 1 ? 0 : i - 1, n - count);
    std::vector<double> p(y.begin() + static_cast<long>(first), y.begin() + static_cast<long>(first + count));
    for (std::size_t m = 1; m < count; ++m)
      for (std::size_t k = 0; k + m < count; ++k) {
        const double a = x[first + k], b = x[first + k + m];
        p[k] = ((place - b) * p[k] + (a - place) * p[k + 1]) / (a - b);
      }
    return p[0];
  }
};

class OfPoints final : public ReferenceCurve {
 public:
  explicit OfPoints(std::vector<Stretch> stretches) : stretches_(std::move(stretches)) {}
  double operator()(double x) const override {
    for (const Stretch& s : stretches_)
      if (x >= s.x.front() && x <= s.x.back()) return s.at(x);
    return std::numeric_limits<double>::quiet_NaN();
  }

 private:
  std::vector<Stretch> stretches_;
};

class OfFormula final : public ReferenceCurve {
 public:
  explicit OfFormula(const formula::Program& program) : program_(program) {}
  double operator()(double x) const override {
    const double none = 0;
    double result = 0;
    formula::evaluate<double>(program_, &x, &none, &result);
    return result;
  }

 private:
  formula::Program program_;
};

}  // namespace

std::unique_ptr<ReferenceCurve> ReferenceCurve::ofPoints(std::vector<double> x, std::vector<double> y,
                                                         const std::string& what) {
  if (!x.empty() && x.back() < x.front()) {
    std::reverse(x.begin(), x.end());
    std::reverse(y.begin(), y.end());
  }
  std::vector<Stretch> stretches(1);
  for (std::size_t i = 0; i < x.size(); ++i) {
    Stretch* own = &stretches.back();
    if (!own->x.empty() && x[i] == own->x.back()) {
      stretches.emplace_back();
      own = &stretches.back();
    } else if (!own->x.empty() && !(x[i] > own->x.back())) {
      throw std::invalid_argument(fmt::format(
          "{}: {:g} and {:g} are out of order, but what errors are taken over must ascend or descend", what,
          own->x.back(), x[i]));
    }
    if (!std::isfinite(x[i]) || !std::isfinite(y[i]))
      throw std::invalid_argument(fmt::format("{}: row {} holds no numbers", what, i + 1));
    own->x.push_back(x[i]);
    own->y.push_back(y[i]);
  }
  if (stretches.front().x.empty()) throw std::invalid_argument(fmt::format("{}: has no rows", what));
  return std::make_unique<OfPoints>(std::move(stretches));
}

std::unique_ptr<ReferenceCurve> ReferenceCurve::ofPath(const std::string& table, const Chart& chart,
                                                       std::size_t m) {
  const PathRows rows = readPath(table, chart, m);
  std::vector<double> over, monitor;
  for (std::size_t i = 0; i < rows.over.size(); ++i) {
    if (!over.empty() && rows.over[i] == over.back()) continue;
    over.push_back(rows.over[i]);
    monitor.push_back(rows.monitor[i]);
  }
  return ofPoints(std::move(over), std::move(monitor), table);
}

std::unique_ptr<ReferenceCurve> ReferenceCurve::of(const Chart& chart, const std::string& ownPath,
                                                   std::size_t m) {
  const Reference& reference = chart.reference;
  if (!reference.formula.empty()) return ofFormula(reference.formula, chart.over);
  if (reference.file.empty()) return ofPath(ownPath, chart, m);
  const TableFile table(reference.file);
  return ofPoints(table.numbers(reference.x), table.numbers(reference.y.at(m)), reference.file);
}

std::unique_ptr<ReferenceCurve> ReferenceCurve::ofFormula(const std::string& text, const std::string& over) {
  if (!formula::isName(over))
    throw std::invalid_argument(
        fmt::format("'{}' cannot stand in a formula; expected a monitor of another name", over));
  try {
    formula::Builder builder;
    formula::Symbols symbols;
    symbols.scalars[over] = builder.input(0);
    const int result = formula::parse(text, symbols, builder);
    return std::make_unique<OfFormula>(builder.program({result}));
  } catch (const formula::FormulaError& error) {
    throw std::invalid_argument(fmt::format("error/reference/formula: {}", error.what()));
  }
}

PathRows readPath(const std::string& table, const Chart& chart, std::size_t m) {
  const TableFile path(table);
  const auto over = path.numbers(chart.over), monitor = path.numbers(chart.monitors.at(m)),
             branch = path.numbers("branch");
  PathRows rows;
  for (std::size_t i = 0; i < over.size(); ++i) {
    if (branch[i] != 0) continue;
    rows.over.push_back(over[i]);
    rows.monitor.push_back(monitor[i]);
  }
  return rows;
}

PathError errorOf(const PathRows& rows, const std::string& what, const Chart& chart,
                  const ReferenceCurve& reference) {
  PathError error;
  bool compared = false;
  const auto compare = [&](double at, double value) {
    const double exact = reference(at);
    if (std::isnan(exact)) return;
    compared = true;
    const double difference = std::abs(value - exact);
    if (!(difference <= error.largest)) {
      error.largest = difference;
      error.at = at;
    }
  };
  for (std::size_t i = 0; i < rows.over.size(); ++i) compare(rows.over[i], rows.monitor[i]);
  if (chart.between > 0) {
    const auto curve = ReferenceCurve::ofPoints(rows.over, rows.monitor, what);
    const double first = rows.over.front(), range = rows.over.back() - first;
    for (int i = 1; i < chart.between; ++i) {
      const double at = first + range * i / chart.between;
      compare(at, (*curve)(at));
    }
  }
  if (!compared)
    throw std::invalid_argument(fmt::format("{}: the reference knows no {} of the path", what, chart.over));
  return error;
}

PathError errorOf(const std::string& table, const Chart& chart,
                  const std::vector<std::unique_ptr<ReferenceCurve>>& references) {
  PathError largest;
  for (std::size_t m = 0; m < chart.monitors.size(); ++m) {
    const PathRows rows = readPath(table, chart, m);
    PathError error = errorOf(rows, table, chart, *references.at(m));
    if (chart.monitors.size() > 1) {
      const auto [low, high] = std::minmax_element(rows.monitor.begin(), rows.monitor.end());
      if (!(*high > *low))
        throw std::invalid_argument(fmt::format(
            "{}: {} does not change, and has no range to take its error over", table, chart.monitors[m]));
      error.largest /= *high - *low;
    }
    if (m == 0 || !(error.largest <= largest.largest)) largest = error;
  }
  return largest;
}

}  // namespace atrapos::chart
