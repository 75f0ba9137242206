#pragma once

#include <vector>

#include "Modes.hpp"
#include "PadePatience.hpp"
#include "Trial.hpp"

namespace atrapos::path {

/// The end of the step along a series, by its rational form or as a polynomial; `modes` are the eigenvalues
/// followed at its start. Throws PathError: stepTooSmall, loadWithoutEffect.
Trial acceptedTrial(const PathUnderWay& path, Series& series, StepReport& report,
                    const std::vector<Mode>& modes, PadePatience& patience);

/// The length that a polynomial is tried with first.
double firstLength(const PathUnderWay& path, double radius);

/// Factor for the next trial length: the truncation error of the residual grows like a^(K+1).
double shorterBy(const PathUnderWay& path, double a, double residual, int order);

}  // namespace atrapos::path
