#pragma once

#include "import/InpModel.hpp"

namespace atrapos::importer {

/// Reads *EQUATION into the model, once all nodes are there. Those with rotations are left out, which a
/// remark says. Throws Error for what is no equation.
void readInpEquations(InpModel& model, const InpCard& card);

}  // namespace atrapos::importer
