// Small decks with shells against statics: pressures that follow or do not, on a surface or another, moments
// that follow or do not, shells beside solids.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "atrapos/fem/StructuredMesh.hpp"
#include "atrapos/fem/StructuredShell.hpp"
#include "import/UsedNodes.hpp"
#include "support/Command.hpp"
#include "support/Folder.hpp"
#include "support/Table.hpp"

namespace atrapos::test {
namespace {

/// A deck run in a folder of its own, on a mesh that is given or that it generates.
struct DeckRun {
  TemporaryFolder folder;

  explicit DeckRun(const std::string& deck, const fem::Mesh* mesh = nullptr) {
    writeFile(folder / "deck.yaml", deck);
    if (mesh != nullptr)
      exodus::writeMesh(*mesh, (folder / "mesh.exo").string());
    else
      execute({"mesh", "-q", "deck.yaml"});
    execute({"run", "-q", "deck.yaml", "-o", "results"});
  }
  void execute(const std::vector<std::string>& arguments) const {
    const CommandResult r = runAtrapos(arguments, folder.path());
    if (r.exitCode != 0) throw std::runtime_error(r.err);
  }
  double last(const std::string& monitor) const {
    return Table(folder.path() / "results" / "path.csv").column(monitor).back();
  }
  exodus::ResultReader results() const {
    return exodus::ResultReader((folder.path() / "results" / "results.exo").string());
  }
};

/// A quarter of a tube of radius 1 and thickness 0.1, held in its length, under a pressure of 20 on its inner
/// surface: hoop strains of a sixth.
const std::string kTube = R"(mesh:
  file: tube.exo
  generate: {shape: shell_cylinder, radius: 1, theta: [0, 90], length: 0.2, divisions: [8, 1], block: tube}
materials:
  tube: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0, blocks: [tube]}
shells:
  sections:
    tube: {blocks: [tube], thickness: 0.1}
supports:
  top: {set: theta_min, condition: symmetry_x}
  side: {set: theta_max, condition: symmetry_z}
  front: {set: y_min, condition: symmetry_y}
  back: {set: y_max, condition: symmetry_y}
loads:
  inside: {type: surface, set: inner, pressure: 20, follower: true, at: bottom}
path:
  stop: {load_factor: 1}
output:
  monitors:
    crown_uz: {type: displacement, set: theta_min, component: z}
)";

struct Ring {
  double radius = 0, halfThickness = 0, hoop = 0;
  explicit Ring(const std::string& deck) {
    const DeckRun run(deck);
    const auto results = run.results();
    const int step = results.numSteps() - 1;
    radius = 1 + run.last("crown_uz");
    // The crown's director stands along z, up to the error of the normal of a parabola for an arc, 2e-4; node
    // 1 is at theta = 0.
    halfThickness = results.nodal(step, "director_z").at(0);
    hoop = results.element(step, "n_11").at(0);  // where x is the hoop's direction
    EXPECT_NEAR(results.nodal(step, "director_x").at(0), 0, 5e-4 * 0.05);
    EXPECT_NEAR(results.nodal(step, "thickness_change").at(0), 2 * halfThickness - 0.1, 1e-6);
  }
};

// The hoop force is the pressure times the inner radius: as deformed where the pressure follows, as
// undeformed where it is dead. Measured 2e-4, of the resultants' extrapolation through a thickness of a tenth
// of the radius.
TEST(ShellRuns, TubeUnderPressure) {
  const Ring follower(kTube);
  EXPECT_GT(follower.radius, 1.15);
  EXPECT_NEAR(follower.hoop, 20 * (follower.radius - follower.halfThickness), 2e-3 * follower.hoop);
  const Ring dead(edited(kTube, ", follower: true", ""));
  EXPECT_NEAR(dead.hoop, 20 * 0.95, 2e-3 * dead.hoop);
  const Ring outside(edited(edited(kTube, ", follower: true", ""), "at: bottom", "at: top"));
  EXPECT_NEAR(outside.hoop, 20 * 1.05, 2e-3 * outside.hoop);
}

