#include "PathSamples.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace atrapos::bench {

using path::Vector;

bool PathSamples::onStep(const path::StepReport& report, const path::Series& series) {
  for (;;) {
    const double a = (samples_.size() + 1) * spacing_ - report.pathLengthStart;
    if (a > report.length) return true;
    Sample sample;
    sample.state.u = Teuchos::rcp(new Vector(series.coefficient(0).u->getMap()));
    sample.state.lambda = series.evaluate(a, *sample.state.u);
    sample.tangent = series.tangent(a);
    samples_.push_back(sample);
  }
}

double distanceToPath(path::Problem& problem, linear::TangentSolver& solver,
                      const PathSamples::Sample& sample, double weight) {
  const std::vector<double> none(problem.internalCount(), 0.0);
  const auto inner = [&](const Teuchos::RCP<Vector>& x, const Teuchos::RCP<Vector>& y) {
    return weight * problem.inner({x, none}, {y, none});
  };
  const auto fresh = [&] { return Teuchos::rcp(new Vector(problem.map())); };
  const auto u = Teuchos::rcp(new Vector(*sample.state.u, Teuchos::Copy));
  const auto moved = fresh(), r = fresh(), F = fresh(), x = fresh(), hat = fresh();
  double lambda = sample.state.lambda, before = 1e300;
  const auto total = [&] {
    const double dl = lambda - sample.state.lambda;
    return std::sqrt(inner(moved, moved) + dl * dl);
  };
  for (int i = 0; i < 30; ++i) {
    problem.residual({u, lambda}, *r);
    const auto K = problem.tangent({u, lambda}, *F);
    solver.factor(K);
    r->scale(-1);
    solver.solve(*r, *x);
    solver.solve(*F, *hat);
    const double d = -inner(sample.tangent.x.u, x) / (inner(sample.tangent.x.u, hat) + sample.tangent.lambda);
    x->update(d, *hat, 1);
    u->update(1, *x, 1);
    moved->update(1, *x, 1);
    lambda += d;
    const double size = std::sqrt(inner(x, x) + d * d);
    // Until a correction no longer gets smaller: what is left is rounding; or is of no account.
    if (size < 1e-3 * total() && (size < 1e-13 || size > 0.5 * before)) return total();
    if (size < 1e-6 * total() || size < 1e-14) return total();
    before = size;
  }
  throw std::runtime_error("a sample's distance from the path was not found");
}

double worstDistance(path::Problem& problem, linear::TangentSolver& solver, const PathSamples& samples,
                     double weight) {
  double worst = 0;
  for (const auto& s : samples.samples()) worst = std::max(worst, distanceToPath(problem, solver, s, weight));
  return worst;
}

}  // namespace atrapos::bench
