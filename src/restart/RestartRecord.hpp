#pragma once

#include <string>

#include "atrapos/path/Branches.hpp"

namespace atrapos {

/// A finished step of a run.
struct RestartPlace {
  int branch = 0, step = 0;
};

/// What a record of restart.bin says before all else.
struct RestartHead {
  RestartPlace place;  ///< the branch under way, its last step
  bool over = false;   ///< that branch has ended
  bool tree = false;   ///< the run follows branches
};

/// A record: what `progress` has beyond its first `branches` branches and `points` points, and where it
/// stands. Collective, the same on all ranks. Seconds are left out: they would not be those of another run.
std::string packed(const path::BranchProgress& progress, std::size_t branches, std::size_t points, bool tree);

RestartHead headOf(const std::string& record);

/// Takes a record's additions over into the progress of the records before. The state where the branch under
/// way goes on is read from the `last` record only. Throws std::invalid_argument, one line that begins with
/// `file`, where its states have another number of unknowns than the map.
void apply(const std::string& record, bool last, const std::string& file,
           const path::RCP<const path::Map>& map, path::BranchProgress& progress);

}  // namespace atrapos
