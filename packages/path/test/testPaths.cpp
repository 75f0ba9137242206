#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "problems/Ends.hpp"
#include "problems/Record.hpp"

using namespace atrapos::path;

namespace {

/// Rows of a comma-separated file; lines that do not start with a number are skipped.
std::vector<std::vector<double>> table(const std::string& name) {
  std::ifstream file(std::string(ATRAPOS_TEST_DATA "/") + name);
  std::vector<std::vector<double>> rows;
  for (std::string text; std::getline(file, text);) {
    for (char& c : text)
      if (c == ',') c = ' ';
    std::istringstream in(text);
    std::vector<double> row;
    for (double x; in >> x;) row.push_back(x);
    if (!row.empty()) rows.push_back(row);
  }
  return rows;
}

/// What must hold on every path that ended well.
template <class Law>
void expectSound(Followed<Law>& f, double bound = 1e-6) {
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  EXPECT_LE(f.outcome.worstResidual, bound);
  EXPECT_LE(f.worstInside(), 1.01 * bound);  // 1 %: 20 samples a step, the bound itself is kept at its end
  EXPECT_EQ(f.outcome.factorizations, f.outcome.steps + f.outcome.corrections + f.outcome.startIterations);
  EXPECT_EQ(f.solver.counters().factorizations, f.outcome.factorizations);
  EXPECT_EQ(f.solver.counters().solves, f.outcome.solves);
  EXPECT_EQ(f.solver.counters().analyses, 1);
  EXPECT_EQ(f.outcome.steps, static_cast<int>(f.record.steps.size()));
  double length = 0;
  for (const auto& s : f.record.steps) {
    EXPECT_EQ(s.pathLengthStart, length);
    length = s.pathLengthEnd;
  }
  EXPECT_EQ(f.outcome.pathLength, length);
}

/// For limit points to eight digits: the load there is off by the residual, i.e. bound x scale.
Options tight(double direction = 1) {
  Options options;
  options.direction = direction;
  options.delta = 1e-8;
  options.residualBound = 1e-9;
  return options;
}

TEST(Path, BarThroughItsLimitPoint) {
  const Options options = tight(-1);
  Followed<StvkBar> f(StvkBar{}, {0}, 0, options, unknown(StvkBar{}, 0, -0.7));
  expectSound(f, 1e-9);
  ASSERT_EQ(f.record.limitPoints().size(), 1u);
  const auto limit = f.record.limitPoints()[0];
  EXPECT_NEAR(limit.lambda, -1 / (3 * std::sqrt(3.0)), 1e-9);  // bound x scale = 1e-10, and some room
  EXPECT_FALSE(limit.maximum);
  for (std::size_t i = 0; i < f.record.steps.size(); ++i)
    for (const auto& p : f.record.steps[i].limitPoints) {
      auto u = f.problem.vector({});
      f.record.series[i].evaluate(p.a, *u);
      EXPECT_NEAR(1 + u->getData()[0], 1 / std::sqrt(3.0),
                  1e-6);  // position: 100 delta, derivative over step
    }
  const double s = 0.3;
  EXPECT_NEAR(f.outcome.final.lambda, s * (s * s - 1) / 2, 1e-10);  // residual bound x scale 0.1
  EXPECT_LE(f.outcome.steps, 6);  // 3 here; a step is about half of a radius of convergence
}

TEST(Path, BarAgreesWithTheTable) {
  int compared = 0;
  for (const auto& row : table("stvk_bar.csv")) {
    if (row.size() < 2 || row[0] > 0.99) continue;
    Options options;
    options.direction = -1;
    Followed<StvkBar> f(StvkBar{}, {0}, 0, options, unknown(StvkBar{}, 0, row[0] - 1));
    EXPECT_NEAR(f.outcome.final.lambda, row[1], 1.1e-7);  // residual bound 1e-6 x scale 0.1, and 15 digits
    ++compared;
  }
  EXPECT_GE(compared, 7);
}

TEST(Path, TrussSnapsThrough) {
  Followed<Truss> f(Truss{}, {0}, 0, tight(), unknown(Truss{}, 0, 2.2));
  expectSound(f, 1e-9);
  const auto limits = f.record.limitPoints();
  ASSERT_EQ(limits.size(), 2u);
  EXPECT_NEAR(limits[0].lambda, 0.384900179459750, 1e-8);
  EXPECT_NEAR(limits[1].lambda, -0.384900179459750, 1e-8);
  EXPECT_TRUE(limits[0].maximum);
  EXPECT_FALSE(limits[1].maximum);
  int compared = 0;
  for (const auto& row : table("vonmises_truss_stvk.csv")) {
    if (row.size() < 2 || row[0] <= 0) continue;
    Followed<Truss> to(Truss{}, {0}, 0, Options{}, unknown(Truss{}, 0, row[0]));
    EXPECT_NEAR(to.outcome.final.lambda, row[1], 1.1e-7) << row[0];  // bound 1e-6 x scale 0.1
    ++compared;
  }
  EXPECT_GE(compared, 20);
}

/// Both the load and the displacement of the load point fold.
TEST(Path, SpringLoadedTrussSnapsBack) {
  const double k = 0.3;
  const auto law = TrussOnSpring{k};
  Followed<TrussOnSpring> f(law, {0, 0}, 0, tight(), unknown(law, 0, 2.2));
  expectSound(f, 1e-9);
  const auto limits = f.record.limitPoints();
  ASSERT_EQ(limits.size(), 2u);
  EXPECT_NEAR(limits[0].lambda, 0.384900179459750, 1e-8);
  // dz/dx = 1 + P'(x)/k = 0 at 3x^2 - 6x + 2 + k = 0.
  std::vector<double> folds;
  for (std::size_t i = 0; i < f.record.series.size(); ++i) {
    const auto& s = f.record.series[i];
    const auto z = s.functional(*f.problem.vector({0, 1}));
    const auto x = s.functional(*f.problem.vector({1, 0}));
    for (const double a : z.derivative().roots(f.record.steps[i].length)) folds.push_back(x(a));
  }
  ASSERT_EQ(folds.size(), 2u);
  EXPECT_NEAR(folds[0], 1 - std::sqrt((1 - k) / 3), 1e-5);  // derivative of the series: delta / step length
  EXPECT_NEAR(folds[1], 1 + std::sqrt((1 - k) / 3), 1e-5);
}

TEST(Path, OnePointBratuIsExact) {
  Followed<Bratu> f(Bratu{1}, {0}, 0, tight(), unknown(Bratu{1}, 0, 3));
  expectSound(f, 1e-9);
  ASSERT_EQ(f.record.limitPoints().size(), 1u);
  EXPECT_NEAR(f.record.limitPoints()[0].lambda, 8 / std::exp(1.0), 1e-8);  // 8 u exp(-u), fold at u = 1
  EXPECT_NEAR(f.outcome.final.lambda, 24 * std::exp(-3.0), 1e-6);
}

/// The discrete folds converge like h^2; one Richardson step must give the exact fold of the equation.
TEST(Path, BratuFoldConverges) {
  double fold[2];
  for (const int level : {0, 1}) {
    const Bratu law{level == 0 ? 15 : 31};
    Followed<Bratu> f(law, std::vector<double>(law.n, 0.0), 0, Options{}, unknown(law, law.n / 2, 3));
    expectSound(f);
    ASSERT_EQ(f.record.limitPoints().size(), 1u);
    fold[level] = f.record.limitPoints()[0].lambda;
    EXPECT_LT(f.outcome.final.lambda, 2.5);  // u_max = 3 lies on the upper branch, at lambda = 2.38
  }
  const double exact = 3.513830719125161;
  EXPECT_NEAR(fold[1], exact, 0.01);                      // h^2 = 1e-3 times a constant of order 1
  EXPECT_NEAR((4 * fold[1] - fold[0]) / 3, exact, 2e-5);  // h^4 = (1/16)^4 times a constant of order 1
}

TEST(Path, PerturbedPitchfork) {
  int compared = 0;
  for (const auto& row : table("perturbed_pitchfork.csv")) {
    if (row.size() < 3) continue;
    const Pitchfork law{row[0]};
    if (row[1] <= -1.0 || row[0] < 1e-3) continue;
    // From a start that is known exactly: lambda = u^2 - eps / u.
    const double u0 = 0.5 * row[0];
    Stops stops = loads({row[1]});
    Followed<Pitchfork> f(law, {u0}, u0 * u0 - law.eps / u0, Options{}, stops);
    EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
    const double slope = std::abs(2 * row[2] + law.eps / (row[2] * row[2])) * row[2];      // |dR/du|
    EXPECT_NEAR(f.final(0), row[2], 1.1e-6 * law.eps / slope) << row[0] << ' ' << row[1];  // residual bound
    ++compared;
  }
  EXPECT_GE(compared, 10);
}

TEST(Path, PitchforkFold) {
  const Pitchfork law{0.1};
  Followed<Pitchfork> f(law, {-1}, 1.1, tight(-1), unknown(law, 0, -0.1));
  expectSound(f, 1e-9);
  ASSERT_EQ(f.record.limitPoints().size(), 1u);
  EXPECT_NEAR(f.record.limitPoints()[0].lambda, 3 * std::pow(0.05, 2.0 / 3), 1e-8);
}

TEST(Path, BothDirectionsComeBack) {
  const auto law = TrussOnSpring{0.3};
  Followed<TrussOnSpring> out(law, {0, 0}, 0, Options{}, unknown(law, 0, 1.2));
  Options back;  // on the falling part dlambda > 0 leads back
  Followed<TrussOnSpring> home(law, {out.final(0), out.final(1)}, out.outcome.final.lambda, back,
                               unknown(law, 0, 0));
  expectSound(home);
  EXPECT_NEAR(home.outcome.final.lambda, 0, 1e-7);  // residual bound x scale
  EXPECT_EQ(home.record.limitPoints().size(), 1u);
}

/// Without the relaxation of the start's residual, Newton corrections must do the work, and are counted.
TEST(Path, CorrectionsAreCountedAsFactorizations) {
  const auto law = TrussOnSpring{0.3};
  Options options;
  options.relaxResidual = false;
  options.correctAbove = 1e-3;
  options.pade = PadeUse::off;  // a fraction is shortened until it needs none
  Followed<TrussOnSpring> f(law, {0, 0}, 0, options, unknown(law, 0, 2.2));
  expectSound(f);
  EXPECT_GT(f.outcome.corrections, 0);
  for (const auto& s : f.record.steps)
    if (s.corrections > 0) {
      EXPECT_LT(s.residual, s.residualOfSeries);
    }
  EXPECT_LE(f.outcome.worstResidual, 1e-9);  // correctAbove x bound
}

/// At a limit point the tangent is singular and a correction at fixed load has no solution; along the path it
/// has.
TEST(Path, CorrectionWorksAtALimitPoint) {
  Options options;
  options.order = 6;  // truncation well above the correction's tolerance ...
  options.maxStep = 0.35;
  options.residualBound = 1e-2;  // ... and below the bound: no cut-backs, both runs take the same steps
  options.correctAbove = 1e-10;
  options.delta = 0.1;
  Followed<Truss> f(Truss{}, {0}, 0, options, unknown(Truss{}, 0, 1));  // to know where
  Stops stops;
  for (const auto& s : f.record.steps)
    for (const auto& p : s.limitPoints) stops.pathLength = s.pathLengthStart + p.a;
  Followed<Truss> g(Truss{}, {0}, 0, options, stops);
  EXPECT_EQ(g.outcome.reason, EndReason::stopReached) << g.outcome.text;
  EXPECT_GT(g.record.steps.back().corrections, 0);
  EXPECT_LE(g.record.steps.back().residual, 1e-12);  // correctAbove x bound
  // lambda, unlike the position, is exact at the extremum: bound 1e-12 x scale, position off by 1e-6,
  // squared.
  EXPECT_NEAR(g.outcome.final.lambda, 0.384900179459750, 1e-11);
}

TEST(Path, EveryOrderFollowsThePath) {
  int before = 1 << 30;
  for (const int order : {1, 3, 5, 10, 20, 40}) {  // not 2: eq. (36) gives steps of delta times a radius
    Options options;
    options.order = order;
    options.maxSteps = 20000;
    const auto followed = [&](PadeUse pade) {
      options.pade = pade;
      Followed<Truss> f(Truss{}, {0}, 0, options, unknown(Truss{}, 0, 2.2));
      expectSound(f);
      EXPECT_NEAR(f.outcome.final.lambda, 2.2 * -1.2 * -0.2, 1.1e-7) << order;  // bound x scale
      return f.outcome.steps;
    };
    const int steps = followed(PadeUse::off);
    EXPECT_LT(steps, before) << order;
    EXPECT_LE(followed(PadeUse::automatic), steps) << order;
    before = steps;
    RecordProperty("steps_order_" + std::to_string(order), steps);
  }
  EXPECT_LE(before, 8);  // 6 at order 20
}

/// The number of steps hardly hangs on rounding: a start moved by 1e-9 gives the same to one step, as a
/// length that is rounded to the other side changes the later ones.
TEST(Path, StepCountIsStable) {
  const auto law = TrussOnSpring{0.3};
  Followed<TrussOnSpring> f(law, {0, 0}, 0, Options{}, unknown(law, 0, 2.2));
  Followed<TrussOnSpring> g(law, {1e-9, 1e-9}, 2e-9, Options{}, unknown(law, 0, 2.2));
  EXPECT_LE(std::abs(f.outcome.steps - g.outcome.steps), 1);
  EXPECT_LE(f.outcome.steps, 17);  // 13 here: the spring is long against its weight near the folds
}

TEST(Path, WeightIsFixedAlongThePathAndCanBeGiven) {
  const auto law = TrussOnSpring{0.3};
  Options options;
  options.weight = 0.25;
  Followed<TrussOnSpring> f(law, {0, 0}, 0, options, unknown(law, 0, 2.2));
  expectSound(f);
  for (const auto& s : f.record.series) EXPECT_EQ(s.weight(), 0.25);
  Followed<TrussOnSpring> g(law, {0, 0}, 0, Options{}, unknown(law, 0, 2.2));
  for (const auto& s : g.record.series) EXPECT_EQ(s.weight(), g.outcome.weight);
}

/// A stiff bar of length 1 that may turn about (0, 0), with a spring across, loaded along y at its end.
struct StiffBar : Linear {
  int size() const { return 2; }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    const S x = u[0] + 1, tension = 5000 * (x * x + u[1] * u[1] - 1);
    return {tension * x, tension * u[1] + u[1] - lambda};
  }
};

// Newton's first iteration turns the bar by lambda and stretches it, which is 150 times the first residual;
// the second makes that good. Halved until none raises the residual, iterations would be 4e-3 of what is
// needed.
TEST(Path, AStartMayRaiseTheResidualOnce) {
  Stops stops = loads({0.1});
  Followed<StiffBar> f(StiffBar{}, {0, 0}, 0.03, Options{}, stops);
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  EXPECT_LE(f.outcome.startIterations, 6);
  EXPECT_NEAR(f.outcome.final.u->getData()[1], 0.1, 1e-6);  // the bound of the residual
}

}  // namespace
