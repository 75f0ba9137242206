#include <algorithm>
#include <cmath>

#include "Run.hpp"

namespace atrapos::path {

namespace {

/// Below it the estimates have too little to go by.
constexpr int leastOrder = 4;
/// Of delta and of the residual bound: what a series that ends early may leave out. An order makes the
/// remainder about ten times smaller: two of them leave the state behind an event all its room under the
/// bound.
constexpr double margin = 1e-2;
/// The state at a stop is looked at most, and a path has one.
constexpr double marginAtStops = 1e-5;

/// An event function on (0, end] by the orders known.
struct Course {
  double first = 0;      ///< its value at 0
  double change = 0;     ///< sum |c_j| end^j over j >= 1
  double size = 0;       ///< max |c_j| end^j over j >= 0
  double remainder = 0;  ///< the larger of the last two terms: those of even and odd functions vanish in turn

  Course(const Polynomial& p, double end) : first(p(0)), size(std::abs(first)) {
    const auto& c = p.coefficients();
    double power = end;
    for (std::size_t j = 1; j < c.size(); ++j, power *= end) {
      const double term = std::abs(c[j]) * power;
      change += term;
      size = std::max(size, term);
      if (j + 2 >= c.size()) remainder = std::max(remainder, term);
    }
  }

  bool vanishesNowhere() const { return first > change + remainder; }
};

/// Whether the last two orders say nothing at the radius of convergence, where those of most functions are of
/// one size: what comes behind them may be anything.
bool isSilent(const Polynomial& p, double radius) {
  if (!std::isfinite(radius)) return true;
  constexpr double nothing = 1e-6;
  const auto& c = p.coefficients();
  double largest = 0, last = 0, power = radius;
  for (std::size_t j = 1; j < c.size(); ++j, power *= radius) {
    const double term = std::abs(c[j]) * power;
    largest = std::max(largest, term);
    if (j + 2 >= c.size()) last = std::max(last, term);
  }
  return !(last > nothing * largest);
}

/// How many orders more make a residual so small that falls by a / radius of convergence each.
int ordersFor(double tooLarge, double ratio) {
  if (!(ratio > 0 && ratio < 1) || !std::isfinite(tooLarge)) return 1;
  constexpr double most = 100;
  return static_cast<int>(std::clamp(std::ceil(-std::log(tooLarge) / std::log(ratio)), 1.0, most));
}

}  // namespace

/// The series at the state, with as many orders as its end asks for; the functions `zero` are zero at its
/// start.
Series Run::seriesTo(SeriesRequest request, const std::vector<int>& zero) {
  request.order = order_;
  request.mayOverflow = true;
  request.weight = weight_;
  request.direction = options_.direction;
  request.previous = tangent_ ? &*tangent_ : nullptr;
  // The sense that a break allows is told further ahead than its next end may be.
  const auto known = [&](int i) { return !isBreak(i); };
  NearEnd end;
  end.nextLook = leastOrder;
  // What a state remembers is known when the series is whole.
  if (options_.fewerOrders && !calls_.problem().remembers() && std::all_of(zero.begin(), zero.end(), known))
    request.enough = [&](const Series& soFar) {
      return soFar.order() >= end.nextLook && reachesEnd(soFar, zero, end);
    };
  Series series = buildSeries(calls_, outcome_.final, request);
  if (!endsEarly(series) || eventsHold(end)) return series;
  request.enough = nullptr;
  request.factored = true;
  return buildSeries(calls_, outcome_.final, request);
}

/// The series in the sense in which none of the functions `zero` falls below zero.
std::optional<Series> Run::admissible(const Series& series, const std::vector<int>& zero) {
  if (zero.empty() || falling(series, zero, 1).empty()) return series;
  if (tangent_ && falling(series, zero, -1).empty()) return series.reversed();
  return std::nullopt;
}

/// Whether the orders so far lead to an event, a stop or the longest length allowed, with next to no
/// remainder.
bool Run::reachesEnd(const Series& soFar, const std::vector<int>& zero, NearEnd& end) {
  const auto series = admissible(soFar, zero);
  if (!series) return false;
  const double radius = series->radius(options_.delta), longest = longestLength();
  Trial& trial = end.trial;
  trial.a = rounded(std::min(radius, longest));
  limit(*series, trial, zero);
  const bool onPath = trial.stop || !trial.events.empty();
  if (!onPath && radius < longest) return false;  // more orders would go further
  if (!tellsEvents(*series, zero, end)) return false;
  evaluate(*series, trial);
  const double start = startPart(trial.a), part = trial.stop ? marginAtStops : margin;
  const double allowed = std::min(correctAbove(), (onPath ? start : 0) + part * bound());
  if (trial.residual <= allowed) return !astray(trial);
  if (allowed <= start) {
    end.nextLook = order_;
  } else {
    const double ratio = trial.a / series->convergenceRadius();
    end.nextLook = soFar.order() + ordersFor((trial.residual - start) / (allowed - start), ratio);
  }
  return false;
}

/// Whether the orders so far tell where event functions vanish up to the end: one that may vanish has next to
/// no remainder there.
bool Run::tellsEvents(const Series& series, const std::vector<int>& zero, NearEnd& end) const {
  const double radius = series.convergenceRadius();
  std::vector<Course> courses;
  double largest = 0;
  end.silent = false;
  for (int i = 0; i < series.eventCount(); ++i) {
    const Polynomial p = eventPolynomial(series, i, zero);
    end.silent = end.silent || isSilent(p, radius);
    courses.emplace_back(p, end.trial.a);
    largest = std::max(largest, courses.back().size);
  }
  constexpr double rounding = 1e-12;
  end.small.clear();
  end.offset.clear();
  for (int i = 0; i < series.eventCount(); ++i) {
    const Course& c = courses[i];
    const double small = options_.delta * c.size;
    if (!c.vanishesNowhere() && c.remainder > std::max(margin * small, rounding * largest)) return false;
    end.small.push_back(std::max(small, rounding * largest));
    end.offset.push_back(series.eventCoefficients(i)[0] - c.first);
  }
  return true;
}

/// Whether the event functions at the end of a series with fewer orders are what these say, looked at where
/// one is silent: none has fallen below zero that they do not show, as one may that begins with a high power
/// of a.
bool Run::eventsHold(const NearEnd& end) {
  if (!end.silent) return true;
  const Trial& trial = end.trial;
  std::vector<double> g;
  try {
    calls_.beginSeries(trial.state, order_);
    g = calls_.eventOrder(0);
    if (calls_.hasPieces()) calls_.beginSeries(outcome_.final, order_);  // its pieces are still asked for
  } catch (const PathError&) {
    return false;
  }
  for (std::size_t i = 0; i < g.size(); ++i)
    if (g[i] - end.offset[i] < -end.small[i]) return false;
  for (const int i : trial.events)
    if (g[i] - end.offset[i] > end.small[i]) return false;
  return true;
}

}  // namespace atrapos::path
