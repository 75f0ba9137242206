// Bad input: one line on stderr that names what is wrong, exit code 2, and not a byte changed on disk.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>

#include "support/Command.hpp"
#include "support/Folder.hpp"
#include "support/SmallDeck.hpp"

namespace atrapos::test {
namespace {

/// A folder with a good mesh, the deck, and results of an earlier run that must outlive every mistake.
class BadInput : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    TemporaryFolder folder;
    writeFile(folder / "deck.yaml", kSmallDeck);
    const CommandResult made = runAtrapos({"mesh", "-q", "deck.yaml"}, folder.path());
    ASSERT_EQ(made.exitCode, 0) << made.err;
    mesh_ = readFile(folder / "box.exo");
  }

  void SetUp() override {
    ASSERT_FALSE(mesh_.empty());
    writeFile(folder_ / "deck.yaml", kSmallDeck);
    writeFile(folder_ / "box.exo", mesh_);
    std::filesystem::create_directory(folder_ / "deck_results");
    for (const char* name :
         {"path.csv", "events.csv", "sharpen.csv", "results.exo", "summary.json", "path.png", "notes.txt"})
      writeFile(folder_ / "deck_results" / name, std::string("kept: ") + name);
  }

  /// Runs the command and expects it to refuse, saying all of `words` in one line.
  void refuses(const std::vector<std::string>& arguments, const std::vector<std::string>& words) {
    const auto before = snapshot(folder_.path());
    const CommandResult r = runAtrapos(arguments, folder_.path());
    EXPECT_EQ(r.exitCode, 2);
    EXPECT_EQ(r.out, "");
    ASSERT_EQ(r.errorLines().size(), 1u) << r.err;
    for (const std::string& word : words)
      EXPECT_NE(r.err.find(word), std::string::npos) << word << " is not in: " << r.err;
    EXPECT_TRUE(snapshot(folder_.path()) == before) << "something was written";
  }

  /// `run` refuses the small deck with one edit.
  void refusesDeck(const std::string& from, const std::string& to, const std::vector<std::string>& words) {
    writeFile(folder_ / "deck.yaml", edited(kSmallDeck, from, to));
    refuses({"run", "-q", "deck.yaml"}, words);
  }

  TemporaryFolder folder_;
  static std::string mesh_;
};
std::string BadInput::mesh_;

TEST_F(BadInput, MissingDeck) {
  refuses({"run", "nowhere.yaml"}, {"nowhere.yaml", "No such file"});
  refuses({"check", "nowhere.yaml"}, {"nowhere.yaml", "No such file"});
  refuses({"mesh", "nowhere.yaml"}, {"nowhere.yaml", "No such file"});
}

TEST_F(BadInput, DeckIsAFolder) { refuses({"run", "deck_results"}, {"deck_results", "folder"}); }

TEST_F(BadInput, EmptyDeck) {
  writeFile(folder_ / "deck.yaml", "");
  refuses({"run", "deck.yaml"}, {"deck.yaml"});
}

TEST_F(BadInput, DeckOfRandomBytes) {
  std::mt19937 random(7);
  std::string bytes(5000, ' ');
  std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<char>(random() & 0xff); });
  writeFile(folder_ / "deck.yaml", bytes);
  refuses({"run", "deck.yaml"}, {"deck.yaml"});
}

TEST_F(BadInput, DeckThatIsNoYaml) {
  refusesDeck("[0, 0, -10]}", "[0, 0, -10]",
              {"deck.yaml:11:1: unexpected 't'; expected ',' or '}' for the '{' on line 10"});
  refusesDeck("stiffness: 1000", "stiffness: 1000, tool: roll",
              {"deck.yaml:14:", "'contact/lower/tool' is given twice, first on line 14"});
  refusesDeck("roll: {", "roll: &roll {<<: *roll, ", {"deck.yaml:12:", "within what it names"});
  refusesDeck("order: 15", "order: " + std::string(100000, '['), {"deck.yaml:16:", "64 deep"});
  writeFile(folder_ / "deck.yaml", std::string("\xEF\xBB\xBF\r\n"));
  refuses({"check", "deck.yaml"}, {"deck.yaml: the deck is empty"});
}

