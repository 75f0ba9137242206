#pragma once

#include <memory>
#include <optional>

#include "RigidTool.hpp"
#include "atrapos/contact/MovingTool.hpp"
#include "atrapos/contact/OneOf.hpp"
#include "atrapos/contact/PatchSet.hpp"

namespace atrapos {

// Tools of the package, at rest or moving, whose contact laws are put together of stages.
std::unique_ptr<RigidTool> stagedTool(const contact::AnyTool& tool,
                                      const std::optional<contact::Motion>& motion);
std::unique_ptr<RigidTool> stagedTool(std::shared_ptr<const contact::PatchSet> set,
                                      const std::optional<contact::Motion>& motion);

}  // namespace atrapos
