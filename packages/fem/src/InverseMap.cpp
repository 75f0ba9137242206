#include "InverseMap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "atrapos/taylor/SmallLu.hpp"

namespace atrapos::fem::detail {
namespace {

/// The change of one place's coordinates; NaN where its cell has no map there.
void newtonStep(const PlacesInCells& places, const Tabulation& t, int p, double* change) {
  const int d = places.dim, N = t.numNodes;
  double J[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, r[3] = {0, 0, 0};
  for (int i = 0; i < d; ++i) {
    r[i] = places.targets[static_cast<std::size_t>(p) * d + i];
    for (int j = 0; j < d; ++j) J[3 * i + j] = 0;
  }
  for (int a = 0; a < N; ++a) {
    const std::size_t at = static_cast<std::size_t>(p) * N + a;
    for (int i = 0; i < d; ++i) {
      const double X = places.nodes[at * d + i];
      r[i] -= t.values[at] * X;
      for (int j = 0; j < d; ++j) J[3 * i + j] += t.gradients[at * d + j] * X;
    }
  }
  taylor::detail::SmallLu<3> lu;
  if (lu.factor(J))
    lu.solve(r, change);
  else
    std::fill(change, change + 3, std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

std::vector<double> inverseMap(const PlacesInCells& places, const std::vector<double>& start,
                               const std::function<Tabulation(const std::vector<double>&)>& tabulate) {
  const int d = places.dim, count = places.count();
  std::vector<double> xi;
  for (int p = 0; p < count; ++p) xi.insert(xi.end(), start.begin(), start.end());
  std::vector<char> done(count, 0);
  // Of straight cells the second step is zero, of curved ones the fifth; a step of 1e-8 leaves rounding.
  constexpr int most = 25;
  constexpr double small = 1e-8, longest = 1;
  for (int i = 0; i < most && std::count(done.begin(), done.end(), 0) > 0; ++i) {
    const Tabulation t = tabulate(xi);
    for (int p = 0; p < count; ++p) {
      if (done[p]) continue;
      double change[3] = {0, 0, 0};
      newtonStep(places, t, p, change);
      const double size = std::max({std::abs(change[0]), std::abs(change[1]), std::abs(change[2])});
      const double part = size > longest ? longest / size : 1;
      for (int k = 0; k < d; ++k) xi[static_cast<std::size_t>(p) * d + k] += part * change[k];
      done[p] = size < small || std::isnan(size);
    }
  }
  for (int p = 0; p < count; ++p)
    if (!done[p]) xi[static_cast<std::size_t>(p) * d] = std::numeric_limits<double>::quiet_NaN();
  return xi;
}

}  // namespace atrapos::fem::detail
