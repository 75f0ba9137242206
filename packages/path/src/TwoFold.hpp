#pragma once

#include <array>
#include <vector>

#include "Augmented.hpp"

namespace atrapos::path {

/// Tangents of the branches through a point where two eigenvalues of a symmetric tangent vanish together
/// (docs/theory/path.md), unit in w <U, U> + lambda^2, without that of the path itself.
///
/// `path` is the direction of a branch that is known and along which both eigenvalues change sign; `phi` the
/// two null vectors. The solver holds the tangent of a state near `state`. Empty where the equations say
/// nothing: no direction is isolated.
std::vector<Augmented> twoFoldTangents(Calls& calls, const State& state, double w, const Augmented& path,
                                       const std::array<RCP<Vector>, 2>& phi);

/// Directions (c_0, c_1), of Euclidean norm 1 and up to their sign, in which the binary form
/// sum_i f_i c_0^(d-i) c_1^i vanishes; empty where all f_i are zero.
std::vector<std::array<double, 2>> rootsOfForm(const std::vector<double>& f);

}  // namespace atrapos::path
