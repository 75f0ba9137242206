#include "ZoneSearch.hpp"

#include <algorithm>
#include <cmath>

#include "OneLine.hpp"

namespace atrapos::fem {
namespace {

/// Places at which a line is looked at: closely enough that extrema of gaps over smooth tools lie apart.
const std::vector<double>& samples() {
  static const std::vector<double> xi = [] {
    constexpr int inside = 14;
    std::vector<double> all{-1 - kBeyondEnds};
    for (int i = 0; i < inside; ++i) all.push_back(-1 + 2.0 * i / (inside - 1));
    all.push_back(1 + kBeyondEnds);
    return all;
  }();
  return xi;
}

/// The root of f between two places where it has different signs; of(xi) gives f and f'. Newton's method,
/// held in what bisection leaves.
template <class Of>
double bracketedRoot(const Of& of, double from, double to) {
  double low = from, high = to, xi = 0.5 * (from + to);
  const bool rises = of(from).first < 0;
  constexpr int most = 60;
  for (int i = 0; i < most; ++i) {
    const auto [f, rate] = of(xi);
    if (f == 0) return xi;
    ((f < 0) == rises ? low : high) = xi;
    double next = xi - f / rate;
    if (!(next > std::min(low, high) && next < std::max(low, high))) next = 0.5 * (low + high);
    if (std::abs(next - xi) <= 4e-16) return next;
    xi = next;
  }
  return xi;
}

}  // namespace

std::vector<GapShape> gapShapes(const LineLaws& laws, const double* c, double lambda) {
  const auto& places = samples();
  const int Q = static_cast<int>(places.size()), C = laws.coefficients();
  std::vector<double> xi;
  for (const double place : places) xi.insert(xi.end(), L, place);
  const LineProbe p = probe(laws, Q, xi.data(), c, lambda);
  std::vector<GapShape> shapes(L);
  for (int lane = 0; lane < L; ++lane) {
    GapShape& shape = shapes[lane];
    shape.ends[0] = p.gap[1 * L + lane];
    shape.ends[1] = p.gap[(Q - 2) * L + lane];
    std::vector<double> own(C);
    for (int m = 0; m < C; ++m) own[m] = c[m * L + lane];
    double steepest = 0;
    for (int q = 0; q < Q; ++q) steepest = std::max(steepest, std::abs(p.slope[q * L + lane]));
    // A line that follows the tool has extrema by rounding only.
    if (!(steepest > 1e-9 * std::hypot(own[3], own[4], own[5]))) continue;
    const OneLine line(laws, own.data(), lambda);
    const auto slope = [&](double at) {
      const auto f = line(at);
      return std::pair(f.slope, f.bend);
    };
    for (int q = 0; q + 1 < Q; ++q) {
      const double left = p.slope[q * L + lane], right = p.slope[(q + 1) * L + lane];
      if (std::isinf(p.gap[q * L + lane]) || std::isinf(p.gap[(q + 1) * L + lane])) continue;
      if (!((left < 0) != (right < 0))) continue;
      const double at = bracketedRoot(slope, places[q], places[q + 1]);
      shape.extrema.push_back({at, line(at).gap, left < 0});
    }
  }
  return shapes;
}

const std::vector<GapShape>& KnownShapes::of(const LineLaws& laws, int batch, const double* c,
                                             double lambda) {
  Batch& own = of_[batch];
  for (const Known& known : own.states)
    if (!known.c.empty() && known.lambda == lambda && std::equal(known.c.begin(), known.c.end(), c))
      return known.shapes;
  Known& known = own.states[own.next];
  own.next = (own.next + 1) % kStates;
  known = {{c, c + laws.coefficients() * L}, lambda, gapShapes(laws, c, lambda)};
  return known.shapes;
}

double rootBetween(const LineLaws& laws, const double* c, double lambda, double from, double to) {
  const OneLine line(laws, c, lambda);
  return bracketedRoot([&](double at) { return line.gapAndSlope(at); }, from, to);
}

std::optional<double> rootNear(const LineLaws& laws, const double* c, double lambda, double from,
                               double within) {
  const OneLine line(laws, c, lambda);
  double xi = from;
  constexpr int most = 30;
  for (int i = 0; i < most; ++i) {
    const auto [gap, slope] = line.gapAndSlope(xi);
    const double next = xi - gap / slope;
    if (!(std::abs(next - from) < within)) return std::nullopt;
    if (std::abs(next - xi) <= 4e-16) return next;
    xi = next;
  }
  return xi;
}

}  // namespace atrapos::fem
