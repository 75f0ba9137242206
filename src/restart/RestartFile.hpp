#pragma once

#include <fstream>
#include <optional>
#include <string>

#include "restart/RestartRecord.hpp"

namespace atrapos {

/// An earlier run that goes on.
struct Continued {
  std::string directory;  ///< of its results
  path::BranchProgress progress;
  std::size_t records = 0;  ///< of its restart.bin that are kept
  bool tree = false;        ///< it follows branches
};

/// restart.bin: what the next step needs (StepReport::next) and what has been found of the diagram, in
/// binary, one record a step and one where a branch that others come after is over; each holds what is new. A
/// record that was cut short, or does not agree with its check sum, counts as not written.
class RestartFile {
 public:
  /// Starts a new file; `tree`: of a run that follows branches. Throws std::runtime_error where it cannot be
  /// written.
  RestartFile(const std::string& file, bool tree);

  /// Takes over the records of an earlier file that the run keeps.
  void goOn(const std::string& file, const Continued& run);

  /// Collective.
  void append(const path::BranchProgress& progress);

 private:
  void put(const std::string& record);

  std::string file_;
  bool tree_, writes_;  ///< writes: on several ranks the first one
  std::ofstream out_;
  std::size_t branches_ = 0, points_ = 0;  ///< that are in the file
};

/// The run with results in the directory, behind a finished step, or behind all that was written. Throws
/// std::invalid_argument, one line, where the file has none or its states have another number of unknowns
/// than `map`.
Continued readRestart(const std::string& directory, std::optional<RestartPlace> place,
                      const path::RCP<const path::Map>& map);

}  // namespace atrapos
