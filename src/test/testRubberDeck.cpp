// What `check` says of materials: Saint Venant-Kirchhoff in large compression, pressures where cells have
// none.
#include <gtest/gtest.h>

#include <string>

#include "support/Command.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

constexpr const char* kBlock = R"(mesh:
  file: block.exo
  generate: {shape: rectangle, lengths: [2, 1], divisions: [2, 1], cell: QUAD4}
plane: {kind: strain}
materials:
  block: {law: saint_venant_kirchhoff, youngs_modulus: 100, poissons_ratio: 0.3, blocks: [body]}
supports:
  left: {set: x_min, x: 0}
  below: {set: y_min, y: 0}
  right: {set: x_max, x: {per_load_factor: -1}}
loads:
  gas: {type: surface, set: y_max, pressure: 5}
path:
  stop: {load_factor: 0.15}
)";

CommandResult check(const std::string& deck) {
  TemporaryFolder folder;
  writeFile(folder / "block.yaml", deck);
  EXPECT_EQ(runAtrapos({"mesh", "-q", "block.yaml"}, folder.path()).exitCode, 0);
  return runAtrapos({"check", "block.yaml"}, folder.path());
}

std::string warningsOf(const std::string& deck) {
  const CommandResult r = check(deck);
  EXPECT_EQ(r.exitCode, 0) << r.err;
  std::string lines;
  for (std::size_t at = 0; (at = r.out.find("# warning", at)) != std::string::npos; ++at)
    lines += r.out.substr(at, r.out.find('\n', at) - at + 1);
  return lines;
}

const std::string advice =
    "where saint_venant_kirchhoff is more than a quarter too soft, and collapses at 42 %; neo_hookean does "
    "not\n";

}  // namespace

// 0.15 of 2 is 7.5 %, and 0.15 times 5 less than a tenth of 100.
TEST(Check, SmallCompressionIsNoWarning) { EXPECT_EQ(warningsOf(kBlock), ""); }

TEST(Check, LargeCompressionBetweenSupports) {
  const std::string far = edited(kBlock, "load_factor: 0.15", "load_factor: [0.4, -0.4]");
  EXPECT_EQ(
      warningsOf(far),
      "# warning   supports/right: comes nearer to supports/left by 20 % at load factor 0.4, " + advice);
  EXPECT_EQ(warningsOf(edited(far, "law: saint_venant_kirchhoff", "law: neo_hookean")), "");
  EXPECT_EQ(warningsOf(edited(far, "per_load_factor: -1", "per_load_factor: 0.2")), "");
}

TEST(Check, LargePressures) {
  EXPECT_EQ(warningsOf(edited(kBlock, "pressure: 5", "pressure: 100")),
            "# warning   loads/gas: a pressure of 15 is 15 % of Young's modulus, " + advice);
  EXPECT_EQ(warningsOf(edited(kBlock, "pressure: 5", "pressure: 11, constant: true")),
            "# warning   loads/gas: a pressure of 11 is 11 % of Young's modulus, " + advice);
  EXPECT_EQ(warningsOf(edited(kBlock, "pressure: 5", "pressure: -100")), "");
}

// Cells of degree 1 have no pressures beside their displacements.
TEST(Check, MixedCellsAreOfDegreeTwo) {
  const std::string mixed =
      edited(kBlock, "saint_venant_kirchhoff, youngs_modulus: 100, poissons_ratio: 0.3, blocks: [body]}",
             "neo_hookean, youngs_modulus: 100, poissons_ratio: 0.4999, blocks: [body], formulation: mixed}");
  EXPECT_EQ(check(edited(mixed, "QUAD4", "QUAD9")).exitCode, 0);
  const CommandResult r = check(mixed);
  EXPECT_EQ(r.exitCode, 2);
  ASSERT_EQ(r.errorLines().size(), 1u) << r.err;
  EXPECT_NE(
      r.err.find("materials/block/formulation: block 'body' has QUAD4; pressures stand beside displacements "
                 "of degree 2, in QUAD8, QUAD9, TRI6, HEX20, HEX27, TET10 and WEDGE15"),
      std::string::npos)
      << r.err;
}

}  // namespace atrapos::test