// Each would stand twice in the tables' headers.
TEST_F(BadInput, MonitorsNamedAsColumns) {
  writeFile(folder_ / "free.yaml", kSmallDeck);
  ASSERT_EQ(runAtrapos({"run", "-q", "free.yaml", "-o", "free"}, folder_.path()).exitCode, 0);
  int columns = 0;
  for (const char* table : {"path.csv", "points.csv"}) {
    std::istringstream header(readFile(folder_ / "free" / table));
    std::string line;
    std::getline(header, line);
    std::istringstream words(line);
    for (std::string name; std::getline(words, name, ',');) {
      if (name == "tip_uz" || name == "force") continue;
      ++columns;
      refusesDeck("    force: {", "    " + name + ": {",
                  {"output/monitors/" + name, "a column of path.csv or points.csv"});
    }
  }
  EXPECT_EQ(columns, 6 + 9);
}

TEST_F(BadInput, WhatWouldTakeTooMuch) {
  refusesDeck("points_per_step: 2", "points_per_step: 2000000000",
              {"output/points_per_step", "from 1 to 10000"});
  for (const char* divisions : {"[2000000000, 2000000000, 2000000000]", "[100000000, 2, 1]"}) {
    writeFile(folder_ / "deck.yaml",
              edited(kSmallDeck, "divisions: [4, 1, 1]", std::string("divisions: ") + divisions));
    refuses({"mesh", "deck.yaml"}, {"mesh/generate/divisions", "elements; expected at most 1e+08"});
  }
}

TEST_F(BadInput, UnknownKey) {
  refusesDeck("order: 15", "ordre: 15", {"path/ordre", "did you mean 'order'?"});
}
TEST_F(BadInput, WrongType) {
  refusesDeck("order: 15", "order: many", {"path/order", "whole number", "many"});
}
TEST_F(BadInput, NegativeRadius) {
  refusesDeck("radius: 1", "radius: -1", {"tools/roll/radius", "positive", "-1"});
}
TEST_F(BadInput, OrderZero) { refusesDeck("order: 15", "order: 0", {"path/order", "0"}); }
TEST_F(BadInput, NotANumber) {
  refusesDeck("youngs_modulus: 1000", "youngs_modulus: nan", {"materials/rubber/youngs_modulus", "nan"});
}
TEST_F(BadInput, InfiniteLoad) { refusesDeck("[0, 0, -10]", "[0, 0, -inf]", {"loads/tip/total"}); }
TEST_F(BadInput, NumberBeyondDouble) { refusesDeck("[0, 0, -10]", "[0, 0, -1.0e999]", {"loads/tip/total"}); }
TEST_F(BadInput, Incompressible) {
  refusesDeck("poissons_ratio: 0.3", "poissons_ratio: 0.5", {"materials/rubber/poissons_ratio"});
}
TEST_F(BadInput, NoStop) { refusesDeck("  stop: {load_factor: 0.5}\n", "", {"path/stop"}); }

TEST_F(BadInput, UnknownSet) {
  refusesDeck("set: x_min", "set: x_mn", {"supports/clamp/set", "x_mn", "did you mean 'x_min'?"});
}

TEST_F(BadInput, BodyThatCanSlide) {
  refusesDeck("{set: x_min, x: 0, y: 0, z: 0}", "{set: x_min, x: 0, z: 0}", {"supports", "rigid motion"});
}
TEST_F(BadInput, BodyWithoutSupports) {
  refusesDeck("supports:\n  clamp: {set: x_min, x: 0, y: 0, z: 0}\n", "", {"supports"});
}

TEST_F(BadInput, ToolInTheBody) {
  refusesDeck("center: [4, 0, -1.25]", "center: [4, 0, -0.75]", {"contact/lower", "penetrates", "gap -0.24"});
}

