// Runs of decks with couplings.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/fem/StructuredMesh.hpp"
#include "atrapos/fem/StructuredShell.hpp"
#include "support/Command.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

// A strip of shells, length 10, width 1, thickness 0.1, E = 1.2e6: EI = 100. Its end carries 0.4 upwards.
const char* const kStrip = R"(mesh:
  file: strip.exo
  generate: {shape: shell_plate, length: 10, width: 1, divisions: [8, 1], block: strip}
materials:
  rubber: {law: saint_venant_kirchhoff, youngs_modulus: 1200000, poissons_ratio: 0, blocks: [strip]}
shells:
  sections:
    skin: {blocks: [strip], thickness: 0.1}
supports:
  clamp: {set: x_min, condition: clamped}
couplings:
  end: {kind: rigid, set: x_max}
loads:
  tip: {type: nodal, set: x_max, total: [0, 0, 0.4]}
path:
  stop: {load_factor: 1}
output:
  points_per_step: 1
  monitors:
    uz: {type: displacement, set: x_max, component: z}
    ux: {type: displacement, set: x_max, component: x}
    clamp_z: {type: reaction, support: clamp, component: z}
)";

class CouplingsTest : public testing::Test {
 protected:
  CommandResult run(const std::string& text) {
    writeFile(folder_ / "deck.yaml", text);
    const CommandResult made = runAtrapos({"mesh", "-q", "deck.yaml"}, folder_.path());
    EXPECT_EQ(made.exitCode, 0) << made.err;
    return runAtrapos({"run", "-q", "-o", "out", "deck.yaml"}, folder_.path());
  }
  TemporaryFolder folder_;
};

/// Columns of the last line of a CSV file, by the names of its first.
std::map<std::string, double> lastRow(const std::string& csv) {
  std::istringstream in(csv);
  std::string header, line, last;
  std::getline(in, header);
  while (std::getline(in, line))
    if (!line.empty()) last = line;
  std::istringstream names(header), values(last);
  std::map<std::string, double> row;
  for (std::string name, value; std::getline(names, name, ',') && std::getline(values, value, ',');)
    row[name] = std::strtod(value.c_str(), nullptr);
  return row;
}

}  // namespace

// The end is rigid, the load is its load, and the clamp bears it. The elastica at P L^2/EI = 0.4 (elliptic
// integrals): w/L = 0.130975242, u/L = 0.010353922.
TEST_F(CouplingsTest, RigidEndOfAStrip) {
  const CommandResult r = run(kStrip);
  ASSERT_EQ(r.exitCode, 0) << r.err;
  const auto end = lastRow(readFile(folder_ / "out" / "path.csv"));
  EXPECT_NEAR(end.at("load_factor"), 1, 1e-9);
  EXPECT_NEAR(end.at("uz"), 1.30975242, 1e-3 * 1.31);
  EXPECT_NEAR(end.at("ux"), -0.10353922, 5e-3 * 0.104);
  EXPECT_NEAR(end.at("clamp_z"), -0.4, 1e-5);  // the path's residual bound is 1e-6
}

// A strip of which the first half is a solid: the same elastica; a hinge at the joint would be a mechanism.
TEST_F(CouplingsTest, ShellOnSolid) {
  fem::BoxOptions solid;
  solid.lengths = {5, 1, 0.1};
  solid.origin = {0, 0, -0.05};
  solid.divisions = {20, 1, 1};
  solid.topology = fem::Topology::Hex27;
  fem::ShellPlateOptions shell;
  shell.length = 5;
  shell.origin = {5, 0, 0};
  shell.divisions = {4, 1};
  shell.blockName = "strip";
  fem::Mesh mesh = fem::boxMesh(solid);
  const fem::Mesh plate = fem::shellPlateMesh(shell);
  const int shift = mesh.numNodes();
  const auto nodesOf = [&](const fem::Mesh& m, const char* name, int offset) {
    std::vector<int> nodes = m.nodeSets.at(fem::findNodeSet(m, name)).nodes;
    for (int& n : nodes) n += offset;
    return nodes;
  };
  const std::vector<fem::NodeSet> sets{{"root", 1, nodesOf(mesh, "x_min", 0)},
                                       {"joint", 2, nodesOf(plate, "x_min", shift)},
                                       {"end", 3, nodesOf(plate, "x_max", shift)}};
  mesh.sideSets.clear();
  mesh.nodeSets = sets;
  mesh.coordinates.insert(mesh.coordinates.end(), plate.coordinates.begin(), plate.coordinates.end());
  mesh.blocks.push_back(plate.blocks[0]);
  mesh.blocks[1].id = 2;
  for (int& n : mesh.blocks[1].nodes) n += shift;
  exodus::writeMesh(mesh, (folder_ / "mixed.exo").string());
  writeFile(folder_ / "deck.yaml", R"(mesh:
  file: mixed.exo
materials:
  rubber: {law: saint_venant_kirchhoff, youngs_modulus: 1200000, poissons_ratio: 0, blocks: [body, strip]}
shells:
  sections:
    skin: {blocks: [strip], thickness: 0.1}
supports:
  clamp: {set: root, x: 0, y: 0, z: 0}
couplings:
  joint: {kind: shell_on_solid, set: joint}
  end: {kind: rigid, set: end}
loads:
  tip: {type: nodal, set: end, total: [0, 0, 0.4]}
path:
  stop: {load_factor: 1}
output:
  points_per_step: 1
  monitors:
    uz: {type: displacement, set: end, component: z}
    ux: {type: displacement, set: end, component: x}
    clamp_z: {type: reaction, support: clamp, component: z}
)");
  const CommandResult r = runAtrapos({"run", "-q", "-o", "out", "deck.yaml"}, folder_.path());
  ASSERT_EQ(r.exitCode, 0) << r.err;
  const auto end = lastRow(readFile(folder_ / "out" / "path.csv"));
  EXPECT_NEAR(end.at("uz"), 1.30975242, 2e-3 * 1.31);  // twenty solids over half the length
  EXPECT_NEAR(end.at("ux"), -0.10353922, 5e-3 * 0.104);
  EXPECT_NEAR(end.at("clamp_z"), -0.4, 1e-5);
}

