// Decks that are right by themselves and not for their mesh, or ask for what is not there together: one line
// each that names the key.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "commands/MeshCommand.hpp"
#include "deck/Deck.hpp"
#include "scene/DeckMesh.hpp"
#include "scene/Scene.hpp"
#include "support/Folder.hpp"
#include "support/HalvedMesh.hpp"

namespace {

using namespace atrapos;
using test::edited, test::halved;

/// The line with which a deck with this mesh is refused.
std::string refusal(const std::string& text, const fem::Mesh* mesh = nullptr) {
  try {
    const deck::Deck deck = deck::readDeckText(text, "deck.yaml");
    Scene(deck, DeckMesh(mesh != nullptr ? *mesh : generateMesh(deck)));
  } catch (const deck::DeckError& error) {
    return error.what();
  } catch (const std::invalid_argument& error) {  // of the problem; the command tells the deck's name
    return error.what();
  }
  return "no error";
}

void expectRefused(const std::string& text, const std::string& words, const fem::Mesh* mesh = nullptr) {
  const std::string error = refusal(text, mesh);
  EXPECT_NE(error.find(words), std::string::npos) << error << "\n  expected: " << words;
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
}

fem::Mesh meshOf(const std::string& text) { return generateMesh(deck::readDeckText(text, "deck.yaml")); }

const std::string bar = R"(mesh:
  file: bar.exo
  generate: {shape: box, lengths: [4, 1, 1], divisions: [4, 1, 1], cell: HEX8, block: bar}
materials:
  steel: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3, blocks: [bar]}
tools:
  floor: {type: plane, point: [0, 0, -1], normal: [0, 0, 1]}
supports:
  clamp: {set: x_min, x: 0, y: 0, z: 0}
loads:
  tip: {type: surface, set: x_max, traction: [0, 0, -1]}
path:
  stop: {load_factor: 1}
)";

const std::string plate = R"(mesh:
  file: plate.exo
  generate: {shape: shell_plate, length: 4, width: 1, divisions: [4, 1], block: plate}
materials:
  steel: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3, blocks: [plate]}
shells:
  sections:
    skin: {blocks: [plate], thickness: 0.1}
supports:
  clamp: {set: x_min, condition: clamped}
loads:
  tip: {type: edge, set: x_max, total: [0, 0, -1]}
path:
  stop: {load_factor: 1}
)";

const std::string heat = R"(mesh:
  file: plate.exo
  generate: {shape: rectangle, lengths: [4, 2], divisions: [4, 2], cell: QUAD8, block: body}
plane: {kind: strain}
materials:
  steel: {law: neo_hookean, youngs_modulus: 1000, poissons_ratio: 0.3, blocks: [body]}
physics:
  heat: {type: balance, field: T, blocks: [body], conductivity: 1, source: lambda}
supports:
  hold: {set: x_min, x: 0, y: 0}
  cold: {set: x_min, field: T, value: 0}
path:
  stop: {load_factor: 1}
)";

const std::string flow = R"(mesh:
  file: channel.exo
  generate: {shape: rectangle, lengths: [4, 1], divisions: [4, 2], cell: QUAD9, block: channel}
plane: {kind: strain}
physics:
  fluid: {type: flow, velocity: [u, v], pressure: p, viscosity: 1, density: 1, blocks: [channel]}
supports:
  inlet: {set: x_min, field: u, value: {per_load_factor: 1}}
path:
  stop: {load_factor: 1}
)";

}  // namespace

TEST(SceneInput, TheDecksThemselvesPass) {
  for (const std::string& text : {bar, plate, heat, flow}) EXPECT_EQ(refusal(text), "no error");
}

TEST(SceneInput, EmptySets) {
  fem::Mesh mesh = meshOf(bar);
  mesh.nodeSets.at(static_cast<std::size_t>(fem::findNodeSet(mesh, "x_min"))).nodes.clear();
  expectRefused(bar, "supports/clamp/set: the node set 'x_min' is empty", &mesh);
}

