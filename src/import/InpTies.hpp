#pragma once

#include "import/InpModel.hpp"

namespace atrapos::importer {

/// *TIE: nodes of the first surface of each line become those of the second one that are at the same places.
/// Surfaces whose nodes are not are left out with a remark. Throws Error for surfaces that are not there.
void tieInpSurfaces(InpModel& model, const InpCard& card);

}  // namespace atrapos::importer
