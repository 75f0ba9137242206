#include "RigidToolLaws.hpp"

ATRAPOS_TOOL_LAWS(atrapos::contact::PatchTool)

#ifndef ATRAPOS_KERNEL_LEVEL
#include "RigidToolOf.hpp"

namespace atrapos {

std::unique_ptr<RigidTool> patchTool(std::shared_ptr<const contact::PatchSet> set) {
  const contact::PatchTool tool = set->tool();
  return std::make_unique<RigidToolOf<contact::PatchTool>>(tool, std::move(set));
}

}  // namespace atrapos
#endif
