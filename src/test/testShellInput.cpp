// Shells that cannot be right: one line that names the element, block or load, exit code 2.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/fem/StructuredShell.hpp"
#include "support/Command.hpp"
#include "support/Folder.hpp"
#include "support/Profile.hpp"

namespace atrapos::test {
namespace {

const std::string kDeck = R"(mesh:
  file: roof.exo
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

/// 4 x 2 elements of a cylindrical roof about y; its crown is in the middle.
fem::Mesh roof(fem::Topology cell = fem::Topology::Shell8) {
  fem::ShellCylinderOptions options;
  options.radius = 10;
  options.thetaMin = -40;
  options.thetaMax = 40;
  options.length = 5;
  options.divisions = {4, 2};
  options.topology = cell;
  options.blockName = "roof";
  return fem::shellCylinderMesh(options);
}

CommandResult checked(const fem::Mesh& mesh, const std::string& deck = kDeck) {
  const TemporaryFolder folder;
  writeFile(folder / "deck.yaml", deck);
  exodus::writeMesh(mesh, (folder / "roof.exo").string());
  return runAtrapos({"check", "deck.yaml"}, folder.path());
}

void expectRefused(const CommandResult& r, const std::vector<std::string>& words) {
  EXPECT_EQ(r.exitCode, 2);
  EXPECT_EQ(r.out, "");
  ASSERT_EQ(r.errorLines().size(), 1u) << r.err;
  for (const std::string& word : words)
    EXPECT_NE(r.err.find(word), std::string::npos) << word << " is not in: " << r.err;
}

TEST(ShellInput, RightShellsPass) {
  const CommandResult r = checked(roof());
  EXPECT_EQ(r.exitCode, 0) << r.err;
  // 6 x 5 nodes of corners and edges less 8 centres: 45 - 8 = 37 nodes, each with a director.
  EXPECT_NE(r.out.find("# unknowns  222 ("), std::string::npos) << r.out;
}

TEST(ShellInput, TooThick) {
  expectRefused(checked(roof(), edited(kDeck, "thickness: 0.1", "thickness: 21")),
                {"shells: element 1 (block 'roof'): the Jacobian is -", "too thick for its curvature"});
}

TEST(ShellInput, NoThickness) {
  expectRefused(checked(roof(), edited(kDeck, "thickness: 0.1", "thickness: attribute")),
                {"shells: block 'roof': the shells have no thickness"});
}

// A corner drawn through the opposite edge: the Jacobian changes its sign within the element.
TEST(ShellInput, JacobianOfVaryingSign) {
  fem::Mesh mesh = roof();
  const auto& nodes = mesh.blocks[0].nodes;
  for (int i = 0; i < 3; ++i) {
    double& corner = mesh.coordinates[3 * nodes[0] + i];
    corner += 2.2 * (mesh.coordinates[3 * nodes[2] + i] - corner);
  }
  expectRefused(checked(mesh), {"shells: element 1 (block 'roof'): the Jacobian"});
}

// Two corners at one place.
TEST(ShellInput, CollapsedEdge) {
  fem::Mesh mesh = roof();
  auto& x = mesh.coordinates;
  const auto& nodes = mesh.blocks[0].nodes;
  for (int i = 0; i < 3; ++i) x[3 * nodes[1] + i] = x[3 * nodes[4] + i] = x[3 * nodes[0] + i];
  expectRefused(checked(mesh), {"shells: element 1 (block 'roof'): the Jacobian"});
}

// Normals that do not agree are made to, and the run says so.
TEST(ShellInput, OppositeNormals) {
  fem::Mesh mesh = roof();
  auto& nodes = mesh.blocks[0].nodes;
  // Element 3 from its other side: corners 1 4 3 2 and their edges.
  const std::vector<int> old(nodes.begin() + 16, nodes.begin() + 24);
  const int order[8] = {0, 3, 2, 1, 7, 6, 5, 4};
  for (int n = 0; n < 8; ++n) nodes[16 + n] = old[order[n]];
  const CommandResult r = checked(mesh);
  EXPECT_EQ(r.exitCode, 0) << r.err;
  EXPECT_NE(r.out.find("# normals   1 of the 8 shells around that of element 1 (block 'roof') turned over"),
            std::string::npos)
      << r.out;
  EXPECT_EQ(checked(roof()).out.find("turned over"), std::string::npos);
}

namespace {

/// An angle of two plates along z; the line of its corner is a node set.
fem::Mesh angle(double degrees) {
  const double a = degrees * 3.14159265358979323846 / 180;
  fem::Mesh mesh =
      fem::test::profileMesh({{{-1, 0}, {0, 0}, 2}, {{0, 0}, {std::cos(a), std::sin(a)}, 2}}, 1, 2);
  mesh.nodeSets.push_back({"corner", 3, fem::test::nodesAbove(mesh, {0, 0})});
  return mesh;
}

const std::string kAngle = R"(mesh: {file: roof.exo}
materials:
  steel: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3, blocks: [wall1, wall2]}
shells:
  sections:
    skin: {blocks: [wall1, wall2], thickness: 0.1}
supports:
  foot: {set: foot, condition: clamped}
loads:
  tip: {type: nodal, set: head, total: [0, 0.001, 0]}
path:
  stop: {load_factor: 1}
)";

}  // namespace

