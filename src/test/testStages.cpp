// Paths in stages: what one stage leaves is where the next begins.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "output/TableFile.hpp"
#include "support/Command.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

class Stages : public testing::Test {
 protected:
  /// Runs a deck with a mesh of its own; `more`: of the command's words.
  void run(const std::string& deck, const std::string& results, int ranks = 0) {
    writeFile(folder_ / (results + ".yaml"), deck);
    ASSERT_EQ(runAtrapos({"mesh", "-q", results + ".yaml"}, folder_.path()).exitCode, 0);
    follow({"run", "-q", results + ".yaml", "-o", results}, ranks);
  }
  void follow(const std::vector<std::string>& words, int ranks = 0) {
    const CommandResult r =
        ranks > 0 ? runAtraposOnRanks(ranks, words, folder_.path()) : runAtrapos(words, folder_.path());
    ASSERT_EQ(r.exitCode, 0) << r.err;
  }
  TableFile path(const std::string& results) const {
    return TableFile((folder_ / results / "path.csv").string());
  }
  /// Of the last row.
  double last(const std::string& results, const std::string& column) const {
    return path(results).numbers(column).back();
  }
  nlohmann::json summary(const std::string& results) const {
    return nlohmann::json::parse(readFile(folder_ / results / "summary.json"));
  }
  /// The command refuses the deck in one line with these words.
  void refuses(const std::string& deck, const std::string& expected) {
    writeFile(folder_ / "refused.yaml", deck);
    const CommandResult r = runAtrapos({"check", "refused.yaml"}, folder_.path());
    EXPECT_EQ(r.exitCode, 2);
    ASSERT_EQ(r.errorLines().size(), 1u) << r.err;
    EXPECT_NE(r.err.find(expected), std::string::npos) << r.err;
  }
  TemporaryFolder folder_;
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

const std::string kBar = R"(mesh:
  file: bar.exo
  generate: {shape: box, lengths: [2, 1, 1], divisions: [2, 1, 1], cell: HEX8}
materials:
  metal: {law: von_mises, youngs_modulus: 200000, poissons_ratio: 0.3, yield_stress: 200, hardening_modulus: 10000, blocks: [body]}
supports:
  left: {set: x_min, x: 0}
  front: {set: y_min, y: 0}
  bottom: {set: z_min, z: 0}
loads:
  pull: {type: surface, set: x_max, traction: [200, 0, 0]}
path:
  accuracy: 1.0e-9
  residual: 1.0e-9
  stages:
    load: {stop: {load_factor: 1.2}}
    unload: {stop: {load_factor: 0}}
    press: {stop: {load_factor: -1.3}}
    back: {stop: {load_factor: 0}}
output:
  points_per_step: 1
  monitors:
    end: {type: displacement, set: x_max, component: x}
)";

/// A bar of the law of kBar under uniaxial stress (docs/theory/plasticity.md): E = S/E0 + p, |S| <= R0 + H
/// gamma.
struct Bar {
  double plastic = 0, accumulated = 0;
  /// The stretch at a nominal stress P = (1 + e) S, with the yielding that it takes.
  double stretchAt(double P) {
    constexpr double young = 200000, R0 = 200, H = 10000;
    double e = 0;
    const double p0 = plastic, gamma0 = accumulated;
    for (int i = 0; i < 200; ++i) {
      const double S = P / (1 + e), over = std::abs(S) - (R0 + H * gamma0);
      const double more = std::max(0.0, over / H);
      plastic = p0 + std::copysign(more, S);
      accumulated = gamma0 + more;
      e = std::sqrt(1 + 2 * (S / young + plastic)) - 1;
    }
    return e;
  }
};