TEST(SceneInput, ShellsAreNoSolids) {
  expectRefused(
      edited(plate, "poissons_ratio: 0.3", "poissons_ratio: 0.3, dielectric: {field: V, permittivity: 1}"),
      "materials/steel/dielectric: block 'plate' has shells; dielectric is for solids and plane bodies");
  EXPECT_EQ(
      refusal(edited(plate, "poissons_ratio: 0.3", "poissons_ratio: 0.3, expansion: 1.0e-5*lambda*zeta")),
      "no error");
  expectRefused(edited(plate, "thickness: 0.1}", "thickness: 0.1, shear: 2}"),
                "shells/sections/skin/shear: expected one of");
}

TEST(SceneInput, SolidsAreNoShells) {
  expectRefused(edited(bar, "poissons_ratio: 0.3", "poissons_ratio: 0.3, expansion: 1.0e-5*zeta"),
                "materials/steel/expansion: in block 'bar'");
  expectRefused(edited(bar, "tools:\n", "shells: {joints: {fold: {set: x_max, joint: hinge}}}\ntools:\n"),
                "shells/joints/fold/set: no node of 'x_max' belongs to shells");
  expectRefused(edited(bar, "loads:\n", "couplings:\n  seam: {kind: shell_on_solid, set: x_max}\nloads:\n"),
                "couplings/seam/set: no node of 'x_max' belongs to shells");
  const std::string contact =
      "contact:\n  below: {tool: floor, set: z_min, points: nodes, at: top, stiffness: 10}\npath:\n";
  expectRefused(edited(bar, "path:\n", contact),
                "contact/below/at: no node of 'z_min' belongs to shells, which have a top and a bottom");
}

TEST(SceneInput, FlowsAndTheirCells) {
  expectRefused(edited(flow, "cell: QUAD9", "cell: QUAD4"),
                "physics/fluid/blocks: block 'channel' has QUAD4; a flow needs");
  expectRefused(edited(flow, "velocity: [u, v]", "velocity: [u, v, w]"),
                "physics/fluid/velocity: has 3 components; the mesh has 2 dimensions");
  expectRefused(edited(flow, "kind: strain", "kind: stress, thickness: 1"),
                "physics/fluid: a flow is plane with kind: strain, or axisymmetric");
  expectRefused(edited(flow, "supports:\n",
                       "  more: {type: flow, velocity: [a, b], pressure: q, viscosity: 1, blocks: "
                       "[channel]}\nsupports:\n"),
                "physics/more/blocks: block 'channel' already has the flow 'fluid'");
  expectRefused(edited(flow, "physics:\n",
                       "materials:\n  ice: {law: neo_hookean, youngs_modulus: 1, poissons_ratio: 0.3, "
                       "blocks: [channel]}\nphysics:\n"),
                "physics/fluid/blocks: block 'channel' has the material 'ice'; a fluid has none");
  expectRefused(edited(flow, "supports:\n",
                       "  heat: {type: balance, field: u, blocks: [channel], conductivity: 1}\nsupports:\n"),
                "physics/fluid/velocity: 'u' has a balance already");
}

