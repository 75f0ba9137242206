// examples/shells/*.yaml as shipped: linear benchmarks against their quoted values, large rotations against
// the tables of Sze, Liu and Lo (2004), each on one path with default settings.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "support/ExampleRun.hpp"

namespace atrapos::test {
namespace {

/// The tables are results of another element on other meshes, not exact: 1 to 2 % of the largest value.
constexpr double kTables = 0.015;

ExampleRun run(const std::string& name, const Edits& edits = {}) {
  return ExampleRun("shells/" + name + ".yaml", edits);
}

/// States are compared between those that a deck as shipped writes.
const Edits kManyPoints{{"  shells: body", "  shells: body\n  points_per_step: 40"}};

/// A displacement per load factor at the end of a path in the linear range.
double perLoad(const ExampleRun& run, const std::string& monitor) {
  return run.column(monitor).back() / run.column("load_factor").back();
}

/// Largest deviation of monitors from the columns of a table over load factors, in units of each column's
/// largest value.
double worstDeviation(const ExampleRun& run, const std::string& table,
                      const std::vector<std::pair<std::string, double>>& monitorsAndSigns) {
  const auto rows = numberRows(ATRAPOS_SHELL_DATA "/" + table);
  const auto load = run.column("load_factor");
  double worst = 0;
  for (std::size_t c = 0; c < monitorsAndSigns.size(); ++c) {
    const auto values = run.column(monitorsAndSigns[c].first);
    double largest = 0, deviation = 0;
    for (const auto& row : rows) {
      const double x = std::min(row.at(0), load.back());  // the last row's 1 is reached to rounding
      largest = std::max(largest, std::abs(row.at(1 + c)));
      deviation = std::max(
          deviation, std::abs(monitorsAndSigns[c].second * interpolate(load, values, x) - row.at(1 + c)));
    }
    worst = std::max(worst, deviation / largest);
  }
  EXPECT_GE(rows.size(), 20u);
  return worst;
}

/// Largest distance of a table's points from a path that turns back, in the plane of load and deflection in
/// units of their largest values.
double worstDistance(const ExampleRun& run, const std::string& table) {
  const auto rows = numberRows(ATRAPOS_SHELL_DATA "/" + table);
  const auto load = run.column("load_factor"), z = run.column("centre_uz");
  double loadRange = 0, range = 0, worst = 0;
  for (const auto& row : rows) {
    loadRange = std::max(loadRange, std::abs(row.at(0)));
    range = std::max(range, std::abs(row.at(1)));
  }
  for (const auto& row : rows) {
    double nearest = 1e300;
    for (std::size_t i = 0; i + 1 < load.size(); ++i) {
      const double x0 = load[i] / loadRange, y0 = -z[i] / range, dx = load[i + 1] / loadRange - x0,
                   dy = -z[i + 1] / range - y0, px = row[0] / loadRange - x0, py = row[1] / range - y0;
      const double s = std::clamp((px * dx + py * dy) / (dx * dx + dy * dy), 0.0, 1.0);
      nearest = std::min(nearest, std::hypot(px - s * dx, py - s * dy));
    }
    worst = std::max(worst, nearest);
  }
  return worst;
}

/// Values at the turning points of a curve.
std::vector<double> turns(const std::vector<double>& y) {
  std::vector<double> found;
  for (std::size_t i = 1; i + 1 < y.size(); ++i)
    if ((y[i] - y[i - 1]) * (y[i + 1] - y[i]) < 0) found.push_back(y[i]);
  return found;
}

// Limits of shear-flexible shells, 0.3014 to 0.3020; measured 0.30141.
TEST(ShellExamples, ScordelisLo) {
  EXPECT_NEAR(perLoad(run("scordelis_lo"), "edge_uz"), -0.3017, 0.005 * 0.3017);
}

// Quoted 1.8248e-5, measured 1.8274e-5.
TEST(ShellExamples, PinchedCylinder) {
  EXPECT_NEAR(perLoad(run("pinched_cylinder"), "under_force"), -1.8248e-5, 0.01 * 1.8248e-5);
}

// Dents run along it without a snap. The same nodes as 20 x 20 SHELL8 go back and forth at false ones.
TEST(ShellExamples, PinchedCylinderFar) {
  const auto load = run("pinched_cylinder_far").column("load_factor");
  EXPECT_TRUE(turns(load).empty());
  EXPECT_DOUBLE_EQ(load.back(), 1);
}

// 0.0930 to 0.0940; measured 0.09315.
TEST(ShellExamples, Hemisphere) {
  const ExampleRun r = run("hemisphere");
  EXPECT_NEAR(perLoad(r, "pulled_ux"), 0.0935, 0.01 * 0.0935);
  EXPECT_NEAR(perLoad(r, "pushed_uy"), -0.0935, 0.01 * 0.0935);
}

// 4.0786e-4 q a^4/D; measured 0.2 % below.
TEST(ShellExamples, Morley) {
  const double D = 1e-9 / (12 * (1 - 0.09));
  EXPECT_NEAR(perLoad(run("morley"), "centre_uz"), -4.0786e-4 * 1e-10 / D, 0.01 * 4.0786e-4 * 1e-10 / D);
}

// The mesh that is usually quoted, a/t = 100, against the thin plate's value; measured 0.6 % below. The same
// deck without assumed shear strains is 8.5 % off.
TEST(ShellExamples, MorleyOnEqualElements) {
  const double D = 1e-6 / (12 * (1 - 0.09)), quoted = 4.0786e-4 * 1e-7 / D;
  EXPECT_NEAR(perLoad(run("morley_equal"), "centre_uz"), -quoted, 0.01 * quoted);
  const double compatible =
      perLoad(run("morley_equal", {{"shear: assumed", "shear: compatible"}}), "centre_uz");
  EXPECT_LT(std::abs(compatible), 0.93 * quoted);
  EXPECT_GT(std::abs(compatible), 0.9 * quoted);
}

TEST(ShellExamples, EndShear) {
  EXPECT_LT(
      worstDeviation(run("end_shear", kManyPoints), "sze31_end_shear.csv", {{"tip_ux", -1}, {"tip_uz", 1}}),
      kTables);
}

// The result file has the body as solids: the reactions on it, at the ends of the directors too, balance the
// end force and its moment about the clamp, and the stress resultants are those of statics.
void expectStaticsInTheResultFile(const ExampleRun& run) {
  const std::string file = run.folder.results("results.exo").string();
  const fem::Mesh mesh = exodus::readMesh(file);
  const exodus::ResultReader results(file);
  const int last = results.numSteps() - 1;
  ASSERT_EQ(mesh.blocks.at(0).topology, fem::Topology::Hex20);
  const auto x = results.nodal(last, "reaction_x"), z = results.nodal(last, "reaction_z");
  ASSERT_EQ(static_cast<int>(x.size()), mesh.numNodes());
  double force = 0, moment = 0;
  for (int n = 0; n < mesh.numNodes(); ++n) {
    force += z[n];
    moment += mesh.coordinates[3 * n + 2] * x[n] - mesh.coordinates[3 * n] * z[n];  // the clamp does not move
  }
  const double arm = 10 + run.column("tip_ux").back();
  EXPECT_NEAR(force, -4, 1e-4);  // the residual's bound is 1e-6 of the elements' own forces, some 100
  EXPECT_NEAR(moment, 4 * arm, 1e-3 * 4 * arm);
  // m_11 is linear between the points of an element, whose mean is its value in the middle; the first
  // element has hardly turned there. Tension at the bottom.
  const double m = results.element(last, "m_11").at(0);
  EXPECT_NEAR(m, -4 * (arm - 10.0 / 32), 0.01 * 4 * arm);
  // In every section the force is that of the end, turned; its size would be off by m times the curvature,
  // 6.5 at the clamp, if the section's area were taken for the volume's. An element turns by 0.16 at most:
  // the size of its mean is 1 - 0.16^2/24 of that of the values.
  const auto n = results.element(last, "n_11"), q = results.element(last, "q_1");
  for (std::size_t e = 0; e < n.size(); ++e) EXPECT_NEAR(std::hypot(n[e], q[e]), 4, 0.01 * 4) << e;
  const double top = results.element(last, "stress_top_xx").at(0),
               bottom = results.element(last, "stress_bottom_xx").at(0);
  EXPECT_NEAR(top, 6 * m / 0.01, 0.03 * std::abs(top));  // turned, stretched and sheared by a few per cent
  EXPECT_NEAR(bottom, -top, 0.03 * std::abs(top));
}

TEST(ShellExamples, EndShearInTheResultFile) { expectStaticsInTheResultFile(run("end_shear")); }
TEST(ShellExamples, EndShearInTheResultFileWithAssumedShear) {
  expectStaticsInTheResultFile(run("end_shear", {{"shells:\n", "shells:\n  shear: assumed\n"}}));
}

// The moment of narrow legs is 622.2 with EI, GJ of strips; half of a frame up to its plane of symmetry, and
// widths that fall, are in testCouplings. Both branches are mirrored.
TEST(ShellExamples, RightAngleFrame) {
  const ExampleRun r = run("right_angle_frame");
  std::vector<double> loads;
  for (const auto& point : r.summary.at("points")) loads.push_back(point.at("load_factor").get<double>());
  ASSERT_EQ(loads.size(), 1u);
  EXPECT_NEAR(loads[0], 1.045, 0.002);
  const auto apex = r.column("apex_uz"), load = r.column("load_factor");
  const auto [low, high] = std::minmax_element(apex.begin(), apex.end());
  EXPECT_NEAR(*high, 100, 1e-6);
  EXPECT_NEAR(*low, -100, 1e-6);
  EXPECT_NEAR(load[low - apex.begin()], load[high - apex.begin()], 1e-5);  // what the residual leaves open
}

// The table is the elastica's closed form; a strip as thick differs from it by 0.14 % (docs/theory/shell.md).
TEST(ShellExamples, EndMoment) {
  const ExampleRun r = run("end_moment", kManyPoints);
  EXPECT_LT(worstDeviation(r, "sze32_end_moment.csv", {{"tip_ux", -1}, {"tip_uz", 1}}), 0.004);
  // Rolled up to a circle: the end is back at the clamp, within 0.3 % of the length.
  EXPECT_NEAR(r.column("tip_ux").back(), -12, 0.04);
  EXPECT_NEAR(r.column("tip_uz").back(), 0, 0.04);
}

TEST(ShellExamples, SlitAnnulus) {
  EXPECT_LT(worstDeviation(run("slit_annulus", kManyPoints), "sze33_slit_annulus.csv",
                           {{"inner_uz", 1}, {"outer_uz", 1}}),
            kTables);
}

TEST(ShellExamples, HemisphereWithHole) {
  EXPECT_LT(worstDeviation(run("hemisphere_hole", kManyPoints), "sze34_hemisphere18.csv",
                           {{"pulled_ux", 1}, {"pushed_uy", -1}}),
            kTables);
}

TEST(ShellExamples, HingedRoof12p7) {
  const ExampleRun r = run("hinged_roof_12.7", kManyPoints);
  EXPECT_LT(worstDistance(r, "sze38_roof_iso_h12p7.csv"), kTables);
  const auto load = turns(r.column("load_factor"));
  ASSERT_EQ(load.size(), 2u);
  EXPECT_NEAR(3000 * load[0], 2226, kTables * 2226);
  EXPECT_NEAR(3000 * load[1], 519, kTables * 2226);
  EXPECT_TRUE(turns(r.column("centre_uz")).empty());
}

// Both limit points of the load and both of the deflection, on the way without a parameter set for it.
TEST(ShellExamples, HingedRoof6p35) {
  const ExampleRun r = run("hinged_roof_6.35", kManyPoints);
  EXPECT_LT(worstDistance(r, "sze38_roof_iso_h6p35.csv"), kTables);
  const auto load = turns(r.column("load_factor")), z = turns(r.column("centre_uz"));
  ASSERT_EQ(load.size(), 2u);
  EXPECT_NEAR(3000 * load[0], 585.9, kTables * 585.9);
  EXPECT_NEAR(3000 * load[1], -386.4, kTables * 585.9);
  ASSERT_EQ(z.size(), 2u);
  EXPECT_NEAR(-z[0], 17.01, kTables * 17.01);
  EXPECT_NEAR(-z[1], 14.45, kTables * 17.01);
}

}  // namespace
}  // namespace atrapos::test
