// Monitors of a contact's pressure: bodies whose touching sides are moved as a whole, so that the gap is that
// of the tool's formula, and a block under uniform pressure.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <sstream>

#include "support/Command.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

constexpr double kRadius = 2, kDepth = 0.1, kStiffness = 50, kShift = 0.5, kPlace = 0.3;

/// Integral of f over [0, the half width of a circle's part below the depth] by Simpson's rule; f(s, p), p
/// the pressure at the distance s from its deepest place.
double overHalfWidth(const std::function<double(double, double)>& f) {
  const double away = kRadius - kDepth, width = std::sqrt(kRadius * kRadius - away * away);
  constexpr int n = 2000;
  double sum = 0;
  for (int i = 0; i <= n; ++i) {
    const double s = width * i / n;
    sum += (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2) * f(s, kStiffness * (kRadius - std::hypot(s, away)));
  }
  return sum * width / n / 3;
}

class ContactMonitors : public testing::Test {
 protected:
  CommandResult run(const std::string& deck, int ranks = 1) {
    writeFile(folder_ / "deck.yaml", deck);
    EXPECT_EQ(runAtrapos({"mesh", "-q", "deck.yaml"}, folder_.path()).exitCode, 0);
    const std::vector<std::string> words{"run", "-q", "deck.yaml", "-o", "out"};
    return ranks > 1 ? runAtraposOnRanks(ranks, words, folder_.path()) : runAtrapos(words, folder_.path());
  }
  /// The last row of a run that reaches its stop, by name.
  std::map<std::string, double> last(const std::string& deck, int ranks = 1) {
    const CommandResult r = run(deck, ranks);
    EXPECT_EQ(r.exitCode, 0) << r.err;
    std::istringstream rows(readFile(folder_ / "out" / "path.csv"));
    std::string head, row, name, cell;
    std::getline(rows, head);
    for (std::string next; std::getline(rows, next);) row = next;
    std::istringstream names(head), cells(row);
    std::map<std::string, double> values;
    while (std::getline(names, name, ',') && std::getline(cells, cell, ',')) values[name] = std::stod(cell);
    EXPECT_EQ(values["load_factor"], 1) << r.err;
    return values;
  }

  TemporaryFolder folder_;
};

/// A block or shell, wide 4 along x, that is shifted along x by kShift while a tool comes down on it at
/// x = kPlace by kDepth.
struct Pressed {
  std::string generate, more, held, tool, contact, monitors;
  std::string deck() const {
    return fmt::format(R"(mesh:
  file: body.exo
  generate: {}
{}materials:
  body: {{law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3, blocks: [body]}}
supports:
{}tools:
  tool: {{{}}}
contact:
  face: {{tool: tool, points: zones, law: linear, stiffness: {}, {}}}
path: {{stop: {{load_factor: 1}}}}
output:
  monitors:
    force: {{type: contact_force, contact: face}}
    area: {{type: contact_area, contact: face}}
    largest: {{type: contact_pressure, contact: face}}
    center: {{type: contact_center, contact: face, component: x}}
    spread: {{type: contact_spread, contact: face}}
{})",
                       generate, more, held, tool, kStiffness, contact, monitors);
  }
};

Pressed planeBlock() {
  return {
      "{shape: rectangle, lengths: [4, 1], origin: [-2, -1], divisions: [5, 1], cell: QUAD8, block: body}",
      "plane: {kind: strain, thickness: 0.5}\n",
      fmt::format("  upper: {{set: y_max, x: {{per_load_factor: {0}}}, y: 0}}\n"
                  "  lower: {{set: y_min, x: {{per_load_factor: {0}}}, y: 0}}\n",
                  kShift),
      fmt::format("type: cylinder, center: [{}, 2.05, 0], axis: [0, 0, 1], radius: 2, motion: {{shift: [0, "
                  "-0.15, 0]}}",
                  kPlace),
      "set: y_max",
      "    beside: {type: contact_spread, contact: face, component: x, about: [0.8, 0, 0]}\n"
      "    place: {type: contact_pressure, contact: face, near: [0, 0, 0]}\n"};
}

