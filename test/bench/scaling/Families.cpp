#include "Families.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace atrapos::bench {
namespace {

/// Beyond the contact's reach at first, so that steps do not end at single points that touch: the law is
/// evaluated all the same.
constexpr const char* kShell = R"(title: shell
mesh:
  file: shell.exo
  generate: {{shape: shell_plate, length: 1000, width: 1000, thickness: 10, divisions: [{0}, {0}], block: plate}}
materials:
  steel: {{law: saint_venant_kirchhoff, youngs_modulus: 210000, poissons_ratio: 0.3, blocks: [plate]}}
supports:
  left: {{set: x_min, condition: clamped}}
  right: {{set: x_max, condition: clamped}}
  front: {{set: y_min, condition: clamped}}
  back: {{set: y_max, condition: clamped}}
loads:
  pressure: {{type: surface, set: top, pressure: 0.1, at: top}}
tools:
  floor: {{type: plane, point: [0, 0, -60], normal: [0, 0, 1]}}
contact:
  below: {{tool: floor, set: bottom, points: quadrature, quadrature_degree: 4, at: bottom, stiffness: 10, regularisation: 1.0e-3}}
path:
  stop: {{steps: {1}}}
output:
  monitors:
    centre_uz: {{type: displacement, set: x_mid_y_mid, component: z}}
)";

/// 2 x 2 x 1 cubes.
constexpr const char* kSolid = R"(title: solid
mesh:
  file: solid.exo
  generate: {{shape: box, lengths: [40, 40, 20], divisions: [{0}, {0}, {2}], cell: HEX20, block: block}}
materials:
  rubber: {{law: saint_venant_kirchhoff, youngs_modulus: 100, poissons_ratio: 0.3, blocks: [block]}}
supports:
  clamp: {{set: x_min, x: 0, y: 0, z: 0}}
loads:
  tip: {{type: surface, set: x_max, total: [0, 0, -2000]}}
tools:
  roll: {{type: cylinder, center: [40, 0, -25], axis: [0, 1, 0], radius: 20}}
contact:
  below: {{tool: roll, set: z_min, points: quadrature, quadrature_degree: 4, stiffness: 10, regularisation: 1.0e-2}}
path:
  stop: {{steps: {1}}}
output:
  monitors:
    tip_uz: {{type: displacement, set: x_max, component: z}}
)";

}  // namespace

const std::vector<std::string>& families() {
  static const std::vector<std::string> names{"shell", "solid"};
  return names;
}

std::string familyDeck(const std::string& family, double unknowns, int steps) {
  if (!(unknowns >= 1000)) throw std::invalid_argument("bench_scaling: sizes are at least 1000 unknowns");
  if (family == "shell") {
    // Three nodes an element, six dofs a node.
    const int n = 2 * std::max(1, static_cast<int>(std::lround(std::sqrt(unknowns / 18) / 2)));
    return fmt::format(kShell, n, steps);
  }
  if (family == "solid") {
    // Four nodes an element, three dofs a node, n x n x n/2 elements.
    const int half = std::max(1, static_cast<int>(std::lround(std::cbrt(unknowns / 6) / 2)));
    return fmt::format(kSolid, 2 * half, steps, half);
  }
  throw std::invalid_argument("bench_scaling: unknown family '" + family + "', there are shell, solid");
}

}  // namespace atrapos::bench
