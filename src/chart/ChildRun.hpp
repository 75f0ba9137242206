#pragma once

#include <string>
#include <vector>

namespace atrapos::chart {

/// How a run of this program as a process of its own ended.
struct ChildResult {
  int exitCode = -1;    ///< -1: by a signal
  std::string message;  ///< its first line of errors
};

/// Runs `atrapos` with these words in a folder, without output. Throws std::runtime_error where no process
/// can be made.
ChildResult runChild(const std::vector<std::string>& words, const std::string& folder);

}  // namespace atrapos::chart