// Integrals over zones are those of Gauss' rule with ten points a cell: 1e-10 of them; 1e-9 allows for the
// residual's bound.
TEST_F(ContactMonitors, CylinderOnAPlaneBody) {
  auto end = last(planeBlock().deck());
  const double force = 2 * overHalfWidth([](double, double p) { return p; }),
               square = 2 * overHalfWidth([](double s, double p) { return p * s * s; }) / force;
  EXPECT_NEAR(end["force"], 0.5 * force, 1e-9);
  EXPECT_NEAR(end["area"], 0.5 * 2 * std::sqrt(kDepth * (2 * kRadius - kDepth)), 1e-9);
  EXPECT_NEAR(end["largest"], kStiffness * kDepth, 1e-9);
  EXPECT_NEAR(end["center"], kPlace, 1e-9);  // in space, where the body goes by
  EXPECT_NEAR(end["spread"], std::sqrt(square), 1e-9);
  EXPECT_NEAR(end["beside"], std::sqrt(square + 0.25), 1e-9);
  // A point of the undeformed body that is shifted by 0.5 to 0.2 beside the deepest place.
  EXPECT_NEAR(end["place"], kStiffness * (kRadius - std::hypot(0.2, kRadius - kDepth)), 1e-9);
}

TEST_F(ContactMonitors, RanksSeeTheSame) {
  const auto alone = last(planeBlock().deck()), shared = last(planeBlock().deck(), 3);
  for (const char* name : {"force", "area", "largest", "center", "spread", "beside", "place"})
    EXPECT_NEAR(shared.at(name), alone.at(name), 1e-12 + 1e-12 * std::abs(alone.at(name))) << name;
}

// Around an axis rings count by their length, and the centre is on the axis.
TEST_F(ContactMonitors, BallOnARing) {
  auto end = last(Pressed{
      "{shape: rectangle, lengths: [2, 1], origin: [0, -1], divisions: [3, 1], cell: QUAD8, block: body}",
      "plane: {kind: axisymmetric}\n",
      "  upper: {set: y_max, x: 0, y: {per_load_factor: 0.05}}\n"
      "  lower: {set: y_min, x: 0, y: {per_load_factor: 0.05}}\n",
      "type: sphere, center: [0, 2.05, 0], radius: 2, motion: {shift: [0, -0.1, 0]}", "set: y_max",
      "    height: {type: contact_center, contact: face, component: y}\n"
      "    radius: {type: contact_spread, contact: face, component: x, about: [7, 0, 0]}\n"}
                      .deck());
  const double pi = std::acos(-1.0), force = 2 * pi * overHalfWidth([](double s, double p) { return p * s; }),
               square = 2 * pi * overHalfWidth([](double s, double p) { return p * s * s * s; }) / force;
  EXPECT_NEAR(end["force"], force, 1e-9);
  EXPECT_NEAR(end["largest"], kStiffness * kDepth, 1e-9);
  EXPECT_EQ(end["center"], 0);
  EXPECT_NEAR(end["height"], 0.05, 1e-9);
  EXPECT_NEAR(end["spread"], std::sqrt(square), 1e-9);
  EXPECT_NEAR(end["radius"], std::sqrt(square), 1e-9);
}

TEST_F(ContactMonitors, CylinderOnSolidsAndShells) {
  const Pressed solid{
      "{shape: box, lengths: [4, 1, 1], origin: [-2, 0, -1], divisions: [5, 2, 1], cell: HEX20, block: body}",
      "",
      fmt::format("  upper: {{set: z_max, x: {{per_load_factor: {0}}}, y: 0, z: 0}}\n"
                  "  lower: {{set: z_min, x: {{per_load_factor: {0}}}, y: 0, z: 0}}\n",
                  kShift),
      fmt::format("type: cylinder, center: [{}, 0, 2.05], axis: [0, 1, 0], radius: 2, motion: {{shift: [0, "
                  "0, -0.15]}}",
                  kPlace),
      "set: z_max",
      "    along: {type: contact_spread, contact: face, component: x}\n"
      "    across: {type: contact_spread, contact: face, component: y}\n"
      "    middle: {type: contact_center, contact: face, component: y}\n"};
  Pressed shell = solid;
  shell.generate =
      "{shape: shell_plate, length: 4, width: 1, origin: [-2, 0, 0], divisions: [5, 2], block: body}";
  shell.more = "shells: {sections: {body: {blocks: [body], thickness: 0.2}}}\n";
  shell.held = "  all: {set: top, x: 0, y: 0, z: 0}\n";
  shell.contact = "set: top";
  const double force = 2 * overHalfWidth([](double, double p) { return p; }),
               square = 2 * overHalfWidth([](double s, double p) { return p * s * s; }) / force;
  for (const Pressed& body : {solid, shell}) {
    SCOPED_TRACE(body.generate);
    auto end = last(body.deck());
    EXPECT_NEAR(end["force"], force, 1e-9);
    EXPECT_NEAR(end["largest"], kStiffness * kDepth, 1e-9);
    EXPECT_NEAR(end["center"], kPlace, 1e-9);
    EXPECT_NEAR(end["middle"], 0.5, 1e-9);
    EXPECT_NEAR(end["along"], std::sqrt(square), 1e-9);
    EXPECT_NEAR(end["across"], std::sqrt(1.0 / 12), 1e-9);
    EXPECT_NEAR(end["spread"], std::sqrt(square + 1.0 / 12), 1e-9);
  }
}

