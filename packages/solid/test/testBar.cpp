// A cube between planes of symmetry, pulled or pushed by a dead force P on one face: uniaxial stress, with the closed
// form P/(EA) = s (s^2 - 1)/2 of the stretch s and lateral stretch sqrt(1 - nu (s^2 - 1)). Under compression the load
// has its limit at s = 1/sqrt 3, P/(EA) = -1/(3 sqrt 3).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "SolidModel.hpp"
#include "atrapos/fem/Loads.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/PathFollower.hpp"
#include "atrapos/path/SeriesStep.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::solid::test;
using namespace atrapos::fem::test;

namespace {

const double limitStretch = 1 / std::sqrt(3.0), limitLoad = 1 / (3 * std::sqrt(3.0));

struct Bar {
  double E = 3.0, nu = 0;
  fem::Mesh mesh;
  std::unique_ptr<fem::FeProblem> problem;
  std::unique_ptr<linear::TangentSolver> solver = linear::makeTangentSolver();

  Bar(fem::Topology cell, std::array<int, 3> divisions, double poisson) : nu(poisson), mesh(box(cell, divisions)) {
    fem::FeModel model = solidModel(mesh, SaintVenantKirchhoff::fromYoung(E, nu));
    // Eight points leave a lone HEX20 with hourglass modes that planes of symmetry do not hold.
    if (cell == fem::Topology::Hex20)
      model.terms[0] = std::make_unique<fem::LawTerm<SaintVenantKirchhoff, fem::DisplacementGradient>>(
          SaintVenantKirchhoff::fromYoung(E, nu), fem::volumePoints(mesh, mesh.blocks[0], fem::tabulate(cell, 5)));
    const char* planes[3] = {"x_min", "y_min", "z_min"};
    for (int i = 0; i < 3; ++i)
      for (int n : nodesOfSet(mesh, planes[i])) model.supports.prescribe(n, i, 0.0, 0.0);
    fem::addSurfaceForce(mesh, sideSet(mesh, "x_max"), {E, 0, 0}, model.load);  // lambda = P/(EA), A = 1
    problem = std::make_unique<fem::FeProblem>(std::move(model));
  }

  int corner() const { return nodesOfSet(mesh, "x_max_y_max_z_max").at(0); }

  /// Largest distance of the nodes from the homogeneous state of this stretch.
  double error(const Numbers& u, double s) const {
    const double stretch[3] = {s, std::sqrt(1 - nu * (s * s - 1)), std::sqrt(1 - nu * (s * s - 1))};
    double worst = 0;
    for (std::size_t d = 0; d < u.size(); ++d)
      worst = std::max(worst, std::abs(u[d] - (stretch[d % 3] - 1) * mesh.coordinates[d]));
    return worst;
  }
};

/// Looks at ten points inside every step.
class Watch : public path::Observer {
 public:
  explicit Watch(const Bar& bar) : bar_(bar) {}

  bool onStep(const path::StepReport& report, const path::Series& series) override {
    auto u = zeroVector(*bar_.problem);
    for (int i = 1; i <= 10; ++i) {
      const double lambda = series.evaluate(0.1 * i * report.length, *u);
      const Numbers values = fem::FeProblem::values(*u);
      const double s = 1 + values[3 * bar_.corner()];
      loadError = std::max(loadError, std::abs(lambda - s * (s * s - 1) / 2));
      shapeError = std::max(shapeError, bar_.error(values, s));
      least = std::min(least, s);
    }
    for (const auto& point : report.limitPoints) {
      limits.push_back(point);
      series.evaluate(point.a, *u);
      limitStretches.push_back(1 + fem::FeProblem::values(*u)[3 * bar_.corner()]);
    }
    return true;
  }

  double loadError = 0, shapeError = 0, least = 1;
  std::vector<path::LimitPoint> limits;
  std::vector<double> limitStretches;

 private:
  const Bar& bar_;
};

struct Followed {
  path::Outcome outcome;
  Watch watch;
};

/// Default options, compression, until the face has moved by `displacement`.
Followed follow(Bar& bar, double displacement) {
  path::Options options;
  options.direction = -1;
  path::Stops stops;
  Numbers weights(bar.mesh.coordinates.size(), 0.0);
  weights[3 * bar.corner()] = 1;
  stops.functionals.push_back({"end displacement", vectorOf(*bar.problem, weights), displacement});
  Watch watch(bar);
  path::PathFollower follower(*bar.problem, *bar.solver, options, stops);
  const auto outcome = follower.run({bar.problem->initialState(0), 0.0}, watch);
  return {outcome, watch};
}

class OneBar : public testing::TestWithParam<fem::Topology> {};
const auto cellName = [](const auto& info) { return std::string(fem::topologyName(info.param)); };

}  // namespace

TEST_P(OneBar, ThroughTheLimitPoint) {
  for (double nu : {0.0, 0.3}) {
    SCOPED_TRACE(nu);
    Bar bar(GetParam(), {1, 1, 1}, nu);
    const auto [outcome, watch] = follow(bar, -0.6);
    ASSERT_EQ(outcome.reason, path::EndReason::stopReached) << outcome.text;
    EXPECT_NEAR(watch.least, 0.4, 1e-9);
    RecordProperty("steps", outcome.steps);
    // printed for the tolerances
    printf("%s nu %g steps %d load %.2e shape %.2e limits %zu", fem::topologyName(GetParam()), nu, outcome.steps,
           watch.loadError, watch.shapeError, watch.limits.size());
    if (!watch.limits.empty())
      printf(" limit %.2e %.2e", watch.limits[0].lambda + limitLoad, watch.limitStretches[0] - limitStretch);
    printf(" corr %d cut %d restarts %d\n", outcome.corrections, outcome.cutBacks, outcome.restarts);
    ASSERT_EQ(watch.limits.size(), 1u);
    EXPECT_FALSE(watch.limits[0].maximum);
    EXPECT_NEAR(watch.limits[0].lambda, -limitLoad, 1e-8);
    EXPECT_NEAR(watch.limitStretches[0], limitStretch, 1e-6);
    EXPECT_LT(watch.loadError, 1e-6);
    EXPECT_LT(watch.shapeError, 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(All, OneBar, testing::ValuesIn(allCells()), cellName);
