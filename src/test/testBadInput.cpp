// Bad input: one line on stderr that names what is wrong, exit code 2, and not a byte changed on disk.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

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
    for (const char* name : {"path.csv", "results.exo", "summary.json", "path.png", "notes.txt"})
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
    refuses({"run", "deck.yaml"}, {"deck.yaml: mesh/file", "box.exo"});
  }
}

TEST_F(BadInput, EmptyMeshFile) {
  writeFile(folder_ / "box.exo", "");
  refuses({"run", "deck.yaml"}, {"deck.yaml: mesh/file", "box.exo"});
}

TEST_F(BadInput, MeshOfRandomBytes) {
  std::mt19937 random(11);
  for (const std::string& magic : {std::string(), std::string("CDF\x02"), std::string("\x89HDF\r\n\x1a\n")}) {
    SCOPED_TRACE(magic);
    std::string bytes(20000, ' ');
    std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<char>(random() & 0xff); });
    writeFile(folder_ / "box.exo", magic + bytes);
    refuses({"run", "deck.yaml"}, {"deck.yaml: mesh/file", "box.exo"});
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
            edited(kSmallDeck, "  generate: {shape: box, lengths: [4, 1, 1], divisions: [4, 1, 1]}\n", ""));
  refuses({"mesh", "deck.yaml"}, {"mesh/generate", "missing"});
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

// What is wrong with shells, after a deck that is right.
TEST_F(BadInput, Shells) {
  const std::string deck = R"(mesh:
  file: roof.exo
  generate: {shape: shell_cylinder, radius: 10, theta: [-40, 40], length: 5, divisions: [4, 2], block: roof}
materials:
  steel: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3, blocks: [roof]}
shells:
  sections:
    skin: {blocks: [roof], thickness: 0.1}
supports:
  clamp: {set: y_min, condition: clamped}
loads:
  tip: {type: edge, set: y_max, total: [0, 0, -10]}
path:
  stop: {load_factor: 1}
)";
  writeFile(folder_ / "deck.yaml", deck);
  const CommandResult made = runAtrapos({"mesh", "-q", "deck.yaml"}, folder_.path());
  ASSERT_EQ(made.exitCode, 0) << made.err;
  const CommandResult good = runAtrapos({"check", "deck.yaml"}, folder_.path());
  EXPECT_EQ(good.exitCode, 0) << good.err;
  const auto refusesShell = [&](const std::string& from, const std::string& to,
                                const std::vector<std::string>& words) {
    writeFile(folder_ / "deck.yaml", edited(deck, from, to));
    refuses({"check", "deck.yaml"}, words);
  };
  refusesShell("thickness: 0.1", "thickness: 21",
               {"shells: element 1 (block 'roof'): the Jacobian is -", "too thick for its curvature"});
  refusesShell("thickness: 0.1", "thickness: attribute",
               {"shells: block 'roof': the shells have no thickness"});
  refusesShell("set: y_max, total", "set: outer, total", {"loads/tip/set: side 1 of element 1", "no edge"});
}

TEST_F(BadInput, PressureThatFollows) {
  refusesDeck("total: [0, 0, -10]", "pressure: 1, follower: true",
              {"loads/tip/follower: pressures that follow cannot be run yet"});
}

}  // namespace
}  // namespace atrapos::test
