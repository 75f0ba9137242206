#pragma once

#include <memory>
#include <string>
#include <vector>

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/formula/Program.hpp"
#include "atrapos/physics/Balance.hpp"
#include "atrapos/physics/Expanding.hpp"

namespace atrapos::physics {

/// A formula for the expansion of a material, as its law takes it.
struct Expansion {
  formula::Program program;
  std::string field;  ///< which it depends on; empty: none
};

/// A formula of at most one of the fields, lambda, x, y and z. Throws formula::FormulaError.
Expansion expansionOf(const std::string& text, const std::vector<std::string>& fields,
                      const Constants& constants);

/// The expansion of a material in a shell, a formula of the fields, lambda, x, y, z and zeta.
struct ShellExpansion {
  std::unique_ptr<fem::PointLaw> stage;  ///< GrowthStage of these
  std::vector<std::string> fields;       ///< that it depends on, at most mostFields
};
/// Throws formula::FormulaError.
ShellExpansion shellExpansion(const std::string& text, const std::vector<std::string>& fields,
                              const Constants& constants);

/// The law of a material of solids with an expansion. Its inputs are H, the value of the expansion's field
/// where it has one, and the load factor; its data the place.
template <class Material>
std::unique_ptr<fem::PointLaw> expandingLaw(const Material& material, const Expansion& expansion) {
  if (expansion.field.empty()) return fem::pointLaw(Expanding<Material, 0>{material, expansion.program});
  return fem::pointLaw(Expanding<Material, 1>{material, expansion.program});
}

}  // namespace atrapos::physics