TEST_F(BadInput, ToolsThatAreNoSurface) {
  const std::string roll = "{type: cylinder, center: [4, 0, -1.25], axis: [0, 1, 0], radius: 1}";
  refusesDeck(roll, "{type: torus, center: [4, 0, -9], axis: [1, 0, 0], radius: 1, tube_radius: 1}",
              {"tools/roll: torus: radius must be above the tube radius 1, got 1"});
  refusesDeck(roll,
              "{type: crowned_roll, center: [4, 0, -9], axis: [0, 1, 0], places: [0, 0], radii: [1, 1]}",
              {"tools/roll", "places must ascend, got 0 after 0"});
  refusesDeck(roll,
              "{type: tapered_roll, center: [4, 0, -9], axis: [0, 1, 0], radius: 1, flat: -1, angle: 3, "
              "smoothing: 0.1}",
              {"tools/roll", "flat length must be >= 0 where both ends taper"});
}

// Patches: repeated knots, weights, numbers of points and knots, a normal that vanishes, a body inside.
TEST_F(BadInput, PatchesThatAreNoSurface) {
  const std::string roll = "{type: cylinder, center: [4, 0, -1.25], axis: [0, 1, 0], radius: 1}";
  const auto refusesSurface = [&](const std::string& surface, const std::vector<std::string>& words) {
    refusesDeck(roll, "{type: patches, surfaces: {s: {" + surface + "}}}", words);
  };
  const std::string flat = "points: [[-9, -9, -1], [-9, 9, -1], [9, -9, -1], [9, 9, -1]]";
  refusesSurface("degree: [1, 1], " + flat + ", knots_1: [0, 0, 0, 1], knots_2: [0, 0, 1, 1]",
                 {"tools/roll: surface 's': NURBS surface: knot 0 is repeated more than 2 times (degree 1)"});
  refusesSurface("degree: [1, 1], " + flat + ", knots_1: [0, 1, 0, 1], knots_2: [0, 0, 1, 1]",
                 {"tools/roll: surface 's'", "knots must ascend, got 0 after 1"});
  refusesSurface("degree: [1, 1], " + flat + ", knots_2: [0, 0, 1, 1]",
                 {"tools/roll: surface 's': knots_1 is missing"});
  refusesSurface("degree: [1, 1], " + flat + ", weights: [1, 1, 0, 1]",
                 {"tools/roll: surface 's': Bezier patch: weight must be > 0 and finite, got 0"});
  refusesSurface("degree: [1, 1], " + flat + ", weights: [1, 1, 1]", {"needs 4 weights or none, got 3"});
  refusesSurface("degree: [2, 1], " + flat, {"needs 6 control points, got 4"});
  refusesSurface("degree: [0, 1], " + flat, {"tools/roll/surfaces/s/degree", "from 1 to 20"});
  refusesSurface("degree: [1, 1], points: [[0, 0], [1, 0]]",
                 {"tools/roll/surfaces/s/points: expected a list of lists of 3 finite numbers"});
  refusesSurface("degree: [1, 1], points: [[-9, 0, -1], [-9, 0, -1], [9, -9, -1], [9, 9, -1]]",
                 {"tools/roll: patch surface: the normal of patch 1 vanishes at (-9, 0, -1)"});
  refusesSurface("degree: [1, 1], points: [[-9, -9, 0.5], [-9, 9, 0.5], [9, -9, 0.5], [9, 9, 0.5]]",
                 {"contact/lower: tool 'roll' penetrates the body at the start: gap -0.5"});
  refusesDeck(roll, "{type: patches, file: nowhere.yaml}",
              {"tools/roll/file: the file 'nowhere.yaml' does not exist"});
  refusesDeck(roll, "{type: patches, reversed: true}", {"tools/roll: needs either surfaces or file"});
  writeFile(folder_ / "surfaces.yaml", "surfaces: {s: {degree: [1, 1]}}\n");
  refusesDeck(roll, "{type: patches, file: surfaces.yaml}",
              {"surfaces.yaml:1:12: surfaces/s/points: is missing"});
}