TEST_F(Stages, ABarYieldsUnloadsAndYieldsTheOtherWay) {
  run(kBar, "bar");
  const TableFile table = path("bar");
  const auto branch = table.integers("branch");
  const auto load = table.numbers("load_factor"), end = table.numbers("end");
  Bar bar;
  for (std::size_t i = 0; i < load.size(); ++i)
    EXPECT_NEAR(end[i], 2 * bar.stretchAt(200 * load[i]), 1e-8 * 0.01)
        << "stage " << branch[i];  // the accuracy
  EXPECT_EQ(branch.back(), 3);
  const auto json = summary("bar");
  EXPECT_TRUE(json.at("reached_stop"));
  EXPECT_EQ(json.at("stage"), "back");
  EXPECT_EQ(json.at("branches")[2].at("stage"), "press");
  // Each stage is as long as what yields makes it: a body without stress at an end costs no steps.
  EXPECT_LE(json.at("steps"), 6);
}

const std::string kBeam = R"(mesh:
  file: beam.exo
  generate: {shape: rectangle, lengths: [10, 1], divisions: [10, 2], cell: QUAD8}
plane: {kind: strain}
materials:
  metal: {law: saint_venant_kirchhoff, youngs_modulus: 200000, poissons_ratio: 0.3, blocks: [body]}
supports:
  left: {set: x_min, x: 0, y: 0}
  tip: {set: x_max, y: {per_load_factor: -0.3}}
path:
  accuracy: 1.0e-8
  residual: 1.0e-8
  stages:
    bend: {stop: {load_factor: 1}}
    let_go: {release: [tip]}
output:
  points_per_step: 4
  monitors:
    end: {type: displacement, set: x_max, component: y}
    hold: {type: reaction, support: tip, component: y}
)";

TEST_F(Stages, WhatAReleasedSupportHeldFallsInProportion) {
  run(kBeam, "beam");
  const TableFile table = path("beam");
  const auto branch = table.integers("branch");
  const auto load = table.numbers("load_factor"), hold = table.numbers("hold");
  double bent = 0;
  for (std::size_t i = 0; i < load.size(); ++i) {
    if (branch[i] == 0)
      bent = hold[i];
    else  // what the accuracy leaves inside a step
      EXPECT_NEAR(hold[i], (1 - load[i]) * bent, 1e-6 * std::abs(bent));
  }
  EXPECT_LT(bent, -10);
  EXPECT_NEAR(last("beam", "end"), 0, 1e-9);
}

/// A bar that is pulled by its end and let go keeps what its stress, at the end of the pull, has made
/// plastic.
TEST_F(Stages, ALetGoBarKeepsItsPlasticStrain) {
  std::string deck = replaced(kBar, "loads:\n  pull: {type: surface, set: x_max, traction: [200, 0, 0]}\n",
                              "  pull: {set: x_max, x: {per_load_factor: 0.01}}\n");
  const auto stages = deck.find("    load:"), output = deck.find("output:");
  deck.replace(stages, output - stages,
               "    pull: {stop: {load_factor: 1}}\n    let_go: {release: [pull]}\n");
  deck += "    hold: {type: reaction, support: pull, component: x}\n";
  run(deck, "bar");
  const TableFile table = path("bar");
  const auto branch = table.integers("branch");
  const auto hold = table.numbers("hold");
  Bar bar;
  for (std::size_t i = 0; i < hold.size(); ++i)
    if (branch[i] == 0) bar.stretchAt(hold[i]);
  EXPECT_GT(bar.plastic, 1e-3);
  EXPECT_NEAR(last("bar", "end"), 2 * bar.stretchAt(0),
              1e-7 * 0.01);  // the force is that of the end of a step
}

/// An elastic body does not know in which order it was loaded: dead and follower loads, supports, tools and
/// temperatures one after another lead to where all of them together do.
const std::string kMany = R"(mesh:
  file: many.exo
  generate: {shape: rectangle, lengths: [4, 1], divisions: [8, 2], cell: QUAD8}
plane: {kind: strain}
constants: {warm: 0.002}
materials:
  rubber: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3, blocks: [body], expansion: "0.01*T + warm*lambda"}
