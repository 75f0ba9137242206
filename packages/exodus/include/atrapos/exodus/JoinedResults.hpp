#pragma once

#include <memory>
#include <string>
#include <vector>

#include "atrapos/exodus/JoinedMesh.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "atrapos/exodus/ResultWriter.hpp"

namespace atrapos::exodus {

/// Results in part files as those of the whole mesh; steps count from 0.
class JoinedResults {
 public:
  /// Opens all parts of `file`. Throws Error as readPart and join do, and where the parts hold other
  /// variables or other times.
  JoinedResults(const std::string& file, int parts);

  const JoinedMesh& joined() const { return joined_; }
  int numSteps() const { return numSteps_; }  ///< of the part with the fewest
  /// Whether other parts have more steps: a run was ended while it wrote one.
  bool uneven() const { return uneven_; }
  std::vector<double> times() const;
  ResultNames names() const;  ///< with the first part's info and QA records

  std::vector<double> nodal(int step, const std::string& name) const;    ///< [node]
  std::vector<double> element(int step, const std::string& name) const;  ///< [element]
  std::vector<double> globals(int step) const;                           ///< those of the first part

 private:
  std::vector<ResultReader> readers_;
  JoinedMesh joined_;
  std::vector<std::string> nodalNames_, elementNames_;
  int numSteps_ = 0;
  bool uneven_ = false;
};

/// Writes mesh and all steps into one file. Throws Error.
void writeJoined(const JoinedResults& results, const std::string& file);

}  // namespace atrapos::exodus
