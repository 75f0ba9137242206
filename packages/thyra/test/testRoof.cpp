// The hinged roof with shells by series, by Newton steps and by LOCA.
#include "HingedRoof.hpp"
#include "ThreeCodes.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"

using namespace atrapos;
using namespace atrapos::thyra::test;

namespace {

/// Both limit points of the hinged roof and the end of the path by three codes.
TEST(Loca, HingedRoof) {
  const solid::test::HingedRoof roof(4, 12.7);
  const path::State start{roof.problem->initialState(0.0), 0.0};
  const double deflection = 30;
  const auto stops = roof.stopAtDeflection(deflection);
  const auto a = linear::makeTangentSolver(), b = linear::makeTangentSolver(),
             c = linear::makeTangentSolver();
  Limits series, newton;
  const auto bySeries = withSeries(*roof.problem, start, stops, series, *a);
  path::NewtonOptions options;
  options.accuracy = 1e-4;
  const auto byNewton = withNewton(*roof.problem, start, stops, newton, *b, options);
  LocaOptions loca;
  loca.maxStep = 0.05;
  loca.firstStep = 0.02;
  loca.stop = [&](const path::State& s) { return -s.u->getData()[roof.centreDof] > deflection; };
  const LocaRun run = followWithLoca(*roof.problem, *c, start, loca);
  record("loca", run.steps, run.factorizations, run.solves);
  ASSERT_TRUE(run.stopped);

  ASSERT_EQ(series.lambda.size(), 2u);
  ASSERT_EQ(newton.lambda.size(), 2u);
  for (int i = 0; i < 2; ++i)
    EXPECT_NEAR(newton.lambda[i], series.lambda[i], 5e-4);          // accuracy, and some room
  EXPECT_NEAR(byNewton.final.lambda, bySeries.final.lambda, 1e-4);  // residual bounds at the same deflection

  // LOCA's own limit points, from its points before and after the least load between them.
  std::size_t turn = 0;
  while (turn + 1 < run.points.size() && run.points[turn + 1].lambda > run.points[turn].lambda) ++turn;
  const std::vector<path::State> first(run.points.begin(), run.points.begin() + turn + 2),
      second(run.points.begin() + turn, run.points.end());
  const double signs[] = {1, -1};
  for (int i = 0; i < 2; ++i) {
    // Residuals in N and N/mm beside 750 N of load.
    const LocaFold fold = foldByLoca(*roof.problem, *c, i == 0 ? first : second, signs[i], 1e-6);
    EXPECT_TRUE(fold.converged) << i;
    EXPECT_NEAR(fold.lambda, series.lambda[i], 2e-6) << i;  // the series' residual bound, 1e-6
  }
  // Its end, by a secant between the points on both sides.
  const auto& last = run.points.back();
  const auto& before = run.points[run.points.size() - 2];
  const double u0 = -before.u->getData()[roof.centreDof], u1 = -last.u->getData()[roof.centreDof];
  const double end = before.lambda + (deflection - u0) / (u1 - u0) * (last.lambda - before.lambda);
  EXPECT_NEAR(end, bySeries.final.lambda, 2e-3);
}

}  // namespace
