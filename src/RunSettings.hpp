#pragma once

#include "atrapos/path/Branches.hpp"
#include "deck/Deck.hpp"

namespace atrapos {

/// The block `path` of a deck as the library takes it.
path::Options pathOptions(const deck::Path& path);
path::BranchOptions branchOptions(const deck::Path& path);

}  // namespace atrapos