/// Fields are there where something acts on them alone.
TEST(SceneInput, FieldsThatABlockDoesNotHave) {
  const fem::Mesh two = halved(meshOf(heat));
  const std::string half =
      edited(edited(heat, "blocks: [body]}\nphysics", "blocks: [body, other]}\nphysics"), "source: lambda}",
             "source: lambda}\n  charge: {type: balance, field: phi, blocks: [other], conductivity: 1}");
  EXPECT_EQ(refusal(half, &two), "no error");
  expectRefused(edited(half, "conductivity: 1, source: lambda", "conductivity: 1 + phi, source: lambda"),
                "physics/heat: in block 'body' a formula does not know 'phi'", &two);
  expectRefused(edited(half, "poissons_ratio: 0.3", "poissons_ratio: 0.3, expansion: phi"),
                "materials/steel/expansion: in block 'body' does not know 'phi'", &two);
  expectRefused(edited(half, "supports:\n", "supports:\n  pole: {set: x_min, field: phi, value: 1}\n"),
                "supports/pole/set: node", &two);
  expectRefused(
      edited(half, "path:\n", "loads:\n  air: {type: inflow, set: x_min, field: phi, amount: 1}\npath:\n"),
      "loads/air/field: a side of 'x_min' belongs to a block without the field 'phi'", &two);
  expectRefused(
      edited(half, "path:\n", "loads:\n  air: {type: inflow, set: x_min, field: T, amount: phi}\npath:\n"),
      "loads/air/amount: does not know 'phi'", &two);
  expectRefused(half + "output: {monitors: {m: {type: field, field: phi, set: x_min}}}\n",
                "output/monitors/m/set: node", &two);

  const std::string fluid = edited(
      flow, "supports:\n", "  push: {type: balance, field: u, blocks: [other], source: 1}\nsupports:\n");
  const fem::Mesh channel = halved(meshOf(flow));
  expectRefused(
      fluid, "physics/push/blocks: block 'other' has no flow, whose velocity 'u' is; a force acts on a fluid",
      &channel);
}

/// Forces are measured where driven supports leave the initial values, by as little as laws allow.
TEST(SceneInput, LawsWithoutAValueAtTheStart) {
  const std::string hot = edited(edited(heat, "conductivity: 1,", "conductivity: log(T/20),"), "value: 0}",
                                 "value: {value: 30, per_load_factor: 1}}");
  EXPECT_EQ(refusal(edited(hot, "supports:\n", "fields: {T: {initial: 30}}\nsupports:\n")), "no error");
  const std::string metal =
      edited(edited(bar, "law: saint_venant_kirchhoff, youngs_modulus: 1000",
                    "law: von_mises, strains: finite, yield_stress: 1, youngs_modulus: 1.0e300"),
             "loads:\n  tip: {type: surface, set: x_max, traction: [0, 0, -1]}\n",
             "  push: {set: x_max, x: {per_load_factor: 1}}\n");
  expectRefused(metal, "the start cannot be evaluated: entity 1, point 1: sqrt of -nan");
  const std::string thin = edited(edited(bar, "lengths: [4, 1, 1]", "lengths: [4.0e-4, 1, 1]"),
                                  "law: saint_venant_kirchhoff", "law: neo_hookean");
  EXPECT_EQ(refusal(edited(thin, "loads:\n", "  push: {set: x_max, x: {per_load_factor: -1}}\nloads:\n")),
            "no error");
}

TEST(SceneInput, SupportsAndFieldsThatDisagree) {
  expectRefused(edited(heat, "path:\n", "  warm: {set: x_min, field: T, value: 1}\npath:\n"),
                "supports/warm: the field 'T' of node");
  const fem::Mesh two = halved(meshOf(heat));
  expectRefused(
      edited(edited(heat, "source: lambda}",
                    "source: lambda}\n  more: {type: balance, field: T, blocks: [other], conductivity: 1}"),
             "supports:\n", "supports:\n  end: {set: x_max, x: 0}\n"),
      "supports/end/set: node", &two);  // no material there, no displacement
}

TEST(SceneInput, TooManyFields) {
  std::string many = heat;
  for (int f = 0; f < 9; ++f) {
    const std::string name = "c" + std::to_string(f);
    many = edited(
        many, "supports:\n",
        "  " + name + ": {type: balance, field: " + name + ", blocks: [body], conductivity: 1}\nsupports:\n");
  }
  expectRefused(many, "scalar fields; expected at most");
}

