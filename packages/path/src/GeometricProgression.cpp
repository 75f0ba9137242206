#include "GeometricProgression.hpp"

#include <cmath>

namespace atrapos::path {

std::optional<double> geometricProgression(const Problem& problem, const Series& series, double ratioBound,
                                           double perpBound) {
  const int N = series.order();
  if (N < 5) return std::nullopt;
  const double last2 = series.norm(N) * series.norm(N);
  if (!(last2 > 0)) return std::nullopt;
  const auto alpha = [&](int p) {
    return problem.inner(series.coefficient(p), series.coefficient(N)) / last2;
  };
  const double ac = alpha(N - 1);
  double ratios = 0, perps = 0;
  for (int p = N - 3; p <= N - 1; ++p) {
    const double a = alpha(p);
    if (p < N - 1) {
      const double deviation = std::pow(std::abs(a), 1.0 / (N - p)) / std::abs(ac) - 1;
      ratios += deviation * deviation;
    }
    const double size2 = series.norm(p) * series.norm(p);
    perps += std::sqrt(std::max(0.0, size2 - a * a * last2) / size2);
  }
  if (!(ratios < ratioBound && perps < perpBound)) return std::nullopt;
  return ac;
}

}  // namespace atrapos::path
