#include "atrapos/path/Stops.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace atrapos::path {

void Stops::validate() const {
  for (const double value : loadFactors)
    if (!std::isfinite(value))
      throw std::invalid_argument("path stops: a load factor is not a finite number");
  for (const auto& f : functionals) {
    if (f.weights.is_null())
      throw std::invalid_argument("path stops: functional '" + f.name + "' has no weights");
    if (!std::isfinite(f.value))
      throw std::invalid_argument("path stops: functional '" + f.name + "' has no finite value");
  }
  if (!(pathLength > 0)) throw std::invalid_argument("path stops: the path length must be positive");
  if (limitPoints < 0 || bifurcations < 0)
    throw std::invalid_argument("path stops: numbers of limit and bifurcation points must not be negative");
}

namespace {

std::string reached(const std::string& what, double value) {
  std::ostringstream text;
  text.precision(12);
  text << what << ' ' << value << " reached";
  return text.str();
}

constexpr const char* kLoadFactor = "load factor";
constexpr const char* kPathLength = "path length";

/// First root of p - value in (0, end].
std::optional<double> firstRoot(const Rational& p, double value, double end, bool atStart) {
  auto q = p.minus(value);
  // Relative to what p is made of: a start that came from an earlier stop satisfies it to rounding only. Zero
  // is not rounded: there a tiny value still lies ahead.
  const double rounding = p(0) == 0 ? 0 : 1e-12 * (std::abs(value) + p.magnitude(end));
  if (atStart && std::abs(q(0)) <= rounding) q = q.withoutRootAtZero();
  const auto roots = q.roots(end);
  if (roots.empty()) return std::nullopt;
  return roots.front();
}

}  // namespace

bool Stops::have(const std::string& text) const {
  for (const double value : loadFactors)
    if (text == reached(kLoadFactor, value)) return true;
  for (const auto& f : functionals)
    if (text == reached(f.name, f.value)) return true;
  return text == reached(kPathLength, pathLength);
}

std::string Stops::passed(int limits, int bifurcationPoints) const {
  const auto text = [](const char* what, int n) { return what + std::to_string(n) + " passed"; };
  if (limitPoints > 0 && limits >= limitPoints) return text("limit point ", limitPoints);
  if (bifurcations > 0 && bifurcationPoints >= bifurcations) return text("bifurcation point ", bifurcations);
  return {};
}

std::optional<StopHit> firstStop(const Stops& stops, const Series& series, double pathLengthSoFar, double end,
                                 bool atStart) {
  std::optional<StopHit> first;
  const auto offer = [&](std::optional<double> a, StopHit::Kind kind, int index, const std::string& what,
                         double value) {
    if (!a || (first && first->a <= *a)) return;
    first = StopHit{*a, kind, index, reached(what, value)};
  };
  const auto lambda = series.lambdaFunction();
  for (std::size_t i = 0; i < stops.loadFactors.size(); ++i)
    offer(firstRoot(lambda, stops.loadFactors[i], end, atStart), StopHit::Kind::loadFactor,
          static_cast<int>(i), kLoadFactor, stops.loadFactors[i]);
  for (std::size_t i = 0; i < stops.functionals.size(); ++i) {
    const auto& f = stops.functionals[i];
    offer(firstRoot(series.functional(*f.weights), f.value, end, atStart), StopHit::Kind::functional,
          static_cast<int>(i), f.name, f.value);
  }
  const double remaining = stops.pathLength - pathLengthSoFar;
  if (remaining <= end) offer(remaining, StopHit::Kind::pathLength, 0, kPathLength, stops.pathLength);
  return first;
}

}  // namespace atrapos::path