// Four nodes: 32 chords of an arc of 90 degrees, whose sagitta is 3e-4 of the radius. At the plane of
// symmetry the director stands in it all the same.
TEST(ShellRuns, TubeOfFourNodesUnderPressure) {
  const Ring ring(edited(kTube, "divisions: [8, 1]", "divisions: [32, 1], cell: SHELL4"));
  const Ring fine(edited(kTube, "divisions: [8, 1]", "divisions: [32, 1]"));
  EXPECT_NEAR(ring.radius, fine.radius, 5e-4);
  EXPECT_NEAR(ring.hoop, 20 * (ring.radius - ring.halfThickness), 2e-3 * ring.hoop);
}

/// The tube of kTube, so many cells around and two along it.
fem::Mesh tubeMesh(int around, fem::Topology cell) {
  fem::ShellCylinderOptions options;
  options.radius = 1;
  options.thetaMax = 90;
  options.length = 0.2;
  options.divisions = {around, 2};
  options.topology = cell;
  options.blockName = "tube";
  return fem::shellCylinderMesh(options);
}

/// The tube of 32 x 2 SHELL4, every second one cut into two SHELL3 of a block `fill`, with the sides of both.
fem::Mesh mixedTube() {
  fem::Mesh mesh = tubeMesh(32, fem::Topology::Shell4);
  const std::vector<int> cells = mesh.blocks[0].nodes;
  const int count = static_cast<int>(cells.size()) / 4;
  fem::Block fill;
  fill.name = "fill";
  fill.id = 2;
  fill.topology = fem::Topology::Shell3;
  mesh.blocks[0].nodes.clear();
  std::vector<int> number(count);
  for (int e = 0; e < count; ++e) {
    const int* quad = &cells[4 * static_cast<std::size_t>(e)];
    number[e] = e % 2 == 0 ? e / 2 : (count + 1) / 2 + e - 1;
    if (e % 2 == 0)
      mesh.blocks[0].nodes.insert(mesh.blocks[0].nodes.end(), quad, quad + 4);
    else
      fill.nodes.insert(fill.nodes.end(), {quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]});
  }
  mesh.blocks.push_back(fill);
  constexpr int triangle[4] = {0, 0, 1, 1}, edge[4] = {2, 3, 3, 4};
  for (fem::SideSet& set : mesh.sideSets) {
    std::vector<fem::Side> sides;
    for (const fem::Side& side : set.sides) {
      const int first = number[side.element];
      if (side.element % 2 == 0) {
        sides.push_back({first, side.side});
      } else if (side.side < 2) {
        sides.push_back({first, side.side});
        sides.push_back({first + 1, side.side});
      } else {
        sides.push_back({first + triangle[side.side - 2], edge[side.side - 2]});
      }
    }
    set.sides = sides;
  }
  return mesh;
}

/// The tube of 16 x 2 SHELL8, every second one without its middle nodes in a block `fill`.
fem::Mesh tubeOfEightAndFour() {
  fem::Mesh mesh = tubeMesh(16, fem::Topology::Shell8);
  const std::vector<int> cells = mesh.blocks[0].nodes;
  const int count = static_cast<int>(cells.size()) / 8;
  fem::Block fill;
  fill.name = "fill";
  fill.id = 2;
  fill.topology = fem::Topology::Shell4;
  mesh.blocks[0].nodes.clear();
  std::vector<int> number(count);
  const auto isWhole = [](int e) { return (e / 2 + e) % 2 == 0; };  // checkered: cells count along y first
  for (const bool whole : {true, false})
    for (int e = 0, next = whole ? 0 : count / 2; e < count; ++e) {
      if (isWhole(e) != whole) continue;
      number[e] = next++;
      auto& nodes = whole ? mesh.blocks[0].nodes : fill.nodes;
      nodes.insert(nodes.end(), &cells[8 * static_cast<std::size_t>(e)],
                   &cells[8 * static_cast<std::size_t>(e)] + (whole ? 8 : 4));
    }
  mesh.blocks.push_back(fill);
  for (fem::SideSet& set : mesh.sideSets)
    for (fem::Side& side : set.sides) side.element = number[side.element];
  importer::dropUnusedNodes(mesh);  // in the middle of outer edges
  return mesh;
}

/// kTube on such a mesh of blocks `tube` and `fill`.
std::string deckOfTwoBlocks() {
  const std::string before = kTube.substr(0, kTube.find("  generate")),
                    after = kTube.substr(kTube.find("materials"));
  std::string deck = edited(before + after, "file: tube.exo", "file: mesh.exo");
  for (const char* blocks : {"poissons_ratio: 0, blocks: [tube]", "{blocks: [tube], thickness"}) {
    std::string more = blocks;
    more.insert(more.find("tube]") + 4, ", fill");
    deck = edited(deck, blocks, more);
  }
  return deck;
}

