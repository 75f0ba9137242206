// The strip on the roll with the roll as the implicit cylinder, as a NURBS surface, as Bezier patches and
// from a STEP file: one path.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "support/Folder.hpp"
#include "support/StripRun.hpp"

namespace atrapos::test {
namespace {

const std::string kRoll = "{type: cylinder, center: [200, 0, -54], axis: [0, 1, 0], radius: 50}";

/// The shell to a small load, with a bound of the residual so tight that what differs is the tool.
StripRun runWith(const std::string& roll) {
  return StripRun(
      "shell.yaml",
      Edits{{"stop: {load_factor: 2}", "residual: 1.0e-8\n  stop: {load_factor: 0.25}"}, {kRoll, roll}});
}

class Points {
 public:
  Points() { text_.precision(17); }
  /// A control point (x, z) of the roll's section, at both ends of the roll: S_1 x S_2 points outwards.
  void add(double x, double z) {
    for (const char* y : {"50", "-50"})
      text_ << (text_.tellp() > 0 ? ", [" : "[") << 200 + 50 * x << ", " << y << ", " << 50 * z - 54 << "]";
  }
  std::string text() const { return "[" + text_.str() + "]"; }

 private:
  std::ostringstream text_;
};

/// Four quarters of degree 2, exact.
std::string nurbsRoll() {
  const double corner[9][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
  Points points;
  std::ostringstream weights;
  weights.precision(17);
  for (int i = 0; i < 9; ++i) {
    points.add(corner[i][0], corner[i][1]);
    for (int end = 0; end < 2; ++end)
      weights << (weights.tellp() > 0 ? ", " : "") << (i % 2 == 0 ? 1.0 : std::sqrt(0.5));
  }
  return "{type: patches, surfaces: {roll: {degree: [2, 1], points: " + points.text() + ", weights: [" +
         weights.str() + "], knots_1: [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4], knots_2: [0, 0, 1, 1]}}}";
}

/// Eight arcs of degree p: Taylor polynomials about their middles, off the circle by 50 (pi/8)^(p+1)/(p+1)!.
std::string bezierRoll(int p) {
  const double half = std::acos(-1.0) / 8;
  std::string surfaces;
  for (int n = 0; n < 8; ++n) {
    Points points;
    for (int i = 0; i <= p; ++i) {
      // Bernstein coefficient i of sum_k c_k t^k over t in [-1, 1]: blossom of the powers.
      double x = 0, z = 0, factor = 1;
      for (int k = 0; k <= p; ++k) {
        if (k > 0) factor *= half / k;
        // Mean of the products of k of the p arguments, i of them 1 and p - i of them -1.
        double mean = 0;
        const auto binomial = [](int a, int b) {
          double c = 1;
          for (int j = 0; j < b; ++j) c = c * (a - j) / (j + 1);
          return b > a ? 0.0 : c;
        };
        for (int m = 0; m <= k; ++m)
          mean += binomial(i, m) * binomial(p - i, k - m) * ((k - m) % 2 == 0 ? 1 : -1) / binomial(p, k);
        const double phase = (2 * n + 1) * half + k * 4 * half;
        x += factor * mean * std::cos(phase);
        z += factor * mean * std::sin(phase);
      }
      points.add(x, z);
    }
    surfaces += (n > 0 ? ", " : "") + std::string("arc") + std::to_string(n) + ": {degree: [" +
                std::to_string(p) + ", 1], points: " + points.text() + "}";
  }
  return "{type: patches, surfaces: {" + surfaces + "}}";
}

class RollThreeWays : public testing::Test {
 protected:
  const StripRun cylinder = runWith(kRoll);

  void expectSame(const StripRun& run, double tolerance) {
    for (const char* name : {"tip_ux", "tip_uz", "force"})
      EXPECT_NEAR(run.path->column(name).back(), cylinder.path->column(name).back(), tolerance) << name;
    EXPECT_EQ(run.summary.at("contact_events"), cylinder.summary.at("contact_events"));
    // Step lengths are rounded to 7 bits: now and then rounding makes another one.
    EXPECT_NEAR(run.summary.at("steps"), cylinder.summary.at("steps"), 2);
  }
};

TEST_F(RollThreeWays, OnePath) {
  EXPECT_GT(cylinder.path->column("force").back(), 20.0);
  EXPECT_EQ(cylinder.summary.at("contact_events"),
            8);  // stations 210, 220, 230 in turn, at the edges or the middle
  expectSame(runWith(nurbsRoll()),
             1e-7);  // 1e-9 mm measured: rounding of a path whose residuals are below 1e-8
  expectSame(runWith(bezierRoll(7)), 1e-5);  // 4e-7 mm measured: the Bezier roll is off by 7e-7 mm
}

// Arcs of degree 5 meet with tangents that are off by 8e-5: where a pressed station comes over such a crease
// the forces jump by some 1e-6 of them, which is corrected and told.
TEST(RollOfArcs, SlightCreasesArePassed) {
  const StripRun arcs("shell.yaml", Edits{{kRoll, bezierRoll(5)}}), exact("shell.yaml", Edits{});
  EXPECT_TRUE(arcs.summary.at("reached_stop"));
  EXPECT_GE(arcs.summary.at("jumps"), 1);
  EXPECT_LT(arcs.summary.at("worst_jump"), 1e-4);
  EXPECT_LE(arcs.summary.at("worst_residual_at_step_ends"), 1e-6);
  // The arcs are off the circle by 50 (pi/8)^6/6! = 2.5e-4 mm.
  for (const char* name : {"tip_ux", "tip_uz"})
    EXPECT_NEAR(arcs.path->column(name).back(), exact.path->column(name).back(), 5e-4) << name;
}

TEST_F(RollThreeWays, FromAStepFile) {
#ifndef ATRAPOS_SURFACES
  GTEST_SKIP() << "built without OpenCASCADE";
#else
  const TemporaryFolder folder;
  const std::string file = (folder / "roll.yaml").string();
  const std::string line = ATRAPOS_SURFACES " " ATRAPOS_ACCEPT_DATA "/roll.step --faces 1 > " + file;
  ASSERT_EQ(std::system(line.c_str()), 0);
  expectSame(runWith("{type: patches, file: " + file + "}"), 1e-7);  // exact as the NURBS above
#endif
}

// Nodes that never come near the roll carry no law, and what they would add is below eta.
TEST(ContactPointsCarried, AreThoseThatComeNear) {
  const auto run = [&](const std::string& carried) {
    return StripRun("shell.yaml", Edits{{"{load_factor: 2}", "{load_factor: 0.25}"},
                                        {"points: nodes,", "points: nodes, carried: " + carried + ","}});
  };
  const StripRun near = run("near"), all = run("all");
  const auto carried = [](const StripRun& r) {
    return r.summary.at("contacts").at("strip").at("points_carried").get<int>();
  };
  const int present = near.summary.at("contacts").at("strip").at("points");
  EXPECT_EQ(present, 103);
  EXPECT_EQ(carried(all), present);
  EXPECT_GT(carried(near), 5);
  EXPECT_LT(carried(near), present);
  // 41 stations of at most eta = 0.01 N against 25 N at the tip: 1.6 % of the deflection if all of it acted
  // there.
  const double uz = all.path->column("tip_uz").back();
  EXPECT_NEAR(near.path->column("tip_uz").back(), uz, 0.016 * std::fabs(uz));
  EXPECT_NE(near.path->column("tip_uz").back(), uz);
}

}  // namespace
}  // namespace atrapos::test
