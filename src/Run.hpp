#pragma once

#include <iosfwd>
#include <string>

#include "Scene.hpp"

namespace atrapos {

struct RunOptions {
  std::string directory;             ///< where results go; made if missing
  std::ostream* progress = nullptr;  ///< one line a step; none where null
};

/// How a run ended.
struct RunResult {
  bool reachedStop = false;  ///< false: the path could not be continued to a stop of the deck
  std::string text;          ///< one line
};

/// Follows the scene's path and writes results.exo, path.csv, summary.json and path.png into the directory.
/// Every finished step is on disk before the next one begins.
RunResult runScene(Scene& scene, const RunOptions& options);

}  // namespace atrapos
