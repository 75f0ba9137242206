// The paper's first example (4.1), a strip pulled over a rigid roll, in hard contact at 41 stations by events
// and by a nearly hard law with its curve as unknown, against the elastica in hard contact at the same
// stations (data/README.md), nu = 0.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/RigidContact.hpp"
#include "support/StripOnRoll.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;
using solid::test::atLoad;
using solid::test::ShellPath;

namespace {

struct Followed final : path::Observer {
  StripOnRoll strip;
  fem::FeProblem problem;
  ShellPath path;
  Numbers events;              ///< load factors at which the contact set changes
  long long unstable = 0;      ///< negative pivots beyond those of the constraints, summed over the steps
  std::size_t mostActive = 0;  ///< stations that touch at once

  Followed(int refinement, double loadFactor, double delta = 1e-6)
      : strip(refinement),
        problem((addHardContact(strip.model, strip.points, strip.roll), std::move(strip.model))) {
    path::Options options;
    options.delta = delta;
    options.residualBound = std::min(delta, options.residualBound);
    path::Stops stops;
    stops.loadFactors = {loadFactor};
    linear::TangentSolverOptions solverOptions;
    solverOptions.symmetric = problem.symmetric();
    const auto solver = linear::makeTangentSolver(solverOptions);
    path::PathFollower follower(problem, *solver, options, stops);
    path.outcome = follower.run({problem.initialState(0), 0.0}, *this);
    EXPECT_EQ(path.outcome.reason, path::EndReason::stopReached) << path.outcome.text;
  }

  bool onStep(const path::StepReport& report, const path::Series& series) override {
    path.series.push_back(series);
    path.lengths.push_back(report.length);
    EXPECT_TRUE(report.inertia);
    if (report.inertia) unstable += report.inertia->negative;
    EXPECT_TRUE(report.limitPoints.empty());
    EXPECT_EQ(report.unexplained, 0);
    // The nodes of a station touch at loads that differ by 1e-7 of themselves: together or one by one.
    if (!report.events.empty() && (events.empty() || report.lambdaEnd > (1 + 1e-6) * events.back()))
      events.push_back(report.lambdaEnd);
    std::vector<char> active(StripOnRoll::stations, 0);
    const auto conditions = problem.conditionsAt(report.next.state);
    for (std::size_t p = 0; p < conditions.size(); ++p)
      if (conditions[p] == 1) active[strip.station[p]] = 1;
    mostActive = std::max<std::size_t>(mostActive, std::count(active.begin(), active.end(), 1));
    return true;
  }

  struct Deviation {
    double tip = 0;    ///< mm
    double force = 0;  ///< of a station, in units of the sum of forces
  };
  /// From the reference, lambda in (from, to].
  Deviation deviation(double from, double to) {
    std::vector<int> all(fem::FeProblem::values(*problem.initialState(0)).size());
    for (std::size_t d = 0; d < all.size(); ++d) all[d] = static_cast<int>(d);
    Deviation worst;
    int compared = 0;
    for (const auto& row : solid::test::table(ATRAPOS_CONTACT_TEST_DATA "/roll_41_stations_hard.csv")) {
      const double lambda = row[0], total = row[4];
      if (!(lambda > from && lambda <= to)) continue;
      const Numbers u = atLoad(path, lambda, all).u;
      for (int i : {0, 2}) worst.tip = std::max(worst.tip, std::abs(u[3 * strip.tip + i] - row[1 + i / 2]));
      const Numbers forces = strip.stationForces(problem, u);
      for (int s = 18; s <= 27; ++s)
        worst.force = std::max(worst.force, std::abs(forces[s] - row[12 + s - 18]) / total);
      ++compared;
    }
    EXPECT_GT(compared, 10);
    return worst;
  }
};

/// Rows of the table from here on have contact; before, its barrier's forces are all there is.
constexpr double touched = 0.0011;

}  // namespace

// Two elements between stations, so that all kinks of the curvature are at edges of elements.
TEST(HardShellOnRoll, AStepAnEvent) {
  Followed f(2, 0.25);
  // Stations 200, 210, 220 and 230 mm close, 200, 210 and 220 mm open.
  ASSERT_EQ(f.events.size(), 7u);
  EXPECT_LE(f.path.outcome.steps, 14);  // 11, and three for another machine's rounding
  EXPECT_EQ(f.path.outcome.eventTrials, 0);
  EXPECT_EQ(f.unstable, 0);
  EXPECT_EQ(f.mostActive, 2u);
  // The reference neglects 0.01 mm of stretch and shear.
  const auto d = f.deviation(touched, 0.25);
  EXPECT_LT(d.tip, 0.005);
  EXPECT_LT(d.force, 5e-4);
}

