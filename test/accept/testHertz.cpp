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

}  // namespace atrapos::test