TEST_F(BadInput, MotionsThatAreNone) {
  const auto refusesMotion = [&](const std::string& motion, const std::vector<std::string>& words) {
    refusesDeck("radius: 1}", "radius: 1, motion: {" + motion + "}}", words);
  };
  refusesMotion("pivot: [0, 0, 0]", {"tools/roll/motion: moves nothing; expected shift or angle"});
  refusesMotion("angle: [5]", {"tools/roll/motion/axis: is missing"});
  refusesMotion("shift: [[0, 0, 1], [0, 0, 1], [0, 0, 1], [0, 0, 1]]",
                {"tools/roll/motion/shift", "1, 2, 3"});
  refusesMotion("angle: [1, 2, 3, 4], axis: [0, 0, 1]", {"tools/roll/motion/angle", "1, 2, 3"});
  refusesMotion("shift: [0, 1]", {"tools/roll/motion/shift: expected a list of lists of 3"});
}

TEST_F(BadInput, ContactLaws) {
  const std::string law = "stiffness: 1000, regularisation: 1.0e-3";
  refusesDeck(law, "law: spring", {"contact/lower/law: 'spring' is not a choice here"});
  refusesDeck(law, "law: penalty, regularisation: 1", {"regularisation: has no meaning with law: penalty"});
  refusesDeck(law, "law: barrier, stiffness: 1", {"stiffness: has no meaning with law: barrier"});
  refusesDeck(law, "law: penalty, stiffness: rigid", {"stiffness: a penalty has a finite stiffness"});
  refusesDeck(law, "law: power, exponent: 0.5", {"exponent: must be from 1 to 16, got 0.5"});
  refusesDeck(law, "stiffness: soft", {"stiffness: expected a positive number, rigid or auto"});
  writeFile(folder_ / "deck.yaml",
            edited(edited(kSmallDeck, law, "law: penalty"), "order: 15", "order: 15\n  sharpen: 0.1"));
  refuses({"run", "deck.yaml"}, {"path/sharpen: needs contacts with the law hyperbola or barrier"});
  refusesDeck("order: 15", "order: 15\n  sharpen: 2", {"path/sharpen: must be above 0 and below 1, got 2"});
  refusesDeck(law, law + ", reference_gap: 1.0e-7", {"reference_gap: must be above"});
}

TEST_F(BadInput, PointWithoutAUniqueProjection) {
  // Faces' points of degree 4 lie at (1 +- sqrt(0.6))/2 and 1/2 of their sides; the axis goes through one of
  // them.
  refusesDeck("{type: cylinder, center: [4, 0, -1.25], axis: [0, 1, 0], radius: 1}",
              "{type: cylinder, center: [3.5, 0.5, 0], axis: [0, 0, 1], radius: 9, side: inside}",
              {"contact/lower", "(3.5, 0.5, 0) has no unique projection on tool 'roll'",
               "lies on the axis of the cylinder"});
}

TEST_F(BadInput, LoadOnTheSupport) {
  refusesDeck("set: x_max, total", "set: x_min, total", {"loads", "without effect"});
}
TEST_F(BadInput, OnlyAConstantLoad) {
  refusesDeck("total: [0, 0, -10]", "total: [0, 0, -10], constant: true",
              {"nothing depends on the load factor"});
}

TEST_F(BadInput, MissingMesh) {
  refusesDeck("file: box.exo", "file: bax.exo", {"mesh/file", "bax.exo", "does not exist"});
}

TEST_F(BadInput, MeshCutShort) {
  const std::string& whole = mesh_;
  // Within the magic number, the header and the data.
  for (std::size_t size : {std::size_t{3}, std::size_t{200}, whole.size() / 2, whole.size() - 40}) {
    SCOPED_TRACE(size);
    writeFile(folder_ / "box.exo", whole.substr(0, size));
    refuses({"run", "deck.yaml"}, {"deck.yaml:3:9: mesh/file", "box.exo"});
  }
}

TEST_F(BadInput, EmptyMeshFile) {
  writeFile(folder_ / "box.exo", "");
  refuses({"run", "deck.yaml"}, {"deck.yaml:3:9: mesh/file", "box.exo"});
}

