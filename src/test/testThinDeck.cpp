// Decks with membranes and bars: what is refused, loads and contact on them, ranks, result files.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "support/Command.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

// A membrane over a frame, with a stay below it.
constexpr const char* kSheet = R"(mesh:
  file: sheet.exo
  generate: {shape: shell_plate, length: 100, width: 100, divisions: [4, 4], cell: SHELL8, block: skin}
materials:
  rubber: {law: neo_hookean, shear_modulus: 0.4, bulk_modulus: 40, blocks: [skin]}
membranes:
  all: {blocks: [skin], thickness: 0.5, prestress: 0.01}
supports:
  a: {set: x_min, condition: hinged}
  b: {set: x_max, condition: hinged}
  c: {set: y_min, condition: hinged}
  d: {set: y_max, condition: hinged}
loads:
  air: {type: surface, set: bottom, pressure: 0.001, follower: true}
path:
  stop: {load_factor: 1}
output:
  fields: [displacement, stress]
  monitors:
    middle: {type: displacement, set: top, component: z, near: [50, 50, 0]}
)";

constexpr const char* kTruss = R"(mesh:
  file: truss.exo
  generate:
    shape: truss
    nodes: [[-10, 0, 0], [0, 0, 2], [10, 0, 0]]
    bars: [[1, 2], [2, 3]]
    sets: {ends: [1, 3], apex: [2]}
materials:
  steel: {law: von_mises, youngs_modulus: 200e3, poissons_ratio: 0.3, yield_stress: 250, hardening_modulus: 300, blocks: [bars]}
bars:
  all: {blocks: [bars], area: 2}
supports:
  ends: {set: ends, condition: hinged}
  plane: {set: apex, y: 0}
loads:
  down: {type: nodal, set: apex, total: [0, 0, -1]}
path:
  stop: {load_factor: 1}
)";

/// The command on a deck whose mesh is made.
CommandResult command(const TemporaryFolder& folder, const std::vector<std::string>& words,
                      const std::string& deck) {
  writeFile(folder / "deck.yaml", deck);
  const CommandResult made = runAtrapos({"mesh", "-q", "deck.yaml"}, folder.path());
  return made.exitCode == 0 ? runAtrapos(words, folder.path()) : made;
}

struct Refused {
  const char *deck, *from, *to, *line;
};

}  // namespace

TEST(ThinDeck, WhatCannotBeIsRefused) {
  const std::vector<Refused> cases{
      {kSheet, "all: {blocks: [skin]", "all: {blocks: [skim]",
       "membranes/all/blocks: the mesh has no block 'skim'"},
      {kSheet, "thickness: 0.5", "thickness: 0", "membranes/all/thickness: must be positive"},
      {kSheet, "materials:", "bars: {x: {blocks: [skin], area: 1}}\nmaterials:",
       "bars/x/blocks: block 'skin' has SHELL8, no bars (BAR2, BAR3)"},
      {kSheet, "materials:", "shells: {sections: {s: {blocks: [skin], thickness: 1}}}\nmaterials:",
       "shells/sections/s/blocks: block 'skin' has membranes, which are no shells"},
      {kSheet, "condition: hinged}\n  b:", "condition: hinged, director_x: 0.5}\n  b:",
       "supports/a/director_x: no node of 'x_min' belongs to shells"},
      {kSheet, "pressure: 0.001,", "pressure: 0.001, at: top,",
       "loads/air/at: the side set 'bottom' has faces of membranes"},
      {kSheet, "  air:", "  turn: {type: edge, set: x_max, follower_moment: 2}\n  air:",
       "loads/turn: block 'skin' has membranes, whose edges take dead forces alone"},
      {kSheet, "blocks: [skin]}",
       "blocks: [skin], expansion: 0.001 * T}\nphysics:\n  heat: {type: balance, field: T, "
       "conductivity: 1, blocks: [skin]}",
       "block 'skin' has membranes; expansion is for solids, plane bodies and shells"},
      {kSheet, "blocks: [skin]}", "blocks: [skin], formulation: mixed}",
       "pressures stand beside displacements"},
      {kTruss, "all: {blocks: [bars], area: 2}", "all: {blocks: [bars], area: 2, prestress: 3}",
       "bars/all/prestress: is not for von_mises"},
      {kTruss, "yield_stress", "strains: finite, yield_stress",
       "materials/steel/strains: finite strains are for solids"},
      {kTruss, "bars:\n  all: {blocks: [bars], area: 2}\n", "",
       "bars: block 'bars' has bars without an entry, which says their area"},
      {kTruss, "[[1, 2], [2, 3]]", "[[1, 2], [2, 4]]", "mesh/generate: bar [2, 4]: there are nodes 1 to 3"},
      {kTruss, "[[1, 2], [2, 3]]", "[[1, 2], [2, 1]]", "mesh/generate: bar [2, 1] is given twice"},
      {kTruss, "[[1, 2], [2, 3]]", "[[1, 2]]", "mesh/generate: node 3 is at the end of no bar"},
      {kTruss, "[10, 0, 0]", "[0, 0, 2]", "mesh/generate: bar [2, 3] has no length"},
      {kTruss, "apex: [2]", "apex: [2, 9]", "mesh/generate: set 'apex' has node 9: there are nodes 1 to 3"},
      {kTruss, "[1, 2], [2, 3]", "1, 2", "mesh/generate/bars: expected a list of 2 whole numbers"},
      {kTruss, "apex: [2]", "apex: two", "mesh/generate/sets/apex: expected a list of whole numbers"}};
  for (const Refused& refused : cases) {
    TemporaryFolder folder;
    const CommandResult r =
        command(folder, {"check", "deck.yaml"}, edited(refused.deck, refused.from, refused.to));
    EXPECT_EQ(r.exitCode, 2) << refused.line;
    ASSERT_EQ(r.errorLines().size(), 1u) << r.err;
    EXPECT_NE(r.err.find(refused.line), std::string::npos) << r.err << "\nexpected: " << refused.line;
  }
}

