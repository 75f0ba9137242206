#pragma once

#include <functional>

#include "atrapos/path/Calls.hpp"

namespace atrapos::path {

/// The scalar equation c(dU) + cLambda dlambda = 0 that a Newton correction keeps: what must not move.
struct Border {
  std::function<double(const RCP<Vector>&)> c;
  double cLambda = 0;
};

/// The load factor stays.
Border holdLoad();
/// weights . U stays.
Border holdFunctional(const RCP<const Vector>& weights);
/// The path parameter stays, measured along `tangent` (its unknowns and load only).
Border holdPathParameter(const Problem& problem, double weight, const PathTangent& tangent);

struct NewtonResult {
  int iterations = 0;   ///< one factorization each
  double residual = 0;  ///< relative, at the state returned
  bool converged = false;
  std::string trouble;  ///< why it did not converge
};

/// Newton iterations on R(U, lambda) = 0 with a border, until the relative residual is <= tolerance:
/// K_T dU - F dlambda = -R, c(dU) + cLambda dlambda = 0, by block elimination. A step that does not reduce
/// the residual is halved up to `maxHalvings` times; where that is allowed at all, a whole step that raises
/// the residual is first given a second one to make it good: in thin bodies a right rotation stretches them
/// until the next iteration. `state` holds the best state found, `residual` is R there.
NewtonResult newton(Calls& calls, State& state, Vector& residual, const Border& border, double tolerance,
                    int maxIterations, int maxHalvings);

/// Newton iterations with the factorization that the solver holds, of a tangent near the state, and Uhat =
/// K^-1 F of it: two residuals and a solve each, no factorization. They go on while one makes the residual at
/// most half as large; the last one may do less.
NewtonResult newtonAtHand(Calls& calls, State& state, Vector& residual, const RCP<Vector>& Uhat,
                          const Border& border, double tolerance, int maxIterations);

}  // namespace atrapos::path
