#pragma once

#include <memory>
#include <string>
#include <vector>

#include "atrapos/exodus/Error.hpp"
#include "atrapos/exodus/ResultWriter.hpp"

namespace atrapos::exodus {

/// Reads back results from an Exodus file. Steps count from 0. All members throw Error where the file does
/// not hold what they are asked for.
class ResultReader {
 public:
  /// Opens the file; throws Error as readMesh does for files that are no Exodus files or cut short.
  explicit ResultReader(const std::string& file);
  ~ResultReader();
  ResultReader(ResultReader&&) noexcept;
  ResultReader& operator=(ResultReader&&) noexcept;

  int numSteps() const;
  std::vector<double> times() const;

  const std::vector<std::string>& nodalNames() const;
  const std::vector<std::string>& elementNames() const;
  const std::vector<std::string>& globalNames() const;

  /// One nodal variable at a step, [node].
  std::vector<double> nodal(int step, const std::string& name) const;

  /// One element variable at a step, [element] over the blocks that have elements, in the file's
  /// order as readMesh gives them; Error where a block lacks the variable.
  std::vector<double> element(int step, const std::string& name) const;

  /// All global variables at a step, in the order of globalNames.
  std::vector<double> globals(int step) const;

  /// One global variable at a step.
  double global(int step, const std::string& name) const;

  /// Info records with continued lines joined.
  std::vector<std::string> info() const;

  std::vector<QaRecord> qa() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace atrapos::exodus
