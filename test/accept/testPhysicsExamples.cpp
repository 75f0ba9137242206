// examples/reaction/*.yaml and examples/heat/*.yaml against closed forms and published numbers
// (docs/physics.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "support/ExampleRun.hpp"

namespace atrapos::test {
namespace {

struct Point {
  double loadFactor = 0;
  std::map<std::string, double> monitors;
};

/// Entries of a list of the summary, "load_limits" or "points".
std::vector<Point> pointsIn(const ExampleRun& run, const std::string& list) {
  std::vector<Point> found;
  for (const auto& entry : run.summary.at(list))
    found.push_back({entry.at("load_factor"), entry.at("monitors").get<std::map<std::string, double>>()});
  return found;
}

/// `number` to a relative accuracy.
void expectClose(double value, double number, double accuracy) {
  EXPECT_NEAR(value, number, accuracy * std::abs(number));
}

const double pi = std::acos(-1.0);

}  // namespace

/// 6.80812442258 and 1.39166120598 (shared with the table of Chebyshev collocation in the model problems);
/// the mesh's error is 1.4e-6, and falls by 16 when it is halved: a functional of a quadratic cell.
TEST(Bratu, FoldOnTheSquare) {
  double error[2];
  for (int i = 0; i < 2; ++i) {
    const std::string n = i == 0 ? "8" : "16";
    const ExampleRun run("reaction/bratu_square.yaml", {{"[16, 16]", "[" + n + ", " + n + "]"}});
    const auto folds = pointsIn(run, "load_limits");
    ASSERT_EQ(folds.size(), 1u);
    error[i] = folds[0].loadFactor - 6.80812442258;
    expectClose(folds[0].monitors.at("centre"), 1.39166120598, 1e-4);
    EXPECT_LE(run.summary.at("worst_residual"), 1e-6);
    EXPECT_LE(run.summary.at("steps"), 4);
    // What comes up flows out through four equal sides.
    EXPECT_LT(folds[0].monitors.at("inflow"), 0);
  }
  EXPECT_LT(std::abs(error[1]), 1.5e-5);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 4, 0.2);
}

/// Folds of the ball, published to six digits. The mesh's error grows with the load's rise in the centre.
TEST(Bratu, FoldsOfTheBall) {
  const ExampleRun run("reaction/bratu_ball.yaml");
  const auto folds = pointsIn(run, "load_limits");
  ASSERT_EQ(folds.size(), 3u);
  expectClose(folds[0].loadFactor, 3.321992, 3e-7);
  expectClose(folds[1].loadFactor, 1.664156, 2e-6);
  expectClose(folds[2].loadFactor, 2.10854, 5e-6);
  EXPECT_LE(run.summary.at("steps"), 9);
}

TEST(Bratu, FoldOfTheCube) {
  const ExampleRun run("reaction/bratu_cube.yaml");
  const auto folds = pointsIn(run, "load_limits");
  ASSERT_EQ(folds.size(), 1u);
  expectClose(folds[0].loadFactor, 9.900138, 1e-5);
  expectClose(folds[0].monitors.at("centre"), 1.62098, 2e-4);
}

/// Two folds below e = 0.24578, where they meet at lambda = 1.3074, none above.
TEST(Explosion, FoldsMeetInACusp) {
  const auto folds = [](const std::string& e) {
    return pointsIn(ExampleRun("reaction/explosion.yaml", {{"{e: 0.2}", "{e: " + e + "}"}}), "load_limits");
  };
  EXPECT_EQ(folds("0.2").size(), 2u);
  const auto near = folds("0.2455");
  ASSERT_EQ(near.size(), 2u);
  // Near the cusp: with its distance d = 0.24578 - e the folds are apart by some d^(3/2).
  expectClose((near[0].loadFactor + near[1].loadFactor) / 2, 1.3074, 2e-3);
  EXPECT_TRUE(folds("0.246").empty());
}

/// The uniform state loses its stability at p = sqrt(60) sqrt(3 - sqrt 8), p = 3.5 - lambda, with a wave of
/// two halves on this length: found on a tangent that is not symmetric, and both branches are followed.
TEST(Schnakenberg, TuringsBifurcation) {
  const ExampleRun run("reaction/schnakenberg.yaml");
  const auto points = pointsIn(run, "points");
  ASSERT_EQ(points.size(), 1u);
  expectClose(3.5 - points[0].loadFactor, std::sqrt(60) * std::sqrt(3 - std::sqrt(8)), 1e-8);
  EXPECT_EQ(run.summary.at("branches").size(), 3u);
  EXPECT_EQ(run.summary.at("points")[0].at("kind"), "pitchfork");
  EXPECT_TRUE(run.summary.at("branches_complete"));
  EXPECT_EQ(run.summary.at("unexplained_sign_changes"), 0);
}