// A reference node that no cell has, 2 ahead of the rigid end: loaded, driven, and held while the end carries
// the load. A force P there deflects it by P (L^3/3 + a L^2 + a^2 L)/EI with a = 2, and the end by P (L^3/3 +
// a L^2/2)/EI.
TEST_F(CouplingsTest, ReferenceNodeOfARigidEnd) {
  fem::ShellPlateOptions options;
  options.length = 10;
  options.divisions = {8, 1};
  options.blockName = "strip";
  fem::Mesh mesh = fem::shellPlateMesh(options);
  mesh.coordinates.insert(mesh.coordinates.end(), {12, 0.5, 0});
  mesh.nodeSets.push_back({"pin", 100, {mesh.numNodes() - 1}});
  exodus::writeMesh(mesh, (folder_ / "strip.exo").string());
  std::string deck = kStrip;
  deck.erase(deck.find("  generate:"), deck.find("materials:") - deck.find("  generate:"));
  deck = edited(deck, "set: x_max}\nloads", "set: x_max, reference: pin}\nloads");
  const auto endOf = [&](const std::string& text) {
    writeFile(folder_ / "deck.yaml", text);
    const CommandResult r = runAtrapos({"run", "-q", "-o", "out", "deck.yaml"}, folder_.path());
    EXPECT_EQ(r.exitCode, 0) << r.err;
    return lastRow(readFile(folder_ / "out" / "path.csv"));
  };
  const double EI = 100, P = 0.4e-3, atPin = (1000 / 3. + 200 + 40) / EI, atEnd = (1000 / 3. + 100) / EI;
  // Loads of a thousandth of the strip's test above: linear to 1e-6. The strip's shear is 1e-4 of its
  // bending.
  const std::string loaded =
      edited(edited(deck, "set: x_max, total: [0, 0, 0.4]", "set: pin, total: [0, 0, 0.4e-3]"),
             "  ux: {type: displacement, set: x_max", "  ux: {type: displacement, set: pin");
  const auto bent = endOf(edited(loaded, "component: x}\n    clamp", "component: z}\n    clamp"));
  EXPECT_NEAR(bent.at("uz"), P * atEnd, 5e-4 * P * atEnd);
  EXPECT_NEAR(bent.at("ux"), P * atPin, 5e-4 * P * atPin);  // z of the pin
  EXPECT_NEAR(bent.at("clamp_z"), -P, 1e-5 * P);

  const std::string driven =
      edited(edited(deck, "loads:\n  tip: {type: nodal, set: x_max, total: [0, 0, 0.4]}\n", ""),
             "supports:\n", "supports:\n  pin: {set: pin, z: {per_load_factor: 1.0e-3}}\n");
  const auto pushed = endOf(edited(driven, "support: clamp", "support: pin"));
  EXPECT_NEAR(pushed.at("clamp_z"), 1e-3 / atPin, 5e-4 * 1e-3 / atPin);  // reaction of the pin

  // The end's load P deflects the pin by P atEnd; the pin's reaction takes that back.
  const auto held = endOf(
      edited(edited(edited(deck, "0.4]", "0.4e-3]"), "supports:\n", "supports:\n  pin: {set: pin, z: 0}\n"),
             "support: clamp", "support: pin"));
  EXPECT_NEAR(held.at("clamp_z"), -P * atEnd / atPin, 5e-4 * P);

  for (const auto& [with, words] : std::vector<std::pair<std::string, std::string>>{
           {"reference: x_max", "couplings/end/reference: 'x_max' has 3 nodes; expected a set of one node"},
           {"reference: nail", "couplings/end/reference: the mesh has no node set or side set 'nail'"}}) {
    writeFile(folder_ / "deck.yaml", edited(deck, "reference: pin", with));
    const CommandResult r = runAtrapos({"run", "-q", "-o", "out", "deck.yaml"}, folder_.path());
    EXPECT_EQ(r.exitCode, 2);
    EXPECT_NE(r.err.find(words), std::string::npos) << r.err;
  }
}

