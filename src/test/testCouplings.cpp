// Runs of decks with couplings.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/fem/StructuredMesh.hpp"
#include "atrapos/fem/StructuredPlane.hpp"
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

/// The second mesh of two whose nodes and block come behind those of the first, which keeps its sets.
void append(const fem::Mesh& other, fem::Mesh& mesh) {
  const int shift = mesh.numNodes();
  mesh.coordinates.insert(mesh.coordinates.end(), other.coordinates.begin(), other.coordinates.end());
  mesh.blocks.push_back(other.blocks[0]);
  mesh.blocks[1].id = 2;
  for (int& n : mesh.blocks[1].nodes) n += shift;
}

class CouplingsTest : public testing::Test {
 protected:
  CommandResult run(const std::string& text) {
    writeFile(folder_ / "deck.yaml", text);
    const CommandResult made = runAtrapos({"mesh", "-q", "deck.yaml"}, folder_.path());
    EXPECT_EQ(made.exitCode, 0) << made.err;
    return runAtrapos({"run", "-q", "-o", "out", "deck.yaml"}, folder_.path());
  }
  /// The last row of path.csv of a deck whose mesh is there, on so many ranks.
  std::map<std::string, double> endOf(const std::string& text, int ranks = 1) {
    writeFile(folder_ / "deck.yaml", text);
    const std::vector<std::string> arguments{"run", "-q", "-o", "out", "deck.yaml"};
    const CommandResult r = ranks > 1 ? runAtraposOnRanks(ranks, arguments, folder_.path())
                                      : runAtrapos(arguments, folder_.path());
    EXPECT_EQ(r.exitCode, 0) << r.err;
    return lastRow(readFile(folder_ / "out" / "path.csv"));
  }
  /// The same with the mesh that the deck describes.
  std::map<std::string, double> endOfGenerated(const std::string& text, int ranks = 1) {
    writeFile(folder_ / "deck.yaml", text);
    const CommandResult made = runAtrapos({"mesh", "-q", "deck.yaml"}, folder_.path());
    EXPECT_EQ(made.exitCode, 0) << made.err;
    return endOf(text, ranks);
  }
  /// A deck whose mesh is there ends with exit code 2 and these words.
  void expectRefused(const std::string& text, const std::string& words) {
    writeFile(folder_ / "deck.yaml", text);
    const CommandResult r = runAtrapos({"run", "-q", "-o", "out", "deck.yaml"}, folder_.path());
    EXPECT_EQ(r.exitCode, 2);
    EXPECT_NE(r.err.find(words), std::string::npos) << r.err;
  }
  TemporaryFolder folder_;
};

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
  append(plate, mesh);
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
    expectRefused(edited(deck, "reference: pin", with), words);
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
  const auto closed = endOfGenerated(loaded);
  EXPECT_NEAR(closed.at("angle"), 360, 4e-3 * 360);
  EXPECT_NEAR(closed.at("ux"), -10, 4e-3 * 10);
  EXPECT_NEAR(closed.at("uz"), 0, 4e-3 * 10);

  const std::string load = "loads:\n  tip: {type: moment, coupling: end, moment: 62.8318530718}\n";
  const std::string driven =
      edited(edited(edited(loaded, load, ""), "[0, -2, 0]}", "[0, -2, 0], angle: {per_load_factor: 360}}"),
             "    angle:", "    moment: {type: moment, coupling: end}\n    angle:");
  for (const int ranks : {1, 2}) {
    const auto turned = endOf(driven, ranks);
    EXPECT_NEAR(turned.at("angle"), 360, 1e-9);
    EXPECT_NEAR(turned.at("moment"), 62.8318530718, 4e-3 * 62.8);
    EXPECT_NEAR(turned.at("ux"), -10, 4e-3 * 10);
  }
  // A stop at an angle.
  EXPECT_NEAR(endOf(edited(loaded, "{load_factor: 1}", "{monitor: {angle: 90}}")).at("angle"), 90, 1e-6);
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
  const int elements = mesh.numElements();
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
  append(other, mesh);
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
           {"to: below}", "to: above}", "couplings/glue: node 112 is on both surfaces"}}) {
    expectRefused(edited(kStack, from, to), words);
  }
}

// Thirty degrees of a thick tube between a plane x = 0 and an inclined one, under pressure p: Lame's
// displacements, and each plane bears p a L. The ends hold y on both.
TEST_F(CouplingsTest, InclinedPlaneOfSymmetry) {
  const std::string wedge = R"(mesh:
  file: wedge.exo
  generate: {shape: cylinder_panel, mid_radius: 2, thickness: 2, theta: [0, 30], length: 0.5, divisions: [3, 1, 6], cell: HEX20, block: b}
materials:
  steel: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3, blocks: [b]}
