#pragma once

#include "atrapos/path/Problem.hpp"

namespace atrapos::path {

/// A point of the path: the unknowns and the load parameter.
struct State {
  RCP<Vector> u;
  double lambda = 0;
};

/// dX/da and dlambda/da at a point of the path.
struct PathTangent {
  Increment x;
  double lambda = 0;
};

}  // namespace atrapos::path
