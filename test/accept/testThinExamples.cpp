// examples/thin/*.yaml and decks like them: membranes and trusses against closed forms, symmetry and
// CalculiX.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/ExampleRun.hpp"

namespace atrapos::test {
namespace {

/// A membrane of neo-Hookean rubber between straight edges, that does not stretch along them: an arc of a
/// circle with one stretch l, whose force by unit of width is its pressure times the radius.
struct Arc {
  double shear = 0.4, bulk = 400, thickness = 0.5, prestress = 0.01, half = 50;

  double pressure(double height) const {
    const double angle = 2 * std::atan(height / half), l = angle / std::sin(angle);
    const double lambda = bulk - 2 * shear / 3;
    double t = 1 / l;  // across: no stress there
    for (int i = 0; i < 50; ++i)
      t -= (shear * (t * t - 1) + lambda * std::log(l * t)) / (2 * shear * t + lambda / t);
    const double P = shear * (l - 1 / l) + lambda * std::log(l * t) / l;
    return thickness * (P + prestress * l) * std::sin(angle) / half;
  }
};

/// The largest relative error of the pressure along a path.
double arcError(const std::string& divisions) {
  // The series' own error is far below that of the mesh.
  const ExampleRun run("thin/inflated.yaml", {{"divisions: [40, 1]", "divisions: [" + divisions + ", 1]"},
                                              {"path:\n", "path:\n  accuracy: 1e-10\n  residual: 1e-10\n"}});
  const auto load = run.column("load_factor"), height = run.column("height");
  double worst = 0;
  for (std::size_t i = 1; i < load.size(); ++i)
    worst = std::max(worst, std::abs(0.01 * load[i] / Arc{}.pressure(height[i]) - 1));
  EXPECT_NEAR(height.back(), 80, 1e-9);
  return worst;
}

struct Point {
  std::string kind;
  double load, displacement;
};
std::vector<Point> pointsOf(const ExampleRun& run, const std::string& monitor) {
  const Table table(run.folder.results("points.csv"));
  const auto kind = table.texts("kind");
  const auto load = table.column("load_factor"), displacement = table.column(monitor);
  std::vector<Point> points;
  for (std::size_t i = 0; i < kind.size(); ++i) points.push_back({kind[i], load[i], displacement[i]});
  return points;
}

}  // namespace

// Beyond the half circle, to a stretch of 2.3, with the order of quadratic cells in the energy.
TEST(Membrane, BlownUpToAnArc) {
  const double coarse = arcError("10"), fine = arcError("20");
  EXPECT_LT(coarse, 5e-5);
  EXPECT_NEAR(std::log2(coarse / fine), 4, 0.1);
}

// The force of both bars along z, S A z/L0 each, and its limits.
TEST(Truss, TwoBarsSnapThrough) {
  const ExampleRun run("thin/two_bars.yaml");
  const double EA = 210e6 * 0.002, length = std::sqrt(104.0);
  const auto load = run.column("load_factor"), sinking = run.column("sinking");
  for (std::size_t i = 0; i < load.size(); ++i) {
    const double z = 2 + sinking[i], strain = (z * z - 4) / (2 * length * length);
    // The default bound of the residual, 1e-6 of the forces of the bars.
    EXPECT_NEAR(1000 * load[i], -2 * EA * strain * z / length, 1e-6 * EA);
  }
  const auto points = pointsOf(run, "sinking");
  ASSERT_EQ(points.size(), 2u);
  EXPECT_NEAR(points[0].displacement, -2 * (1 - 1 / std::sqrt(3.0)), 1e-5);
  EXPECT_NEAR(points[1].displacement, -2 * (1 + 1 / std::sqrt(3.0)), 1e-5);
}

// The star turned inside out is the star pulled: what the path passes comes back mirrored.
TEST(Truss, DomeAndItsMirrorImage) {
  const ExampleRun run("thin/dome.yaml");
  const double height = 8.216;
  std::vector<Point> limits;
  for (const Point& p : pointsOf(run, "displacement"))
    if (p.kind == "maximum" || p.kind == "minimum") limits.push_back(p);
  ASSERT_EQ(limits.size(), 7u);
  EXPECT_NEAR(limits[0].load, 0.2962469, 1e-6);
  for (const Point& p : limits) {
    const auto mirrored = std::find_if(limits.begin(), limits.end(), [&](const Point& q) {
      // Where a displacement's limit is, a load stands only to the root of the residual.
      return std::abs(p.load + q.load) < 1e-4 &&
             std::abs(p.displacement + q.displacement + 2 * height) < 1e-3;
    });
    EXPECT_TRUE(mirrored != limits.end() || &p == &limits[0]) << p.load;  // whose image lies beyond the stop
  }
}

// CalculiX 2.20's T3D2 with NLGEOM: the apex under 200 N.
TEST(Truss, DomeAsCalculix) {
  const ExampleRun run("thin/dome.yaml", {{"displacement: {displacement: -15}", "load_factor: 0.2"}});
  EXPECT_NEAR(run.column("displacement").back(), -0.3177794, 1e-6);
}

// A ball on a membrane, contact by zones, as stiff as the least depth of a zone allows: the first zone begins
// at the line's end on the axis of symmetry and leaves it at once, as the sheet bends around the ball. Its
// force is what the edges hold, but for the corner, which belongs to both.
TEST(Membrane, BallWhoseZoneLeavesTheLinesEnd) {
  const TemporaryFolder folder;
  writeFile(folder / "deck.yaml", R"(mesh:
  file: sheet.exo
  generate: {shape: shell_plate, length: 100, width: 100, divisions: [8, 8], block: sheet}
materials:
  m: {law: neo_hookean, youngs_modulus: 3, poissons_ratio: 0.45, blocks: [sheet]}
membranes: {sheet: {blocks: [sheet], thickness: 1, prestress: 0.05}}
supports:
  right: {set: x_max, x: 0, y: 0, z: 0}
  back: {set: y_max, x: 0, y: 0, z: 0}
  left: {set: x_min, x: 0}
  front: {set: y_min, y: 0}
tools:
  ball: {type: sphere, center: [0, 0, 30.5], radius: 30, motion: {shift: [0, 0, -1]}}
contact:
  ball: {tool: ball, set: top, points: zones, law: linear, stiffness: 10000}
path: {stop: {load_factor: 5, steps: 80}}
output:
  monitors:
    force: {type: contact_force, contact: ball, component: z}
    right: {type: reaction, support: right, component: z}
    back: {type: reaction, support: back, component: z}
    middle: {type: displacement, set: x_min_y_min, component: z}
)");
  ASSERT_EQ(runAtrapos({"mesh", "-q", "deck.yaml"}, folder.path()).exitCode, 0);
  const auto run = runAtrapos({"run", "-q", "-o", "results", "deck.yaml"}, folder.path());
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const Table path((folder / "results/path.csv").string());
  EXPECT_EQ(path.column("load_factor").back(), 5);
  const double force = -path.column("force").back();
  EXPECT_GT(force, 0.1);
  EXPECT_NEAR(path.column("right").back() + path.column("back").back(), force, 0.02 * force);
  // The ball has gone down by 4.5, and the sheet with it, of cells that are as large as the contact.
  EXPECT_NEAR(path.column("middle").back(), -4.5, 0.3);
}

}  // namespace atrapos::test
