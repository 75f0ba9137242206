// examples/strip_roll/zones.yaml, zones_solid.yaml and zones_shell.yaml: contact integrated up to its moving
// edges, against the elastica.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/Elastica.hpp"
#include "support/NurbsRoll.hpp"
#include "support/StripRun.hpp"

namespace atrapos::test {
namespace {

/// A run, and how far its tip and the force on the roll are from the elastica at worst, over the whole path.
struct Strip {
  StripRun run;
  double tip = 0, force = 0;
  int steps;

  Strip(const std::string& deck, const Edits& edits, double loadFactor = 0.25,
        Elastica::Case which = Elastica::Case::A)
      : run(deck, edits) {
    const Elastica elastica(which);
    const auto load = run.column("load_factor"), force = run.column("contact_force"),
               tip = run.column(deck == "zones.yaml" ? "tip_uy" : "tip_uz");
    EXPECT_DOUBLE_EQ(load.back(), loadFactor);
    for (std::size_t i = 0; i < load.size(); ++i) {
      const StripState exact = elastica.beam(load[i]);
      this->tip = std::max(this->tip, std::abs(tip[i] - exact.uz));
      this->force = std::max(this->force, std::abs(force[i] - exact.force));
    }
    steps = run.summary.at("steps");
  }
};

/// Solids, of this many cells, with another contact; the tip alone is looked at.
Strip pressed(int cells, const std::string& contact) {
  return {"zones_solid.yaml",
          {{"divisions: [40, 2, 1]", fmt::format("divisions: [{}, 2, 1]", cells)},
           {"points: zones, law: linear, stiffness: 1.0e3", "points: zones" + contact},
           {"fields: [displacement, stress, nodal_stress, contact, reaction]", "fields: [displacement]"},
           {"points_per_step: 10", "points_per_step: 3"}}};
}

/// Plane cells, solids two cells wide and shells, this many along the strip.
Strip plane(int cells) {
  return {"zones.yaml", {{"divisions: [40, 1]", "divisions: [" + std::to_string(cells) + ", 1]"}}};
}
Strip solid(int cells) {
  return {"zones_solid.yaml",
          {{"divisions: [40, 2, 1]", "divisions: [" + std::to_string(cells) + ", 2, 1]"}}};
}
Strip shell(int cells, Edits edits = {}, Elastica::Case which = Elastica::Case::A) {
  edits.push_back({"divisions: [20, 1]", "divisions: [" + std::to_string(cells) + ", 1]"});
  return {"zones_shell.yaml", edits, 2, which};
}

}  // namespace

// The elastica neglects 0.01 mm of stretch and shear. A stiffness of 1e3 MPa/mm lets the roll 1e-3 mm in.
TEST(ZoneStrip, IsTheElasticaOverTheWholePath) {
  const Strip strip = plane(40);
  EXPECT_LT(strip.tip, 0.015);
  EXPECT_LT(strip.force, 0.01);  // of 42 N
  EXPECT_LE(strip.steps, 22);
}

// Cells of 20 mm are four tenths of the roll's radius.
TEST(ZoneStrip, NeedsNoFineCells) {
  const Strip coarse = plane(20);
  EXPECT_LT(coarse.tip, 0.1);
  EXPECT_LE(coarse.steps, 22);
}

// Steps go with the ends of edges that the contact passes, two events each: 17 ends with 200 cells.
TEST(ZoneStrip, StepsGoWithEventsOnFineMeshes) {
  const Strip fine = plane(80), finest = plane(200);
  EXPECT_LT(fine.tip, 0.01);
  EXPECT_LE(fine.steps, 30);
  EXPECT_LT(finest.tip, 0.01);
  EXPECT_LE(finest.steps, 45);
}

// Six lines across two faces. CalculiX is within 0.02 mm on these 40 x 2 x 1 cells (docs/strip_roll.md).
TEST(ZoneStrip, OfSolidsIsTheElasticaToo) {
  const Strip strip = solid(40), coarse = solid(20), fine = solid(80);
  EXPECT_LT(strip.tip, 0.015);
  EXPECT_LT(strip.force, 0.01);
  EXPECT_LE(strip.steps, 24);
  EXPECT_LT(coarse.tip, 0.05);
  EXPECT_LE(coarse.steps, 22);
  EXPECT_LT(fine.tip, 0.01);
  EXPECT_LE(fine.steps, 27);
}

// A deck that names no stiffness: one that is hard against a strip that bends, not against its cells.
TEST(ZoneStrip, StiffnessThatNobodyChose) {
  const Strip coarse = pressed(20, ""), strip = pressed(40, "");
  EXPECT_LT(coarse.tip, 0.05);
  EXPECT_LT(strip.tip, 0.015);
  EXPECT_LE(strip.steps, 30);
  EXPECT_GT(Table(strip.run.folder.results("steps.csv")).column("closed_contacts").back(), 0);
}

// A hundred times as stiff: the zones of six lines, 1e-7 mm deep, begin with 1 % of the load and push each
// other off; those of a power begin with next to nothing, and grow by all of themselves within 1e-10 of the
// load. Nothing of it is seen in the answer.
TEST(ZoneStrip, StiffZonesBegin) {
  EXPECT_LT(pressed(20, ", stiffness: 1.0e5").tip, 0.05);
  EXPECT_LT(pressed(40, ", stiffness: 1.0e5").tip, 0.015);
  EXPECT_LT(pressed(80, ", law: power_overclosure").tip, 0.01);
}

// All six lines touch the roll where the path starts, at nodes, and each has next to no load to begin with.
TEST(ZoneStrip, TouchesAtTheStart) {
  const auto end = [](const char* center) {
    const StripRun run("zones_solid.yaml", {{"divisions: [40, 2, 1]", "divisions: [20, 2, 1]"},
                                            {"center: [200, 0, -54.0]", center},
                                            {"points_per_step: 10", "points_per_step: 1"}});
    EXPECT_DOUBLE_EQ(run.column("load_factor").back(), 0.25);
    return run.column("tip_uz").back();
  };
  // The tip moves by some 2 mm with each of the roll.
  EXPECT_NEAR(end("center: [200, 0, -50.0]"), end("center: [200, 0, -50.001]"), 5e-3);
}

// The lowest place of the flat strip is next to a node, and leaves it by 8 mm before it touches.
TEST(ZoneStrip, ALowestPlaceThatLeavesItsNode) {
  for (const char* x : {"199.99", "199.9999", "199.999999"}) {
    const Strip strip("zones.yaml", {{"center: [200, -54.0, 0]", fmt::format("center: [{}, -54.0, 0]", x)},
                                     {"points_per_step: 10", "points_per_step: 3"}});
    EXPECT_LT(strip.tip, 0.03) << x;  // of a roll at 200: 0.008 for each 0.01
    EXPECT_LT(strip.force, 0.03);
    EXPECT_LE(strip.steps, 22);
  }
}

// The roll as a NURBS surface of four patches, two of which meet at its top: the same path.
TEST(ZoneStrip, OverPatches) {
  const std::string surfaces = nurbsRoll([](double a, double b, int end) {
    return std::array<double, 3>{200 + 49.6 * a, -54 + 49.6 * b, end == 0 ? -1.0 : 1.0};
  });
  const Strip roll = plane(40),
              patches("zones.yaml",
                      {{"{type: cylinder, center: [200, -54.0, 0], axis: [0, 0, 1], radius: 49.6}",
                        "{type: patches, surfaces: " + surfaces + "}"}});
  EXPECT_LT(patches.tip, 0.015);
  EXPECT_LT(patches.force, 0.01);
  EXPECT_LE(patches.steps, roll.steps + 2);
  // What residuals within the bound leave.
  EXPECT_NEAR(patches.run.column("tip_uy").back(), roll.run.column("tip_uy").back(), 1e-4);
}

// Beyond load factor 1.18 the strip wraps the roll: cells of 20 mm, 0.4 of its radius, bend as quadratic
// curves do.
TEST(ZoneStrip, OfShellsWrapsTheRoll) {
  const Strip paper = shell(20), fine = shell(40);
  EXPECT_LT(paper.tip, 0.1);
  EXPECT_LE(paper.steps, 30);
  EXPECT_LT(fine.tip, 0.05);
  EXPECT_LT(fine.force, 0.3);  // of 242 N
  EXPECT_LE(fine.steps, 56);
}

// Lines along one side of each triangle, which the two halves of a rectangle share.
TEST(ZoneStrip, OnTriangles) {
  const Edits triangles{{"block: strip}", "cell: SHELL6, block: strip}"}};
  const Strip paper = shell(20, triangles), fine = shell(40, triangles);
  EXPECT_LT(paper.tip, 0.15);
  EXPECT_LT(fine.tip, 0.05);
  EXPECT_LT(fine.force, 0.4);  // of 242 N
  const Strip solids{
      "zones_solid.yaml",
      {{"cell: HEX20", "cell: TET10"},
       {"fields: [displacement, stress, nodal_stress, contact, reaction]", "fields: [displacement]"},
       {"points_per_step: 10", "points_per_step: 3"}}};
  EXPECT_LT(solids.tip, 0.4);
}

// On the lower faces of shells, half a thickness from where their unknowns are: the roll of case A once more.
TEST(ZoneStrip, OnTheFacesOfShells) {
  const Strip strip =
      shell(40, {{"points: zones", "at: bottom, points: zones"}, {"radius: 50}", "radius: 49.6}"}});
  EXPECT_LT(strip.tip, 0.05);
  EXPECT_LT(strip.force, 0.3);
}

}  // namespace atrapos::test
