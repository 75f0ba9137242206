#pragma once

#include <string>
#include <vector>

namespace atrapos {

/// How another program ended.
struct ChildResult {
  int exitCode = -1;    ///< -1: by a signal
  std::string message;  ///< its first line of errors, without control characters
};

/// The path of a program that stands beside this one, or of this one itself where the name is empty; empty
/// where it is not there.
std::string programBeside(const std::string& name);

/// Runs a program to its end, without input. Its output is that of this process where it is `shown`, else
/// dropped; a folder that is not empty is its own. Throws std::runtime_error where it cannot be started.
ChildResult runProgram(const std::string& program, const std::vector<std::string>& words, bool shown,
                       const std::string& folder = "");

}  // namespace atrapos