// Eight nodes beside four, checkered: every edge inside is straight for one and has a middle node for the
// other. The circle is met with the error of 16 chords of an arc of 90 degrees, whose sagitta is 1.2e-3 of
// the radius.
TEST(ShellRuns, TubeOfEightAndFourNodesUnderPressure) {
  const Ring fine(edited(kTube, "divisions: [8, 1]", "divisions: [32, 1]"));
  const fem::Mesh mesh = tubeOfEightAndFour();
  const DeckRun mixed(deckOfTwoBlocks(), &mesh);
  EXPECT_NEAR(1 + mixed.last("crown_uz"), fine.radius, 2e-3);
  const CommandResult check = runAtrapos({"check", "deck.yaml"}, mixed.folder.path());
  EXPECT_NE(check.out.find("edges     46 are shared by shells with and without middle nodes"),
            std::string::npos)
      << check.out;
  EXPECT_EQ(check.out.find("are in the middle of an edge"), std::string::npos) << check.out;
}

// Six nodes: the tube of SHELL8, on as many squares.
TEST(ShellRuns, TubeOfSixNodesUnderPressure) {
  const std::string deck = edited(kTube, "divisions: [8, 1]", "divisions: [8, 1], cell: SHELL6");
  const Ring ring(deck), eight(kTube);
  EXPECT_NEAR(ring.radius, eight.radius, 1e-4);
  EXPECT_NEAR(ring.hoop, 20 * (ring.radius - ring.halfThickness), 2e-3 * ring.hoop);
}

// Three nodes, and three beside four: the same tube. The circle is met with the chords' error, and hoop
// strains of a sixth are the same in all triangles of a ring.
TEST(ShellRuns, TubeOfThreeNodesUnderPressure) {
  const Ring ring(edited(kTube, "divisions: [8, 1]", "divisions: [32, 1], cell: SHELL3"));
  const Ring fine(edited(kTube, "divisions: [8, 1]", "divisions: [32, 1]"));
  EXPECT_NEAR(ring.radius, fine.radius, 5e-4);
  EXPECT_NEAR(ring.hoop, 20 * (ring.radius - ring.halfThickness), 2e-3 * ring.hoop);
  const fem::Mesh mesh = mixedTube();
  const DeckRun mixed(deckOfTwoBlocks(), &mesh);
  EXPECT_NEAR(1 + mixed.last("crown_uz"), fine.radius, 5e-4);
}

// A side that pushes from the top pushes the other way.
TEST(ShellRuns, PressureOnTheOtherSide) {
  const std::string small = edited(kTube, "pressure: 20", "pressure: 0.01");
  const Ring inner(small), outer(edited(edited(small, "set: inner", "set: outer"), "at: bottom", "at: top"));
  EXPECT_NEAR(inner.radius - 1, 0.01 * 0.95 / 100, 0.01 * 1e-4);  // p R_i/(E t), thin
  EXPECT_NEAR(outer.radius - 1, -0.01 * 1.05 / 100, 0.01 * 1e-4);
}

/// A quarter of a roof on rigid diaphragms, under its weight.
const std::string kRoof = R"(mesh:
  file: roof.exo
  generate: {shape: shell_cylinder, radius: 25, theta: [0, 40], length: 25, divisions: [4, 4], block: roof}
materials:
  roof: {law: saint_venant_kirchhoff, youngs_modulus: 4.32e8, poissons_ratio: 0, blocks: [roof]}
shells:
  sections:
    roof: {blocks: [roof], thickness: 0.25}
supports:
  crown: {set: theta_min, condition: symmetry_x}
  middle: {set: y_min, condition: symmetry_y}
  diaphragm: {set: y_max, x: 0, z: 0, director_x: 0, director_z: 0}
loads:
  weight: {type: volume, blocks: [roof], force: [0, 0, -360]}
path:
  stop: {load_factor: 1}
output:
  monitors:
    edge_uz: {type: displacement, set: theta_max_y_min, component: z}
)";

