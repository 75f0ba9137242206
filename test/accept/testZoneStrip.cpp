// examples/strip_roll/zones.yaml: contact integrated up to its moving edges, against the elastica.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/Elastica.hpp"
#include "support/StripRun.hpp"

namespace atrapos::test {
namespace {

/// The deck with this many cells along the strip, and how far its tip is from the elastica at worst, over the
/// whole path.
struct Strip {
  StripRun run;
  double tip = 0, force = 0;
  int steps;

  explicit Strip(int cells, Edits edits = {}) : run("zones.yaml", with(cells, std::move(edits))) {
    const Elastica elastica(Elastica::Case::A);
    const auto load = run.column("load_factor"), uy = run.column("tip_uy"),
               force = run.column("contact_force");
    EXPECT_DOUBLE_EQ(load.back(), 0.25);
    for (std::size_t i = 0; i < load.size(); ++i) {
      const StripState exact = elastica.beam(load[i]);
      tip = std::max(tip, std::abs(uy[i] - exact.uz));
      this->force = std::max(this->force, std::abs(force[i] - exact.force));
    }
    steps = run.summary.at("steps");
  }
  static Edits with(int cells, Edits edits) {
    edits.push_back({"divisions: [40, 1]", "divisions: [" + std::to_string(cells) + ", 1]"});
    return edits;
  }
};

}  // namespace

// The elastica neglects 0.01 mm of stretch and shear. A stiffness of 1e3 MPa/mm lets the roll 1e-3 mm in.
TEST(ZoneStrip, IsTheElasticaOverTheWholePath) {
  const Strip strip(40);
  EXPECT_LT(strip.tip, 0.015);
  EXPECT_LT(strip.force, 0.01);  // of 42 N
  EXPECT_LE(strip.steps, 22);
}

// Cells of 20 mm are four tenths of the roll's radius.
TEST(ZoneStrip, NeedsNoFineCells) {
  const Strip coarse(20);
  EXPECT_LT(coarse.tip, 0.1);
  EXPECT_LE(coarse.steps, 22);
}

// Steps go with the ends of edges that the contact passes, two events each: 17 ends with 200 cells.
TEST(ZoneStrip, StepsGoWithEventsOnFineMeshes) {
  const Strip fine(80), finest(200);
  EXPECT_LT(fine.tip, 0.01);
  EXPECT_LE(fine.steps, 30);
  EXPECT_LT(finest.tip, 0.01);
  EXPECT_LE(finest.steps, 45);
}

}  // namespace atrapos::test
