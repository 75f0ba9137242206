// Problems that are analytic piece by piece: a step ends at a border where the residual asks for it.
#include <cmath>

#include <gtest/gtest.h>

#include "atrapos/path/Pieces.hpp"
#include "problems/Record.hpp"

using namespace atrapos::path;

namespace {

/// A spring with x + x^3 = lambda up to x = 1 (piece 0) and 2 + jump + slope (x - 1) + bend (x - 1)^2 =
/// lambda beyond.
struct TwoSprings {
  double jump = 0, slope = 4, bend = 0;  // 4 and 3: the first spring to second order
  int preferred = -1;                    ///< piece at the border; -1: none
  int held = -1;                         ///< piece everywhere; -1: that of the place

  int size() const { return 1; }
  double scale() const { return 1; }
  static int pieceOf(double x) { return x < 1 ? 0 : 1; }
  int pieceAt(double x) const {
    if (held >= 0) return held;
    return preferred >= 0 && std::abs(x - 1) < 1e-6 ? preferred : pieceOf(x);
  }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    const S x = u[0], y = x - S(1.0);
    if (pieceAt(x[0]) == 0) return {x + x * x * x - lambda};
    return {S(2 + jump) + S(slope) * y + S(bend) * y * y - lambda};
  }
  template <class S>
  std::vector<S> internal(const std::vector<S>&, const S&) const {
    return {};
  }
};

class TwoSpringsProblem final : public JetProblem<TwoSprings>, public Pieces {
 public:
  using JetProblem::JetProblem;

  Pieces* pieces() override { return this; }
  State afterEvent(const std::vector<int>& indices, const State& state) override {
    auto memory = std::make_shared<Memory>();
    int preferred = state.memory ? state.memory->conditions[0] : -1;
    for (const int i : indices) preferred = preferred == i ? -1 : i;
    memory->conditions = {preferred};
    return {state.u, state.lambda, memory};
  }

  void beginSeries(const State& state, int maxOrder) override {
    JetProblem::beginSeries(state, maxOrder);
    ofSeries_ = law_.pieceAt(state.u->getData()[0]);
  }

  ResidualNorm residualOfSeries(const State& state, Vector& r) override {
    law_.held = ofSeries_;
    const auto result = residual(state, r);
    law_.held = -1;
    return result;
  }
  bool eventsAstray(const State&, const std::vector<int>&) const override { return false; }
  std::vector<Break> breaks(const Series& series, double end) const override {
    auto u = vector({});
    const auto pieceAt = [&](double a) {
      series.evaluate(a, *u);
      return law_.pieceOf(u->getData()[0]);
    };
    if (pieceAt(end) == ofSeries_) return {};
    double low = 0, high = end;
    for (int i = 0; i < 100; ++i) (pieceAt((low + high) / 2) == ofSeries_ ? low : high) = (low + high) / 2;
    return {{low, 1 - ofSeries_}};
  }
  /// The relative residual on this piece, wherever the state is.
  double residualOn(int piece, const State& state) const {
    TwoSpringsProblem other(*this);
    other.law_.held = piece;
    auto r = vector({});
    return other.residual(state, *r).relative();
  }
  bool continues(const State& state, int) const override {
    return law_.pieceOf(state.u->getData()[0]) == ofSeries_;
  }
  std::string text(int index) const override { return "the force jumps at piece " + std::to_string(index); }

 protected:
  void remember(const State& state) override {
    law_.preferred = state.memory ? state.memory->conditions[0] : -1;
  }

 private:
  int ofSeries_ = 0;
};

struct MovedSprings {
  TwoSpringsProblem problem;
  SymmetricDenseSolver solver;
  Record record;
  Outcome outcome;

  MovedSprings(const TwoSprings& law, double end, const Start* from = nullptr,
        double jumpBound = Options{}.jumpBound)
      : problem(law) {
    Stops stops;
    stops.functionals = {{"x", problem.vector({1}), end}};
    Start start;
    start.state = {problem.vector({}), 0};
    Options options;
    options.maxSteps = 60;
    options.jumpBound = jumpBound;
    outcome = PathFollower(problem, solver, options, stops).runFrom(from ? *from : start, record);
  }
  std::vector<StepReport> breaks() const {
    std::vector<StepReport> all;
    for (const auto& s : record.steps)
      if (!s.events.empty()) all.push_back(s);
    return all;
  }
};

