// examples/contact/hertz.yaml: a ball on a block by contact up to its moving edge, against Hertz.
#include <gtest/gtest.h>

#include <cmath>

#include "support/ExampleRun.hpp"

namespace atrapos::test {

TEST(Hertz, ForceAgainstApproach) {
  const ExampleRun run("contact/hertz.yaml");
  const auto load = run.column("load_factor"), force = run.column("force");
  EXPECT_DOUBLE_EQ(load.back(), 0.11625);
  constexpr double R = 10, E = 1000 / (1 - 0.3 * 0.3);
  int compared = 0;
  for (std::size_t i = 0; i < load.size(); ++i) {
    const double d = load[i] - 0.1, a = std::sqrt(R * std::abs(d));
    // Nothing before the touch; from three cells in the contact on the force goes up and down by 1.5 % about
    // 0.5 % too little, as the edge of the contact passes through cells (docs/theory/moving_edges.md).
    if (d < 0) {
      EXPECT_EQ(force[i], 0);
    } else if (a > 0.18) {
      const double hertz = 4.0 / 3 * E * std::sqrt(R * d * d * d);
      EXPECT_NEAR(-force[i], hertz, 0.022 * hertz) << "contact radius " << a;
      ++compared;
    }
  }
  EXPECT_GT(compared, 20);
  EXPECT_LE(run.summary.at("steps"), 60);
}

TEST(Hertz, WidthUnderACylinder) {
  const ExampleRun run("contact/hertz_cylinder.yaml");
  const auto force = run.column("force"), area = run.column("area");
  constexpr double R = 10, E = 1000 / (1 - 0.3 * 0.3);
  int compared = 0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    const double b = std::sqrt(4 * 2 * force[i] * R / (std::acos(-1.0) * E));
    if (b < 0.18) continue;
    // Between its edges the contact is known to a part of a cell, a third to a fifth of b here, and the
    // stiffness adds a width in which the gap is p/alpha.
    EXPECT_NEAR(area[i], b, 0.06 * b);
    ++compared;
  }
  EXPECT_GT(compared, 20);
  EXPECT_LE(run.summary.at("steps"), 35);
}

}  // namespace atrapos::test
