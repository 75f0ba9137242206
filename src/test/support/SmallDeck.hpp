#pragma once

#include <string>

namespace atrapos::test {

/// A cube pulled sideways until a plane below stops it: runs in a tenth of a second.
inline const std::string kSmallDeck = R"(title: Small box
mesh:
  file: box.exo
  generate: {shape: box, lengths: [4, 1, 1], divisions: [4, 1, 1], cell: HEX8}
materials:
  rubber: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3, blocks: [body]}
supports:
  clamp: {set: x_min, x: 0, y: 0, z: 0}
loads:
  tip: {type: surface, set: x_max, total: [0, 0, -10]}
tools:
  roll: {type: cylinder, center: [4, 0, -1.25], axis: [0, 1, 0], radius: 1}
contact:
  lower: {tool: roll, set: z_min, stiffness: 1000, regularisation: 1.0e-3}
path:
  order: 15
  residual: 1.0e-8
  stop: {load_factor: 0.5}
output:
  points_per_step: 2
  monitors:
    tip_uz: {type: displacement, set: x_max, component: z}
    force: {type: contact_force, contact: lower}
)";

}  // namespace atrapos::test
