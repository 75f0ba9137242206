// Cases in which earlier maps of contact (docs/figures/contact_map.py) found paths that ended: a cantilever
// of 100 x 10 x 1 mm pressed onto tools by 20 N.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "support/Command.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

const std::string kFloor = "{type: plane, point: [0, 0, -0.5], normal: [0, 0, 1]}";

class ContactCases : public testing::Test {
 protected:
  /// `options` of the contact behind its tool and set.
  CommandResult run(const std::string& tool, const std::string& options, int order = 20) {
    writeFile(folder_ / "deck.yaml", body() + fmt::format(R"(loads:
  tip: {{type: surface, set: x_max, total: [0, 0, -20]}}
tools:
  tool: {}
contact:
  face: {{tool: tool, set: bottom{}}}
path: {{order: {}, stop: {{load_factor: 1}}}}
)",
                                                          tool, options, order));
    if (!std::filesystem::exists(folder_ / "strip.exo")) {
      EXPECT_EQ(runAtrapos({"mesh", "-q", "deck.yaml"}, folder_.path()).exitCode, 0);
    }
    return runAtrapos({"run", "-q", "deck.yaml", "-o", "out"}, folder_.path());
  }
  /// Of a run that reaches its stop.
  double tip(const std::string& tool, const std::string& options, int order = 20) {
    const CommandResult r = run(tool, options, order);
    EXPECT_EQ(r.exitCode, 0) << r.err;
    return lastTip();
  }
  /// The same strip under a ball that comes down on it.
  double tipUnderBall(const std::string& options, int order) {
    writeFile(folder_ / "ball.yaml", body() + fmt::format(R"(tools:
  ball: {{type: sphere, center: [80, 0, 20.5], radius: 20, motion: {{shift: [0, 0, -10]}}}}
contact:
  face: {{tool: ball, set: top{}}}
path: {{order: {}, stop: {{load_factor: 1, steps: 3000}}}}
)",
                                                          options, order));
    EXPECT_EQ(runAtrapos({"mesh", "-q", "ball.yaml"}, folder_.path()).exitCode, 0);
    const CommandResult r = runAtrapos({"run", "-q", "ball.yaml", "-o", "out"}, folder_.path());
    EXPECT_EQ(r.exitCode, 0) << r.err;
    return lastTip();
  }
  double lastTip() const {
    std::istringstream rows(readFile(folder_ / "out" / "path.csv"));
    std::string row, cell;
    for (std::string next; std::getline(rows, next);) row = next;
    std::istringstream cells(row);
    for (int i = 0; i < 4; ++i) std::getline(cells, cell, ',');
    return std::stod(cell);
  }

  /// The strip, clamped, and what is watched of it.
  std::string body() const {
    return fmt::format(R"(mesh:
  file: strip.exo
  generate: {{shape: strip, length: 100, width: 10, thickness: 1, origin: [0, -5, -0.5], divisions: [{}], cell: HEX20, block: strip}}
materials:
  steel: {{law: saint_venant_kirchhoff, youngs_modulus: 210000, poissons_ratio: 0.3, blocks: [strip]}}
supports:
  clamp: {{set: x_min, x: 0, y: 0, z: 0}}
output:
  monitors:
    tip: {{type: displacement, set: x_max, component: z}}
)",
                       divisions_);
  }

  TemporaryFolder folder_;
  std::string divisions_ = "10, 2, 1";
};

// The body lies on a floor, which holds it: without one its end would go 38 mm down. A thousandth of that is
// what laws at points, the last of which lie 1.1 mm before the end, and means over faces may leave.
TEST_F(ContactCases, BodiesMayLieOnTools) {
  for (const char* law : {"", ", points: nodes", ", law: hyperbola", ", law: hyperbola, points: nodes",
                          ", law: power", ", law: exponential", ", law: hard"}) {
    SCOPED_TRACE(law);
    EXPECT_NEAR(tip(kFloor, law), 0, 0.038);
  }
  EXPECT_NEAR(tip(kFloor, ", law: penalty", 5), tip(kFloor, ", law: hyperbola"),
              1e-5);  // of quadrature points both; rounded by 1e-6 of the thickness
  const CommandResult curve = run(kFloor, ", unknown: curve");
  EXPECT_EQ(curve.exitCode, 2);
  EXPECT_NE(curve.err.find("unknown: curve needs a positive reference_gap there, give a number"),
            std::string::npos)
      << curve.err;
}