// Supports on what a coupling moves are refused with the coupling's name.
TEST_F(CouplingsTest, SupportedSlavesAreRefused) {
  const CommandResult r = run(edited(kStrip, "supports:\n", "supports:\n  tip: {set: x_max, y: 0}\n"));
  EXPECT_EQ(r.exitCode, 2);
  EXPECT_NE(r.err.find("couplings/end: displacement y of node"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("is both supported and coupled"), std::string::npos) << r.err;
}

TEST_F(CouplingsTest, AShellWithoutASolidIsNamed) {
  const CommandResult r = run(edited(kStrip, "kind: rigid", "kind: shell_on_solid"));
  EXPECT_EQ(r.exitCode, 2);
  EXPECT_NE(r.err.find("couplings/end/set: no node of a solid at the top of the shell's node"),
            std::string::npos)
      << r.err;
}

// A moment at the end bends the strip into an arc of circle of curvature M/EI: 2 pi EI/L = 62.83 closes it;
// the angle that is driven by 360 degrees needs it. (h kappa)^2 = 0.4 % is what strains of 3 % make of that.
TEST_F(CouplingsTest, MomentAndAngleOfARigidEnd) {
  const std::string loaded =
      edited(edited(edited(kStrip, "set: x_max}\nloads", "set: x_max, axis: [0, -2, 0]}\nloads"),
                    "{type: nodal, set: x_max, total: [0, 0, 0.4]}",
                    "{type: moment, coupling: end, moment: 62.8318530718}"),
             "    clamp_z: {type: reaction, support: clamp, component: z}",
             "    angle: {type: rotation, coupling: end}");
  const CommandResult bent = run(loaded);
  ASSERT_EQ(bent.exitCode, 0) << bent.err;
  const auto closed = lastRow(readFile(folder_ / "out" / "path.csv"));
  EXPECT_NEAR(closed.at("angle"), 360, 4e-3 * 360);
  EXPECT_NEAR(closed.at("ux"), -10, 4e-3 * 10);
  EXPECT_NEAR(closed.at("uz"), 0, 4e-3 * 10);

  const std::string load = "loads:\n  tip: {type: moment, coupling: end, moment: 62.8318530718}\n";
  const std::string driven =
      edited(edited(edited(loaded, load, ""), "[0, -2, 0]}", "[0, -2, 0], angle: {per_load_factor: 360}}"),
             "    angle:", "    moment: {type: moment, coupling: end}\n    angle:");
  for (const int ranks : {1, 2}) {
    writeFile(folder_ / "deck.yaml", driven);
    const CommandResult r = runAtraposOnRanks(ranks, {"run", "-q", "-o", "out", "deck.yaml"}, folder_.path());
    ASSERT_EQ(r.exitCode, 0) << r.err;
    const auto turned = lastRow(readFile(folder_ / "out" / "path.csv"));
    EXPECT_NEAR(turned.at("angle"), 360, 1e-9);
    EXPECT_NEAR(turned.at("moment"), 62.8318530718, 4e-3 * 62.8);
    EXPECT_NEAR(turned.at("ux"), -10, 4e-3 * 10);
  }
  // It ends where the angle does, and has half of the angle in a stage before the other.
  writeFile(folder_ / "deck.yaml", edited(loaded, "{load_factor: 1}", "{monitor: {angle: 90}}"));
  ASSERT_EQ(runAtrapos({"run", "-q", "-o", "out", "deck.yaml"}, folder_.path()).exitCode, 0);
  EXPECT_NEAR(lastRow(readFile(folder_ / "out" / "path.csv")).at("angle"), 90, 1e-6);
}

namespace {

/// A bar of two boxes along z whose cells do not fit, side sets "below" and "above" where they meet.
fem::Mesh stack() {
  fem::BoxOptions lower, upper;
  lower.lengths = upper.lengths = {1, 1, 2};
  upper.origin = {0, 0, 2};
  lower.divisions = {2, 2, 3};
  upper.divisions = {3, 3, 4};
  lower.topology = upper.topology = fem::Topology::Hex20;
  lower.blockName = "lower";
  upper.blockName = "upper";
  fem::Mesh mesh = fem::boxMesh(lower);
  const fem::Mesh other = fem::boxMesh(upper);
  const int nodes = mesh.numNodes(), elements = mesh.numElements();
  const auto setOf = [](const fem::Mesh& m, const char* name) {
    return m.sideSets.at(fem::findSideSet(m, name));
  };
  std::vector<fem::SideSet> sets{setOf(mesh, "z_min"), setOf(mesh, "z_max"), setOf(other, "z_min"),
                                 setOf(other, "z_max")};
  const char* const names[] = {"bottom", "below", "above", "top"};
  for (std::size_t s = 0; s < sets.size(); ++s) {
    sets[s].name = names[s];
    sets[s].id = static_cast<long long>(s) + 1;
    for (fem::Side& side : sets[s].sides) side.element += s > 1 ? elements : 0;
  }
  mesh.nodeSets.clear();
  mesh.sideSets = sets;
  mesh.coordinates.insert(mesh.coordinates.end(), other.coordinates.begin(), other.coordinates.end());
  mesh.blocks.push_back(other.blocks[0]);
  mesh.blocks[1].id = 2;
  for (int& n : mesh.blocks[1].nodes) n += nodes;
  return mesh;
}

const char* const kStack = R"(mesh:
  file: stack.exo
materials:
  steel: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3, blocks: [lower, upper], expansion: "0.01*T"}
physics:
  heat: {type: balance, field: T, conductivity: "2", blocks: [lower, upper]}
supports:
  bottom: {set: bottom, x: 0, y: 0, z: 0}
  cold: {set: bottom, field: T, value: 0}
  hot: {set: top, field: T, value: {per_load_factor: 8}}
couplings:
  glue: {kind: tie, set: above, to: below}
path:
  stop: {load_factor: 1}
output:
  points_per_step: 1
  monitors:
    flow: {type: reaction, support: hot}
    seam: {type: field, field: T, set: above}
    under: {type: field, field: T, set: below}
    top: {type: displacement, set: top, component: z}
    lean: {type: displacement, set: top, component: x}
)";

}  // namespace

