#include "atrapos/contact/RollProfiles.hpp"

#include <Teuchos_LAPACK.hpp>
#include <algorithm>

namespace atrapos::contact {

TableProfile TableProfile::through(const std::vector<double>& places, const std::vector<double>& radii) {
  const char* who = "crowned roll";
  const int n = static_cast<int>(places.size());
  if (n != static_cast<int>(radii.size()))
    detail::refuse(
        who, "the table has " + std::to_string(n) + " places but " + std::to_string(radii.size()) + " radii");
  if (n < 2 || n > maxEntries) detail::refuse(who, "a table needs 2 to 32 entries, got " + std::to_string(n));
  for (int i = 0; i < n; ++i) {
    detail::requireFinite(who, "place in the table", places[i]);
    detail::requirePositive(who, "radius in the table", radii[i]);
    if (i > 0 && !(places[i] > places[i - 1]))
      detail::refuse(who, "the table's places must ascend, got " + detail::shown(places[i]) + " after " +
                              detail::shown(places[i - 1]));
  }
  TableProfile p;
  p.entries = n;
  p.middle = (places.front() + places.back()) / 2;
  p.half = (places.back() - places.front()) / 2;
  for (int i = 0; i < n; ++i) p.place[i] = (places[i] - p.middle) / p.half;
  p.smoothing = 2;
  for (int i = 1; i < n; ++i) p.smoothing = std::min(p.smoothing, p.place[i] - p.place[i - 1]);

  // Rows: the n entries, then the two side conditions. Unknowns: c, then a and b.
  const int N = n + 2;
  std::vector<double> matrix(static_cast<std::size_t>(N) * N, 0.0), right(N, 0.0);
  const auto at = [&](int i, int j) -> double& { return matrix[static_cast<std::size_t>(j) * N + i]; };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) at(i, j) = std::pow(std::hypot(p.place[i] - p.place[j], p.smoothing), 3);
    at(i, n) = at(n, i) = 1;
    at(i, n + 1) = at(n + 1, i) = p.place[i];
    right[i] = radii[i];
  }
  std::vector<int> pivots(N);
  int info = 0;
  Teuchos::LAPACK<int, double>().GESV(N, 1, matrix.data(), N, pivots.data(), right.data(), N, &info);
  std::copy(right.begin(), right.begin() + n, p.factor);
  p.constant = right[n];
  p.linear = right[n + 1];
  const double size = *std::max_element(radii.begin(), radii.end());
  for (int i = 0; i < n; ++i) {
    double r = 0, slope = 0;
    p(places[i], r, slope);
    if (info != 0 || !(std::fabs(r - radii[i]) < 1e-10 * size))
      detail::refuse(who, "the table's places are too unevenly spaced to be interpolated smoothly");
  }
  return p;
}

}  // namespace atrapos::contact