supports:
  straight: {set: theta_min, x: 0}
  inclined: {set: theta_max, condition: symmetry, normal: [1.7320508075688772, 0, -1]}
  ends: {set: y_min, y: 0}
  others: {set: y_max, y: 0}
loads:
  p: {type: surface, set: inner, pressure: 1.0e-4}
path:
  stop: {load_factor: 1}
output:
  points_per_step: 1
  monitors:
    straight: {type: reaction, support: straight, component: x}
    inclined: {type: reaction, support: inclined}
    inner: {type: displacement, set: theta_min, component: z, near: [0, 0, 1]}
)";
  const double k = 1e-4 / (3 * 3 - 1), lame = 1.3 / 1000 * k * (0.4 + 9);
  for (const int ranks : {1, 2}) {
    const auto end = endOfGenerated(wedge, ranks);
    EXPECT_NEAR(end.at("straight"), -0.5e-4, 1e-6 * 0.5e-4);  // strains of 1e-7
    EXPECT_NEAR(end.at("inclined"), 0.5e-4, 1e-6 * 0.5e-4);
    EXPECT_NEAR(end.at("inner"), lame, 1e-3 * lame);
  }
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& words) {
    expectRefused(edited(wedge, from, to), words);
  };
  refused("normal: [1.7320508075688772, 0, -1]", "x: 0", "supports/inclined/normal: is missing");
  refused("normal: [1.7320508075688772, 0, -1]", "normal: [0, 0, 0]",
          "supports/inclined/normal: must not be the zero vector");
  refused("condition: symmetry, normal: [1.7320508075688772, 0, -1]", "normal: [1, 0, -1], x: 0",
          "supports/inclined/normal: stands beside what else is held");
  refused("normal: [1.7320508075688772, 0, -1]", "normal: [1, 0, -1], value: 1",
          "supports/inclined/value: stands beside condition: symmetry");
  refused("{type: reaction, support: inclined}", "{type: reaction, support: inclined, component: x}",
          "output/monitors/inclined/component: support 'inclined' holds along its normal alone");
  refused("others: {set: y_max, y: 0}",
          "others: {set: y_max, y: 0}\n  more: {set: y_max, normal: [0, 2, 0], value: 1}",
          "supports: displacement x of node");
}

// A block on a slide of 45 degrees, pulled along it, moves along it and nowhere else: what is held along two
// directions at a node, one of them driven, and the directions' forces.
TEST_F(CouplingsTest, DrivenAlongASlide) {
  const auto end = endOfGenerated(R"(mesh:
  file: block.exo
  generate: {shape: box, lengths: [2, 1, 1], divisions: [2, 1, 1], cell: HEX27, block: b}
materials:
  steel: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0, blocks: [b]}
supports:
  fixed: {set: x_min, x: 0, y: 0, z: 0}
  pull: {set: x_max, normal: [1, 1, 0], value: {per_load_factor: 1.0e-6}}
  across: {set: x_max, normal: [1, -2, 0]}
  level: {set: x_max, z: 0}
path:
  stop: {load_factor: 1}
output:
  monitors:
    ux: {type: displacement, set: x_max, component: x}
    uy: {type: displacement, set: x_max, component: y}
    pull: {type: reaction, support: pull}
    across: {type: reaction, support: across}
    fx: {type: reaction, support: fixed, component: x}
    fy: {type: reaction, support: fixed, component: y}
)");
  // (ux + uy)/sqrt(2) = 1e-6 and ux = 2 uy.
  EXPECT_NEAR(end.at("ux"), 2e-6 * std::sqrt(2.0) / 3, 1e-12);
  EXPECT_NEAR(end.at("uy"), 1e-6 * std::sqrt(2.0) / 3, 1e-12);
  // Both directions' forces together are those of the other end with their sign turned.
  EXPECT_NEAR(end.at("pull") / std::sqrt(2.0) + end.at("across") / std::sqrt(5.0), -end.at("fx"), 1e-10);
  EXPECT_NEAR(end.at("pull") / std::sqrt(2.0) - 2 * end.at("across") / std::sqrt(5.0), -end.at("fy"), 1e-10);
  EXPECT_GT(std::abs(end.at("fx")), 1e-4);
}

