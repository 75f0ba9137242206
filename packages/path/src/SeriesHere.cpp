#include "SeriesHere.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Tpetra_Vector.hpp>

#include "EventSenses.hpp"
#include "PathUnderWay.hpp"
#include "Rounded.hpp"

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

/// An end that a series may reach with fewer orders: an event, a stop or the longest length allowed.
class NearEnd {
 public:
  NearEnd(const PathUnderWay& path, const std::vector<int>& zero) : path_(path), zero_(zero) {}

  /// Whether the orders so far lead to one, with next to no remainder.
  bool isReachedBy(const Series& soFar);

  /// Whether the event functions there are what these orders say, looked at where one is silent: none has
  /// fallen below zero that they do not show, as one may that begins with a high power of a.
  bool eventsHold() const;

 private:
  std::optional<Series> admissible(const Series& series) const;
  bool tellsEvents(const Series& series);

  const PathUnderWay& path_;
  const std::vector<int>& zero_;
  int nextLook_ = leastOrder;   ///< order at which it is looked for again
  Trial trial_;                 ///< the step to it
  std::vector<double> small_;   ///< what event functions may be off by there
  bool silent_ = false;         ///< the orders of one of them say nothing about what comes behind them
  std::vector<double> offset_;  ///< what is left of those that are zero at the start
};

/// The series in the sense in which none of the functions that are zero falls below zero.
std::optional<Series> NearEnd::admissible(const Series& series) const {
  if (zero_.empty() || falling(path_, series, zero_, 1).empty()) return series;
  if (path_.here.tangent && falling(path_, series, zero_, -1).empty()) return series.reversed();
  return std::nullopt;
}

bool NearEnd::isReachedBy(const Series& soFar) {
  if (soFar.order() < nextLook_) return false;
  const auto series = admissible(soFar);
  if (!series) return false;
  const double radius = series->radius(path_.options.delta), longest = path_.longestLength();
  trial_.a = rounded(std::min(radius, longest));
  limit(path_, *series, trial_, zero_);
  const bool onPath = trial_.stop || !trial_.events.empty();
  if (!onPath && radius < longest) return false;  // more orders would go further
  if (!tellsEvents(*series)) return false;
  evaluate(path_, *series, trial_);
  const double start = path_.here.startPart(trial_.a), part = trial_.stop ? marginAtStops : margin;
  const double allowed = std::min(path_.correctAbove(), (onPath ? start : 0) + part * path_.bound());
  if (trial_.residual <= allowed) return !astray(path_, trial_);
  if (allowed <= start) {
    nextLook_ = path_.order;
  } else {
    const double ratio = trial_.a / series->convergenceRadius();
    nextLook_ = soFar.order() + ordersFor((trial_.residual - start) / (allowed - start), ratio);
  }
  return false;
}

/// Whether the orders so far tell where event functions vanish up to the end: one that may vanish has next to
/// no remainder there.
bool NearEnd::tellsEvents(const Series& series) {
  const double radius = series.convergenceRadius();
  std::vector<Course> courses;
  double largest = 0;
  silent_ = false;
  for (int i = 0; i < series.eventCount(); ++i) {
    const Polynomial p = eventPolynomial(series, i, zero_);
    silent_ = silent_ || isSilent(p, radius);
    courses.emplace_back(p, trial_.a);
    largest = std::max(largest, courses.back().size);
  }
  constexpr double rounding = 1e-12;
  small_.clear();
  offset_.clear();
  for (int i = 0; i < series.eventCount(); ++i) {
    const Course& c = courses[i];
    const double small = path_.options.delta * c.size;
    if (!c.vanishesNowhere() && c.remainder > std::max(margin * small, rounding * largest)) return false;
    small_.push_back(std::max(small, rounding * largest));
    offset_.push_back(series.eventCoefficients(i)[0] - c.first);
  }
  return true;
}

bool NearEnd::eventsHold() const {
  if (!silent_) return true;
  Calls& calls = path_.calls;
  std::vector<double> g;
  try {
    calls.beginSeries(trial_.state, path_.order);
    g = calls.eventOrder(0);
    if (calls.hasPieces())
      calls.beginSeries(path_.here.state, path_.order);  // its pieces are still asked for
  } catch (const PathError&) {
    return false;
  }
  for (std::size_t i = 0; i < g.size(); ++i)
    if (g[i] - offset_[i] < -small_[i]) return false;
  for (const int i : trial_.events)
    if (g[i] - offset_[i] > small_[i]) return false;
  return true;
}

}  // namespace

Series seriesHere(const PathUnderWay& path, SeriesRequest request, const std::vector<int>& zero) {
  const Position& here = path.here;
  request.order = path.order;
  request.mayOverflow = true;
  request.weight = here.weight;
  request.direction = path.options.direction;
  request.previous = here.tangent ? &*here.tangent : nullptr;
  // The sense that a break allows is told further ahead than its next end may be.
  const auto known = [&](int i) { return !path.isBreak(i); };
  NearEnd end(path, zero);
  // What a state remembers is known when the series is whole.
  if (path.options.fewerOrders && !path.calls.problem().remembers() &&
      std::all_of(zero.begin(), zero.end(), known))
    request.enough = [&](const Series& soFar) { return end.isReachedBy(soFar); };
  Series series = buildSeries(path.calls, here.state, request);
  if (!path.endsEarly(series) || end.eventsHold()) return series;
  request.enough = nullptr;
  request.factored = true;
  return buildSeries(path.calls, here.state, request);
}

}  // namespace atrapos::path
