#pragma once

#include <memory>
#include <vector>

#include "atrapos/linear/TangentSolver.hpp"
#include "atrapos/path/Branches.hpp"
#include "commands/PathCase.hpp"
#include "output/Recorder.hpp"

namespace atrapos {

/// A case with one imperfection of path/imperfections, in the shape of a point's null vector: a small
/// constant force that would deflect the structure by it, at its start and linearly, or an undeformed body
/// whose nodes are moved by it. The largest entry, or displacement, is `size`.
class ImperfectCase {
 public:
  /// Throws std::runtime_error, one line, where the point has no null vector.
  ImperfectCase(PathCase& perfect, const path::CriticalPoint& point, double size);
  ~ImperfectCase();

  PathCase& pathCase() { return moved_ ? *moved_ : perfect_; }
  path::Problem& problem();

 private:
  PathCase& perfect_;
  std::unique_ptr<PathCase> moved_;         ///< null: an imperfect load
  std::unique_ptr<path::Problem> problem_;  ///< null: that of moved_
};

/// The imperfect case that a continued run is under way with; null where it is not.
std::unique_ptr<ImperfectCase> imperfectUnderWay(PathCase& pathCase, const path::BranchProgress& progress);

/// Follows the paths of imperfect structures after the perfect one's, those that are not done yet, the one
/// under way first. They become further branches of the diagram, without a parent. Throws std::runtime_error,
/// one line, where the diagram has no bifurcation point.
void followImperfect(PathCase& pathCase, linear::TangentSolver& solver,
                     std::unique_ptr<ImperfectCase> underWay, Recorder& recorder,
                     path::BranchProgress& progress);

}  // namespace atrapos
