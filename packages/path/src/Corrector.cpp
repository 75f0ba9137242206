#include "Corrector.hpp"

#include <cmath>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>

namespace atrapos::path {

double Corrector::dot(const Augmented& x, const Augmented& y, double weight) const {
  return path::dot(calls_.problem(), x, y, weight);
}

void Corrector::factor(const State& state) {
  if (F_.is_null()) {
    F_ = calls_.newVector();
    uhat_ = calls_.newVector();
  }
  calls_.factor(state, *F_);
  calls_.solve(*F_, *uhat_);
  distance_ = 0;
  if (!std::isfinite(uhat_->norm2()))
    throw PathError(EndReason::notFinite, "the tangent solver returned values that are not finite");
}

Augmented Corrector::solve(const Vector& rhs, const Augmented& direction, double weight) {
  Augmented x{calls_.newVector(), 0};
  calls_.solve(rhs, *x.u);
  x.lambda = -dot(direction, x, weight) / dot(direction, {uhat_, 1}, weight);
  x.u->update(x.lambda, *uhat_, 1);
  return x;
}

Augmented Corrector::tangent(const Augmented& direction, double weight) const {
  const double lambda = 1 / dot(direction, {uhat_, 1}, weight);
  Augmented x{calls_.newVector(), lambda};
  x.u->update(lambda, *uhat_, 0);
  return x;
}

Corrector::Result Corrector::correct(State& state, Vector& r, const Augmented& direction, double weight,
                                     double s) {
  Result result;
  result.first = result.residual = calls_.residual(state, r).relative();
  // The correction before; the step stands for it at first, since the predictor is off by order s^2.
  double before = s;
  double left = 0;  // estimate of the next one
  int grown = 0;    // corrections in a row that were larger than the one before
  bool stale = true;
  const auto fail = [&](const std::string& why) {
    result.trouble = why;
    return result;
  };
  while (result.iterations < options_.minIterations || !(result.residual <= options_.residualBound) ||
         !(left <= 0.1 * options_.accuracy)) {
    if (!std::isfinite(result.residual)) return fail("the residual is not finite");
    if (result.iterations == options_.maxIterations)
      return fail("not converged after " + std::to_string(options_.maxIterations) + " iterations");
    ++result.iterations;
    const bool fresh = stale || options_.kind == NewtonKind::full;
    try {
      if (fresh) factor(state);
      r.scale(-1);
      const Augmented d = solve(r, direction, weight);
      const double size = std::sqrt(dot(d, d, weight));
      state.u->update(1, *d.u, 1);
      state.lambda += d.lambda;
      distance_ += size;
      result.residual = calls_.residual(state, r).relative();
      const bool done = result.residual <= options_.residualBound;
      const double contraction = size / before;
      left = size * (fresh ? contraction * contraction : contraction);
      // Corrections, not residuals, tell divergence: in thin bodies a good first correction of a rotation
      // stretches them and can raise the residual. One may be larger than the one before, as where contact
      // changes, but not two in a row, and none larger than the step.
      grown = result.iterations > 1 && size >= before ? grown + 1 : 0;
      if (!done && (grown == 2 || size > s)) return fail("the corrections grow");
      stale = result.iterations > 1 && size > options_.refactorAbove * before;
      before = size;
    } catch (const PathError& error) {
      if (error.reason() == EndReason::solverFailed) throw;  // a shorter step does not help
      return fail(error.what());
    }
  }
  result.converged = true;
  return result;
}

Augmented Corrector::tangentAt(const State& state, const Augmented& direction, double weight) {
  Augmented t = tangent(direction, weight);
  auto F = calls_.newVector(), rho = calls_.newVector();
  const auto K = calls_.tangent(state, *F);
  double before = std::numeric_limits<double>::infinity();
  // Each refinement gains the factor by which K changed since its factorization.
  constexpr int maxRefinements = 8;
  constexpr double accurate = 1e-10;
  for (int i = 0; i < maxRefinements; ++i) {
    K->apply(*t.u, *rho, Teuchos::NO_TRANS, -1, 0);
    rho->update(t.lambda, *F, 1);
    const Augmented d = solve(*rho, direction, weight);
    const double size = std::sqrt(dot(d, d, weight) / dot(t, t, weight));
    if (!(size < 0.5 * before)) break;
    add(t, 1, d);
    if (size <= accurate) return t;
    before = size;
  }
  // What is left of a refinement that went well is its last gain, squared.
  if (before <= 1e-6) return t;
  factor(state);
  return tangent(direction, weight);
}

}  // namespace atrapos::path
