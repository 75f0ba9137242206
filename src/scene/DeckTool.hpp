#pragma once

#include <memory>
#include <vector>

#include "atrapos/contact/BezierPatch.hpp"
#include "atrapos/contact/RigidTool.hpp"
#include "deck/Deck.hpp"

namespace atrapos {

/// A deck's tool. Throws std::invalid_argument, one line, where its numbers make no surface.
std::unique_ptr<contact::RigidTool> makeTool(const deck::Tool& tool);

/// The tools of a deck, in its order.
struct SceneTools {
  std::vector<std::unique_ptr<contact::RigidTool>> tools;
  /// The same where they stand before they move; null where that is at load factor 0 of `tools`.
  std::vector<std::unique_ptr<contact::RigidTool>> atStart;
};

/// Throws deck::DeckError.
SceneTools sceneTools(const deck::Deck& deck);

/// Where a tool goes with the load factor.
contact::Motion toolMotion(const deck::ToolMotion& motion);

/// The Bezier patches that a tool's surfaces are made of. Throws std::invalid_argument likewise.
std::vector<contact::BezierPatch> bezierPatches(const deck::PatchesTool& tool);

}  // namespace atrapos