/// Hopf points of the rest state at l = n pi sqrt((D1 + D2)/(b - 1 - a^2)), with omega^2 the determinant of
/// the reaction with diffusion there; the mesh's error is that of an eigenvalue of quadratic cells, of
/// order 4.
TEST(Brusselator, HopfPointsAlongTheLength) {
  const double D1 = 0.008, D2 = 0.004, a2 = 4, b = 5.45;
  const double q = (b - 1 - a2) / (D1 + D2), first = pi / std::sqrt(q);
  const double frequency = std::sqrt((b - 1 - D1 * q) * (-a2 - D2 * q) + a2 * b);
  double error[2][4];
  for (int i = 0; i < 2; ++i) {
    const ExampleRun run("reaction/brusselator.yaml", {{"[32, 1]", i == 0 ? "[16, 1]" : "[32, 1]"}});
    const auto points = pointsIn(run, "hopf_points");
    ASSERT_EQ(points.size(), 4u);
    for (int n = 1; n <= 4; ++n) {
      const auto& entry = run.summary.at("hopf_points")[n - 1];
      error[i][n - 1] = points[n - 1].monitors.at("length") - n * first;
      expectClose(entry.at("frequency"), frequency, i == 0 ? 1e-3 : 1e-4);
      EXPECT_EQ(entry.at("negative_change"), 2);
      EXPECT_LT(entry.at("uncertainty"), 1e-6);
    }
    EXPECT_TRUE(run.summary.at("points").empty());
    // Two more unstable eigenvalues behind each.
    const auto length = run.column("length"), unstable = run.column("negative_eigenvalues");
    for (std::size_t k = 0; k < length.size(); ++k)
      EXPECT_EQ(unstable[k], 2 * std::floor(length[k] / first)) << length[k];
  }
  for (int n = 1; n <= 4; ++n) EXPECT_LT(std::abs(error[1][n - 1]), 2e-5 * n * first) << n;
  // Those of one and two half waves are off by what eigenvalues are computed to already.
  for (int n = 3; n <= 4; ++n) EXPECT_NEAR(std::log2(error[0][n - 1] / error[1][n - 1]), 4, 0.2) << n;
}

/// A run that goes on knows the points before it.
TEST(Brusselator, GoesOn) {
  const ExampleRun run("reaction/brusselator.yaml", {{"load_factor: 2", "load_factor: 1"}});
  EXPECT_EQ(pointsIn(run, "hopf_points").size(), 2u);
  writeFile(run.folder.deck(), edited(readFile(run.folder.deck()), "{load_factor: 1}", "{load_factor: 2}"));
  const auto result = runAtrapos({"run", "-q", "--restart", "results", "deck.yaml"}, run.folder.path());
  ASSERT_EQ(result.exitCode, 0) << result.err;
  const auto found = nlohmann::json::parse(readFile(run.folder.results("summary.json"))).at("hopf_points");
  ASSERT_EQ(found.size(), 4u);
  for (int n = 1; n <= 4; ++n) expectClose(found[n - 1].at("monitors").at("length"), 0.513020 * n, 1e-4);
  expectClose(found[0].at("frequency"), 2.13951, 1e-4);
}

/// Uniform temperature: the voltage is largest at T = B/2 (1 - sqrt(1 - 4 T0/B)), whatever the other numbers
/// are, and the current is what the load says.
TEST(Thermistor, LargestVoltage) {
  const ExampleRun run("heat/thermistor.yaml");
  const Table points((run.folder.results("points.csv")).string());
  ASSERT_EQ(points.column("voltage").size(), 1u);
  const double T = 2000 * (1 - std::sqrt(1 - 4 * 300 / 4000.0));
  // Where the voltage of a series is stationary whose residual is up to 1e-6 of the current.
  expectClose(points.column("temperature")[0], T, 3e-8);
  const double sigma = 2 * std::exp(-4000 * (1 / T - 1 / 300.0)), loss = 5e5 * (T - 300);
  expectClose(points.column("voltage")[0], 0.01 * std::sqrt(loss / sigma), 1e-8);
  const auto load = run.column("load_factor"), ground = run.column("ground");
  for (std::size_t i = 0; i < load.size(); ++i)
    EXPECT_NEAR(ground[i], -load[i] * 1e4 * 0.002 * 0.002, 8e-8);  // the residual's bound times the current
}