// A right-angle frame of thin strips, hinged about the normal of its plane at both ends, that slide along the
// line between them, under end moments buckles sideways (Argyris and others; Simo and Vu-Quoc, 1986): with
// legs of length L that are narrow at M = pi sqrt(EI GJ)/L, less what the bending in the plane before gives.
// The corner is as wide as the legs, an error of the order of b/L that two widths extrapolate away. Half of
// it, up to its inclined plane of symmetry.
TEST_F(CouplingsTest, RightAngleFrameUnderEndMoments) {
  const double L = 240, t = 0.6, E = 71240, nu = 0.31;
  const auto criticalOf = [&](double b) {
    fem::QuadrilateralOptions leg;
    leg.corners = {0, -b / 2, L - b / 2, -b / 2, L + b / 2, b / 2, 0, b / 2};
    leg.divisions = {48, 2};
    fem::Mesh mesh = fem::quadrilateralMesh(leg);
    mesh.dimension = 3;
    mesh.blocks[0].topology = fem::Topology::Shell8;
    mesh.sideSets.clear();
    for (int n = 0; n < mesh.numNodes(); ++n)
      if (std::hypot(mesh.coordinates[3 * n], mesh.coordinates[3 * n + 1]) < 1e-9)
        mesh.nodeSets.push_back({"hinge", 100, {n}});
    exodus::writeMesh(mesh, (folder_ / "leg.exo").string());
    endOf(R"(mesh:
  file: leg.exo
materials:
  aluminium: {law: saint_venant_kirchhoff, youngs_modulus: 71240, poissons_ratio: 0.31, blocks: [body]}
shells:
  sections:
    strip: {blocks: [body], thickness: 0.6}
supports:
  slide: {set: hinge, normal: [1, 1, 0]}
  plane: {set: hinge, z: 0}
  symmetry: {set: x_max, condition: symmetry, normal: [1, -1, 0]}
couplings:
  end: {kind: rigid, set: x_min, reference: hinge, axis: [0, 0, 1]}
loads:
  moment: {type: moment, coupling: end, moment: 1000}
path:
  stop: {load_factor: 1, bifurcation: 1}
output:
  monitors:
    angle: {type: rotation, coupling: end}
)");
    const double critical = 1000 * lastRow(readFile(folder_ / "out" / "points.csv")).at("load_factor");
    const double G = E / 2 / (1 + nu), EI = E * b * t * t * t / 12,
                 GJ = G * b * t * t * t / 3 * (1 - 0.63 * t / b), inPlane = E * t * b * b * b / 12;
    const double narrow = M_PI * std::sqrt(EI * GJ / ((1 - EI / inPlane) * (1 - GJ / inPlane))) / L;
    return critical / narrow;
  };
  const double wide = criticalOf(15), narrow = criticalOf(7.5);
  EXPECT_NEAR(wide, 1.03, 0.01);
  EXPECT_NEAR(2 * narrow - wide, 1, 0.01);
}

// A lever: the end's upper edge moves twice as far as its lower one, node by node; what pulls at the upper
// one pulls twice as hard at the lower one.
TEST_F(CouplingsTest, Equations) {
  const std::string lever = R"(mesh:
  file: block.exo
  generate: {shape: box, lengths: [2, 1, 1], divisions: [2, 2, 2], cell: HEX8, block: b}
materials:
  steel: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3, blocks: [b]}
supports:
  fixed: {set: x_min, x: 0, y: 0, z: 0}
couplings:
  lever: {kind: equation, terms: [[x_max_z_max, x, 1], [x_max_z_min, x, -2]]}
loads:
  pull: {type: nodal, set: x_max_z_max, total: [1.0e-3, 0, 0]}
path:
  stop: {load_factor: 1}
output:
  monitors:
    upper: {type: displacement, set: x_max_z_max, component: x, near: [2, 1, 1]}
    lower: {type: displacement, set: x_max_z_min, component: x, near: [2, 1, 0]}
    held: {type: reaction, support: fixed, component: x}
)";
  const auto pulled = endOfGenerated(lever);
  EXPECT_GT(pulled.at("lower"), 1e-7);
  EXPECT_NEAR(pulled.at("upper"), 2 * pulled.at("lower"), 1e-15);
  const auto other = endOf(
      edited(lever, "set: x_max_z_max, total: [1.0e-3, 0, 0]", "set: x_max_z_min, total: [2.0e-3, 0, 0]"));
  for (const char* name : {"upper", "lower", "held"}) EXPECT_NEAR(other.at(name), pulled.at(name), 1e-12);
  expectRefused(
      edited(lever, "[x_max_z_min, x, -2]", "[y_max, x, -2]"),
      "couplings/lever/terms: 'x_max_z_max' has 3 nodes and 'y_max' has 9; expected as many, or one");
}

}  // namespace atrapos::test
