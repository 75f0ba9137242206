#pragma once

#include <optional>

#include "Augmented.hpp"
#include "atrapos/path/Report.hpp"
#include "atrapos/path/Series.hpp"

namespace atrapos::path {

/// A branch that came to a pitchfork and turned back beside it.
///
/// Next to a simple bifurcation point there are no states but those of its two branches, so a branch whose
/// load turns there has come to the point. What turns it off it, onto the path that the point is on, is a
/// residual within its bound, which is an imperfection (docs/theory/path.md, "Branches").
///
/// @param known      a bifurcation point, unknowns and load corrected.
/// @param a          a limit point of the load on the series.
/// @param pathLength of the branch up to the step's end, in the path parameter.
/// @return the direction from the point to the limit point, the side from which the branch has come; nothing
///         where it turns somewhere else.
std::optional<Augmented> turnedBeside(const Problem& problem, const CriticalPoint& known,
                                      const Series& series, double a, double pathLength);

}  // namespace atrapos::path