physics:
  heat: {type: balance, field: T, conductivity: "1 + 0.1*T", source: "3*lambda^2", blocks: [body]}
supports:
  left: {set: x_min, x: 0, y: {per_load_factor: 0.05}}
  cold: {set: x_min, field: T, value: {value: 0.1, per_load_factor: 0.2}}
loads:
  tip: {type: surface, set: x_max, total: [0, -6, 0]}
  gas: {type: surface, set: y_max, pressure: 2, follower: true}
  glow: {type: inflow, set: x_max, field: T, amount: "0.5*lambda - 0.1*T"}
tools:
  roll: {type: cylinder, center: [3, -1.35, 0], axis: [0, 0, 1], radius: 1, motion: {shift: [[0, 0.05, 0], [0.1, 0, 0]]}}
contact:
  lower: {tool: roll, set: y_min, stiffness: 1000, regularisation: 1.0e-2}
path:
  accuracy: 1.0e-8
  residual: 1.0e-8
  stop: {load_factor: 1}
output:
  monitors:
    tip_uy: {type: displacement, set: x_max, component: y}
    tip_ux: {type: displacement, set: x_max, component: x}
    hot: {type: field, field: T, set: x_max}
    force: {type: contact_force, contact: lower}
)";

constexpr const char* kInTurn = R"(  stages:
    heat: {drives: [heat, rubber, cold, glow], stop: {load_factor: 1}}
    press: {drives: [roll], stop: {load_factor: 1}}
    lift: {drives: [left], stop: {load_factor: 1}}
    blow: {drives: [gas], stop: {load_factor: 1}}
    bend: {drives: [tip], stop: {load_factor: 1}}
)";

TEST_F(Stages, TheOrderOfElasticLoadsDoesNotMatter) {
  run(kMany, "together");
  run(replaced(kMany, "  stop: {load_factor: 1}\n", kInTurn), "in_turn");
  for (const char* monitor : {"tip_uy", "tip_ux", "hot", "force"}) {
    const double expected = last("together", monitor);
    EXPECT_NEAR(last("in_turn", monitor), expected, 1e-6 * std::abs(expected))
        << monitor;  // residuals of 1e-8
    EXPECT_GT(std::abs(expected), 1e-3) << monitor;
  }
}

TEST_F(Stages, NewtonStepsGoThroughThemToo) {
  const std::string newton =
      replaced(replaced(kBeam, "  accuracy: 1.0e-8", "  method: newton"), "  points_per_step: 4\n", "");
  run(newton, "newton");
  EXPECT_EQ(path("newton").integers("branch").back(), 1);
  EXPECT_NEAR(last("newton", "end"), 0, 1e-7);  // of 0.3, by a residual of 1e-8
}

TEST_F(Stages, RanksFollowTheSameStages) {
  const std::string deck = replaced(replaced(kBeam, "law: saint_venant_kirchhoff", "law: von_mises"),
                                    "poissons_ratio: 0.3,", "poissons_ratio: 0.3, yield_stress: 400,");
  run(deck, "one");
  run(deck, "three", 3);
  EXPECT_EQ(summary("one").at("steps"), summary("three").at("steps"));
  EXPECT_GT(std::abs(last("one", "end")), 0.01);
  EXPECT_NEAR(last("three", "end"), last("one", "end"), 1e-9);  // sums in another order, over all steps
}