// Conditions of symmetry make a quarter of a body the whole. Its directors there are means of the normals of
// one side only, off by 2e-4; that costs 1e-7 of the deflection.
TEST(ShellRuns, AQuarterIsTheWhole) {
  std::string whole = edited(kRoof, "theta: [0, 40], length: 25, divisions: [4, 4]",
                             "theta: [-40, 40], y_min: -25, length: 50, divisions: [8, 8]");
  whole = edited(
      whole,
      "  crown: {set: theta_min, condition: symmetry_x}\n  middle: {set: y_min, condition: symmetry_y}\n",
      "  along: {set: theta_mid_y_mid, y: 0}\n"
      "  other: {set: y_min, x: 0, z: 0, director_x: 0, director_z: 0}\n");
  whole = edited(whole, "set: theta_max_y_min", "set: theta_max_y_mid");
  const double quarter = DeckRun(kRoof).last("edge_uz"), full = DeckRun(whole).last("edge_uz");
  EXPECT_LT(quarter, -0.2);
  // The residual's bound is 1e-6.
  EXPECT_NEAR(quarter, full, 1e-5 * std::abs(full));
}

const std::string kStrip = R"(mesh:
  file: strip.exo
  generate: {shape: shell_plate, length: 12, width: 1, divisions: [12, 1], block: strip}
materials:
  strip: {law: saint_venant_kirchhoff, youngs_modulus: 1.2e6, poissons_ratio: 0, blocks: [strip]}
shells:
  sections:
    strip: {blocks: [strip], thickness: 0.1}
supports:
  clamp: {set: x_min, condition: clamped}
loads:
  turn: {type: edge, set: x_max, follower_moment: -20}
path:
  stop: {load_factor: 1}
output:
  monitors:
    tip_ux: {type: displacement, set: x_max, component: x}
    tip_uz: {type: displacement, set: x_max, component: z}
)";

// In a plane a moment that keeps its direction and one that follows the edge are the same.
TEST(ShellRuns, DeadAndFollowingMomentInAPlane) {
  const DeckRun follower(kStrip), dead(edited(kStrip, "follower_moment: -20", "moment: [0, -20, 0]"));
  EXPECT_GT(follower.last("tip_uz"), 5);
  // Both are corrected to a residual of 1e-6 of the elements' forces.
  EXPECT_NEAR(dead.last("tip_uz"), follower.last("tip_uz"), 1e-4);
  EXPECT_NEAR(dead.last("tip_ux"), follower.last("tip_ux"), 1e-4);
}

// A force that follows stays normal to the strip: its reaction at the clamp, turned by the end's slope, is
// its size; a dead one keeps its direction. Forces along the director of a turned end pull back.
TEST(ShellRuns, ForceAlongTheDirector) {
  const std::string deck = edited(edited(kStrip, "follower_moment: -20", "follower_force: [0, 0, 2]"),
                                  "output:\n", "output:\n  fields: [displacement, reaction]\n");
  const DeckRun run(deck);
  const auto results = run.results();
  const int step = results.numSteps() - 1;
  double x = 0, z = 0, dx = 0, dz = 0;
  const auto rx = results.nodal(step, "reaction_x"), rz = results.nodal(step, "reaction_z");
  for (double r : rx) x += r;
  for (double r : rz) z += r;
  const fem::Mesh mesh = exodus::readMesh((run.folder.path() / "strip.exo").string());
  const auto& end = mesh.nodeSets.at(fem::findNodeSet(mesh, "x_max")).nodes;
  for (int n : end) {
    dx += results.nodal(step, "director_x").at(n);
    dz += results.nodal(step, "director_z").at(n);
  }
  EXPECT_LT(dx, -0.5 * std::hypot(dx, dz));  // the end has turned by more than 30 degrees
  EXPECT_NEAR(std::hypot(x, z), 2, 1e-4);
  EXPECT_NEAR(x, -2 * dx / std::hypot(dx, dz), 1e-3);
  EXPECT_NEAR(z, -2 * dz / std::hypot(dx, dz), 1e-3);
}

