// A limit point by series, by Newton steps and by LOCA: same problem, same tangent solver.
#include "ThreeCodes.hpp"
#include "problems/ChebyshevBratu.hpp"
#include "problems/DenseSolver.hpp"
#include "problems/JetProblem.hpp"

using namespace atrapos;
using namespace atrapos::thyra::test;

namespace {

/// One limit point by three codes, and the literature's.
TEST(Loca, BratuFold) {
  const ChebyshevBratu law(24, 1);
  JetProblem<ChebyshevBratu> problem(law);
  const int middle = law.size() - 1;
  std::vector<double> weights(law.size(), 0.0);
  weights[middle] = 1;
  path::Stops stops;
  stops.functionals.push_back({"middle", problem.vector(weights), 2.5});
  const path::State start{problem.vector({}), 0};
  Limits series, newton;
  DenseSolver a, b, c;
  withSeries(problem, start, stops, series, a);
  path::NewtonOptions options;
  options.accuracy = 1e-5;
  withNewton(problem, start, stops, newton, b, options);
  LocaOptions loca;
  loca.stop = [&](const path::State& s) { return s.u->getData()[middle] > 2.5; };
  const LocaRun run = followWithLoca(problem, c, start, loca);
  EXPECT_TRUE(run.stopped);
  record("loca", run.steps, run.factorizations, run.solves);
  const double exact = 3.513830719125161;
  ASSERT_EQ(series.lambda.size(), 1u);
  EXPECT_NEAR(series.lambda[0], exact, 1e-5);  // residual bound 1e-6 x scale
  ASSERT_EQ(newton.lambda.size(), 1u);
  EXPECT_NEAR(newton.lambda[0], exact, 2e-5);  // the cubic's accuracy
  const LocaFold fold = foldByLoca(problem, c, run.points, 1, 1e-8);
  EXPECT_TRUE(fold.converged);
  EXPECT_NEAR(fold.lambda, exact, 1e-7);  // the discrete fold is exact to 1e-8, LOCA's residual 1e-8
}

}  // namespace