// The same slope but another curvature: the residual beyond falls with the square of the way only.
TEST(Pieces, AJumpOfTheCurvature) {
  const MovedSprings f({0, 4, -1}, 1.5);
  ASSERT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  ASSERT_EQ(f.breaks().size(), 1u);
  EXPECT_NEAR(f.breaks()[0].end.u->getData()[0], 1, 1e-6);  // Newton's correction may move it
  EXPECT_NEAR(f.breaks()[0].lambdaEnd, 2, 4e-6);
  EXPECT_NEAR(f.outcome.final.lambda, 2 + 4 * 0.5 - 0.25, 2e-6);  // bound of the residual: 1e-6
  EXPECT_EQ(f.outcome.events, 1);
  EXPECT_EQ(f.outcome.eventTrials, 0);
  EXPECT_TRUE(f.record.limitPoints().empty());
}

// Softening from the border on: the path goes on in x, so lambda turns there.
TEST(Pieces, AKinkMayBeALimitPoint) {
  const MovedSprings f({0, -1, 0}, 1.5);
  ASSERT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  EXPECT_NEAR(f.outcome.final.lambda, 1.5, 2e-6);
  const auto limits = f.record.limitPoints();
  ASSERT_EQ(limits.size(), 1u);
  EXPECT_NEAR(limits[0].lambda, 2, 4e-6);
  EXPECT_TRUE(limits[0].maximum);
  EXPECT_FALSE(limits[0].smooth);
}

// Where the functions differ by less than the bound of the residual, a border ends no step.
TEST(Pieces, ABorderThatDoesNotMatter) {
  const MovedSprings across({0, 4, 3}, 1.001);  // off by 1e-9
  ASSERT_EQ(across.outcome.reason, EndReason::stopReached) << across.outcome.text;
  EXPECT_TRUE(across.breaks().empty());
}

TEST(Pieces, AJumpOfTheForceEndsThePath) {
  const MovedSprings f({0.1, 4, 0}, 1.5);
  EXPECT_EQ(f.outcome.reason, EndReason::problemFailed);
  EXPECT_NE(f.outcome.text.find("the force jumps at piece 1"), std::string::npos) << f.outcome.text;
  EXPECT_NEAR(f.outcome.final.lambda, 2, 4e-6);
}

// Up to Options::jumpBound a jump is corrected: the next step starts on the other piece.
TEST(Pieces, ALittleJumpIsPassed) {
  // Down and up: where the force rises at the border, that path begins at a larger load.
  for (const double jump : {-2e-4, 2e-4}) {
    SCOPED_TRACE(jump);
    const MovedSprings f({jump, 4, -1}, 1.5);
    ASSERT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
    ASSERT_EQ(f.breaks().size(), 1u);
    const StepReport& at = f.breaks()[0];
    const auto beyond = f.problem.residualOn(1, at.end);
    EXPECT_NEAR(at.jump, beyond, 1e-12);  // the same residual, computed once more
    EXPECT_GT(at.jump, 1e-5);
    EXPECT_EQ(f.outcome.jumps, 1);
    EXPECT_EQ(f.outcome.worstJump, at.jump);
    EXPECT_GE(at.corrections, 1);
    EXPECT_NEAR(f.outcome.final.lambda, 2 + jump + 4 * 0.5 - 0.25, 2e-6);  // bound of the residual: 1e-6
    EXPECT_EQ(f.outcome.factorizations, f.outcome.steps + f.outcome.corrections + f.outcome.closings +
                                            f.outcome.criticalFactorizations + f.outcome.eventTrials);

    const MovedSprings strict({jump, 4, -1}, 1.5, nullptr, 0);
    EXPECT_EQ(strict.outcome.reason, EndReason::problemFailed);
    EXPECT_NE(strict.outcome.text.find("the force jumps at piece 1"), std::string::npos)
        << strict.outcome.text;
  }
}

TEST(Pieces, RestartsHaveTheSameBits) {
  const auto expectSameBits = [](const TwoSprings& law, double jumpBound) {
    const MovedSprings whole(law, 1.5, nullptr, jumpBound);
    const auto& all = whole.record.steps;
    ASSERT_GE(all.size(), 3u);
    for (std::size_t s = 0; s + 1 < all.size(); ++s) {
      const MovedSprings rest(law, 1.5, &all[s].next, jumpBound);
      EXPECT_EQ(rest.outcome.reason, whole.outcome.reason);
      EXPECT_EQ(rest.outcome.steps, whole.outcome.steps);
      EXPECT_EQ(rest.outcome.final.lambda, whole.outcome.final.lambda);
      EXPECT_EQ(rest.outcome.final.u->getData()[0], whole.outcome.final.u->getData()[0]);
    }
  };
  for (const TwoSprings& law : {TwoSprings{0, 4, -1}, TwoSprings{0, -1, 0}, TwoSprings{2e-4, 4, -1}})
    expectSameBits(law, 1e-3);
  // Beyond the border a residual above its bound, 1e-6, that is let pass and not corrected.
  expectSameBits({3e-6, 4, 0}, 0);
}

}  // namespace
