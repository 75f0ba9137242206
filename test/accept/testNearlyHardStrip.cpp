// examples/strip_roll/nearly_hard.yaml: law (15) with the place on its curve as unknown.
#include <gtest/gtest.h>

#include <cmath>

#include "support/StripRun.hpp"

namespace atrapos::test {
namespace {

const std::string kLaw = "stiffness: 5.0e5, regularisation: 5.0e-6, unknown: curve";

/// Both contacts with another law.
Edits withLaw(const std::string& law) {
  const auto contact = [](const std::string& side, const std::string& set, const std::string& text) {
    return side + ": {tool: roll, set: " + set + ", points: nodes, " + text + "}";
  };
  return {{contact("right", "y_min", kLaw), contact("right", "y_min", law)},
          {contact("left", "y_max", kLaw), contact("left", "y_max", law)},
          {"stop: {load_factor: 0.25}", "pade: off\n  stop: {load_factor: 0.25}"}};
}

// Half the steps that displacements and load need for the same law, three times those of a soft law (1e3 N/mm
// and 0.1 N a station) at most; the same path. With polynomials: rational series, the default, take the plain
// law's branch points out by themselves (74 steps for 117) and hardly shorten the curve's 55 (52).
TEST(NearlyHardStrip, HalfTheSteps) {
  const StripRun curve("nearly_hard.yaml", withLaw(kLaw)),
      plain("nearly_hard.yaml", withLaw("stiffness: 5.0e5, regularisation: 5.0e-6")),
      soft("nearly_hard.yaml", withLaw("stiffness: 500, regularisation: 0.05"));
  const int steps = curve.summary.at("steps");
  EXPECT_LE(2 * steps, plain.summary.at("steps").get<int>());
  EXPECT_LE(steps, 3 * soft.summary.at("steps").get<int>());
  for (const char* monitor : {"tip_ux", "tip_uz", "force_right"}) {
    const double a = curve.column(monitor).back(), b = plain.column(monitor).back();
    // The residual's bound is 1e-6 of forces that are a hundred times the load here.
    EXPECT_NEAR(a, b, 1e-3 * std::abs(b)) << monitor;
  }
  EXPECT_EQ(curve.summary.at("contact_events"), plain.summary.at("contact_events"));
}

}  // namespace
}  // namespace atrapos::test
