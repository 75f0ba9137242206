#include "RigidToolOf.hpp"

namespace atrapos {

std::unique_ptr<RigidTool> rigidTool(const contact::MovingTool<contact::AnyTool>& tool) {
  return std::make_unique<RigidToolOf<contact::MovingTool<contact::AnyTool>>>(tool);
}

}  // namespace atrapos
