#pragma once

#include <optional>

#include "atrapos/path/Problem.hpp"
#include "atrapos/path/Series.hpp"

namespace atrapos::path {

/// Late terms U_p ~ U_N / a_c^(N-p) of a series: the signature of a simple critical point at a = a_c, ahead
/// or behind, that a residual has excited (Cochelin and Medale 2013). With alpha_p = <U_p, U_N>/<U_N, U_N>
/// and U_p_perp = U_p - alpha_p U_N it holds where
///
///     sum_{p=N-3..N-2} ( |alpha_p|^(1/(N-p)) / |alpha_{N-1}| - 1 )^2 < ratioBound,
///     sum_{p=N-3..N-1} ||U_p_perp|| / ||U_p|| < perpBound;
///
/// returns a_c = alpha_{N-1} then. Bounds of 1e-6 and 1e-3 with N = 30 locate the point; looser ones suspect
/// it.
std::optional<double> geometricProgression(const Problem& problem, const Series& series, double ratioBound,
                                           double perpBound);

}  // namespace atrapos::path
