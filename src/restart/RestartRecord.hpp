#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "atrapos/path/Branches.hpp"
#include "machine/Digest.hpp"

namespace atrapos {

/// A finished step of a run.
struct RestartPlace {
  int branch = 0, step = 0;
};

/// A mesh as a restart compares it. Sets are the same in whatever order their entries stand.
struct MeshDigest {
  std::uint64_t nodes = 0, elements = 0;
  std::uint64_t places = 0, blocks = 0, sets = 0;  ///< digests
};

/// What a run's path is of.
struct RunProblem {
  std::vector<std::string> deck;  ///< deck::problemLines
  MeshDigest mesh;                ///< of a model problem: empty
};

/// How far the run's other files had come when a record was written. Those of the fields count from the
/// branch's start.
struct RunMarks {
  Mark path, points, steps, events, fields;
};

/// What a record of restart.bin says before all else.
struct RestartHead {
  RestartPlace place;  ///< the branch under way, its last step
  bool over = false;   ///< that branch has ended
  bool tree = false;   ///< the run follows branches
  RunMarks marks;
};

/// The first record.
std::string packed(const RunProblem& problem);
RunProblem problemOf(const std::string& record, const std::string& file);

/// A record: what `progress` has beyond its first `branches` branches and `points` points, and where it
/// stands. Collective, the same on all ranks. Seconds are left out: they would not be those of another run.
std::string packed(const path::BranchProgress& progress, std::size_t branches, std::size_t points, bool tree,
                   const RunMarks& marks);

// These throw std::invalid_argument, one line that begins with `file`, where a record holds other things than
// a run writes.

RestartHead headOf(const std::string& record, const std::string& file);

/// Takes a record's additions over into the progress of the records before. The state where the branch under
/// way goes on is read from the `last` record only. Throws too where its states have another number of
/// unknowns than the map.
void apply(const std::string& record, bool last, const std::string& file,
           const path::RCP<const path::Map>& map, path::BranchProgress& progress);

}  // namespace atrapos