/// alpha dT = pi^2/(6 (1 + nu)) (h/a)^2 of thin plates.
void expectBucklesAsThinPlate(const std::string& deck, double tolerance) {
  const ExampleRun run(deck);
  const auto points = pointsIn(run, "points");
  ASSERT_EQ(points.size(), 1u);
  expectClose(points[0].loadFactor * 1e-4, pi * pi / (6 * 1.3) * 1e-4, tolerance);
  EXPECT_EQ(run.summary.at("branches").size(), 3u);
}

// The solid is softer by its shear, 0.2 % here, shells 0.02 %.
TEST(HeatedPlate, Buckles) { expectBucklesAsThinPlate("heat/plate.yaml", 5e-3); }
TEST(HeatedPlate, BucklesAsShells) { expectBucklesAsThinPlate("heat/plate_shells.yaml", 1e-3); }

/// Three fields, a tangent that is not symmetric, numbers of six orders of magnitude: the mean temperature
/// V^2 sigma/(12 k) with V = 10 lambda buckles the beam at alpha T = pi^2 h^2/(3 L^2). Shear and the cells
/// make 0.04 % of the load factor.
TEST(JouleBeam, BucklesByItsCurrent) {
  const ExampleRun run("heat/joule_beam.yaml");
  const auto points = pointsIn(run, "points");
  ASSERT_EQ(points.size(), 1u);
  const double T = pi * pi / (3 * 100 * 100) / 1e-5;
  expectClose(points[0].loadFactor, std::sqrt(12 * T / 2) / 10, 1e-3);
  expectClose(points[0].monitors.at("middle_T"), 1.5 * T, 2e-3);
  expectClose(points[0].monitors.at("current"), 2 * points[0].loadFactor * 10 / 100, 1e-6);
  EXPECT_EQ(run.summary.at("branches").size(), 3u);
  EXPECT_EQ(run.summary.at("unexplained_sign_changes"), 0);
  EXPECT_TRUE(run.summary.at("branches_complete"));
}

/// Metres or millimetres, kelvins or their thousandths: the same beam has the same path, though numbers of
/// its fields are up to nine orders of magnitude apart, and next to as many steps (lengths follow the first
/// response, which volts, the only ones that move at first, are all of).
TEST(JouleBeam, IsTheSameInAllUnits) {
  const Edits metres{{"lengths: [100, 1]", "lengths: [0.1, 0.001]"},
                     {"thickness: 1}", "thickness: 0.001}"},
                     {"youngs_modulus: 2.0e5", "youngs_modulus: 2.0e11"}};
  // In thousandths, k 1e3 times smaller would be the same heat; sources in other units change nothing.
  const Edits millikelvins{{"alpha: 1e-5", "alpha: 1e-8"}, {"k: 1,", "k: 1e-3,"}};
  const ExampleRun known("heat/joule_beam.yaml");
  const auto at = pointsIn(known, "points")[0];
  const double tip = std::abs(known.column("middle_y").back());
  EXPECT_LE(known.summary.at("steps"), 10);  // 23 where fields count by their numbers
  struct Other {
    Edits edits;
    double metre, kelvin;
  };
  for (const Other& other : {Other{metres, 1e-3, 1}, Other{millikelvins, 1, 1e3}}) {
    const ExampleRun run("heat/joule_beam.yaml", other.edits);
    const auto points = pointsIn(run, "points");
    ASSERT_EQ(points.size(), 1u);
    expectClose(points[0].loadFactor, at.loadFactor, 1e-8);  // `uncertainty` in summary.json is 1e-9
    expectClose(points[0].monitors.at("middle_T"), other.kelvin * at.monitors.at("middle_T"), 1e-8);
    ASSERT_EQ(run.summary.at("branches").size(), 3u);
    EXPECT_TRUE(run.summary.at("branches_complete"));
    expectClose(std::abs(run.column("middle_y").back()), other.metre * tip, 1e-6);  // residuals
    const int steps = known.summary.at("steps"), others = run.summary.at("steps");
    EXPECT_LE(std::abs(steps - others), 3);
    const auto negative = run.column("negative_eigenvalues");
    EXPECT_EQ(*std::max_element(negative.begin(), negative.end()), 1);
    EXPECT_EQ(*std::min_element(negative.begin(), negative.end()), 0);
  }
}

/// Timoshenko's curvature 3/2 (alpha2 - alpha1) dT/t of two layers of equal thickness and modulus, as an arc;
/// his strains are small, these are 2e-3 at lambda = 1.
TEST(Bimetal, BendsToTimoshenkosCurvature) {
  const ExampleRun run("heat/bimetal.yaml", {{"load_factor: 10", "load_factor: 1"}});
  const double curvature = 1.5 * 1.8e-5 * 100;
  expectClose(run.column("tip").back(), (1 - std::cos(20 * curvature)) / curvature, 3e-4);
}

