// What check says of scenes that model more than they need.
#include <gtest/gtest.h>

#include <string>

#include "support/Command.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

/// A box under tension: its lengths and divisions, and supports beside x = 0 at its x_min.
std::string box(const std::string& generate, const std::string& supports, const std::string& path = "") {
  return "mesh:\n  file: m.exo\n  generate: {" + generate +
         "}\nmaterials:\n  m: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3, "
         "blocks: "
         "[body]}\nsupports:\n  left: {set: x_min, x: 0}\n" +
         supports +
         "loads:\n  right: {type: surface, set: x_max, total: [1, 0, 0]}\npath:\n  stop: {load_factor: 1}\n" +
         path;
}

class Waste : public ::testing::Test {
 protected:
  /// The lines of check that begin with "# waste".
  std::string of(const std::string& deck) {
    writeFile(folder_ / "m.yaml", deck);
    EXPECT_EQ(runAtrapos({"mesh", "-q", "m.yaml"}, folder_.path()).exitCode, 0);
    const CommandResult check = runAtrapos({"check", "m.yaml"}, folder_.path());
    EXPECT_EQ(check.exitCode, 0) << check.err;
    std::string lines;
    for (std::size_t at = check.out.find("# waste"); at != std::string::npos;
         at = check.out.find("# waste", at + 1))
      lines += check.out.substr(at, check.out.find('\n', at) + 1 - at);
    return lines;
  }
  TemporaryFolder folder_;
};

const std::string kHeld =
    "  front: {set: y_min, y: 0}\n  back: {set: y_max, y: 0}\n  below: {set: z_min, z: 0}\n";
const std::string kFree = "  front: {set: y_min, y: 0}\n  below: {set: z_min, z: 0}\n";

TEST_F(Waste, NothingMovesAcross) {
  const std::string lines =
      of(box("shape: box, lengths: [4, 1, 2], divisions: [4, 1, 2], cell: HEX20, block: body", kHeld));
  EXPECT_EQ(lines,
            "# waste     nothing moves along y: a plane body (plane: {kind: strain}) has a third of the "
            "unknowns and "
            "the same answer\n");
  EXPECT_EQ(of(box("shape: box, lengths: [4, 1, 2], divisions: [4, 1, 2], cell: HEX20, block: body", kFree)),
            "");
  EXPECT_EQ(of(box("shape: box, lengths: [4, 1, 2], divisions: [4, 2, 2], cell: HEX20, block: body", kHeld)),
            "");
  EXPECT_EQ(of(box("shape: box, lengths: [4, 1, 2], divisions: [4, 1, 2], cell: HEX20, block: body",
                   "  front: {set: y_min, y: 0}\n  back: {set: y_max, y: {per_load_factor: 0.01}}\n"
                   "  below: {set: z_min, z: 0}\n")),
            "");
}

TEST_F(Waste, ThinBodiesOfSolids) {
  const std::string thin =
      of(box("shape: box, lengths: [40, 30, 1], divisions: [4, 3, 1], cell: HEX20, block: body", kFree));
  EXPECT_EQ(
      thin.find("# waste     block 'body': HEX20 in a body 1 thick and 30 wide; shells (docs/shells.md)"), 0u)
      << thin;
  EXPECT_EQ(
      of(box("shape: box, lengths: [40, 19, 1], divisions: [4, 2, 1], cell: HEX20, block: body", kFree)), "");
}

TEST_F(Waste, OrdersThatCostMoreThanTheyBring) {
  const std::string mesh = "shape: box, lengths: [4, 1, 2], divisions: [4, 1, 2], cell: HEX20, block: body";
  EXPECT_NE(of(box(mesh, kFree, "  order: 5\n")).find("path/order: 5 takes two to ten times"),
            std::string::npos);
  EXPECT_NE(of(box(mesh, kFree, "  order: 50\n")).find("path/order: 50 costs more than 30"),
            std::string::npos);
  EXPECT_EQ(of(box(mesh, kFree, "  order: 10\n")), "");
}

}  // namespace
}  // namespace atrapos::test
