#pragma once

#include <memory>

#include "PathCase.hpp"
#include "atrapos/linear/TangentSolver.hpp"
#include "atrapos/path/Branches.hpp"
#include "atrapos/path/NewtonFollower.hpp"

namespace atrapos {

// What a case's deck asks for, as the library takes it.
path::Options pathOptions(const PathCase& pathCase);
path::NewtonOptions newtonOptions(const PathCase& pathCase);  ///< of decks whose method is one of Newton's
path::BranchOptions branchOptions(const deck::Path& path);
std::unique_ptr<linear::TangentSolver> tangentSolver(PathCase& pathCase);

}  // namespace atrapos