// What `check` prints is a deck that reads back.
TEST(ThinDeck, PrintedDecksReadBack) {
  for (const char* deck : {kSheet, kTruss}) {
    TemporaryFolder folder;
    const CommandResult first = command(folder, {"check", "deck.yaml"}, deck);
    ASSERT_EQ(first.exitCode, 0) << first.err;
    const auto deckOf = [](const std::string& out) { return out.substr(0, out.find("\n# ")); };
    EXPECT_EQ(deckOf(command(folder, {"check", "deck.yaml"}, first.out).out), deckOf(first.out));
  }
}

// A membrane that nothing stretches has no stiffness across itself, and the line names what could move.
TEST(ThinDeck, SlackMembranesHaveNoWayToStart) {
  TemporaryFolder folder;
  const CommandResult r =
      command(folder, {"run", "-q", "deck.yaml", "-o", "out"}, edited(kSheet, ", prestress: 0.01", ""));
  EXPECT_EQ(r.exitCode, 3) << r.err;
  EXPECT_NE(r.err.find("numerically singular"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("displacement z of node"), std::string::npos) << r.err;
}

// On two ranks as on one, to the rounding of sums.
TEST(ThinDeck, RanksAndStress) {
  TemporaryFolder folder;
  ASSERT_EQ(command(folder, {"run", "-q", "deck.yaml", "-o", "one"}, kSheet).exitCode, 0);
  ASSERT_EQ(runAtraposOnRanks(2, {"run", "-q", "deck.yaml", "-o", "two"}, folder.path()).exitCode, 0);
  double middle[2];
  for (const int i : {0, 1}) {
    const exodus::ResultReader results((folder / (i == 0 ? "one" : "two") / "results.exo").string());
    const int last = results.numSteps() - 1;
    const auto u = results.nodal(last, "displ_z");
    middle[i] = *std::max_element(u.begin(), u.end());
    // Stretched, in the plane of the membrane.
    const auto stress = results.element(last, "stress_xx");
    EXPECT_GT(*std::min_element(stress.begin(), stress.end()), 0.01);
  }
  EXPECT_GT(middle[0], 5);
  EXPECT_NEAR(middle[0], middle[1], 1e-9 * middle[0]);
}

// A ball from below, a gap away. Before it touches next to nothing moves, and that is what the path's length
// is measured by: steps were a thousandth of what the membrane allows.
TEST(ThinDeck, SheetOverABall) {
  TemporaryFolder folder;
  const std::string air = "  air: {type: surface, set: bottom, pressure: 0.001, follower: true}\n";
  std::string deck = edited(
      kSheet, "loads:\n" + air,
      "tools:\n  ball: {type: sphere, center: [50, 50, -30], radius: 29.9, motion: {shift: [0, 0, 1]}}\n"
      "contact:\n  touch: {tool: ball, set: bottom}\n");
  deck = edited(deck, "load_factor: 1", "load_factor: 10, steps: 200");
  const CommandResult r = command(folder, {"run", "-q", "deck.yaml", "-o", "out"}, deck);
  EXPECT_EQ(r.exitCode, 0) << r.err;
  EXPECT_NE(readFile(folder / "out" / "summary.json").find("\"reached_stop\": true"), std::string::npos);
}

}  // namespace atrapos::test