TEST(SceneInput, WhatMaterialsInFieldsCannotBe) {
  const auto with = [](const std::string& words) {
    return edited(heat, "poissons_ratio: 0.3", "poissons_ratio: 0.3" + words);
  };
  const std::string dielectric = ", dielectric: {field: phi, permittivity: 1}";
  expectRefused(with(", expansion: 0.1*T" + dielectric),
                "materials/steel/dielectric: stands beside expansion; expected one of them");
  expectRefused(with(", expansion: 0.1*T, formulation: mixed"),
                "materials/steel/expansion: is not for formulation: mixed");
  expectRefused(edited(with(dielectric), "kind: strain", "kind: axisymmetric"),
                "materials/steel/dielectric: is not for axisymmetric bodies");
  expectRefused(
      with(", dielectric: {field: T, permittivity: 1}"),
      "materials/steel/dielectric/field: physics/heat has a balance of 'T', whose rows are no charges");
  expectRefused(
      edited(heat, "law: neo_hookean, youngs_modulus: 1000, poissons_ratio: 0.3",
             "law: yeoh, c1: 1, c2: 0, c3: 0, bulk_modulus: 10, expansion: 0.1*T"),
      "materials/steel/expansion: is for the laws saint_venant_kirchhoff, neo_hookean and mooney_rivlin");
  expectRefused(edited(heat, "path:\n", "path:\n  imperfections: [0.1]\n"),
                "path/imperfections: their shapes are of displacements alone; not with scalar fields");
}

TEST(SceneInput, ConstantsAreAMap) {
  expectRefused(edited(heat, "plane:", "constants: 3\nplane:"),
                "constants: expected a map of names to numbers, got 3");
}

TEST(SceneInput, MetalsThatAreNone) {
  const auto metal = [](const std::string& words) {
    return edited(bar, "law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3",
                  "law: von_mises, youngs_modulus: 1000, poissons_ratio: 0.3, yield_stress: 1" + words);
  };
  expectRefused(metal(", strains: finite, kinematic_modulus: 10"),
                "materials/steel/kinematic_modulus: is for strains: small");
  expectRefused(metal(", yield_width: 0.6"), "materials/steel/yield_width: must be 0 to 0.5, got 0.6");
  expectRefused(metal(", saturation: -1, exponent: 5"),
                "materials/steel/saturation: must leave some of the yield stress 1, got -1");
}

TEST(SceneInput, MixedBodiesHaveNoImperfections) {
  const std::string rubber =
      edited(bar, "law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3",
             "law: neo_hookean, youngs_modulus: 1000, poissons_ratio: 0.3, formulation: mixed");
  expectRefused(
      edited(rubber, "path:\n", "path:\n  imperfections: [0.1]\n"),
      "path/imperfections: their shapes are of displacements alone; expected formulation: displacement");
}

TEST(SceneInput, ContactsThatCannotBe) {
  const auto with = [](const std::string& words) {
    return edited(bar, "path:\n", "contact:\n  below: {tool: floor, set: z_min, " + words + "}\npath:\n");
  };
  const auto touching = [&](const std::string& words) {
    return edited(with(words), "point: [0, 0, -1]", "point: [0, 0, 0]");
  };
  EXPECT_EQ(refusal(with("stiffness: 10")), "no error");
  expectRefused(with("unknown: curve, carried: near, stiffness: 10, regularisation: 0.1"),
                "contact/below/carried: near has no meaning with unknown: curve; expected all");
  expectRefused(with("points: nodes, stiffness: 10") +
                    "output: {monitors: {a: {type: contact_area, contact: below}}}\n",
                "output/monitors/a/contact: contact 'below' acts at nodes, which have no area");
  expectRefused(touching("unknown: curve, stiffness: 10, regularisation: 0.1"),
                "contact/below/reference_gap: the body touches tool 'floor' at");
  expectRefused(with("stiffness: 10, regularisation: 5, reference_gap: 0.1"),
                "contact/below/reference_gap: must be above regularisation/stiffness = 0.5, got 0.1");
  expectRefused(
      with("reference_gap: 1.0e-9"),
      "contact/below/reference_gap: must be above 3.90625e-06, regularisation/stiffness as the body suggests "
      "them, got 1e-09");
}

