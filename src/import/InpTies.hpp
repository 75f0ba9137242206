#pragma once

#include "import/InpModel.hpp"

namespace atrapos::importer {

/// *TIE: nodes of the first surface of each line become those of the second one that are at the same places.
/// Where some are not, surfaces of solids and plane bodies are put down as tied (InpModel::tied), and others
/// left out; a remark tells either. Throws Error for surfaces that are not there.
void tieInpSurfaces(InpModel& model, const InpCard& card);

}  // namespace atrapos::importer