TEST(ShellInput, JointsAreTold) {
  const CommandResult rigid = checked(angle(90), kAngle);
  EXPECT_EQ(rigid.exitCode, 0) << rigid.err;
  EXPECT_NE(rigid.out.find("# joints    of shells at 5 nodes: 5 rigid, 0 hinged\n"), std::string::npos)
      << rigid.out;
  const std::string joints = "shells:\n  joints:\n    corner: {set: corner, joint: hinge}\n";
  const CommandResult hinged = checked(angle(90), edited(kAngle, "shells:\n", joints));
  EXPECT_EQ(hinged.exitCode, 0) << hinged.err;
  EXPECT_NE(hinged.out.find("# joints    of shells at 5 nodes: 0 rigid, 5 hinged\n"), std::string::npos)
      << hinged.out;
  // The last of several entries counts.
  const std::string more = joints + "    foot: {set: foot, joint: rigid}\n";
  EXPECT_NE(checked(angle(90), edited(kAngle, "shells:\n", more)).out.find("1 rigid, 4 hinged"),
            std::string::npos);
  // Below the fold angle there is one director and no joint.
  EXPECT_EQ(checked(angle(19), kAngle).out.find("# joints"), std::string::npos);
  expectRefused(
      checked(angle(19), edited(kAngle, "shells:\n", joints)),
      {"shells/joints/corner/set: at no node of 'corner' do shells meet at more than the fold angle of 20 "
       "degrees"});
  expectRefused(checked(angle(179.8), kAngle), {"shells: node ", "folded onto each other"});
}

// A moment about the director turns nothing: shells have no stiffness and no unknown for it.
TEST(ShellInput, DrillingMoment) {
  // At y_max the directors lie in the x-z plane; the crown's is along z.
  expectRefused(checked(roof(), edited(kDeck, "total: [0, 0, -10]", "moment: [0, 0, 1]")),
                {"loads/tip: block 'roof': the moment on edge", "of shell element", "no drilling moments"});
  const CommandResult bending = checked(roof(), edited(kDeck, "total: [0, 0, -10]", "follower_moment: 1"));
  EXPECT_EQ(bending.exitCode, 0) << bending.err;
  EXPECT_NE(bending.out.find("unsymmetric tangent"), std::string::npos) << bending.out;
}

TEST(ShellInput, EdgeLoadOnFaces) {
  expectRefused(checked(roof(), edited(kDeck, "set: y_max, total", "set: outer, total")),
                {"loads/tip/set: side 1 of element 1", "no edge"});
}

TEST(ShellInput, CellsWithOtherNodes) {
  expectRefused(checked(roof(fem::Topology::Shell9)),
                {"mesh/file: block 'roof' has SHELL9; accepted are SHELL8, SHELL6, SHELL4 and SHELL3"});
  EXPECT_EQ(checked(roof(fem::Topology::Shell4)).exitCode, 0);
  expectRefused(checked(roof(fem::Topology::Shell4),
                        edited(kDeck, "thickness: 0.1", "thickness: 0.1, shear: compatible")),
                {"/shear: block 'roof' has SHELL4, whose shear is always assumed"});
  EXPECT_EQ(checked(roof(fem::Topology::Shell3)).exitCode, 0);
  EXPECT_EQ(checked(roof(fem::Topology::Shell6)).exitCode, 0);
  expectRefused(checked(roof(fem::Topology::Shell6),
                        edited(kDeck, "thickness: 0.1", "thickness: 0.1, shear: compatible")),
                {"/shear: block 'roof' has SHELL6, whose shear is always assumed"});
}

// Contact points lie where the deck says: a plane 1 below the middle surface of a plate of thickness 0.2.
TEST(ShellInput, ContactOnSurfaces) {
  fem::ShellPlateOptions options;
  options.length = 3;
  options.divisions = {3, 1};
  options.blockName = "roof";
  const fem::Mesh mesh = fem::shellPlateMesh(options);
  const std::string deck = edited(edited(kDeck, "thickness: 0.1", "thickness: 0.2"), "path:\n", R"(tools:
  floor: {type: plane, point: [0, 0, -1], normal: [0, 0, 1]}
contact:
  below: {tool: floor, set: bottom, at: middle, points: nodes, stiffness: 100, regularisation: 0.01}
path:
)");
  for (const char* points : {"points: nodes", "points: quadrature"})
    for (auto [place, gap] :
         {std::make_pair("top", "1.1"), std::make_pair("middle", "1"), std::make_pair("bottom", "0.9")}) {
      const CommandResult r = checked(
          mesh, edited(edited(deck, "at: middle", std::string("at: ") + place), "points: nodes", points));
      EXPECT_EQ(r.exitCode, 0) << r.err;
      EXPECT_NE(r.out.find(std::string("smallest gap ") + gap + ", "), std::string::npos) << r.out;
    }
}

TEST(ShellInput, DirectorHeldTwice) {
  const std::string deck = edited(kDeck, "loads:\n", "  more: {set: y_min, director_z: 0.01}\nloads:\n");
  expectRefused(checked(roof(), deck), {"supports/more: displacement z of node", "prescribed twice"});
}

}  // namespace
}  // namespace atrapos::test
