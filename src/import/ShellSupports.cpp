#include "import/ShellSupports.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace atrapos::importer {
namespace {

/// The axis that the element's normal is along, -1 where there is none.
int axisOf(const InpModel& model, const InpElement& element) {
  std::array<std::array<double, 3>, 4> x{};
  const auto last = static_cast<std::size_t>(fem::shellCorners(element.type->topology)) - 1;
  for (std::size_t c = 0; c < 4; ++c) {  // a triangle's last corner counts twice
    const int node = model.connectivity[element.firstNode + std::min(c, last)];
    for (std::size_t d = 0; d < 3; ++d) x[c][d] = model.coordinates[3 * static_cast<std::size_t>(node) + d];
  }
  std::array<double, 3> a{}, b{}, n{};
  for (std::size_t d = 0; d < 3; ++d) {
    a[d] = x[2][d] - x[0][d];
    b[d] = x[3][d] - x[1][d];
  }
  double length = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    n[d] = a[(d + 1) % 3] * b[(d + 2) % 3] - a[(d + 2) % 3] * b[(d + 1) % 3];
    length = std::hypot(length, n[d]);
  }
  // An angle of 1e-3, as of coordinates that are written with few digits.
  for (std::size_t d = 0; d < 3; ++d)
    if (std::abs(n[d]) > (1 - 5e-7) * length && length > 0) return static_cast<int>(d);
  return -1;
}

}  // namespace

ShellSupports::ShellSupports(const InpModel& model) {
  for (const InpElement& element : model.elements) {
    if (element.type->family != Family::shell) continue;
    const int axis = axisOf(model, element);
    for (int n = 0; n < element.type->nodes; ++n) {
      const auto [at, isNew] =
          normalAxis_.emplace(model.connectivity[element.firstNode + static_cast<std::size_t>(n)], axis);
      if (!isNew && at->second != axis) at->second = -1;
    }
  }
}

std::optional<std::set<int>> ShellSupports::heldDirectors(int node, const InpSupport& support) const {
  std::set<int> held;
  for (int d = 0; d < 3; ++d)
    if (support.value[static_cast<std::size_t>(3 + d)]) held.insert(d);
  if (held.empty() || held.size() == 3) return held;
  const int normal = normalAxis_.at(node);
  if (normal < 0) {
    if (held.size() == 1) return std::nullopt;
    for (int free = 0; free < 3; ++free)
      if (held.count(free) == 0) return std::set<int>{free};
  }
  std::set<int> components;
  for (const int p : held)
    if (p != normal) components.insert(3 - normal - p);
  return components;
}

}  // namespace atrapos::importer