// The paper's twenty elements, each with a station at its middle. A station's two or three nodes need not
// touch together.
TEST(HardShellOnRoll, TwentyElements) {
  Followed f(1, 0.25);
  EXPECT_GE(f.events.size(), 7u);
  EXPECT_LE(f.path.outcome.steps, 20);
  EXPECT_EQ(f.unstable, 0);
  const auto d = f.deviation(touched, 0.25);
  EXPECT_LT(d.tip, 0.02);
  EXPECT_LT(d.force, 5e-3);
}

// Far into the wrapped regime, up to three stations at once.
TEST(HardShellOnRoll, Wrapped) {
  Followed f(2, 1.5);
  EXPECT_LE(f.path.outcome.steps, 24);
  EXPECT_EQ(f.unstable, 0);
  EXPECT_EQ(f.mostActive, 3u);
  const auto d = f.deviation(0.25, 1.5);
  EXPECT_LT(d.tip, 0.02);
  EXPECT_LT(d.force, 6e-3);
}

// Event loads do not depend on delta: six digits.
TEST(HardShellOnRoll, EventLoadsConverge) {
  const Followed loose(2, 0.25, 1e-5), middle(2, 0.25, 1e-6), tight(2, 0.25, 1e-8);
  ASSERT_EQ(loose.events.size(), tight.events.size());
  ASSERT_EQ(middle.events.size(), tight.events.size());
  for (std::size_t i = 0; i < tight.events.size(); ++i) {
    EXPECT_NEAR(middle.events[i] / tight.events[i], 1, 1e-6) << i;
    EXPECT_NEAR(loose.events[i] / tight.events[i], 1, 1e-5) << i;
  }
}

namespace {

enum class Unknown { displacements, curve };

/// Contact by law (15) at one point a station, to lambda = 0.25.
struct NearlyHard {
  StripOnRoll strip;
  std::unique_ptr<fem::FeProblem> problem;
  ShellPath path;

  NearlyHard(int refinement, const RegularisedPressure& law, Unknown unknown) : strip(refinement) {
    for (const auto& points : strip.stationPoints())
      if (unknown == Unknown::curve)
        addCurveContact(strip.model, points, strip.roll, law, strip.gaps(points));
      else
        addContact(strip.model, points, strip.roll, law, 0);
    problem = std::make_unique<fem::FeProblem>(std::move(strip.model));
    path::Stops stops;
    stops.loadFactors = {0.25};
    path = solid::test::followPath(*problem, stops);
    EXPECT_EQ(path.outcome.reason, path::EndReason::stopReached) << path.outcome.text;
  }

  int steps() const { return path.outcome.steps; }
  /// Of the tip from the reference in hard contact, mm.
  double deviation() const {
    double worst = 0;
    for (const auto& row : solid::test::table(ATRAPOS_CONTACT_TEST_DATA "/roll_41_stations_hard.csv")) {
      if (!(row[0] > touched && row[0] <= 0.25)) continue;
      const auto u = atLoad(path, row[0], {3 * strip.tip, 3 * strip.tip + 2}).u;
      for (int i : {0, 1}) worst = std::max(worst, std::abs(u[i] - row[1 + i]));
    }
    return worst;
  }
};

}  // namespace

// alpha = 1e6 N/mm, eta = 1e-5 N: three quarters of the steps that displacements and load need at most (half
// of those with polynomials alone, 117), and three times those of a soft law.
TEST(CurveShellOnRoll, FewerSteps) {
  const RegularisedPressure hard{1e-6, 1e-5}, soft{1e-3, 0.1};
  const NearlyHard onCurve(1, hard, Unknown::curve);
  EXPECT_LE(4 * onCurve.steps(), 3 * NearlyHard(1, hard, Unknown::displacements).steps());  // 55 and 80
  EXPECT_LE(onCurve.steps(), 3 * NearlyHard(1, soft, Unknown::displacements).steps());
  // The barrier has the same curve but for its last part.
  EXPECT_LE(std::abs(NearlyHard(1, {0, 1e-5}, Unknown::curve).steps() - onCurve.steps()), 5);
  EXPECT_LT(onCurve.deviation(), 0.02);
}

// What is left of the deviation is the elements', then the law's own: sqrt(eta) where a station just touches.
TEST(CurveShellOnRoll, TendsToHardContact) {
  const NearlyHard fine(2, {1e-6, 1e-5}, Unknown::curve), closer(2, {1e-6, 1e-7}, Unknown::curve);
  EXPECT_LT(fine.deviation(), 0.01);
  EXPECT_LT(closer.deviation(), 0.005);
  EXPECT_LT(closer.deviation(), fine.deviation());
}
