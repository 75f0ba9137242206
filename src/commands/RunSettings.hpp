#pragma once

#include <iosfwd>
#include <memory>

#include "atrapos/linear/TangentSolver.hpp"
#include "atrapos/path/Branches.hpp"
#include "atrapos/path/NewtonFollower.hpp"
#include "commands/PathCase.hpp"

namespace atrapos {

// What a case's deck asks for, as the library takes it.
path::Options pathOptions(const PathCase& pathCase);
path::NewtonOptions newtonOptions(const PathCase& pathCase);  ///< of decks whose method is one of Newton's
path::BranchOptions branchOptions(const deck::Path& path);

/// `progress`, where not null, gets a line on what was chosen and on what such a solver does not tell.
std::unique_ptr<linear::TangentSolver> tangentSolver(PathCase& pathCase, std::ostream* progress = nullptr);

/// Relative residual of iterative solves under which they do not show in the path's
/// (docs/theory/tangent_solvers.md).
double krylovTolerance(double residualBound);

}  // namespace atrapos
