// examples/rubber/*.yaml: limit points of a balloon, Biot's surface instability, Cook's membrane, against
// closed forms and other codes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "support/ExampleRun.hpp"

namespace atrapos::test {
namespace {

/// dW/dl of equal hoop stretches l.
using Slope = std::function<double(double)>;
Slope mooneyRivlin(double ratio) {  // c1 = 1, c2 = ratio
  return [=](double l) { return 4 * (l - std::pow(l, -5)) + 4 * ratio * (l * l * l - std::pow(l, -3)); };
}
Slope ogden(const std::vector<double>& mu, const std::vector<double>& alpha) {
  return [=](double l) {
    double sum = 0;
    for (std::size_t p = 0; p < mu.size(); ++p)
      sum += 2 * mu[p] * (std::pow(l, alpha[p] - 1) - std::pow(l, -2 * alpha[p] - 1));
    return sum;
  };
}

/// p r0 / (4 h) of a hollow sphere of incompressible rubber of mean radius r0 = 1 and thickness h whose mean
/// radius is L: the integral of L' dW/dL' / r over the wall, with W of one hoop stretch L'. Gauss' rule of
/// five points is exact to rounding for walls that are a tenth of the radius or less.
double spherePressure(double h, const Slope& slope, double L) {
  const double x[5] = {-0.906179845938664, -0.538469310105683, 0, 0.538469310105683, 0.906179845938664},
               w[5] = {0.236926885056189, 0.478628670499366, 0.568888888888889, 0.478628670499366,
                       0.236926885056189};
  double sum = 0;
  for (int q = 0; q < 5; ++q) {
    const double R = 1 + h / 2 * x[q], r = std::cbrt(R * R * R + L * L * L - 1), l = r / R;
    sum += w[q] * l * slope(l) / r * R * R / (r * r);
  }
  return sum / 8;
}

/// Where the slope of that vanishes in an interval, by bisection.
double sphereLimit(double h, const Slope& law, double low, double high) {
  const auto slope = [&](double L) {
    return spherePressure(h, law, L + 1e-4) - spherePressure(h, law, L - 1e-4);
  };
  const bool rises = slope(low) > 0;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    ((slope(middle) > 0) == rises ? low : high) = middle;
  }
  return low;
}

struct LimitPoint {
  double load, stretch;
};
/// Limit points of the load, in the path's order: rows of points.csv of kind maximum or minimum. The stretch
/// is one and the growth.
std::vector<LimitPoint> limitPoints(const ExampleRun& run) {
  const Table points(run.folder.results("points.csv"));
  const auto kind = points.texts("kind");
  const auto load = points.column("load_factor"), growth = points.column("growth");
  std::vector<LimitPoint> found;
  for (std::size_t i = 0; i < kind.size(); ++i)
    if (kind[i] == "maximum" || kind[i] == "minimum") found.push_back({load[i], 1 + growth[i]});
  return found;
}

const std::pair<std::string, std::string> thin{"inner_radius: 0.995, outer_radius: 1.005",
                                               "inner_radius: 0.9995, outer_radius: 1.0005"},
    thinPressure{"pressure: 0.04", "pressure: 0.004"};

}  // namespace

// The membrane's points are those of p = 4 (h0/r0)(1/L - 1/L^7)(c1 + c2 L^2).
TEST(Balloon, LimitPoints) {
  const double L[2] = {1.4760698633, 3.1426213890}, load[2] = {0.7453087778, 0.6318112489};
  const ExampleRun run("rubber/balloon.yaml");
  EXPECT_EQ(run.summary.at("limit_points"), 2);
  const auto found = limitPoints(run);
  ASSERT_EQ(found.size(), 2u);
  const double low[2] = {1.2, 2.5}, high[2] = {2, 4};
  for (int i = 0; i < 2; ++i) {
    const double exact = sphereLimit(0.01, mooneyRivlin(0.1), low[i], high[i]);
    // The sphere's own points to the residual's bound, which at a limit point of the load leaves its root
    // open to the stretch; the membrane's to the square of the thickness.
    EXPECT_NEAR(found[i].load, spherePressure(0.01, mooneyRivlin(0.1), exact), 2e-6);
    EXPECT_NEAR(found[i].load, load[i], 1e-4 * load[i]);
    EXPECT_NEAR(found[i].stretch, exact, 1e-4);
    EXPECT_NEAR(found[i].stretch, L[i], 1e-4 * L[i]);
  }
  // Stable up to the maximum of the pressure, and behind the minimum: pressures of the mixed form are not
  // counted.
  const auto negative = run.column("negative_eigenvalues"), growth = run.column("growth");
  for (std::size_t i = 0; i < negative.size(); ++i) {
    const double stretch = 1 + growth[i];
    if (std::abs(stretch - L[0]) > 0.01 && std::abs(stretch - L[1]) > 0.01) {
      EXPECT_EQ(negative[i], stretch > L[0] && stretch < L[1] ? 1 : 0) << stretch;
    }
  }
}

TEST(Balloon, BecomesAMembrane) {
  const double L[2] = {1.4760698633, 3.1426213890}, load[2] = {0.7453087778, 0.6318112489};
  const ExampleRun run("rubber/balloon.yaml", {thin, thinPressure});
  const auto found = limitPoints(run);
  ASSERT_EQ(found.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(found[i].load, load[i], 1e-6);
    EXPECT_NEAR(found[i].stretch, L[i], 1e-4);
  }
}

