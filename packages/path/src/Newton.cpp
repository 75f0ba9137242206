#include "Newton.hpp"

#include <cmath>

#include <Tpetra_Vector.hpp>

#include "atrapos/linear/Dot.hpp"

namespace atrapos::path {

Border holdLoad() {
  return {[](const RCP<Vector>&) { return 0.0; }, 1};
}

Border holdFunctional(const RCP<const Vector>& weights) {
  return {[weights](const RCP<Vector>& dU) { return linear::dot(*weights, *dU); }, 0};
}

Border holdPathParameter(const Problem& problem, double weight, const PathTangent& tangent) {
  const Increment along{tangent.x.u, std::vector<double>(problem.internalCount(), 0.0)};
  return {[&problem, weight, along](const RCP<Vector>& dU) {
            const Increment x{dU, std::vector<double>(along.internal.size(), 0.0)};
            return weight * problem.inner(x, along);
          },
          tangent.lambda};
}

NewtonResult newton(Calls& calls, State& state, Vector& residual, const Border& border, double tolerance,
                    int maxIterations, int maxHalvings) {
  NewtonResult result;
  result.residual = calls.residual(state, residual).relative();
  auto F = calls.newVector(), x1 = calls.newVector(), x2 = calls.newVector(), r = calls.newVector();
  State trial{calls.newVector(), 0};
  while (!(result.residual <= tolerance)) {
    if (!std::isfinite(result.residual)) {
      result.trouble = "the residual is not finite";
      return result;
    }
    if (result.iterations == maxIterations) {
      result.trouble = "not converged after " + std::to_string(maxIterations) + " iterations";
      return result;
    }
    ++result.iterations;
    double dLambda = 0;
    try {
      calls.factor(state, *F);
      calls.solve(residual, *x1);
      calls.solve(*F, *x2);
    } catch (const PathError& error) {
      result.trouble = error.what();
      return result;
    }
    // dU = -x1 + dlambda x2.
    dLambda = border.c(x1) / (border.c(x2) + border.cLambda);

    double scale = 1, best = result.residual;
    bool improved = false;
    for (int h = 0; h <= maxHalvings && !improved; ++h, scale *= 0.5) {
      trial.u->update(1, *state.u, -scale, *x1, 0);
      trial.u->update(scale * dLambda, *x2, 1);
      trial.lambda = state.lambda + scale * dLambda;
      const double value = calls.residual(trial, *r).relative();
      if (value < best) {
        best = value;
        improved = true;
      }
    }
    if (!improved) {
      result.trouble = "an iteration does not reduce the residual";
      return result;
    }
    const bool slow = maxHalvings == 0 && best > 0.5 * result.residual;
    std::swap(state, trial);
    Tpetra::deep_copy(residual, *r);
    result.residual = best;
    if (slow && best > tolerance) {
      result.trouble = "an iteration hardly reduces the residual";
      return result;
    }
  }
  result.converged = true;
  return result;
}

}  // namespace atrapos::path
