// What the failure map calls on the path, going back and another branch.
#include <gtest/gtest.h>

#include <Tpetra_Vector.hpp>
#include <cmath>

#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/models/Models.hpp"
#include "atrapos/path/PathFollower.hpp"
#include "output/ReferencePath.hpp"

namespace atrapos::test {
namespace {

/// The truss x (1 - x) (2 - x) = lambda as a reference.
class Reference : public testing::Test, public path::Observer {
 protected:
  void SetUp() override {
    problem_ = models::make("von_mises_truss", {});
    const auto setup = models::setup("von_mises_truss", {}, *problem_);
    linear::TangentSolverOptions solverOptions;
    const auto solver = linear::makeTangentSolver(solverOptions);
    path::Options options;
    options.delta = options.residualBound = 1e-9;
    path::PathFollower follower(*problem_, *solver, options, setup.stops);
    ASSERT_EQ(follower.run(setup.start, *this).reason, path::EndReason::stopReached);
  }
  bool onStep(const path::StepReport& report, const path::Series& series) override {
    reference_.append(report, series);
    return true;
  }
  ReferencePath::Walker::Place go(ReferencePath::Walker& walker, double x, double off = 0) const {
    path::Vector u(problem_->map());
    u.putScalar(x);
    return walker.go(u, x * (1 - x) * (2 - x) + off);
  }

  std::unique_ptr<path::Problem> problem_;
  ReferencePath reference_{20};
};

using Place = ReferencePath::Walker::Place;
constexpr double kTolerance = 0.02;  // the path is about 2.5 long, its chords are below 0.1

TEST_F(Reference, StatesOfThePathAreOnItUpToItsEnd) {
  ReferencePath::Walker walker(reference_, kTolerance);
  for (double x = 0; x < 2.2; x += 0.05) {
    EXPECT_EQ(go(walker, x), Place::on) << x;
    EXPECT_FALSE(walker.atEnd()) << x;
    if (x > 1.9) break;
  }
  for (double x = 1.95; x <= 2.2; x += 0.05) EXPECT_EQ(go(walker, x), Place::on) << x;
  EXPECT_TRUE(walker.atEnd());
}

TEST_F(Reference, OtherStatesAreNot) {
  ReferencePath::Walker walker(reference_, kTolerance);
  for (double x = 0; x < 0.4; x += 0.05) ASSERT_EQ(go(walker, x), Place::on);
  EXPECT_EQ(go(walker, 0.4, 0.5), Place::off);
}

TEST_F(Reference, GoingBackIsSeen) {
  ReferencePath::Walker walker(reference_, kTolerance);
  for (double x = 0; x < 0.8; x += 0.05) ASSERT_EQ(go(walker, x), Place::on);
  for (double x = 0.75; x > 0.7; x -= 0.05) go(walker, x);
  EXPECT_EQ(go(walker, 0.3), Place::behind);
}

}  // namespace
}  // namespace atrapos::test
