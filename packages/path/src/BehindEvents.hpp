#pragma once

#include <vector>

namespace atrapos::path {

struct PathUnderWay;

/// Whether what begins or ends at this event has a size there, for which the state is corrected.
bool hasSize(const PathUnderWay& path, int event);

/// Makes the position solve the Problem that the events `chosen` have just changed (none: that goes on from a
/// restart), by corrections as far as they are needed and allowed. Throws PathError: problemFailed where it
/// is another state, stepTooSmall where the bound cannot be met.
void solveBehindEvents(PathUnderWay& path, const std::vector<int>& chosen);

}  // namespace atrapos::path