TEST_F(Stages, ARestartGoesOnInAStageAndWithAnotherOne) {
  const std::string deck = replaced(kBar, "    back: {stop: {load_factor: 0}}\n", "");
  run(deck, "bar");
  const std::string whole = readFile(folder_ / "bar" / "path.csv");
  for (const char* from : {"0:1", "0:2", "1:1", "2:1"}) {
    follow({"run", "-q", "bar.yaml", "--restart", "bar", "--from", from, "-o", "again"});
    EXPECT_TRUE(readFile(folder_ / "again" / "path.csv") == whole) << from;
    EXPECT_TRUE(readFile(folder_ / "again" / "steps.csv") == readFile(folder_ / "bar" / "steps.csv")) << from;
  }
  writeFile(folder_ / "more.yaml", kBar);
  follow({"run", "-q", "more.yaml", "--restart", "bar", "-o", "more"});
  run(kBar, "all");
  EXPECT_TRUE(readFile(folder_ / "more" / "path.csv") == readFile(folder_ / "all" / "path.csv"));

  const auto refusesToGoOn = [&](const std::string& other, const std::string& expected) {
    writeFile(folder_ / "other.yaml", other);
    const CommandResult r = runAtrapos({"run", "-q", "other.yaml", "--restart", "bar"}, folder_.path());
    EXPECT_EQ(r.exitCode, 2);
    EXPECT_NE(r.err.find(expected), std::string::npos) << r.err;
  };
  refusesToGoOn(replaced(deck, "unload: {stop", "unload: {drives: [pull], stop"),
                "path/stages/unload was drives all and is drives [pull] now");
  refusesToGoOn(replaced(deck, "    unload:", "    hold: {stop: {load_factor: 1.1}}\n    unload:"),
                "the run's stage 2 is 'unload', the deck's 'hold'");
}

TEST_F(Stages, AStageThatDoesNotEndAtItsStopIsTheLast) {
  writeFile(folder_ / "bar.yaml",
            replaced(kBar, "load: {stop: {load_factor: 1.2}}", "load: {stop: {load_factor: 1.2, steps: 1}}"));
  ASSERT_EQ(runAtrapos({"mesh", "-q", "bar.yaml"}, folder_.path()).exitCode, 0);
  const CommandResult r = runAtrapos({"run", "-q", "bar.yaml", "-o", "bar"}, folder_.path());
  EXPECT_EQ(r.exitCode, 3);
  EXPECT_NE(r.err.find("stage load: the limit of 1 steps is reached; stage unload has not begun"),
            std::string::npos)
      << r.err;
  EXPECT_FALSE(summary("bar").at("reached_stop"));
}

TEST_F(Stages, WhatCannotBeIsRefused) {
  run(kMany, "many");
  const auto inTurn = [](const std::string& stages) {
    return replaced(kMany, "  stop: {load_factor: 1}\n", "  stages:\n" + stages);
  };
  refuses(inTurn("    a: {drives: [tip]}\n"), "path/stages/a/stop: is missing");
  refuses(inTurn("    a: {drives: [tap], stop: {load_factor: 1}}\n"),
          "no entry 'tap' depends on the load factor (did you mean 'tip'?)");
  refuses(inTurn("    a: {drives: [tip], stop: {load_factor: 1}}\n    b: {stop: {load_factor: 2}}\n"),
          "'tip' and 'gas' were last driven by different stages, and stand at different load factors");
  refuses(inTurn("    a: {drives: [tip], stop: {load_factor: 1}}\n    b: {release: [left]}\n"),
          "supports: the body with block 'body' can still move freely");
  refuses(inTurn("    a: {drives: [tip], stop: {load_factor: 1}}\n    b: {release: [right]}\n"),
          "no entry 'right' in supports");
  refuses(inTurn("    a: {release: [cold], drives: [tip]}\n"), "stands beside release");
  refuses(inTurn("    a: {release: [cold]}\n    b: {release: [cold]}\n"),
          "has been released by a stage before");
  refuses(replaced(kMany, "  stop: {load_factor: 1}\n", "  stop: {load_factor: 1}\n" + std::string(kInTurn)),
          "path/stop: is not for a path in stages; expected it in each stage");
  refuses(replaced(kMany, "  stop: {load_factor: 1}\n", "  branches: all\n" + std::string(kInTurn)),
          "path/branches: is not for a path in stages");
}

}  // namespace
}  // namespace atrapos::test
