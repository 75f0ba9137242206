// The imperfect column and the imperfect strut by series, by Newton steps and by LOCA.
#include <algorithm>
#include <cmath>

#include "ThreeCodes.hpp"
#include "atrapos/models/Models.hpp"
#include "atrapos/path/Rational.hpp"
#include "problems/DenseSolver.hpp"

using namespace atrapos;
using namespace atrapos::thyra::test;

namespace {

/// Where a series path passes the loads of given points, and how far it is from them there.
class Passes final : public path::Observer {
 public:
  explicit Passes(std::vector<path::State> points) : points_(std::move(points)) {}

  bool onStep(const path::StepReport& report, const path::Series& series) override {
    for (; next_ < points_.size() && points_[next_].lambda <= report.lambdaEnd; ++next_) {
      const auto& point = points_[next_];
      const auto roots = series.lambdaFunction().minus(point.lambda).roots(report.length);
      if (roots.empty()) continue;  // the start
      path::Vector u(*point.u, Teuchos::Copy);
      series.evaluate(roots.front(), u);
      const double size = u.norm2();
      u.update(-1, *point.u, 1);
      worst = std::max(worst, u.norm2() / size);
      ++passed;
    }
    return true;
  }

  double worst = 0;  ///< largest distance, of the state's norm
  int passed = 0;

 private:
  std::vector<path::State> points_;
  std::size_t next_ = 0;
};

/// Beyond the Euler load, where the load grows all along the path: every point of LOCA lies on the series,
/// and the ends are the same.
TEST(Loca, ImperfectColumn) {
  const models::Parameters imperfect{{"side_load", 1e-3}};
  const auto problem = models::make("euler_column", imperfect);
  const auto setup = models::setup("euler_column", imperfect, *problem);
  DenseSolver a, b, c;
  LocaOptions loca;
  loca.residualBound = 1e-9;
  const double end = 3;  // a fifth above the Euler load
  loca.stop = [&](const path::State& s) { return s.lambda > end; };
  const LocaRun run = followWithLoca(*problem, c, setup.start, loca);
  ASSERT_TRUE(run.stopped);
  ASSERT_GE(run.points.size(), 5u);
  record("loca", run.steps, run.factorizations, run.solves);

  // LOCA ends with its first point beyond the stop: the others are led to the same load.
  path::Stops stops;
  stops.loadFactors = {run.points.back().lambda};
  path::Options options;
  options.residualBound = 1e-9;
  options.delta = 1e-9;
  options.direction = setup.direction;
  Passes passes(run.points);
  const auto bySeries = path::PathFollower(*problem, a, options, stops).run(setup.start, passes);
  ASSERT_EQ(bySeries.reason, path::EndReason::stopReached) << bySeries.text;
  record("series", bySeries.steps, bySeries.factorizations, bySeries.solves);
  EXPECT_GE(passes.passed, static_cast<int>(run.points.size()) - 2);
  // Residuals of 1e-9, magnified by the softness near the Euler load: its imperfection is a thousandth.
  EXPECT_LT(passes.worst, 1e-5);

  Limits newton;
  path::NewtonOptions steps;
  steps.residualBound = 1e-9;
  steps.accuracy = 1e-3;  // without it a step passes over the bend, to the straight column
  steps.direction = setup.direction;
  const auto byNewton = withNewton(*problem, setup.start, stops, newton, b, steps);
  for (const auto& final : {bySeries.final, byNewton.final}) {
    path::Vector difference(*final.u, Teuchos::Copy);
    difference.update(-1, *run.points.back().u, 1);
    EXPECT_LT(difference.norm2(), 1e-6 * final.u->norm2());
  }
}

/// On a softening foundation the imperfect strut has a largest load: the same by three codes.
TEST(Loca, FoldOfTheImperfectStrut) {
  models::Parameters imperfect = models::parameters("strut_on_foundation");
  ASSERT_TRUE(imperfect.count("imperfection"));
  imperfect["imperfection"] = 0.02;
  imperfect["cubic"] = -1;  // softens
  const auto problem = models::make("strut_on_foundation", imperfect);
  const auto setup = models::setup("strut_on_foundation", imperfect, *problem);
  DenseSolver a, b, c;
  Limits series, newton;
  path::Options options;
  options.residualBound = options.delta = 1e-9;
  options.direction = setup.direction;
  path::Stops stops;
  const double deflection = 1.0;  // of the first mode, well behind the largest load
  stops.functionals.push_back({"mode_1", setup.monitors[0].weights, deflection});
  const auto bySeries = path::PathFollower(*problem, a, options, stops).run(setup.start, series);
  ASSERT_EQ(bySeries.reason, path::EndReason::stopReached) << bySeries.text;
  record("series", bySeries.steps, bySeries.factorizations, bySeries.solves);
  ASSERT_GE(series.lambda.size(), 1u);
  const double fold = series.lambda.front();

  path::NewtonOptions steps;
  steps.residualBound = 1e-9;
  steps.accuracy = 1e-6;
  steps.direction = setup.direction;
  withNewton(*problem, setup.start, stops, newton, b, steps);
  ASSERT_EQ(newton.lambda.size(), series.lambda.size());
  EXPECT_NEAR(newton.lambda.front(), fold, 2e-6);  // the cubic's accuracy

  LocaOptions loca;
  loca.residualBound = 1e-9;
  loca.maxStep = 0.5;
  loca.stop = [&](const path::State& s) { return setup.monitors[0].weights->dot(*s.u) > deflection; };
  const LocaRun run = followWithLoca(*problem, c, setup.start, loca);
  ASSERT_TRUE(run.stopped);
  record("loca", run.steps, run.factorizations, run.solves);
  const LocaFold found = foldByLoca(*problem, c, run.points, 1, 1e-8);
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.lambda, fold, 1e-7);  // residuals of 1e-9, and room for the strut's softness there
}

}  // namespace
