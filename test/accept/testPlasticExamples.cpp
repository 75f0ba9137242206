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
  EXPECT_GT(most, 1.83);  // where Hill has the load of the stop
}

}  // namespace
}  // namespace atrapos::test