// An end that is moved, or turned by its director, in proportion to the load factor, without any load: 3 E I
// /L^3 of force for the one, half the length times the turn for the other. E I = 100.
TEST(ShellRuns, DrivenEnds) {
  const auto deck = [](const std::string& support) {
    return edited(edited(kStrip, "loads:\n  turn: {type: edge, set: x_max, follower_moment: -20}\n", ""),
                  "path:\n", "  end: {set: x_max, " + support + "}\npath:\n");
  };
  const DeckRun moved(deck("z: {value: 0, per_load_factor: 0.012}") +
                      "    force: {type: reaction, support: end, component: z}\n");
  EXPECT_NEAR(moved.last("tip_uz"), 0.012, 1e-12);  // prescribed
  const double force = 3 * 100 * 0.012 / (12 * 12 * 12);
  EXPECT_NEAR(moved.last("force"), force, 1e-3 * force);  // shear, second-order terms: below 1e-4
  const double turn = 0.01;
  const DeckRun turned(deck("director_x: {value: 0, per_load_factor: -0.0005}"));  // of half the thickness
  EXPECT_NEAR(turned.last("tip_uz"), turn * 12 / 2, 1e-3 * turn * 12 / 2);
}

// A block that is pressed at one end while its faces are free to spread: homogeneous, and the reaction is the
// pressure times the end's area as deformed.
TEST(ShellRuns, PressureThatFollowsASolid) {
  const std::string deck = R"(mesh:
  file: box.exo
  generate: {shape: box, lengths: [2, 1, 1], divisions: [2, 1, 1], cell: HEX20}
materials:
  rubber: {law: saint_venant_kirchhoff, youngs_modulus: 10, poissons_ratio: 0.3, blocks: [body]}
supports:
  left: {set: x_min, x: 0}
  front: {set: y_min, y: 0}
  below: {set: z_min, z: 0}
loads:
  push: {type: surface, set: x_max, pressure: 1.5, follower: true}
path:
  stop: {load_factor: 1}
output:
  monitors:
    y: {type: displacement, set: y_max, component: y}
    z: {type: displacement, set: z_max, component: z}
    force: {type: reaction, support: left, component: x}
)";
  const DeckRun run(deck);
  const double area = (1 + run.last("y")) * (1 + run.last("z"));
  EXPECT_GT(area, 1.05);
  EXPECT_NEAR(run.last("force"), 1.5 * area,
              1e-5);  // the residual's bound is 1e-6 of some forces of size one
}

// A strip pressed down on a floor: contact of its bottom is that of its middle with a floor half a thickness
// higher, as long as it turns little.
TEST(ShellRuns, ContactOfTheBottom) {
  const auto deck = [](const std::string& place, const std::string& floor, const std::string& points) {
    std::string text = edited(kStrip, "turn: {type: edge, set: x_max, follower_moment: -20}",
                              "press: {type: edge, set: x_max, total: [0, 0, -1]}");
    text = edited(text, "path:\n",
                  "tools:\n  floor: {type: plane, point: [0, 0, " + floor +
                      "], normal: [0, 0, 1]}\ncontact:\n  below: {tool: floor, set: bottom, " + points +
                      ", at: " + place + ", stiffness: 1000, regularisation: 1.0e-3}\npath:\n");
    return text +
           "    force: {type: contact_force, contact: below}\n"
           "    force_z: {type: contact_force, contact: below, component: z}\n";
  };
  struct Case {
    std::string points, shear, cell;
  };
  for (const Case& c : {Case{"points: nodes", "compatible", "SHELL8"},
                        {"points: quadrature", "compatible", "SHELL8"},
                        {"points: quadrature", "assumed", "SHELL8"},
                        {"points: nodes", "assumed", "SHELL3"},
                        {"points: quadrature", "assumed", "SHELL3"},
                        {"points: nodes", "assumed", "SHELL6"},
                        {"points: quadrature", "assumed", "SHELL6"}}) {
    SCOPED_TRACE(c.points + ", " + c.shear + ", " + c.cell);
    const auto run = [&](const char* place, const char* floor) {
      return DeckRun(
          edited(edited(deck(place, floor, c.points), "shells:\n", "shells:\n  shear: " + c.shear + "\n"),
                 "block: strip}", "block: strip, cell: " + c.cell + "}"));
    };
    const DeckRun bottom = run("bottom", "-0.25"), middle = run("middle", "-0.2");
    EXPECT_GT(bottom.last("force"), 0.5);  // of the load of 1
    EXPECT_LT(bottom.last("force"), 1.2);
    // Turned by 0.03 at most: the bottom is 5e-4 of 0.05 higher.
    EXPECT_NEAR(bottom.last("force"), middle.last("force"), 1e-3);
    EXPECT_NEAR(bottom.last("force_z"), bottom.last("force"), 1e-6);
    EXPECT_NEAR(bottom.last("tip_uz"), middle.last("tip_uz"), 1e-3);
  }
}

