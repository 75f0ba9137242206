#pragma once

#include <string>

namespace atrapos::test {

/// A plate of shells that bends under a pressure that follows it, its end rigid.
inline const std::string kShellPlate = R"(mesh:
  file: plate.exo
  generate: {shape: shell_plate, length: 4, width: 2, divisions: [6, 3], block: plate}
materials:
  plate: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3, blocks: [plate]}
shells:
  sections:
    plate: {blocks: [plate], thickness: 0.4}
supports:
  clamp: {set: x_min, condition: clamped}
couplings:
  end: {kind: rigid, set: x_max}
loads:
  push: {type: surface, set: top, pressure: 2, follower: true}
path:
  order: 15
  stop: {load_factor: 1}
output:
  monitors:
    tip_uz: {type: displacement, set: x_max, component: z}
    tip_ux: {type: displacement, set: x_max, component: x}
)";

}  // namespace atrapos::test
