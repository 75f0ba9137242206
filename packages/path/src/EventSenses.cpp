#include "EventSenses.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <Tpetra_Vector.hpp>

#include "PathUnderWay.hpp"

namespace atrapos::path {

namespace {

/// max |c_k| length^k over 1 <= k < count.
double size(const std::vector<double>& c, double length, std::size_t count) {
  double largest = 0, power = length;
  for (std::size_t k = 1; k < count; ++k, power *= length)
    largest = std::max(largest, std::abs(c[k]) * power);
  return largest;
}

/// How far a function is looked at, `length` at most: no farther than its own series converges, whose later
/// terms are then not the largest. That of the unknowns may reach much farther, as where a body moves as a
/// whole past a curved tool.
double within(const std::vector<double>& c, double length) {
  const std::size_t half = (c.size() + 1) / 2;
  constexpr int most = 200;
  for (int i = 0; i < most && largestTerm(c, length) > size(c, length, half); ++i) length *= 0.5;
  return length;
}

/// Whether a function that is zero at a = 0, as its first derivatives are below `first`, rises in a sense
/// (+1, -1), looked at on this length; what is below `noise` counts as zero.
bool rises(const std::vector<double>& c, double sense, double length, double noise, std::size_t first = 1) {
  length = within(c, length);
  const double small = std::max(noise, 1e-9 * largestTerm(c, length));
  double power = std::pow(length, first);
  for (std::size_t k = first; k < c.size(); ++k, power *= length)
    if (std::abs(c[k]) * power > small) return (k % 2 == 1 ? sense : 1) * c[k] > 0;
  return true;  // stays zero: nothing is violated
}

/// Whether a function that is known by its growth falls at a = 0, by what counts before it turns.
bool fallsFromTheStart(const std::vector<double>& c, double reach, double negligible) {
  if (!(c[1] * reach < -1e-9 * largestTerm(c, reach))) return false;
  // What is small grows exponentially, and a rational series reaches farther.
  const double length = 2 * reach;
  const bool turns = c.size() > 2 && c[2] > 0 && -c[1] < 2 * c[2] * length;
  return (turns ? 0.25 * c[1] * c[1] / c[2] : largestTerm(c, within(c, length))) > negligible;
}

/// The length on which senses are looked at. At a start no step says how long steps are, and a series that is
/// a polynomial (bars that unload) reaches as far as one likes, where first derivatives are lost beside
/// higher ones: there the nearest load factor that is a stop says it.
double reachOf(const PathUnderWay& path, const Series& series) {
  double reach = std::min(series.radius(path.options.delta), path.options.maxStep.value_or(defaultMaxStep));
  if (path.here.tangent) return reach;
  for (const double lambda : path.stops.loadFactors)
    if (const double a = std::abs((lambda - path.here.state.lambda) / series.lambdaCoefficient(1)); a > 0)
      reach = std::min(reach, a);
  return reach;
}

}  // namespace

double largestTerm(const std::vector<double>& c, double a) { return size(c, a, c.size()); }

double lastTerms(const std::vector<double>& c, double a) {
  double last = 0, power = a;
  for (std::size_t k = 1; k < c.size(); ++k, power *= a)
    if (k + 2 >= c.size()) last = std::max(last, std::abs(c[k]) * power);
  return last;
}

bool converges(const std::vector<double>& c, double a, double part) {
  return !(within(c, a) < a) && lastTerms(c, a) <= part * sizeOfTerms(c, a);
}

double sizeOfTerms(const std::vector<double>& c, double a) {
  return std::max(std::abs(c[0]), largestTerm(c, within(c, a)));
}

Polynomial eventPolynomial(const Series& series, int i, const std::vector<int>& zero) {
  auto c = series.eventCoefficients(i);
  if (std::find(zero.begin(), zero.end(), i) != zero.end()) c[0] = 0;
  return Polynomial(std::move(c));
}

std::vector<int> falling(const PathUnderWay& path, const Series& series, const std::vector<int>& candidates,
                         double sense, const std::vector<int>& flat) {
  const double reach = reachOf(path, series);
  const int functions = series.eventCount();
  std::map<int, double> sizes;  ///< of the functions
  for (const int i : candidates)
    if (i < functions) {
      const auto c = series.eventCoefficients(i);
      sizes[i] = largestTerm(c, within(c, reach));
    }
  double largest = 0;
  for (const auto& [i, own] : sizes) largest = std::max(largest, own);
  constexpr double rounding = 1e-12;
  // Far enough to tell the pieces apart, near enough for the sense that the path starts in.
  constexpr double ahead = 1e-3;
  State place;
  std::vector<int> violated;
  for (const int i : candidates) {
    if (i < functions) {
      if (series.eventGrows(i) && sizes[i] <= series.negligibleFall(i)) continue;
      const std::size_t first = std::binary_search(flat.begin(), flat.end(), i) ? 2 : 1;
      if (!rises(series.eventCoefficients(i), sense, reach, rounding * largest, first)) violated.push_back(i);
      continue;
    }
    if (place.u.is_null())
      place = series.state(sense * ahead * (std::isfinite(reach) ? reach : path.here.lastLength));
    if (!path.calls.continues(place, i)) violated.push_back(i);
  }
  return violated;
}

std::vector<int> overdue(const PathUnderWay& path, const Series& series) {
  const double reach = reachOf(path, series);
  std::vector<int> due;
  for (int i = 0; i < series.eventCount(); ++i) {
    const Polynomial p = eventPolynomial(series, i, path.here.applied);
    const auto& c = p.coefficients();
    if (series.eventGrows(i) ? fallsFromTheStart(c, reach, series.negligibleFall(i))
                             : c[0] < 0 && !rises(c, 1, reach, 0))
      due.push_back(i);
  }
  return due;
}

}  // namespace atrapos::path
