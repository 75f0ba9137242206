#pragma once

#include <optional>

#include "Augmented.hpp"
#include "atrapos/path/Report.hpp"
#include "atrapos/path/Series.hpp"

namespace atrapos::path {

/// A branch that came to a pitchfork and was turned off beside it, onto the path that the point is on.
///
/// Next to a simple bifurcation point there are no states but those of its two branches. What keeps a branch
/// that comes there off the point is a residual within its bound, which is an imperfection: the branch passes
/// the point's load beside it, or its load turns before that (docs/theory/path.md, "Branches").
///
/// @param known  a bifurcation point, unknowns and load corrected.
/// @param report the branch's last step, and its series.
/// @return the direction from the point to the branch where that happens, the side from which it has come;
///         nothing where it does not.
std::optional<Augmented> turnedBeside(const Problem& problem, const CriticalPoint& known,
                                      const StepReport& report, const Series& series);

}  // namespace atrapos::path
