#include "PathEnd.hpp"

#include <cmath>

#include <Tpetra_Vector.hpp>

#include "Augmented.hpp"

namespace atrapos::path {

namespace {

/// One Newton iteration where the path has reached its stop, with the factorization made for the inertia
/// there: the state that is looked at most is better than the bound asks. A path that goes on from a limit of
/// steps must not differ from one that was not interrupted, so not there.
void polishEnd(PathUnderWay& path, const RCP<Vector>& Uhat) {
  const Position& here = path.here;
  constexpr double wanted = 1e-2;
  if (!here.stop || !here.due.empty() || here.residual <= wanted * path.bound()) return;
  const Border border = borderAt(path, path.last->series, path.last->at, here.stop);
  auto x = path.calls.newVector();
  path.calls.solve(*here.r, *x);
  const double dLambda = border.c(x) / (border.c(Uhat) + border.cLambda);
  x->update(dLambda, *Uhat, -1);
  State state = here.state.at(copy(*here.state.u), here.state.lambda + dLambda);
  state.u->update(1, *x, 1);
  auto r = path.calls.newVector();
  const double residual = path.calls.residual(state, *r).relative();
  if (residual < here.residual) path.improveEnd(state, r, residual);
}

}  // namespace

EndTangent closeEnd(PathUnderWay& path, StepStability& stability) {
  EndTangent tangent;
  Calls& calls = path.calls;
  const Problem& problem = calls.problem();
  const PathTangent& along = *path.here.tangent;
  const double w = path.last->series.weight();
  auto F = calls.newVector(), Uhat = calls.newVector();
  ++path.outcome.closings;
  try {
    calls.factor(path.here.state, *F);
    tangent = stability.tangentHere(along, w);
    calls.solve(*F, *Uhat);
    const Increment hat{Uhat, std::vector<double>(along.x.internal.size(), 0.0)};
    const double ahead = w * problem.inner(hat, along.x) + along.lambda;
    tangent.lambda1 = std::copysign(1 / std::sqrt(1 + w * problem.inner(hat, hat)), ahead);
    polishEnd(path, Uhat);
  } catch (const PathError&) {
    tangent.inertia.reset();  // singular at the very end: signs are not known there
  }
  return tangent;
}

}  // namespace atrapos::path
