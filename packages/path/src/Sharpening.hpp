#pragma once

#include "atrapos/path/Series.hpp"

namespace atrapos::path {

struct PathUnderWay;

/// Next to a bifurcation point the residual of the state, an imperfection of the size of the bound, displaces
/// it by e = r / mu along the null vector, mu the eigenvalue that is about to vanish, which goes on as
/// e / (1 - a/a_c). Newton iterations with the factorization that the solver holds take it away. False where
/// the progression is another one or they do not help: all stays as it is. True: the state has moved a
/// little, and its series wants a factorization of its own, which counts as that of a correction.
bool sharpenState(PathUnderWay& path, const Series& series);

/// What a residual that cannot be corrected away does to the late terms is taken out by the small force that
/// makes the opposite progression; what is left passes the point. The residual, which that force enters,
/// decides about its length as about any other.
void clean(const PathUnderWay& path, Series& series);

}  // namespace atrapos::path