/// Pressed flat on a plane by 1 % of its height, without Poisson's ratio, by hard contact.
std::string flat(const std::string& cell, const std::string& contact, const std::string& monitors) {
  return fmt::format(R"(mesh:
  file: block.exo
  generate: {{shape: box, lengths: [4, 3, 1], divisions: [4, 3, 2], cell: {}, block: body}}
materials:
  rubber: {{law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0, blocks: [body]}}
supports:
  left: {{set: x_min, x: 0}}
  front: {{set: y_min, y: 0}}
  top: {{set: z_max, z: {{per_load_factor: -0.02}}}}
tools:
  floor: {{type: plane, point: [0, 0, -0.01], normal: [0, 0, 1]}}
contact:
  lower: {{tool: floor, set: z_min, {}}}
path: {{stop: {{load_factor: 1}}}}
output:
  monitors:
    spread: {{type: contact_spread, contact: lower, component: x}}
    across: {{type: contact_spread, contact: lower, component: y}}
    x: {{type: contact_center, contact: lower, component: x}}
    y: {{type: contact_center, contact: lower, component: y}}
    z: {{type: contact_center, contact: lower, component: z}}
{})",
                     cell, contact, monitors);
}

// A uniform pressure, Saint Venant-Kirchhoff's law at the stretch 0.99, to the residual's bound of 1e-6.
TEST_F(ContactMonitors, UniformPressure) {
  const double pressure = 1000 * 0.99 * (1 - 0.99 * 0.99) / 2;
  auto end = last(flat("HEX20", "law: hard",
                       "    largest: {type: contact_pressure, contact: lower}\n"
                       "    corner: {type: contact_pressure, contact: lower, near: [0, 0, 0]}\n"));
  EXPECT_NEAR(end["largest"], pressure, 1e-5 * pressure);
  EXPECT_NEAR(end["corner"], pressure, 1e-5 * pressure);
  EXPECT_NEAR(end["spread"], 4 / std::sqrt(12.0), 1e-5);
  EXPECT_NEAR(end["across"], 3 / std::sqrt(12.0), 1e-5);
  EXPECT_NEAR(end["x"], 2, 1e-5);
  EXPECT_NEAR(end["y"], 1.5, 1e-5);
  EXPECT_NEAR(end["z"], -0.01, 1e-9);
}

// Forces at nodes: 1, 2, 2, 2, 1 along x and 1, 2, 2, 1 along y for bilinear faces under uniform pressure.
TEST_F(ContactMonitors, ForcesAtNodes) {
  auto end = last(flat("HEX8", "law: hard, points: nodes", ""));
  EXPECT_NEAR(end["spread"], std::sqrt((2 * 4 + 4 * 1) / 8.0), 1e-5);
  EXPECT_NEAR(end["across"], std::sqrt((2 * 2.25 + 4 * 0.25) / 6.0), 1e-5);
  EXPECT_NEAR(end["x"], 2, 1e-5);
  writeFile(folder_ / "deck.yaml", flat("HEX8", "law: hard, points: nodes",
                                        "    largest: {type: contact_pressure, contact: lower}\n"));
  const CommandResult refused = runAtrapos({"run", "-q", "deck.yaml"}, folder_.path());
  EXPECT_EQ(refused.exitCode, 2);
  EXPECT_NE(refused.err.find("output/monitors/largest/contact: contact 'lower' acts at nodes, by forces and "
                             "not by a pressure"),
            std::string::npos)
      << refused.err;
}

// Before the touch nothing is pressed: the centre is at the point with the smallest gap.
TEST_F(ContactMonitors, BeforeTheTouch) {
  std::string deck = planeBlock().deck();
  const std::string shift = "-0.15";
  deck.replace(deck.find(shift), shift.size(), "-0.01");
  auto end = last(deck);
  for (const char* name : {"force", "area", "largest", "spread", "place"}) EXPECT_EQ(end[name], 0) << name;
  EXPECT_NEAR(end["center"], kPlace, 0.8 / 3);  // three points a cell of 0.8
}

TEST_F(ContactMonitors, PlaneBodiesHaveNoZ) {
  std::string deck = planeBlock().deck();
  const std::string x = "face, component: x}";
  deck.replace(deck.find(x), x.size(), "face, component: z}");
  const CommandResult r = run(deck);
  EXPECT_EQ(r.exitCode, 2);
  EXPECT_NE(r.err.find("output/monitors/center: a plane body has no z"), std::string::npos) << r.err;
}

}  // namespace
}  // namespace atrapos::test