TEST_F(BadInput, MeshOfRandomBytes) {
  std::mt19937 random(11);
  for (const std::string& magic : {std::string(), std::string("CDF\x02"), std::string("\x89HDF\r\n\x1a\n")}) {
    SCOPED_TRACE(magic);
    std::string bytes(20000, ' ');
    std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<char>(random() & 0xff); });
    writeFile(folder_ / "box.exo", magic + bytes);
    refuses({"run", "deck.yaml"}, {"deck.yaml:3:9: mesh/file", "box.exo"});
  }
}

TEST_F(BadInput, OutputThatCannotBeWritten) {
  writeFile(folder_ / "file", "a file, not a folder");
  refuses({"run", "-q", "deck.yaml", "-o", "file"}, {"folder file", "cannot be made"});
  refuses({"run", "-q", "deck.yaml", "-o", "file/below"}, {"folder file/below", "cannot be made"});
  // Nobody, not even root, makes files in /proc.
  refuses({"run", "-q", "deck.yaml", "-o", "/proc"}, {"folder /proc", "cannot be written to"});
  std::filesystem::create_directories(folder_ / "taken" / "results.exo");
  refuses({"run", "-q", "deck.yaml", "-o", "taken"}, {"taken/results.exo", "is a folder"});
  refuses({"mesh", "deck.yaml", "-o", "file/box.exo"}, {"file/box.exo"});
  refuses({"mesh", "deck.yaml", "-o", "deck_results"}, {"deck_results"});
}

TEST_F(BadInput, MeshThatTheDeckDoesNotDescribe) {
  writeFile(folder_ / "deck.yaml",
            edited(kSmallDeck,
                   "  generate: {shape: box, lengths: [4, 1, 1], divisions: [4, 1, 1], cell: HEX8}\n", ""));
  refuses({"mesh", "deck.yaml"}, {"mesh/generate", "missing"});
}

TEST_F(BadInput, MeshThatWouldReplaceTheDeck) {
  std::filesystem::create_directory(folder_ / "sub");
  std::filesystem::create_symlink("../deck.yaml", folder_ / "sub" / "link.exo");
  std::filesystem::create_hard_link(folder_ / "deck.yaml", folder_ / "hard.exo");
  for (const char* file : {"deck.yaml", "sub/../deck.yaml", "sub/link.exo", "hard.exo"}) {
    refuses({"mesh", "deck.yaml", "-o", file}, {"deck.yaml: --output", file, "the deck itself"});
    // In place: the hard link stays one.
    std::ofstream(folder_ / "deck.yaml") << edited(kSmallDeck, "box.exo", file);
    refuses({"mesh", "deck.yaml"}, {"deck.yaml:3:9: mesh/file", "the deck itself"});
    const std::string named = std::filesystem::absolute(folder_ / "deck.yaml").string();
    refuses({"mesh", "-q", named}, {"mesh/file", "the deck itself"});
  }
}

TEST_F(BadInput, CheckRefusesAsRunDoes) {
  for (const char* edit : {"radius: -1", "radius: 1.5"}) {  // found in the deck alone, and with the mesh
    writeFile(folder_ / "deck.yaml", edited(kSmallDeck, "radius: 1", edit));
    refuses({"check", "deck.yaml"}, {"roll"});
  }
}

TEST_F(BadInput, CommandLine) {
  refuses({}, {"atrapos --help"});
  refuses({"walk", "deck.yaml"}, {"atrapos --help"});
  refuses({"run"}, {"DECK", "atrapos --help"});
  refuses({"run", "deck.yaml", "--loud"}, {"--loud"});
  refuses({"run", "deck.yaml", "-o"}, {"--output"});
  refuses({"run", "deck.yaml", "--threads", "0"}, {"--threads", "1 to"});
  refuses({"run", "deck.yaml", "--threads", "two"}, {"--threads", "two"});
}

TEST_F(BadInput, BodyOfShellsWithoutShells) {
  refusesDeck("  points_per_step: 2", "  points_per_step: 2\n  shells: body",
              {"output/shells: the mesh has no shells"});
}

}  // namespace
}  // namespace atrapos::test
