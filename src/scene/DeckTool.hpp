#pragma once

#include <memory>

#include "atrapos/contact/RigidTool.hpp"
#include "deck/Deck.hpp"

namespace atrapos {

/// A deck's tool. Throws std::invalid_argument, one line, where its numbers make no surface.
std::unique_ptr<contact::RigidTool> makeTool(const deck::Tool& tool);

}  // namespace atrapos
