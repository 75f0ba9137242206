// Follows the host's solution branch through its fold. The equation has its fold at 6.80812442258 (Chebyshev
// collocation of high order); bilinear elements reach it like h^2.
#include <Tpetra_Core.hpp>
#include <cmath>
#include <cstdio>

#include "PathGlue.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/PathFollower.hpp"

using namespace atrapos;

/// Keeps the limit points.
struct Folds : path::Observer {
  std::vector<double> lambda;
  bool onStep(const path::StepReport& report, const path::Series&) override {
    for (const auto& p : report.limitPoints) lambda.push_back(p.lambda);
    return true;
  }
};

/// The fold on an n x n grid; -1 where the path did not end as it should.
static double fold(int n) {
  const auto comm = Tpetra::getDefaultComm();
  host::Application app(n, comm);
  PathGlue problem(app);
  const auto solver = linear::makeTangentSolver({});
  const auto start = Teuchos::rcp(new host::Vector(app.map())),
             middle = Teuchos::rcp(new host::Vector(app.map()));
  if (app.map()->isNodeGlobalElement(app.middle())) middle->replaceGlobalValue(app.middle(), 1.0);
  path::Stops stops;
  stops.functionals.push_back({"middle", middle, 2.5});
  Folds folds;
  const auto outcome = path::PathFollower(problem, *solver, {}, stops).run({start, 0.0}, folds);
  if (comm->getRank() == 0)
    std::printf("%3d x %-3d fold %.8f, %d steps, %d factorizations, %d solves: %s\n", n, n,
                folds.lambda.empty() ? 0.0 : folds.lambda[0], outcome.steps, outcome.factorizations,
                outcome.solves, outcome.text.c_str());
  return outcome.reason == path::EndReason::stopReached && folds.lambda.size() == 1 ? folds.lambda[0] : -1;
}

int main(int argc, char** argv) {
  const Tpetra::ScopeGuard guard(&argc, &argv);
  const double coarse = fold(16), fine = fold(32), exact = 6.80812442258;
  // Second order: the error falls by four, and what is left after Richardson's step is of fourth order, here
  // some 1e-4.
  const double ratio = (coarse - exact) / (fine - exact), extrapolated = (4 * fine - coarse) / 3;
  if (std::abs(ratio - 4) < 0.1 && std::abs(extrapolated - exact) < 2e-4) return 0;
  std::printf("error ratio %.3f, extrapolated %.8f instead of %.8f\n", ratio, extrapolated, exact);
  return 1;
}
