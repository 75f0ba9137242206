#pragma once

#include <string>

#include "import/InpModel.hpp"

namespace atrapos::importer {

/// Law and constants of a material as keys of a deck, "law: saint_venant_kirchhoff, youngs_modulus: ...".
/// Remarks what it leaves out; throws Error where no law is equal. `finite`: of metals, strains are not
/// small.
std::string inpLaw(InpModel& model, const std::string& name, bool finite);

/// Throws Error, for `place`, where the material has none.
double inpDensity(const InpModel& model, const std::string& material, const InpPlace& place);

}  // namespace atrapos::importer