// One strip of two blocks, 0.1 thick and 0.05 thick, each with the strains that its section names: where it
// curls across (nu = 0.3) the elements differ a little, each block on its own.
TEST(ShellRuns, SectionsChooseTheirShear) {
  fem::ShellPlateOptions options;
  options.length = 12;
  options.divisions = {12, 1};
  options.blockName = "strip";
  fem::Mesh mesh = fem::shellPlateMesh(options);
  fem::Block& first = mesh.blocks[0];
  fem::Block second = first;
  second.name = "thin";
  second.id = 2;
  first.nodes.resize(6 * 8);
  second.nodes.erase(second.nodes.begin(), second.nodes.begin() + 6 * 8);
  mesh.blocks.push_back(second);
  const auto deck = [&](const std::string& thick, const std::string& thin) {
    std::string text = edited(kStrip, "file: strip.exo\n", "file: mesh.exo\n");
    text = edited(text, "blocks: [strip]}\nshells", "blocks: [strip, thin]}\nshells");
    text = edited(text, "thickness: 0.1}\n",
                  "thickness: 0.1" + thick + "}\n    thin: {blocks: [thin], thickness: 0.05" + thin + "}\n");
    text = edited(text, "poissons_ratio: 0,", "poissons_ratio: 0.3,");
    return edited(edited(text, "follower_moment: -20", "follower_moment: -4"), "output:\n",
                  "output:\n  fields: [displacement, stress, nodal_stress, reaction]\n");
  };
  const std::string assumed = ", shear: assumed";
  const DeckRun plain(deck("", ""), &mesh);
  const double uz = plain.last("tip_uz");
  EXPECT_GT(uz, 4);
  std::vector<double> others{uz};
  for (const auto& [thick, thin] :
       {std::make_pair(assumed, std::string()), std::make_pair(std::string(), assumed),
        std::make_pair(assumed, assumed)}) {
    SCOPED_TRACE(thick + " and " + thin);
    const DeckRun run(deck(thick, thin), &mesh);
    EXPECT_NEAR(run.last("tip_uz"), uz, 0.01 * uz);
    for (double other : others) EXPECT_GT(std::abs(run.last("tip_uz") - other), 1e-8 * uz);  // not rounding
    others.push_back(run.last("tip_uz"));
    // A moment is the same all along, up to what the meeting of the halves disturbs.
    const auto results = run.results();
    const int step = results.numSteps() - 1;
    const auto m = results.element(step, "m_11");
    for (int e : {2, 9}) EXPECT_NEAR(m.at(e), -4, 0.01 * 4) << e;
  }
}

/// Two meshes side by side in one.
fem::Mesh together(fem::Mesh a, const fem::Mesh& b) {
  const int nodes = a.numNodes(), elements = a.numElements();
  a.coordinates.insert(a.coordinates.end(), b.coordinates.begin(), b.coordinates.end());
  for (fem::Block block : b.blocks) {
    block.id += 10;
    for (int& n : block.nodes) n += nodes;
    a.blocks.push_back(block);
  }
  for (fem::NodeSet set : b.nodeSets) {
    set.id += 100;
    set.name = "b_" + set.name;
    for (int& n : set.nodes) n += nodes;
    a.nodeSets.push_back(set);
  }
  for (fem::SideSet set : b.sideSets) {
    set.id += 100;
    set.name = "b_" + set.name;
    for (fem::Side& side : set.sides) side.element += elements;
    a.sideSets.push_back(set);
  }
  return a;
}

const std::string kBoth = R"(mesh: {file: mesh.exo}
materials:
  steel: {law: saint_venant_kirchhoff, youngs_modulus: 1.0e4, poissons_ratio: 0.3, blocks: [solid, shell]}
shells:
  sections:
    shell: {blocks: [shell], thickness: 0.5}
supports:
  solid: {set: x_min, x: 0, y: 0, z: 0}
  shell: {set: b_x_min, condition: clamped}
loads:
  weight: {type: volume, blocks: [solid, shell], force: [0, 0, -0.2]}
path:
  stop: {load_factor: 1}
