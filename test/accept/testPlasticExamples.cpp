// Decks with metal against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "support/ExampleRun.hpp"

namespace atrapos::test {
namespace {

/// Hill: pressure over yield stress of a sphere with radii 1 and 2 whose plastic zone reaches to c.
double hill(double c) { return 2 * std::log(c) + 2.0 / 3 * (1 - c * c * c / 8); }

TEST(PlasticExamples, ThickSphereAgainstHill) {
  const ExampleRun run("plasticity/sphere.yaml");
  const auto load = run.column("load_factor"), outside = run.column("outside");
  constexpr double E = 200000, nu = 0.3, yield = 20;
  double worst = 0, most = 0;
  for (std::size_t i = 1; i < load.size(); ++i) {
    // Elastic outside: u(b) = (1 - nu) yield c^3 / (E b^2) in units of a = 100.
    const double c = std::cbrt(outside[i] / 100 * E * 4 / ((1 - nu) * yield));
    if (c <= 1) continue;
    worst = std::max(worst, std::abs(load[i] - hill(c)) / hill(c));
    most = std::max(most, c);
  }
  EXPECT_LT(worst, 1e-3);  // 12 cells through the wall; second order
  EXPECT_GT(most, 1.83);   // where Hill has the load of the stop
}

/// The last value of a monitor in each stage.
std::vector<double> atEnds(const ExampleRun& run, const std::string& monitor) {
  const auto stage = run.column("branch"), value = run.column(monitor);
  std::vector<double> ends;
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (stage[i] >= static_cast<double>(ends.size())) ends.emplace_back();
    ends.back() = value[i];
  }
  return ends;
}

/// The deflection of a cantilever, elastic and perfectly plastic, over that at first yield, p its load over
/// that; the integral of 1/sqrt(3 - 2 m) along it. Loads there and back, of the range 2 p, do the same twice
/// as large (Masing), so the strip ends on the other side.
double deflection(double p) { return (5 - (3 + p) * std::sqrt(3 - 2 * p)) / (p * p); }

/// The strip against a beam's closed form, to this part of its deflection.
void expectSpringback(const ExampleRun& run, double tolerance) {
  const auto ends = atEnds(run, "tip");
  ASSERT_EQ(ends.size(), 4u);
  constexpr double E = 70000 / (1 - 0.49 * 0.49), length = 100, height = 5;
  const double yield = 60 * 2 / std::sqrt(3.0), first = 2.0 / 3 * yield * length * length / (E * height);
  const double bent = deflection(1.3) * first, left = (deflection(1.3) - 1.3) * first;
  EXPECT_NEAR(ends[0], bent, tolerance * bent);
  EXPECT_NEAR(ends[1], left, tolerance * bent);
  EXPECT_NEAR(ends[2], -bent, tolerance * bent);
  EXPECT_NEAR(ends[3], -left, tolerance * bent);
}

TEST(PlasticExamples, SpringbackInPlaneStrain) {
  // 60 x 8 cells: 0.05 % here, of which what is left is a thirtieth.
  expectSpringback(ExampleRun("plasticity/springback.yaml"), 2e-3);
}

// The width is an error beside that of the cells, and saves most of the steps.
TEST(PlasticExamples, SpringbackWithASmoothedYieldSurface) {
  const ExampleRun run("plasticity/springback_smoothed.yaml");
  expectSpringback(run, 3e-3);
  EXPECT_LT(run.summary.at("steps"), 60);  // 148 at a sharp one
}

TEST(PlasticExamples, SpringbackOfShells) {
  const ExampleRun run("plasticity/springback_shells.yaml");
  const auto ends = atEnds(run, "tip");
  ASSERT_EQ(ends.size(), 4u);
  constexpr double first = 2 * 120 / (70000.0 * 2), length = 100, m = 1.3;
  const double curvature = first / std::sqrt(3 - 2 * m);
  const auto tip = [](double k) { return (std::cos(k * length) - 1) / k; };  // tension on top
  // Ten points through the thickness: 0.06 % at this curvature.
  EXPECT_NEAR(ends[0], tip(curvature), 1e-3 * std::abs(tip(curvature)));
  EXPECT_NEAR(ends[1], tip(curvature - m * first), 1e-3 * std::abs(tip(curvature)));
  EXPECT_NEAR(ends[2], -tip(curvature), 1e-3 * std::abs(tip(curvature)));
  EXPECT_NEAR(ends[3], -tip(curvature - m * first), 1e-3 * std::abs(tip(curvature)));
}

/// CalculiX on the same mesh (data/ccx_metal), whose yield stress is Cauchy's and not Kirchhoff's: 0.14 % at
/// the largest force, 0.7 % in the neck at the end.
TEST(PlasticExamples, NeckingBar) {
  const ExampleRun run("plasticity/necking.yaml");
  const auto load = run.column("load_factor"), force = run.column("force"), neck = run.column("neck");
  const Table calculix(ATRAPOS_ACCEPT_DATA "/ccx_metal/necking.csv");
  const auto at = calculix.column("load_factor"), forces = calculix.column("force"),
             necks = calculix.column("neck");
  double largest = 0;
  for (const double f : force) largest = std::max(largest, f);
  EXPECT_NEAR(largest, 77.346 / 1.0014, 0.03);
  for (std::size_t i = 0, row = 0; i < at.size(); ++i) {
    while (row + 1 < load.size() && load[row + 1] < at[i]) ++row;
    if (row + 1 == load.size()) --row;
    const double part = (at[i] - load[row]) / (load[row + 1] - load[row]);
    const auto between = [&](const std::vector<double>& y) { return y[row] + part * (y[row + 1] - y[row]); };
    EXPECT_NEAR(between(force), forces[i], 0.008 * forces[i]) << at[i];
    EXPECT_NEAR(between(neck), necks[i], 0.015) << at[i];
  }
  EXPECT_LT(run.summary.at("steps"), 700);  // 300 points yield, most of them unload
}

TEST(PlasticExamples, CooksMembrane) {
  const ExampleRun run("plasticity/cook.yaml");
  EXPECT_NEAR(run.column("corner").back(), 6.7485, 0.004 * 6.7485);  // CalculiX on this mesh
}

}  // namespace
}  // namespace atrapos::test