// Heat goes through a tie as displacements do: 8 degrees over a length of 4 and an area of 1 with a
// conductivity of 2 are a flow of 4, and a bar of one expansion that depends on z alone stays straight but
// for its ends.
TEST_F(CouplingsTest, TiedBodiesConductAndExpand) {
  exodus::writeMesh(stack(), (folder_ / "stack.exo").string());
  writeFile(folder_ / "deck.yaml", kStack);
  std::map<std::string, double> alone;
  for (const int ranks : {1, 2}) {
    const CommandResult r = runAtraposOnRanks(ranks, {"run", "-o", "out", "deck.yaml"}, folder_.path());
    ASSERT_EQ(r.exitCode, 0) << r.err;
    EXPECT_NE(r.out.find("tie       glue: 40 nodes follow, largest gap 0"), std::string::npos) << r.out;
    const auto end = lastRow(readFile(folder_ / "out" / "path.csv"));
    EXPECT_NEAR(end.at("flow"), 4, 1e-9);
    EXPECT_NEAR(end.at("seam"), 4, 1e-9);
    EXPECT_NEAR(end.at("under"), 4, 1e-9);
    if (ranks == 1) alone = end;
    EXPECT_NEAR(end.at("top"), alone.at("top"), 1e-9);
    EXPECT_NEAR(end.at("lean"), alone.at("lean"), 1e-9);
  }
  EXPECT_GT(alone.at("top"),
            0.15);  // 0.01 of 4 degrees in the mean over a length of 4, and more at its held end
}

// A body that nothing but a tie holds is held; without it the deck is refused.
TEST_F(CouplingsTest, TiesHoldAndAreNamed) {
  exodus::writeMesh(stack(), (folder_ / "stack.exo").string());
  for (const auto& [from, to, words] : std::vector<std::array<std::string, 3>>{
           {"couplings:\n  glue: {kind: tie, set: above, to: below}\n", "",
            "supports: the body with block 'upper' can still move freely"},
           {"to: below}", "to: roof}", "couplings/glue/to: the mesh has no side set 'roof'"},
           {"to: below}", "to: bottom}",
            "couplings/glue: no node of the surface that follows has the other one opposite, within 0.1"},
           {"to: below}", "to: above}", "couplings/glue: node 1 is on both surfaces"}}) {
    writeFile(folder_ / "deck.yaml", edited(kStack, from, to));
    const CommandResult r = runAtrapos({"run", "-q", "-o", "out", "deck.yaml"}, folder_.path());
    EXPECT_EQ(r.exitCode, 2);
    EXPECT_NE(r.err.find(words.substr(0, words.find("node 1 is"))), std::string::npos) << r.err;
  }
}

}  // namespace atrapos::test
