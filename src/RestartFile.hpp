#pragma once

#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "atrapos/path/Report.hpp"

namespace atrapos {

/// restart.bin: what the next step needs (StepReport::next), in binary, one record a step. A record that was
/// cut short, or does not agree with its check sum, counts as not written.
class RestartFile {
 public:
  /// Starts a new file. Throws std::runtime_error where it cannot be written.
  explicit RestartFile(const std::string& file);

  /// Takes over the records of an earlier file up to this step.
  void copyFrom(const std::string& file, int lastStep);

  /// Collective.
  void append(const path::Start& next);

 private:
  void put(const std::string& record);

  std::string file_;
  bool writes_;  ///< on several ranks the first one
  std::ofstream out_;
};

/// The state after `step`, or the last one that was written. Throws std::invalid_argument, one line, where
/// the file has none or its states have another number of unknowns than `map`.
path::Start readRestart(const std::string& file, std::optional<int> step,
                        const path::RCP<const path::Map>& map);

}  // namespace atrapos
