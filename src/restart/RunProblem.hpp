#pragma once

#include <string>

#include "atrapos/fem/Mesh.hpp"
#include "restart/RestartRecord.hpp"

namespace atrapos {

MeshDigest digestOf(const fem::Mesh& mesh);

/// What differs first between the problem of a run and the one that shall go on with it, in words; empty:
/// nothing.
std::string firstDifference(const RunProblem& before, const RunProblem& now);

}  // namespace atrapos
