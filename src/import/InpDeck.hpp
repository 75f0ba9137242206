#pragma once

#include <string>
#include <vector>

#include "import/InpMesh.hpp"
#include "import/InpRigidMotions.hpp"
#include "import/InpStep.hpp"

namespace atrapos::importer {

/// Element sets, as lists of positions, whose elements need blocks of their own: those with loads by volume.
std::vector<std::vector<int>> inpCuts(const InpStep& step);

/// The deck of a step, without the line of its mesh file; makes the sets that it needs and remarks what it
/// leaves out. Throws Error where materials, supports or loads have no equal at all.
std::string inpDeck(InpModel& model, const InpStep& step, const InpRigidMotions& rigid, InpMesh& mesh);

}  // namespace atrapos::importer