// Where nothing tells the families of lines apart they go along the strip, as the contact does.
TEST_F(ContactCases, ZonesOverAFloor) {
  const std::string floor = "{type: plane, point: [0, 0, -1.5], normal: [0, 0, 1]}";
  const double linear = tip(floor, ", points: zones, law: linear, stiffness: 1.0e3");
  // The end comes down by 1 mm with the slope s = 1.5/100 of a cantilever, which takes 0.5 N; the floor gives
  // way by d over a zone of the length d/s, 19.5 N = alpha b d^2/(2 s).
  EXPECT_NEAR(linear, -1 - std::sqrt(2 * 19.5 * 0.015 / (1e3 * 10)), 5e-4);
}

// A force that falls exponentially is not in the series of a step that begins far off: the step ends before
// it.
TEST_F(ContactCases, PenaltyComesUnseen) {
  const std::string roll = "{type: cylinder, center: [60, 0, -20.5], axis: [0, 1, 0], radius: 20}";
  const double penalty = tip(roll, ", law: penalty"), hyperbola = tip(roll, ", law: hyperbola");
  EXPECT_NEAR(penalty, hyperbola,
              1e-3 * std::abs(hyperbola));  // both laws round the corner by 1e-3 of the thickness
}

// With few orders the gap of a point that closes is off by what they leave out.
TEST_F(ContactCases, FewOrdersBehindAnEvent) {
  for (const double gap : {0.0, 1.0}) {
    const std::string ring = fmt::format(
        "{{type: torus, center: [62, 0, {}], axis: [0, 0, 1], radius: 20, tube_radius: 5}}", -5.5 - gap);
    const double many = tip(ring, ", law: hard");
    EXPECT_NEAR(tip(ring, ", law: hard", 5), many, 1e-5 * std::abs(many));  // both within 1e-6 of the forces
  }
}

/// Roots beside one another that the series do not have were looked for again and again, without end.
TEST_F(ContactCases, ZonesOnARingBeginTogether) {
  divisions_ = "20, 4, 1";
  const std::string ring =
      "{type: torus, center: [62, 0, -5.500001], axis: [0, 0, 1], radius: 20, tube_radius: 5}";
  const double linear = tip(ring, ", points: zones, law: linear, stiffness: 1.0e3"),
               square = tip(ring, ", points: zones, law: power_overclosure, exponent: 2, stiffness: 1.0e5");
  EXPECT_LT(linear, -0.9);
  EXPECT_NEAR(square, linear, 1e-3);  // what either law gives way by
}

/// A ball that touches a node comes down by 10 mm at 80 of 100 mm: with few orders residuals within the bound
/// turn series beside the steep law.
TEST_F(ContactCases, FewOrdersBesideASteepLaw) {
  const double many = tipUnderBall(", law: hyperbola, points: nodes", 20);
  EXPECT_LT(many, -13);
  EXPECT_NEAR(tipUnderBall(", law: hyperbola, points: nodes", 5), many,
              1e-4);  // both within 1e-6 of the forces
}

/// Its force grows from 1e-38 N: what next to nothing moves by does not choose the weight of the path
/// parameter.
TEST_F(ContactCases, ForcesThatGrowFromNothing) {
  const double hyperbola = tipUnderBall(", law: hyperbola", 20);
  EXPECT_NEAR(tipUnderBall(", law: exponential", 20), hyperbola, 1e-3 * std::abs(hyperbola));
}

}  // namespace
}  // namespace atrapos::test