// Ogden's constants of Treloar's rubber (1972), in kg/cm2: a membrane has its points where those of
// p r0/(4 h0) = sum of mu_p (L^(alpha_p - 3) - L^(-2 alpha_p - 3))/2 are.
TEST(Balloon, OfOgden) {
  const std::string law = "law: ogden, mu: [6.3, 0.012, -0.1], alpha: [1.3, 5, -2]";
  const Slope slope = ogden({6.3, 0.012, -0.1}, {1.3, 5, -2});
  const double L[2] = {1.3740502897, 4.3202827118}, load[2] = {1.3735307704, 0.5888821781};
  const ExampleRun run("rubber/balloon.yaml", {{"law: mooney_rivlin, c1: 1, c2: 0.1", law}});
  const auto found = limitPoints(run);
  ASSERT_EQ(found.size(), 2u);
  const double low[2] = {1.2, 3}, high[2] = {2, 5};
  for (int i = 0; i < 2; ++i) {
    const double exact = sphereLimit(0.01, slope, low[i], high[i]);
    EXPECT_NEAR(found[i].load, spherePressure(0.01, slope, exact), 2e-6 * load[0]);
    EXPECT_NEAR(found[i].load, load[i], 2e-4 * load[i]);
    EXPECT_NEAR(found[i].stretch, exact, 1e-4 * exact);
    EXPECT_NEAR(found[i].stretch, L[i], 2e-4 * L[i]);
  }
}

// Between c2/c1 = 0.2 and 0.2145 the points merge and vanish.
TEST(Balloon, LimitPointsVanish) {
  EXPECT_EQ(limitPoints(ExampleRun("rubber/balloon.yaml", {{"c2: 0.1", "c2: 0.2"}})).size(), 2u);
  EXPECT_EQ(limitPoints(ExampleRun("rubber/balloon.yaml", {{"c2: 0.1", "c2: 0.2145"}})).size(), 0u);
}

namespace {

/// Strain at which a block of depth H between sliding sides a half wave of k apart takes the wave, symmetric
/// to its bottom: (1 + l^4)^2 tanh(k H) = 4 l^2 tanh(k H/l^2) of the stretch l; H infinite: Biot's 0.456311.
double waveStrain(double kH) {
  double low = 0.3, high = 0.7;
  for (int i = 0; i < 60; ++i) {
    const double l = (low + high) / 2;
    const bool above = std::pow(1 + std::pow(l, 4), 2) * std::tanh(kH) > 4 * l * l * std::tanh(kH / (l * l));
    (above ? low : high) = l;
  }
  return 1 - low;
}

}  // namespace

TEST(Biot, SurfaceInstabilityIsFoundAndFollowed) {
  EXPECT_NEAR(waveStrain(1e3), 0.456311, 1e-6);
  const double exact = waveStrain(1.5 * M_PI);
  const auto strain = [](const std::string& divisions) {
    const ExampleRun run("rubber/biot.yaml", {{"[8, 12]", divisions},
                                              {"branches: all", "branches: none"},
                                              {"load_factor: 0.458", "load_factor: 0.465"}});
    double first = 1;
    for (const auto& point : run.summary.at("points"))
      first = std::min(first, point.at("load_factor").get<double>());
    return first;
  };
  const ExampleRun run("rubber/biot.yaml");
  const auto& points = run.summary.at("points");
  ASSERT_GE(points.size(), 1u);
  const double found = points.at(0).at("load_factor");
  EXPECT_EQ(points.at(0).at("kind"), "pitchfork");
  EXPECT_EQ(points.at(0).at("negative_change"), 1);
  EXPECT_NEAR(found, 0.456311, 0.01 * 0.456311);
  EXPECT_NEAR(found, exact, 2e-3 * exact);
  // Cells of degree 2 are good to h^4 in an eigenvalue.
  const double coarse = strain("[6, 9]") - exact, fine = strain("[12, 18]") - exact;
  EXPECT_GT(coarse, 0);
  EXPECT_NEAR(std::log2(coarse / fine), 4, 0.5);
  // Both halves of the branch, along which the surface folds while the strain falls.
  const auto branch = run.column("branch"), crest = run.column("crest"), trough = run.column("trough"),
             load = run.column("load_factor");
  for (const int b : {1, 2}) {
    double fold = 0, least = 1;
    for (std::size_t i = 0; i < branch.size(); ++i)
      if (branch[i] == b) {
        fold = std::max(fold, std::abs(crest[i] - trough[i]));
        least = std::min(least, load[i]);
      }
    EXPECT_GT(fold, 0.03) << b;
    EXPECT_LT(least, found - 0.01) << b;
  }
}

TEST(Cook, NearlyIncompressible) {
  const auto slope = [](const std::string& divisions) {
    const ExampleRun run("rubber/cook.yaml",
                         {{"[16, 16]", divisions}, {"load_factor: 1}", "load_factor: 1.0e-6}"}});
    EXPECT_EQ(run.column("negative_eigenvalues").back(), 0);
    return run.column("middle").back() / 1e-6;
  };
  // FinEALE's extrapolated 16.4326 (P. Krysl); its own cells of degree 1 are 1 % off at 16 x 16.
  const double coarse = slope("[8, 8]"), fine = slope("[32, 32]");
  EXPECT_NEAR(coarse, 16.4326, 0.02 * 16.4326);
  EXPECT_NEAR(fine, 16.4326, 0.003 * 16.4326);
  EXPECT_LT(std::abs(fine - 16.4326), std::abs(coarse - 16.4326));
}

}  // namespace atrapos::test