output:
  fields: [displacement, stress, nodal_stress, reaction]
  monitors:
    solid_uz: {type: displacement, set: x_max, component: z}
    shell_uz: {type: displacement, set: b_x_max, component: z}
    solid_fz: {type: reaction, support: solid, component: z}
    shell_fz: {type: reaction, support: shell, component: z}
)";

// The same strip twice, as solids and as shells, in one mesh and under its weight.
TEST(ShellRuns, ShellsBesideSolids) {
  fem::StripOptions solid;
  solid.length = 10;
  solid.width = 1;
  solid.thickness = 0.5;
  solid.divisions = {20, 2, 1};
  solid.blockName = "solid";
  fem::ShellPlateOptions shell;
  shell.length = 10;
  shell.origin = {0, 5, 0};
  shell.divisions = {10, 1};
  shell.blockName = "shell";
  const fem::Mesh mesh = together(fem::stripMesh(solid), fem::shellPlateMesh(shell));
  for (const auto& [shells, shear] :
       {std::make_pair("surface", "compatible"), std::make_pair("body", "assumed")}) {
    SCOPED_TRACE(shells);
    const std::string deck = edited(kBoth, "shells:\n", std::string("shells:\n  shear: ") + shear + "\n");
    const DeckRun run(edited(deck, "output:\n", std::string("output:\n  shells: ") + shells + "\n"), &mesh);
    EXPECT_NEAR(run.last("solid_fz"), 1, 1e-4);
    EXPECT_NEAR(run.last("shell_fz"), 1, 1e-4);
    // Deflections of a tenth of the length; a clamped solid end is held a little differently.
    EXPECT_GT(std::abs(run.last("solid_uz")), 1);
    EXPECT_NEAR(run.last("shell_uz"), run.last("solid_uz"), 0.02 * std::abs(run.last("solid_uz")));
    const auto results = run.results();
    const auto stress = results.element(results.numSteps() - 1, "stress_top_xx");
    ASSERT_EQ(stress.size(), 40u + 10u);
    EXPECT_GT(stress.at(40), 0);  // the shell's first element: tension on top
    const auto nodal = results.nodalNames();
    const bool top = std::find(nodal.begin(), nodal.end(), "nodal_stress_top_xx") != nodal.end();
    EXPECT_EQ(top, std::string(shells) == "surface");
  }
}

const std::string kBox = R"(mesh: {file: mesh.exo}
materials:
  steel: {law: saint_venant_kirchhoff, youngs_modulus: 210000, poissons_ratio: 0, blocks: [1]}
shells:
  sections:
    w: {blocks: [1], thickness: 1}
supports:
  foot: {set: foot, condition: hinged}
  head: {set: head, x: 0, y: 0, z: {per_load_factor: -1}}
path:
  stop: {load_factor: 0.18}
output:
  monitors:
    force: {type: reaction, support: head, component: z}
)";

// Four equal walls buckle nearly at once: 15 eigenvalues change sign in the first step, and each is owed to a
// point that is found.
TEST(ShellRuns, EveryBucklingLoadOfASquareBoxIsFound) {
  const fem::Mesh mesh = exodus::readMesh(ATRAPOS_ACCEPT_DATA "/box_column.exo");
  const DeckRun run(kBox, &mesh);
  const auto summary = nlohmann::json::parse(readFile(run.folder.path() / "results" / "summary.json"));
  EXPECT_EQ(summary.at("unexplained_sign_changes"), 0);
  EXPECT_EQ(summary.at("branches_complete"), true);
  int found = 0;
  std::vector<double> loads;
  for (const auto& point : summary.at("points")) {
    found += point.at("nullity").get<int>();
    loads.push_back(-point.at("monitors").at("force").get<double>());
  }
  EXPECT_EQ(found, run.last("negative_eigenvalues"));
  EXPECT_EQ(found, 15);
  // S8R in CalculiX, which makes corners rigid, the more so the shorter the waves (test/peers/README.md); as
  // folded plates, exactly, the first is 27 025.
  ASSERT_GE(loads.size(), 3u);
  const double calculix[] = {27295, 29692, 32267}, part[] = {1e-3, 2e-3, 1e-2};
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(loads[i], calculix[i], part[i] * calculix[i]);
  EXPECT_NEAR(loads[0], 27025, 0.01 * 27025);
}

}  // namespace
}  // namespace atrapos::test
