#pragma once

#include <string>

#include "import/InpModel.hpp"

namespace atrapos::importer {

/// The keys of `von_mises` beside its elastic ones that say what *PLASTIC says, or come near it: then a
/// remark says how near. `finite`: strains are not small. Throws Error for what has no equal.
std::string inpPlastic(InpModel& model, const InpCard& card, bool finite);

}  // namespace atrapos::importer
