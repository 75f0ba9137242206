#pragma once

#include <optional>
#include <string>

#include "machine/OutputFile.hpp"
#include "restart/RestartRecord.hpp"

namespace atrapos {

/// An earlier run that goes on.
struct Continued {
  std::string directory;  ///< of its results
  path::BranchProgress progress;
  std::size_t records = 0;  ///< of its restart.bin that are kept
  bool tree = false;        ///< it follows branches
  RunMarks marks;           ///< of its other files at the last of these records
};

/// restart.bin: what the next step needs (StepReport::next) and what has been found of the diagram, in
/// binary, one record a step and one where a branch that others come after is over; each holds what is new,
/// and how far the run's other files had come. The first record says what the path is of. A record that was
/// cut short, or does not agree with its check sum, counts as not written.
class RestartFile {
 public:
  /// Starts a new file; `tree`: of a run that follows branches. Throws FileError where it cannot be written.
  RestartFile(const std::string& file, const RunProblem& problem, bool tree);

  /// Takes over the records of an earlier file that the run keeps.
  void goOn(const std::string& file, const Continued& run);

  /// Collective.
  void append(const path::BranchProgress& progress, const RunMarks& marks);
  void sync() const { out_.sync(); }  ///< until it would outlast a loss of power
  void rename(const std::string& file) {
    if (writes_) out_.rename(file);
  }

 private:
  void put(const std::string& record);

  bool tree_, writes_;  ///< writes: on several ranks the first one
  OutputFile out_;
  std::size_t branches_ = 0, points_ = 0;  ///< that are in the file
};

/// The run with results in the directory, behind a finished step, or behind all that was written. Throws
/// std::invalid_argument, one line, where the file has none, is damaged, or is of another problem.
Continued readRestart(const std::string& directory, std::optional<RestartPlace> place,
                      const RunProblem& problem, const path::RCP<const path::Map>& map);

}  // namespace atrapos
