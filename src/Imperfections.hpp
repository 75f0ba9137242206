#pragma once

#include <vector>

#include "PathCase.hpp"
#include "Recorder.hpp"
#include "atrapos/linear/TangentSolver.hpp"
#include "atrapos/path/Branches.hpp"

namespace atrapos {

/// Follows the paths of imperfect structures after the perfect one's: for each size of path/imperfections a
/// small constant force that would deflect the structure, at its start and linearly, by the null vector of
/// the first bifurcation point with `size` as the largest entry. They become further branches of the diagram,
/// without a parent; `conditions` are those of the problem at its start, and `sizes` gets one entry for each
/// branch of the diagram, 0 where it is perfect. Throws std::runtime_error, one line, where the diagram has
/// no bifurcation point.
void followImperfect(PathCase& pathCase, linear::TangentSolver& solver, const path::Options& settings,
                     const std::vector<int>& conditions, Recorder& recorder, path::BranchDiagram& diagram,
                     std::vector<double>& sizes);

}  // namespace atrapos