/// Growth by exp(k lambda y) is a conformal map: the strip is an arc of curvature k lambda without stress.
/// The error of the tip falls like that of quadratic cells.
TEST(GrowingStrip, IsAnArcWithoutStress) {
  double error[2];
  for (int i = 0; i < 2; ++i) {
    const std::string cells = i == 0 ? "[20, 2]" : "[40, 4]";
    const ExampleRun run("heat/strip.yaml", {{"[40, 2]", cells}});
    const auto load = run.column("load_factor"), x = run.column("tip_x"), y = run.column("tip_y");
    error[i] = 0;
    for (std::size_t n = 1; n < load.size(); ++n) {
      const double k = pi / 5 * load[n], angle = 10 * k;
      const double exact[2] = {std::sin(angle) / k - 10, (1 - std::cos(angle)) / k};
      error[i] = std::max({error[i], std::abs(x[n] - exact[0]), std::abs(std::abs(y[n]) - exact[1])});
    }
  }
  EXPECT_LT(error[1], 0.02);
  EXPECT_GT(std::log2(error[0] / error[1]), 3);
}

/// V^2 = 8 k g^3/(27 eps A) at a third of the gap. The spring is a block of length 1000, whose strain of a
/// third of a thousandth makes 2.5e-4 of the voltage.
TEST(PullIn, AtAThirdOfTheGap) {
  const ExampleRun run("electric/pull_in.yaml");
  const auto limits = pointsIn(run, "load_limits");
  ASSERT_EQ(limits.size(), 1u);
  expectClose(limits[0].loadFactor, std::sqrt(8.0 / 27), 3e-4);
  expectClose(limits[0].monitors.at("gap"), -1.0 / 3, 4e-4);
  // Charge by voltage: the plates' distance.
  expectClose(limits[0].monitors.at("charge"), -limits[0].loadFactor / (1 + limits[0].monitors.at("gap")),
              1e-6);
  EXPECT_LE(run.summary.at("steps"), 6);
  // Stable at given voltages up to the limit point: the potentials' own negative pivots do not count.
  const auto negative = run.column("negative_eigenvalues");
  EXPECT_EQ(negative.front(), 0);
  EXPECT_EQ(negative.back(), 1);
}

/// A thin clamped beam over an electrode, E I w^(4) = eps V^2/(2 (g - w)^2): eps V^2 L^4/(2 E I g^3)
/// = 70.0946 with 0.39676 of the gap in the middle (collocation with 40 and 80 points, extrapolated). Being
/// stretched makes a gap of a tenth of the thickness 2e-4 stiffer.
TEST(PullIn, OfAClampedBeam) {
  const ExampleRun run("electric/electrode.yaml");
  const auto limits = pointsIn(run, "load_limits");
  ASSERT_EQ(limits.size(), 1u);
  const double EI = 1e5 / 12, g = 0.1, eps = 1e-5, L = 100;
  expectClose(limits[0].loadFactor, std::sqrt(70.0946 * 2 * EI * g * g * g / (eps * std::pow(L, 4))), 5e-4);
  expectClose(limits[0].monitors.at("middle"), -0.39676 * g, 3e-3);
  EXPECT_EQ(run.summary.at("bifurcation_points"), 0);
  EXPECT_LE(run.summary.at("steps"), 15);
}

/// eps E^2/mu = l^-2 - l^-8, largest at l = 2^(1/3): E sqrt(eps/mu) = 0.687365, all along the path. The bulk
/// modulus, ten thousand times the shear modulus, makes 1e-5.
TEST(Elastomer, LimitOfTheVoltage) {
  const ExampleRun run("electric/elastomer.yaml");
  const auto limits = pointsIn(run, "load_limits");
  ASSERT_EQ(limits.size(), 1u);
  expectClose(limits[0].loadFactor, std::sqrt(std::pow(2, -2.0 / 3) - std::pow(2, -8.0 / 3)), 2e-6);
  expectClose(1 + limits[0].monitors.at("growth"), std::cbrt(2), 1e-5);
  const auto E = run.column("load_factor"), growth = run.column("growth");
  for (std::size_t i = 0; i < E.size(); ++i) {
    const double l = 1 + growth[i];
    EXPECT_NEAR(E[i] * E[i], std::pow(l, -2) - std::pow(l, -8), 5e-5) << l;
  }
}

}  // namespace atrapos::test