TEST(SceneInput, ZonesOnTrianglesAndPatches) {
  const std::string zones =
      edited(bar, "path:\n", "contact:\n  below: {tool: floor, set: z_min, points: zones}\npath:\n");
  EXPECT_EQ(refusal(zones), "no error");
  EXPECT_EQ(refusal(edited(zones, "cell: HEX8", "cell: TET4")), "no error");
  EXPECT_EQ(refusal(edited(
                zones, "floor: {type: plane, point: [0, 0, -1], normal: [0, 0, 1]}",
                "floor: {type: patches, surfaces: {s: {degree: [1, 1], points: [[-9, -9, -1], [-9, 9, -1], "
                "[9, -9, -1], [9, 9, -1]]}}}")),
            "no error");
}

TEST(SceneInput, InflowThroughContacts) {
  const std::string rod = R"(mesh:
  file: rod.exo
  generate: {shape: rectangle, lengths: [1, 1], divisions: [1, 1], cell: QUAD8, block: body}
plane: {kind: strain}
materials: {m: {law: neo_hookean, youngs_modulus: 1, poissons_ratio: 0.3, blocks: [body], expansion: 0.01*T}}
physics: {heat: {type: balance, field: T, blocks: [body], conductivity: 1}}
tools: {wall: {type: plane, point: [0, 1.1, 0], normal: [0, -1, 0]}}
contact: {end: {tool: wall, set: y_max, law: barrier, regularisation: 0.01}}
loads: {heat: {type: inflow, contact: end, field: T, amount: contact_pressure*(lambda - T)}}
supports: {clamp: {set: y_min, x: 0, y: 0}, cold: {set: y_min, field: T, value: 0}}
path: {stop: {load_factor: 1}}
)";
  EXPECT_EQ(refusal(rod), "no error");
  expectRefused(edited(rod, "contact: end,", "contact: ende,"),
                "loads/heat/contact: no entry 'ende' in contact");
  expectRefused(edited(rod, "contact: end,", "contact: end, set: y_max,"),
                "loads/heat/contact: stands beside set; expected one of them");
  expectRefused(edited(rod, "contact: end, ", ""), "loads/heat/set: is missing");
  expectRefused(edited(rod, "contact: end,", "set: y_max,"), "loads/heat/amount: ");
  expectRefused(edited(rod, "amount: contact_pressure", "amount: pressure"), "loads/heat/amount: ");
  for (const char* law : {"law: hard", "law: linear, points: zones, stiffness: 10",
                          "law: barrier, unknown: curve, regularisation: 0.01"})
    expectRefused(edited(rod, "law: barrier, regularisation: 0.01", law),
                  "loads/heat/contact: the pressure of contact 'end' is no function of the gap");
  expectRefused(edited(rod, "path: {", "path: {sharpen: 0.01, "),
                "loads/heat/contact: not with path/sharpen");
  expectRefused(edited(rod, "physics: {", "constants: {contact_gap: 1}\nphysics: {"),
                "constants/contact_gap: ");
}

TEST(SceneInput, FieldsInShells) {
  const std::string panel = R"(mesh:
  file: panel.exo
  generate: {shape: shell_plate, length: 1, width: 1, divisions: [1, 1], block: panel}
materials: {m: {law: neo_hookean, youngs_modulus: 1, poissons_ratio: 0.3, blocks: [panel], expansion: 0.01*(T + zeta*D)}}
shells: {sections: {panel: {blocks: [panel], thickness: 0.1}}}
physics:
  heat: {type: balance, field: T, blocks: [panel], conductivity: 1, source: lambda}
  difference: {type: balance, field: D, blocks: [panel], conductivity: 1/3, source: lambda - 400*D}
supports: {clamp: {set: x_min, condition: clamped}, cold: {set: x_min, field: T, value: 0}}
path: {stop: {load_factor: 1}}
)";
  EXPECT_EQ(refusal(panel), "no error");
  expectRefused(edited(panel, "zeta*D", "zeta*d"), "materials/m/expansion: ");
  const std::string membrane =
      edited(edited(edited(panel, "shells: {sections: {panel: {blocks: [panel], thickness: 0.1}}}",
                           "membranes: {panel: {blocks: [panel], thickness: 0.1}}"),
                    ", expansion: 0.01*(T + zeta*D)", ""),
             "condition: clamped", "x: 0, y: 0, z: 0");
  expectRefused(membrane,
                "physics/heat/blocks: block 'panel' has membranes; balances are for solids, plane "
                "cells and shells");
}

