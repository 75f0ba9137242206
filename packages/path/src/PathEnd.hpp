#pragma once

#include "StepStability.hpp"

namespace atrapos::path {

/// The tangent at the end of the path's last step, which is pending: its inertia, and the sense in which
/// lambda goes on. Costs a factorization, with which the state at a stop becomes better.
EndTangent closeEnd(PathUnderWay& path, StepStability& stability);

}  // namespace atrapos::path
