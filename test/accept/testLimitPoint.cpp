// A bar of Saint Venant-Kirchhoff material under compression passes its limit point.
// Closed form, nu = 0, dead load P on cross section A, stretch s: P/(EA) = s (1 - s^2)/2, largest at s =
// 1/sqrt(3).
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/Command.hpp"
#include "support/Folder.hpp"
#include "support/Table.hpp"

namespace atrapos::test {
namespace {

constexpr double kLength = 2;

// One cell: cells in a row would all reach the limit at once, where the tangent then has many null vectors.
// Sides that cannot move sideways change nothing with nu = 0, and keep the bar from buckling.
const char* const kDeck = R"(mesh:
  file: bar.exo
  generate: {shape: box, lengths: [2, 1, 0.5], divisions: [1, 1, 1], cell: HEX8}
materials:
  bar: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0, blocks: [body]}
supports:
  end: {set: x_min, x: 0}
  left: {set: y_min, y: 0}
  right: {set: y_max, y: 0}
  below: {set: z_min, z: 0}
  above: {set: z_max, z: 0}
loads:
  # E A = 500
  push: {type: surface, set: x_max, total: [-500, 0, 0]}
path:
  order: 20
  residual: 1.0e-10
  stop: {displacement: {end_ux: -1.4}}
output:
  points_per_step: 10
  monitors:
    end_ux: {type: displacement, set: x_max, component: x}
    end_force: {type: reaction, support: end, component: x}
)";

TEST(LimitPoint, BarInCompression) {
  TemporaryFolder folder;
  writeFile(folder / "bar.yaml", kDeck);
  ASSERT_EQ(runAtrapos({"mesh", "-q", "bar.yaml"}, folder.path()).exitCode, 0);
  const CommandResult r = runAtrapos({"run", "bar.yaml"}, folder.path());
  ASSERT_EQ(r.exitCode, 0) << r.err;

  // Said where it is passed, once. The line shows 8 digits.
  const std::string said = "limit point (maximum) at load factor ";
  const std::size_t at = r.out.find(said);
  ASSERT_NE(at, std::string::npos) << r.out;
  EXPECT_EQ(r.out.find("limit point", at + 1), std::string::npos) << r.out;
  const double exact = 1 / (3 * std::sqrt(3.0));
  EXPECT_NEAR(std::stod(r.out.substr(at + said.size())), exact, 1e-6 * exact);

  const Table path(folder / "bar_results" / "path.csv");
  const auto load = path.column("load_factor"), u = path.column("end_ux"), force = path.column("end_force");
  std::size_t top = 0;
  for (std::size_t i = 0; i < load.size(); ++i) {
    SCOPED_TRACE(i);
    const double s = 1 + u[i] / kLength;
    // The residual's bound is 1e-10 of the forces; 1e-8 leaves room for the displacement that goes with it
    // where the bar is softest.
    EXPECT_NEAR(load[i], s * (1 - s * s) / 2, 1e-8);
    EXPECT_NEAR(force[i], 500 * load[i], 500 * 1e-8);
    if (load[i] > load[top]) top = i;
  }
  // Beyond the maximum the load falls all the way to the stop.
  EXPECT_GT(top, 0u);
  ASSERT_LT(top + 5, load.size());
  for (std::size_t i = top + 1; i < load.size(); ++i) EXPECT_LT(load[i], load[i - 1]);
  EXPECT_NEAR(u.back(), -1.4, 1e-12 * 1.4);  // the stop is a root of the series' polynomial
  EXPECT_LT(load.back(), 0.8 * exact);
  EXPECT_NEAR(load[top], exact, 1e-2 * exact);  // between two rows
}

}  // namespace
}  // namespace atrapos::test