TEST(SceneInput, PlaneBodiesNeedToolsThatGoOnAlongZ) {
  const std::string plane = R"(mesh:
  file: block.exo
  generate: {shape: rectangle, lengths: [2, 1], divisions: [2, 1], cell: QUAD8, block: body}
plane: {kind: strain}
materials: {m: {law: neo_hookean, youngs_modulus: 1, poissons_ratio: 0.3, blocks: [body]}}
tools: {ball: {type: sphere, center: [0, -3, 1], radius: 2}}
contact: {below: {tool: ball, set: y_min, stiffness: 10}}
supports: {clamp: {set: y_max, x: 0, y: {per_load_factor: -1}}}
path: {stop: {load_factor: 0.1}}
)";
  expectRefused(plane, "contact/below: the normal of tool 'ball' leaves the plane z = 0 at");
  EXPECT_EQ(refusal(edited(plane, "center: [0, -3, 1]", "center: [0, -3, 0]")), "no error");
}

TEST(SceneInput, StopsMonitorsAndImperfections) {
  expectRefused(edited(bar, "stop: {load_factor: 1}", "stop: {bifurcation: 1}\nsolver: {type: belos}"),
                "path/stop/bifurcation: bifurcation points are found by the number of negative eigenvalues, "
                "that needs solver/type: mumps");
  expectRefused(edited(bar, "path:\n", "path:\n  hopf: true\n"),
                "path/hopf: is for fields that have rates, which displacements do not");
  expectRefused(bar + "output: {monitors: {f: {type: reaction, support: clamp}}}\n",
                "output/monitors/f/component: is missing");
  const std::string model =
      "problem: {name: lee_frame}\npath: {imperfections: [0.1], imperfections_as: geometry}\n";
  expectRefused(
      model,
      "path/imperfections_as: geometry needs a mesh, which a model problem does not have; expected load");
}

TEST(SceneInput, StagesThatDriveTwoEntriesOfOneName) {
  const std::string moved =
      edited(edited(bar, "x: 0, y: 0, z: 0", "x: {per_load_factor: 1}, y: 0, z: 0"), "tip:", "clamp:");
  expectRefused(edited(moved, "  stop: {load_factor: 1}",
                       "  stages: {pull: {drives: [clamp], stop: {load_factor: 1}}}"),
                "path/stages/pull/drives: 'clamp' is the name of 2 entries that depend on the load factor; "
                "expected other names");
}

TEST(SceneInput, LatitudesOfSpheres) {
  expectRefused(
      edited(plate, "shape: shell_plate, length: 4, width: 1, divisions: [4, 1]",
             "shape: shell_sphere, radius: 1, latitude: [-90, 0], longitude: [0, 90], divisions: [4, 4]"),
      "mesh/generate/latitude: must stay above -90 and below 90 degrees, got the list [-90, 0]");
}

TEST(SceneInput, PluginsThatAreNotAllThere) {
  const std::string own = edited(
      flow,
      "  fluid: {type: flow, velocity: [u, v], pressure: p, viscosity: 1, density: 1, blocks: [channel]}",
      "  film: {type: plugin, law: soap, fields: [u], blocks: [channel]}");
  const std::string with = edited(own, "plane:", "plugins: [soap]\nplane:");
  expectRefused(own, "physics/film/law: needs the block plugins");
  expectRefused(
      edited(with, "path:\n",
             "loads:\n  pull: {type: plugin, law: pull, set: x_max, fields: [u], constant: true}\npath:\n"),
      "loads/pull/constant: has no meaning with type: plugin, whose law reads the load factor itself");
  expectRefused(
      edited(with, "path:\n  stop: {load_factor: 1}\n", "path:\n  stages: {one: {stop: {load_factor: 1}}}\n"),
      "path/stages: are not for decks with plug-ins, whose laws have one load factor");
}
