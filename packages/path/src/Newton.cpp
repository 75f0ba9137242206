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
  State trial = state.at(calls.newVector(), 0);
  // The state before a whole step that raised the residual, which the next one has to make good; none: null.
  State before;
  double toBeat = 0;
  bool mayRise = maxHalvings > 0;
  const auto goBack = [&] {
    std::swap(state, before);
    before.u = linear::RCP<Vector>();
    result.residual = calls.residual(state, residual).relative();
    mayRise = false;
  };
  const auto accept = [&](double value) {
    std::swap(state, trial);
    Tpetra::deep_copy(residual, *r);
    result.residual = value;
  };
  while (!(result.residual <= tolerance)) {
    if (!std::isfinite(result.residual)) {
      result.trouble = "the residual is not finite";
      return result;
    }
    if (result.iterations == maxIterations) {
      if (!before.u.is_null()) goBack();
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
      if (!before.u.is_null() && error.reason() != EndReason::solverFailed) {
        goBack();
        continue;
      }
      result.trouble = error.what();
      return result;
    }
    // dU = -x1 + dlambda x2.
    dLambda = border.c(x1) / (border.c(x2) + border.cLambda);
    const auto tryStep = [&](double scale) {
      trial.u->update(1, *state.u, -scale, *x1, 0);
      trial.u->update(scale * dLambda, *x2, 1);
      trial.lambda = state.lambda + scale * dLambda;
      return calls.residual(trial, *r).relative();
    };

    double value = tryStep(1);
    if (!before.u.is_null()) {
      if (value < toBeat) {
        before.u = linear::RCP<Vector>();
        accept(value);
      } else {
        goBack();
      }
      continue;
    }
    if (!(value < result.residual) && mayRise && std::isfinite(value)) {
      before = state.copy();
      toBeat = result.residual;
      accept(value);
      continue;
    }
    double scale = 1;
    for (int h = 0; h < maxHalvings && !(value < result.residual); ++h) value = tryStep(scale *= 0.5);
    if (!(value < result.residual)) {
      result.trouble = "an iteration does not reduce the residual";
      return result;
    }
    if (scale == 1) mayRise = maxHalvings > 0;
    const bool slow = maxHalvings == 0 && value > 0.5 * result.residual;
    accept(value);
    if (slow && value > tolerance) {
      result.trouble = "an iteration hardly reduces the residual";
      return result;
    }
  }
  result.converged = true;
  return result;
}

NewtonResult newtonAtHand(Calls& calls, State& state, Vector& residual, const RCP<Vector>& Uhat,
                          const Border& border, double tolerance, int maxIterations) {
  NewtonResult result;
  result.residual = calls.residual(state, residual).relative();
  auto x = calls.newVector(), r = calls.newVector();
  bool helps = true;
  while (helps && result.residual > tolerance && result.iterations < maxIterations) {
    ++result.iterations;
    calls.solve(residual, *x);
    const double dLambda = border.c(x) / (border.c(Uhat) + border.cLambda);
    x->update(dLambda, *Uhat, -1);
    State trial = state.copy();
    trial.lambda += dLambda;
    trial.u->update(1, *x, 1);
    const double value = calls.residual(trial, *r).relative();
    helps = value <= 0.5 * result.residual;
    if (!(value < result.residual)) break;
    state = trial;
    Tpetra::deep_copy(residual, *r);
    result.residual = value;
  }
  result.converged = result.residual <= tolerance;
  return result;
}

}  // namespace atrapos::path
