#include "RigidToolLaws.hpp"

ATRAPOS_TOOL_LAWS(atrapos::contact::MovingTool<atrapos::contact::AnyTool>)

#ifndef ATRAPOS_KERNEL_LEVEL
#include "RigidToolOf.hpp"

namespace atrapos {

std::unique_ptr<RigidTool> rigidTool(const contact::MovingTool<contact::AnyTool>& tool) {
  return std::make_unique<RigidToolOf<contact::MovingTool<contact::AnyTool>>>(tool);
}

}  // namespace atrapos
#endif
