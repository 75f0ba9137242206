// The deck: good ones give the right values, every kind of bad one its one line.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

#include "atrapos/fem/StructuredMesh.hpp"
#include "deck/Deck.hpp"
#include "deck/ProblemLines.hpp"

namespace {

using namespace atrapos;
using namespace atrapos::deck;

const char* const goodDeck = R"(# a comment with any text: é { [ "
title: Strip on a roll
mesh:
  file: strip.exo
  generate: {shape: box, lengths: [10, 2.0, 1], divisions: [10, 2, 1], cell: HEX20, block: strip}
materials:
  steel: {law: saint_venant_kirchhoff, youngs_modulus: 220000, poissons_ratio: 0, blocks: [strip]}
supports:
  clamp: {set: x_min, x: 0, y: 0, z: 0}
  pull:
    set: x_max
    x: {value: 0.5, per_load_factor: 1.5}
loads:
  tip: {type: surface, set: x_max, total: [0, 0, -100]}
tools:
  roll: {type: cylinder, center: [200, 0, -54.4], axis: [0, 1, 0], radius: 50}
contact:
  lower: {tool: roll, set: z_min, stiffness: 1.0e3, regularisation: 0.1}
path:
  order: 15
  stop: {load_factor: 0.25}
output:
  monitors:
    tip_uz: {type: displacement, set: x_max, component: z}
)";

/// goodDeck with one piece of text replaced, which must occur.
std::string changed(const std::string& from, const std::string& to) {
  std::string text = goodDeck;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "the good deck has no '" << from << "'";
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string errorOf(const std::string& text) {
  try {
    readDeckText(text, "some/folder/solid.yaml");
  } catch (const DeckError& error) {
    return error.what();
  }
  return "no error";
}

/// What a line of error says behind its file and place.
std::string behindPlace(const std::string& error) {
  const auto place = error.find(".yaml:");
  return place == std::string::npos ? error
                                    : error.substr(error.find_first_not_of("0123456789: ", place + 6));
}

/// Exact start of the line behind the file: its place, or the key path behind that; and words that it must
/// hold. Never more than one line.
void expectError(const std::string& text, const std::string& start, const std::vector<std::string>& words) {
  const std::string error = errorOf(text), file = "some/folder/solid.yaml:";
  ASSERT_EQ(error.substr(0, file.size()), file) << error;
  const bool withPlace = start.find_first_of("0123456789") == 0;
  const std::string rest = withPlace ? error.substr(file.size()) : behindPlace(error);
  EXPECT_EQ(rest.substr(0, start.size()), start) << error;
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  for (const auto& word : words) {
    EXPECT_NE(error.find(word), std::string::npos) << "'" << word << "' is not in: " << error;
  }
}

void expectError(const std::string& from, const std::string& to, const std::string& start,
                 const std::vector<std::string>& words) {
  SCOPED_TRACE(to);
  expectError(changed(from, to), start, words);
}

std::string described(const Deck& deck) {
  std::ostringstream out;
  describe(deck, out);
  return out.str();
}

}  // namespace

TEST(Deck, goodDeckGivesItsValues) {
  const Deck deck = readDeckText(goodDeck, "some/folder/solid.yaml");
  EXPECT_EQ(deck.file, "some/folder/solid.yaml");
  EXPECT_EQ(deck.text, goodDeck);
  EXPECT_EQ(deck.title, "Strip on a roll");
  EXPECT_EQ(deck.mesh.file, "strip.exo");
  EXPECT_EQ(deck.mesh.path, "some/folder/strip.exo");
  EXPECT_FALSE(deck.mesh.decomposed);
  EXPECT_FALSE(deck.output.parts);
  ASSERT_TRUE(deck.mesh.generate);
  const auto& box = std::get<fem::BoxOptions>(*deck.mesh.generate);
  EXPECT_EQ(box.lengths, (Vector3{10, 2, 1}));
  EXPECT_EQ(box.origin, (Vector3{0, 0, 0}));
  EXPECT_EQ(box.divisions, (std::array<int, 3>{10, 2, 1}));
  EXPECT_EQ(box.topology, fem::Topology::Hex20);
  EXPECT_EQ(box.blockName, "strip");

  ASSERT_EQ(deck.materials.size(), 1u);
  EXPECT_EQ(deck.materials[0].name, "steel");
  EXPECT_EQ(deck.materials[0].blocks, std::vector<std::string>{"strip"});
  const auto& law = std::get<SaintVenantKirchhoff>(deck.materials[0].law);
  EXPECT_EQ(law.youngsModulus, 220000.0);
  EXPECT_EQ(law.poissonsRatio, 0.0);

  ASSERT_EQ(deck.supports.size(), 2u);
  EXPECT_EQ(deck.supports[0].name, "clamp");
  EXPECT_EQ(deck.supports[0].set, "x_min");
  for (const auto& component : deck.supports[0].components) {
    ASSERT_TRUE(component);
    EXPECT_EQ(component->value, 0.0);
    EXPECT_EQ(component->perLoadFactor, 0.0);
  }
  ASSERT_TRUE(deck.supports[1].components[0]);
  EXPECT_EQ(deck.supports[1].components[0]->value, 0.5);
  EXPECT_EQ(deck.supports[1].components[0]->perLoadFactor, 1.5);
  EXPECT_FALSE(deck.supports[1].components[1]);
  EXPECT_FALSE(deck.supports[1].components[2]);

  ASSERT_EQ(deck.loads.size(), 1u);
  EXPECT_FALSE(deck.loads[0].constant);
  const auto& load = std::get<SurfaceLoad>(deck.loads[0].load);
  EXPECT_EQ(load.set, "x_max");
  EXPECT_EQ(load.kind, SurfaceLoad::Kind::Total);
  EXPECT_EQ(load.vector, (Vector3{0, 0, -100}));

  ASSERT_EQ(deck.tools.size(), 1u);
  const auto& roll = std::get<CylinderTool>(deck.tools[0].surface);
  EXPECT_EQ(roll.center, (Vector3{200, 0, -54.4}));
  EXPECT_EQ(roll.axis, (Vector3{0, 1, 0}));
  EXPECT_EQ(roll.radius, 50.0);

  ASSERT_EQ(deck.contacts.size(), 1u);
  const auto& contact = deck.contacts[0];
  EXPECT_EQ(contact.name, "lower");
  EXPECT_EQ(contact.tool, "roll");
  EXPECT_EQ(contact.set, "z_min");
  EXPECT_EQ(contact.points, Contact::Points::Auto);
  EXPECT_EQ(contact.law, Contact::Law::Hyperbola);  // its numbers say so
  EXPECT_EQ(contact.quadratureDegree, 4);
  EXPECT_EQ(contact.stiffness, 1000.0);
  EXPECT_EQ(contact.regularisation, 0.1);
  EXPECT_FALSE(contact.referenceGap);

  EXPECT_EQ(deck.path.order, 15);
  EXPECT_EQ(deck.path.accuracy, 1e-6);
  EXPECT_EQ(deck.path.residual, 1e-6);
  EXPECT_EQ(deck.path.direction, 1);
  EXPECT_EQ(deck.path.stop.loadFactors, std::vector<double>{0.25});
  EXPECT_EQ(deck.path.stop.steps, 1000);
  EXPECT_FALSE(deck.path.stop.pathLength);
  EXPECT_TRUE(deck.path.stop.monitors.empty());
  EXPECT_EQ(deck.solver.spec(), "mumps");

  EXPECT_EQ(deck.output.pointsPerStep, 5);
  EXPECT_EQ(deck.output.residuals, Output::Residuals::Steps);
  EXPECT_EQ(deck.output.fieldsEvery, 1);
  EXPECT_EQ(deck.output.fields, (std::vector<OutputField>{OutputField::Displacement, OutputField::Stress,
                                                          OutputField::Reaction, OutputField::Contact}));
  ASSERT_EQ(deck.output.monitors.size(), 1u);
  const auto& monitor = std::get<DisplacementMonitor>(deck.output.monitors[0].quantity);
  EXPECT_EQ(monitor.set, "x_max");
  EXPECT_EQ(monitor.component, Component::Z);
  EXPECT_EQ(monitor.reduce, DisplacementMonitor::Reduce::Mean);
}

TEST(Deck, everyOtherKindOfEntry) {
  const Deck deck = readDeckText(R"(
mesh: {file: /data/a.exo, decomposed: true}
materials:
  soft: {law: saint_venant_kirchhoff, youngs_modulus: 1, poissons_ratio: -0.5, blocks: [1, 2]}
  hard:
    law: saint_venant_kirchhoff
    youngs_modulus: 2.5e3
    poissons_ratio: 0.3
    blocks:
      - core
      - 7
supports:
  held: {set: 12, x: 1, z: -2.5e-1}
loads:
  a: {type: nodal, set: 3, per_node: [1, 2, 3]}
  b: {type: nodal, set: n, total: [1.5, 2, 3], constant: true}
  c: {type: surface, set: s, traction: [1, 0, 0]}
  d: {type: surface, set: s, pressure: -2}
  e: {type: volume, blocks: core, force: [0, 0, -9.81]}
tools:
  table: {type: plane, point: [0, 0, -1], normal: [0, 0, 2]}
contact:
  foot: {tool: table, set: n, points: nodes, stiffness: rigid, regularisation: 1, reference_gap: 4}
path: {direction: -1, accuracy: 1e-8, residual: 1.0e-7, order: 60,
       stop: {steps: 7, path_length: 100, limit_point: 2, displacement: {u: -50, v: 1.5}}}
solver: {type: amesos2, name: klu2}
output:
  points_per_step: 1
  residuals: points
  fields_every: 10
  parts: true
  fields: [contact, displacement]
  monitors:
    u: {type: displacement, set: n, component: z, reduce: sum}
    v: {type: displacement, set: n, component: y, near: [1, 2, 3]}
    f: {type: contact_force, contact: foot}
    fx: {type: contact_force, contact: foot, component: x}
    r: {type: reaction, support: held, component: z}
    c: {type: contact_center, contact: foot, component: y}
    s: {type: contact_spread, contact: foot, component: x, about: [1, 2, 3]}
)",
                                 "all.yaml");
  EXPECT_EQ(deck.title, "all");  // the file's stem
  EXPECT_EQ(deck.mesh.path, "/data/a.exo");
  EXPECT_TRUE(deck.mesh.decomposed);
  EXPECT_TRUE(deck.output.parts);
  EXPECT_FALSE(deck.mesh.generate);
  EXPECT_EQ(deck.materials[0].blocks, (std::vector<std::string>{"1", "2"}));
  EXPECT_EQ(std::get<SaintVenantKirchhoff>(deck.materials[0].law).poissonsRatio, -0.5);
  EXPECT_EQ(deck.materials[1].blocks, (std::vector<std::string>{"core", "7"}));
  EXPECT_EQ(std::get<SaintVenantKirchhoff>(deck.materials[1].law).youngsModulus, 2500.0);
  EXPECT_EQ(deck.supports[0].set, "12");
  EXPECT_EQ(deck.supports[0].components[0]->value, 1.0);
  EXPECT_FALSE(deck.supports[0].components[1]);
  EXPECT_EQ(deck.supports[0].components[2]->value, -0.25);

  ASSERT_EQ(deck.loads.size(), 5u);
  const auto& a = std::get<NodalLoad>(deck.loads[0].load);
  EXPECT_EQ(a.set, "3");
  EXPECT_TRUE(a.perNode);
  EXPECT_EQ(a.force, (Vector3{1, 2, 3}));
  EXPECT_FALSE(deck.loads[0].constant);
  EXPECT_FALSE(std::get<NodalLoad>(deck.loads[1].load).perNode);
  EXPECT_TRUE(deck.loads[1].constant);
  EXPECT_EQ(std::get<SurfaceLoad>(deck.loads[2].load).kind, SurfaceLoad::Kind::Traction);
  EXPECT_EQ(std::get<SurfaceLoad>(deck.loads[2].load).vector, (Vector3{1, 0, 0}));
  EXPECT_EQ(std::get<SurfaceLoad>(deck.loads[3].load).kind, SurfaceLoad::Kind::Pressure);
  EXPECT_EQ(std::get<SurfaceLoad>(deck.loads[3].load).pressure, -2.0);
  EXPECT_EQ(std::get<VolumeLoad>(deck.loads[4].load).blocks, std::vector<std::string>{"core"});
  EXPECT_EQ(std::get<VolumeLoad>(deck.loads[4].load).force, (Vector3{0, 0, -9.81}));

  const auto& table = std::get<PlaneTool>(deck.tools[0].surface);
  EXPECT_EQ(table.point, (Vector3{0, 0, -1}));
  EXPECT_EQ(table.normal, (Vector3{0, 0, 2}));
  EXPECT_EQ(deck.contacts[0].points, Contact::Points::Nodes);
  EXPECT_FALSE(deck.contacts[0].stiffness);
  EXPECT_TRUE(deck.contacts[0].isRigid());
  EXPECT_EQ(deck.contacts[0].referenceGap, 4.0);
  EXPECT_EQ(deck.path.direction, -1);
  EXPECT_EQ(deck.path.accuracy, 1e-8);
  EXPECT_EQ(deck.path.residual, 1e-7);
  EXPECT_EQ(deck.path.order, 60);
  EXPECT_TRUE(deck.path.stop.loadFactors.empty());
  EXPECT_EQ(deck.path.stop.steps, 7);
  EXPECT_EQ(deck.path.stop.pathLength, 100.0);
  EXPECT_EQ(deck.path.stop.monitors,
            (std::map<std::string, std::vector<double>>{{"u", {-50}}, {"v", {1.5}}}));
  EXPECT_EQ(deck.solver.spec(), "amesos2:klu2");
  EXPECT_EQ(deck.output.pointsPerStep, 1);
  EXPECT_EQ(deck.output.residuals, Output::Residuals::Points);
  EXPECT_EQ(deck.output.fieldsEvery, 10);
  EXPECT_EQ(deck.output.fields, (std::vector<OutputField>{OutputField::Contact, OutputField::Displacement}));
  ASSERT_EQ(deck.output.monitors.size(), 7u);
  EXPECT_EQ(std::get<DisplacementMonitor>(deck.output.monitors[0].quantity).reduce,
            DisplacementMonitor::Reduce::Sum);
  EXPECT_EQ(std::get<DisplacementMonitor>(deck.output.monitors[1].quantity).near, (Vector3{1, 2, 3}));
  EXPECT_EQ(std::get<ContactForceMonitor>(deck.output.monitors[2].quantity).contact, "foot");
  EXPECT_EQ(std::get<ContactForceMonitor>(deck.output.monitors[2].quantity).component, Component::Normal);
  EXPECT_EQ(std::get<ContactForceMonitor>(deck.output.monitors[3].quantity).component, Component::X);
  EXPECT_EQ(std::get<ReactionMonitor>(deck.output.monitors[4].quantity).support, "held");
  EXPECT_EQ(std::get<ReactionMonitor>(deck.output.monitors[4].quantity).component, Component::Z);
  EXPECT_EQ(std::get<ContactCenterMonitor>(deck.output.monitors[5].quantity).component, Component::Y);
  const auto& spread = std::get<ContactSpreadMonitor>(deck.output.monitors[6].quantity);
  EXPECT_EQ(spread.component, Component::X);
  EXPECT_EQ(spread.about, (Vector3{1, 2, 3}));
  const std::string once = described(deck);
  EXPECT_EQ(described(readDeckText(once, "/data/all.yaml")), once);
}

TEST(Deck, pathKeys) {
  const Deck plain = readDeckText(goodDeck, "solid.yaml");
  EXPECT_FALSE(plain.path.autoOrder);
  EXPECT_FALSE(plain.path.weight);
  EXPECT_EQ(plain.path.pade, path::PadeUse::automatic);
  EXPECT_EQ(plain.path.criticalPoints, Path::Critical::Automatic);
  EXPECT_EQ(plain.path.branches, path::Follow::none);
  EXPECT_TRUE(plain.path.restart);
  std::string text = changed("  order: 15\n",
                             "  order: auto\n  weight: 0.25\n  pade: off\n  critical_points: every_step\n"
                             "  imperfections: 0.5\n  imperfections_as: geometry\n  branches: stable\n  "
                             "branch_depth: 2\n  branch_count: 7\n  restart: false\n");
  text.replace(text.find("{load_factor: 0.25}"), 19,
               "{load_factor: [0.5, -0.25], displacement: {tip_uz: [-5, 5]}}");
  const Deck deck = readDeckText(text, "solid.yaml");
  EXPECT_TRUE(deck.path.autoOrder);
  EXPECT_EQ(deck.path.weight, 0.25);
  EXPECT_EQ(deck.path.pade, path::PadeUse::off);
  EXPECT_EQ(deck.path.imperfectionsAs, Path::Imperfection::Geometry);
  EXPECT_EQ(deck.path.criticalPoints, Path::Critical::EveryStep);
  EXPECT_EQ(deck.path.branches, path::Follow::stable);
  EXPECT_EQ(deck.path.branchDepth, 2);
  EXPECT_EQ(deck.path.branchCount, 7);
  EXPECT_FALSE(deck.path.restart);
  EXPECT_EQ(deck.path.stop.loadFactors, (std::vector<double>{0.5, -0.25}));
  EXPECT_EQ(deck.path.stop.monitors.at("tip_uz"), (std::vector<double>{-5, 5}));
  const std::string once = described(deck);
  EXPECT_EQ(described(readDeckText(once, "solid.yaml")), once);
}

TEST(Deck, modelProblems) {
  const Deck deck =
      readDeckText("problem: {name: bratu_1d, parameters: {points: 12}}\n", "folder/bratu.yaml");
  ASSERT_TRUE(deck.problem);
  EXPECT_EQ(deck.problem->name, "bratu_1d");
  EXPECT_EQ(deck.problem->parameters, (std::map<std::string, double>{{"points", 12}}));
  EXPECT_EQ(deck.title, "bratu");
  EXPECT_TRUE(deck.path.stop.loadFactors.empty());
  const std::string once = described(deck);
  EXPECT_EQ(described(readDeckText(once, "bratu.yaml")), once);
}

TEST(Deck, shapesToGenerate) {
  const auto generate = [](const std::string& shape) {
    return *readDeckText(
                changed(
                    "{shape: box, lengths: [10, 2.0, 1], divisions: [10, 2, 1], cell: HEX20, block: strip}",
                    shape),
                "d.yaml")
                .mesh.generate;
  };
  const auto strip =
      std::get<fem::StripOptions>(generate("{shape: strip, length: 400, width: 20, thickness: 0.8, origin: "
                                           "[0, -10, -0.4], divisions: [4, 2, 1]}"));
  EXPECT_EQ(strip.length, 400.0);
  EXPECT_EQ(strip.width, 20.0);
  EXPECT_EQ(strip.thickness, 0.8);
  EXPECT_EQ(strip.origin, (Vector3{0, -10, -0.4}));
  EXPECT_EQ(strip.divisions, (std::array<int, 3>{4, 2, 1}));
  EXPECT_EQ(strip.topology, fem::StripOptions{}.topology);
  EXPECT_EQ(strip.blockName, fem::StripOptions{}.blockName);
  const auto roof = std::get<fem::CylinderPanelOptions>(generate(
      "{shape: cylinder_panel, mid_radius: 25, thickness: 0.25, theta: [-40, 40.5], length: 50, y_min: -25, "
      "divisions: [8, 4, 1], cell: WEDGE15}"));
  EXPECT_EQ(roof.midRadius, 25.0);
  EXPECT_EQ(roof.thickness, 0.25);
  EXPECT_EQ(roof.thetaMin, -40.0);
  EXPECT_EQ(roof.thetaMax, 40.5);
  EXPECT_EQ(roof.length, 50.0);
  EXPECT_EQ(roof.yMin, -25.0);
  EXPECT_EQ(roof.topology, fem::Topology::Wedge15);
  const auto dome = std::get<fem::SpherePanelOptions>(generate(
      "{shape: sphere_panel, mid_radius: 10, thickness: 0.04, longitude: [0, 90], latitude: [1, 72], "
      "divisions: [8, 8, 1], block: dome}"));
  EXPECT_EQ(dome.midRadius, 10.0);
  EXPECT_EQ(dome.longitudeMax, 90.0);
  EXPECT_EQ(dome.latitudeMin, 1.0);
  EXPECT_EQ(dome.latitudeMax, 72.0);
  EXPECT_EQ(dome.blockName, "dome");
}

TEST(Deck, allOfYaml) {
  const std::string plain = described(readDeckText(goodDeck, "solid.yaml"));
  const auto same = [&](const std::string& text) {
    EXPECT_EQ(described(readDeckText(text, "solid.yaml")), plain) << text;
  };
  const auto titled = [](const std::string& title) {
    return readDeckText(changed("title: Strip on a roll", "title: " + title), "d.yaml").title;
  };
  EXPECT_EQ(titled("Träger auf Walze, µ = 0 °C"), "Träger auf Walze, µ = 0 °C");
  EXPECT_EQ(titled("\"\\u00e9 \\\"a\\\" \\\\ \\x41 \\U0001F600\""), "é \"a\" \\ A 😀");
  EXPECT_EQ(titled("strip [1], {x} # <a>"), "strip [1], {x}");
  EXPECT_EQ(titled("'it''s: [yes]'"), "it's: [yes]");
  EXPECT_EQ(titled("a\n  title of\n  lines"), "a title of lines");
  EXPECT_EQ(titled("\"a\n  title\""), "a title");
  EXPECT_EQ(titled("|\n  Strip\n"), "Strip");
  EXPECT_EQ(titled(">-\n  Strip on\n  a roll\n"), "Strip on a roll");
  EXPECT_EQ(titled("! 3"), "3");  // a text, as quotes would make it

  std::string crlf = goodDeck;
  for (std::size_t i = 0; (i = crlf.find('\n', i)) != std::string::npos; i += 2) crlf.replace(i, 1, "\r\n");
  same(crlf);
  same(std::string("\xEF\xBB\xBF") + goodDeck);
  same(std::string("%YAML 1.2\n---\n") + goodDeck);
  same(std::string("---\n") + goodDeck + "...\n");
  same(std::string("# first\n--- # a deck\n") + goodDeck + "# last\n\n  \n");
  same(changed("mesh:\n", "'mesh':\n"));
  same(changed("blocks: [strip]", "\"blocks\" : [ strip, ]"));
  same(changed("total: [0, 0, -100]", "total: [0,\n\t0, # in between\n -100]"));
  same(changed("{load_factor: 0.25}", "\n    ? load_factor\n    : 0.25"));
  same(changed("tip: {type: surface, set: x_max, total: [0, 0, -100]}",
               "tip:\n    type: surface\n    set: x_max\n    total:\n    - 0\n    - 0\n    - -100"));
  // The same value again, and keys of another map.
  std::string anchored = changed("set: x_max\n", "set: &end x_max\n");
  anchored.replace(anchored.find("surface, set: x_max"), 19, "surface, set: *end");
  same(anchored);
  anchored = changed("clamp: {set: x_min, x: 0, y: 0, z: 0}",
                     "clamp: {set: x_min, <<: [{x: &zero 0, y: *zero}, {z: 0, y: 7}]}");
  same(anchored);
  const Deck merged =
      readDeckText(changed("clamp: {set: x_min, x: 0, y: 0, z: 0}",
                           "clamp: &clamp {set: x_min, x: 0, y: 0, z: 0}\n  other: {y: 2, <<: *clamp}"),
                   "d.yaml");
  EXPECT_EQ(merged.supports[1].set, "x_min");
  EXPECT_EQ(merged.supports[1].components[0]->value, 0.0);
  EXPECT_EQ(merged.supports[1].components[1]->value, 2.0);
}

TEST(Deck, entriesAsLists) {
  std::string text = changed("  roll: {type: cylinder", "- {name: roll, type: cylinder");
  text.replace(text.find("  lower: {"), 10, "  - name: lower\n    <<: {");
  text.replace(text.find("    tip_uz: {"), 13, "    - {name: tip_uz, ");
  EXPECT_EQ(described(readDeckText(text, "solid.yaml")), described(readDeckText(goodDeck, "solid.yaml")));
  text.replace(text.find("name: roll"), 10, "name: disc");
  expectError(text, "contact/lower/tool: no entry 'roll' in tools", {"there are disc"});
}

TEST(Deck, numbers) {
  const auto radius = [](const std::string& number) {
    return std::get<CylinderTool>(
               readDeckText(changed("radius: 50", "radius: " + number), "d.yaml").tools[0].surface)
        .radius;
  };
  for (const std::string number :
       {"0.001", "1e-3", "1E-3", "1.0e-03", ".001", "+0.001", "+.1e-2", "00.001"}) {
    EXPECT_EQ(radius(number), 0.001) << number;
  }
  for (const std::string number : {"8", "+8", "8.", "08", "8e0", "8.E+0"})
    EXPECT_EQ(radius(number), 8.0) << number;
  EXPECT_EQ(radius("5e-324"), 5e-324);
  EXPECT_EQ(radius("1.7976931348623157e308"), 1.7976931348623157e308);
  EXPECT_EQ(radius("0.1000000000000000055511151231257827021181583404541015625"), 0.1);
  for (const std::string number : {"15", "+15", "15.0", "1.5e1", "15."})
    EXPECT_EQ(readDeckText(changed("order: 15", "order: " + number), "d.yaml").path.order, 15) << number;
  EXPECT_EQ(std::get<fem::BoxOptions>(
                *readDeckText(changed("[10, 2, 1], cell", "[1.0e1, 2.0, 1], cell"), "d.yaml").mesh.generate)
                .divisions,
            (std::array<int, 3>{10, 2, 1}));
  EXPECT_EQ(readDeckText(changed("set: x_min", "set: 007"), "d.yaml").supports[0].set, "7");
  EXPECT_EQ(readDeckText(changed("set: x_min", "set: '007'"), "d.yaml").supports[0].set, "007");
}

TEST(Deck, describedDeckReadsBackToTheSame) {
  for (const std::string file : {"solid", "solid_fine", "solid_nu03"}) {
    const Deck deck = readDeck(fmt::format("{}/strip_roll/{}.yaml", ATRAPOS_EXAMPLES, file));
    const std::string once = described(deck);
    EXPECT_EQ(described(readDeckText(once, file)), once);
  }
  // Numbers in every notation, a quote in a text, names that look like numbers or truth values.
  std::string text = changed("title: Strip on a roll", "title: it's 100 % [odd]: 'yes'");
  text = changed("title: Strip on a roll", "title: \"it's odd: [yes]\"");
  text.replace(text.find("220000"), 6, "2.2e-300");
  text.replace(text.find("blocks: [strip]"), 15, "blocks: [12, 'yes', \"a b\", 'null', 'True', 'ä']");
  text.replace(text.find("radius: 50"), 10, "radius: 1e+21");
  const Deck deck = readDeckText(text, "odd");
  EXPECT_EQ(deck.title, "it's odd: [yes]");
  const std::string once = described(deck);
  const Deck again = readDeckText(once, "odd");
  EXPECT_EQ(described(again), once);
  EXPECT_EQ(again.title, deck.title);
  EXPECT_EQ(again.materials[0].blocks, (std::vector<std::string>{"12", "yes", "a b", "null", "True", "ä"}));
  EXPECT_EQ(std::get<SaintVenantKirchhoff>(again.materials[0].law).youngsModulus, 2.2e-300);
  EXPECT_EQ(std::get<CylinderTool>(again.tools[0].surface).radius, 1e21);
  // Defaults are shown.
  EXPECT_NE(once.find("accuracy: 1e-06"), std::string::npos) << once;
  EXPECT_NE(once.find("reference_gap: initial"), std::string::npos) << once;
}

TEST(Deck, examplesParse) {
  const std::string folder = std::string(ATRAPOS_EXAMPLES) + "/strip_roll/";
  const Deck solid = readDeck(folder + "solid.yaml");
  const Deck fine = readDeck(folder + "solid_fine.yaml");
  const Deck nu03 = readDeck(folder + "solid_nu03.yaml");
  for (const Deck* deck : {&solid, &fine, &nu03}) {
    SCOPED_TRACE(deck->file);
    const auto& strip = std::get<fem::StripOptions>(deck->mesh.generate.value());
    EXPECT_EQ(strip.length, 400.0);
    EXPECT_EQ(strip.width, 20.0);
    EXPECT_EQ(strip.thickness, 0.8);
    EXPECT_EQ(strip.topology, fem::Topology::Hex20);
    EXPECT_EQ(strip.origin[2], -0.4);
    EXPECT_EQ(strip.divisions, (std::array<int, 3>{deck == &fine ? 80 : 40, deck == &fine ? 4 : 2, 1}));
    const auto& law = std::get<SaintVenantKirchhoff>(deck->materials.at(0).law);
    EXPECT_EQ(law.youngsModulus, 220000.0);
    EXPECT_EQ(law.poissonsRatio, deck == &nu03 ? 0.3 : 0.0);
    const auto& roll = std::get<CylinderTool>(deck->tools.at(0).surface);
    // The gap of 4 mm to the lower surface; the sum of two numbers rounded to double: within 4 ulp of the
    // larger.
    EXPECT_NEAR(roll.center[2] + roll.radius, -4.4, 4 * 54.4 * std::numeric_limits<double>::epsilon());
    EXPECT_EQ(std::get<SurfaceLoad>(deck->loads.at(0).load).vector, (Vector3{0, 0, -100}));
    EXPECT_EQ(deck->path.stop.loadFactors, std::vector<double>{0.25});
    ASSERT_EQ(deck->output.monitors.size(), 3u);
    EXPECT_NO_THROW(checkAgainstMesh(*deck, fem::stripMesh(strip)));
  }
}

// ------------------------------------------------------------------------------------------- bad decks

/// goodDeck with one change is refused with this line.
void expectLine(const std::string& from, const std::string& to, const std::string& line) {
  EXPECT_EQ(errorOf(changed(from, to)), "some/folder/solid.yaml" + line);
}

TEST(BadDeck, places) {
  // Of a value, of an item that is wrong, of the key of a map, of a key that is none.
  expectLine("radius: 50", "radius: -50", ":16:76: tools/roll/radius: must be positive, got -50");
  expectLine("axis: [0, 1, 0]", "axis: [0, y, 0]",
             ":16:61: tools/roll/axis: expected a list of 3 finite numbers, got the list [0, y, 0]");
  expectLine("axis: [0, 1, 0]", "axis: [0, 1]",
             ":16:57: tools/roll/axis: expected a list of 3 finite numbers, got the list [0, 1]");
  expectLine(", radius: 50", "", ":16:3: tools/roll/radius: is missing; expected a number, positive");
  expectLine("path:", "ä: 1\npath:",
             ":19:1: ä: is not a key here; allowed are title, mesh, plugins, constants, materials, "
             "physics, fields, plane, shells, membranes, bars, supports, "
             "couplings, loads, "
             "tools, contact, path, solver, output");
  expectLine("{tool: roll", "{tool: # ä\n    'rol'",
             ":19:5: contact/lower/tool: no entry 'rol' in tools (did you mean 'roll'?); there are roll");
  // Columns count characters.
  expectLine("clamp: {set: x_min, x: 0", "clamp: {\"set\": \"ä\\u00e4 ☃ 😀\", x: a",
             ":9:36: supports/clamp/x: expected a finite number or a formula of x, y, z; this text does not "
             "know 'a'; known are x, y, z, pi");
  // What an alias stands for is wrong where it is written, an entry of a list where its name is.
  expectLine("total: [0, 0, -100]", "total: &t [0, 0, -100], at: *t",
             ":14:43: loads/tip/at: expected one of top, middle, bottom, got the list [0, 0, -100]");
  expectLine("  tip: {type: surface,", "  - {type: surface, name: a/b,",
             ":14:27: loads/a/b: a name is made of letters, digits, '_', '-' and '.'");
  // A block that is not there has no place.
  EXPECT_EQ(errorOf("title: a\nmesh: {file: a}\n").find("some/folder/solid.yaml: materials: is missing"), 0u);
}

TEST(BadDeck, budgets) {
  const std::string large(8000001, ' ');
  expectError(large, "is too large for a deck; expected at most 8000000 bytes", {});
  try {
    readDeck("/dev/zero");  // has no end
    ADD_FAILURE();
  } catch (const DeckError& error) {
    EXPECT_STREQ(error.what(), "/dev/zero: is too large for a deck; expected at most 8000000 bytes");
  }
  // As long as may be, and one more.
  EXPECT_EQ(errorOf(changed("Strip on a roll", std::string(4096, 'x'))), "no error");
  for (const std::string quote : {"", "'", "\""}) {
    expectError("Strip on a roll", quote + std::string(4097, 'x') + quote,
                "title: must have at most 4096 bytes, has 4097", {});
    expectError("Strip on a roll", quote + std::string(1000000, 'x') + quote, "title: must have at most", {});
  }
  const std::string key(200, 'k');
  expectError("path:", key + ": 1\npath:", key + ": is not a key here", {});
  expectError("path:", key + "k: 1\npath:", "19:1: a key is at most 200 bytes", {});
  std::string tools = "tools:\n", list;
  for (int i = 0; i <= 10000; ++i) {
    tools += fmt::format("  t{}: {{type: sphere, center: [0, 0, 0], radius: 1}}\n", i);
    list += fmt::format("  - {{name: t{}, type: sphere, center: [0, 0, 0], radius: 1}}\n", i);
  }
  expectError("tools:\n", tools, "tools: holds 10002 entries; expected at most 10000", {});
  expectError("tools:\n  roll: ", "tools:\n" + list + "  - ", "tools/item 10002: has no name", {});
  // Lists of what is there end.
  tools.erase(tools.find("  t9000:"));
  const std::string line = errorOf(
      changed("tools:\n", tools).replace(changed("tools:\n", tools).find("tool: roll"), 10, "tool: rall"));
  EXPECT_NE(line.find("did you mean 'roll'?"), std::string::npos) << line;
  EXPECT_NE(line.find("t39, ... (9001 in all)"), std::string::npos) << line;
}

TEST(BadDeck, fileThatCannotBeRead) {
  for (const std::string file : {"no/such/deck.yaml", "/"}) {
    try {
      readDeck(file);
      ADD_FAILURE() << file;
    } catch (const DeckError& error) {
      EXPECT_EQ(std::string(error.what()).find(file + ": "), 0u) << error.what();
    }
  }
}

TEST(BadDeck, emptyFiles) {
  for (const std::string text : {"", "\n\n", "# only a comment\n", "---\n"}) {
    SCOPED_TRACE(text);
    expectError(text, "the deck is empty", {"expected the blocks"});
  }
}

TEST(BadDeck, textThatIsNoMap) {
  expectError("hello\n", "1:1: ", {"expected 'key: value', got 'hello'"});
  expectError("[1, 2]\n", "1:1: ", {"not a list"});
  expectError("- a\n- b\n", "1:1: ", {"not a list"});
  expectError(std::string(1000000, 'x'), "1:1: ", {"got 'xxx", "xxx...'"});
  expectError("mesh:\n  hello\n", "mesh: expected a map of keys, got the text 'hello'", {":2:3: "});
  expectError("a: 1\n---\nb: 2\n", "2:1: ", {"one YAML document"});
  expectError("%YAML 2.0\n---\na: 1\n", "1:1: ", {"no directives but '%YAML 1.2', of its version"});
  expectError("a: 1\n...\nb: 2\n", "3:1: ", {"one YAML document"});
  expectError("mesh: 3\n", "mesh: ", {"expected a map of keys, got 3", ":1:"});
  expectError(std::string("CDF\x01\0\0\0\0", 8), "1:4: ", {"ASCII"});
}

TEST(BadDeck, indentation) {
  expectError("mesh:\n\tfile: a\n", "2:1: ", {"spaces, not tabs"});
  expectError("mesh:\n    file: a\n  generate: b\n", "3:3: ", {"matches no enclosing block"});
  expectError(" a: 1\nb: 2\n", "2:1: ", {"matches no enclosing block"});
  expectError("a:\n  b: 1\n  - 2\n", "3:3: ", {"must be indented below its key"});
  expectError("a:\n  - 2\n  b: 1\n", "3:3: ", {"expected a list item"});
  expectError("a:\n  - 2\nmesh:\n    file: a\n  block: b\n", "5:3: ", {"matches no enclosing block"});
  expectError("title: a\n   mesh: b\n", "2:", {"indented more"});
}

TEST(BadDeck, keysGivenTwice) {
  expectError("title: a\nmesh: {file: b}\ntitle: c\n", "3:1: ", {"'title' is given twice, first on line 1"});
  expectError("tools:\n  roll: {}\n  # once more\n  roll: {}\n",
              "4:3: ", {"'tools/roll' is given twice, first on line 2"});
  expectError("title: a\nmesh: {file: b, file: c}\n",
              "2:17: ", {"'mesh/file' is given twice, first on line 2"});
  expectError("tools: {roll: &r {}, flat: *r, roll: *r}\n", "1:32: ", {"'tools/roll' is given twice"});
}

TEST(BadDeck, whatIsNoYaml) {
  expectError("title: Strip: on a roll\n", "1:13: ", {"unexpected ':'", "quotes"});
  expectError("path: {order: 15\n  stop: 3}\n", "2:7: ", {"unexpected ':'", "','"});
  expectError("title: \"strip\n", "1:8: ", {"never closed"});
  expectError("title: 'it''s\n\nmesh: {file: 'a'}\n", "3:15: ", {"unexpected 'a'}'"});
  expectError("title: 'it''s\nmesh: \"a\"\n", "1:8: ", {"never closed"});
  expectError("mesh: {file: 'it''s', block: \"a\\\" # b\n} # 'c'\n", "1:30: ", {"never closed"});
  expectError("title: \"a\\q\"\n", "1:10: ", {"unknown escape '\\q'"});
  expectError("title: \"\\ä\"\n", "1:9: ", {"unknown escape '\\ä'"});
  expectError("mesh: {file: \"a\" ä}\n", "1:18: ", {"unexpected 'ä'"});
  expectError("mesh: {file: a\n", "1:7: ", {"'{' is never closed"});
  expectError("mesh: {file: [a}\n", "1:16: ", {"'}' closes nothing"});
  expectError("mesh: [a, b\n", "1:7: ", {"'[' is never closed"});
  expectError("mesh: [[1, 2], [3, 4\n", "1:16: ", {"'[' is never closed"});
  expectError("mesh: [[1, 2],\n [3, 4]\n", "1:7: ", {"'[' is never closed"});
  expectError(", a\n", "1:1: ", {"unexpected ','"});
  expectError("mesh: {a: [1]]\n", "1:14: ", {"']' closes nothing"});
  expectError("mesh: [\"a\" \"b\"]\n", "1:12: ", {"expected ',' or ']' for the '[' on line 1"});
  expectError("mesh: {file: \"a\"}, b\n", "1:18: ", {"unexpected ', b'", "line of its own"});
  expectError("mesh: - a\n", "1:7: ", {"a list item", "a line of its own"});
  expectError("title: @home\n", "1:8: ", {"unexpected '@'", "quotes"});
  expectError("title: ä@\nmesh: {ö: [ü}\n", "2:13: ", {"closes nothing"});  // characters, not bytes
  expectError("title: !!str 3\n", "1:8: ", {"tags"});
  expectError("title: !<a\n", "1:", {"tags are not used in decks"});
  expectError("title: \"a\\xg0\"\n", "1:", {"the escape is no character", "2 hexadecimal digits"});
  expectError("title: \"a\\ud800\"\n", "1:", {"the escape is no character"});
  expectError("%YAML 1.2 3\n---\na: 1\n", "1:1: ", {"no directives but '%YAML 1.2'"});
  expectError("%YAML 1.2\n%YAML 1.2\n---\na: 1\n", "2:1: ", {"no directives but '%YAML 1.2'"});
  expectError("%TAG ! !\n%TAG ! !\n---\na: 1\n", "2:1: ", {"no directives but '%YAML 1.2'"});
  expectError("%YAML x\n---\na: 1\n", "1:1: ", {"no directives but '%YAML 1.2'"});
  expectError("title: |x\n  a\n", "1:", {"'|' or '>'"});
  expectError("title: |0\n  a\n", "1:", {"'|' or '>'"});
  expectError("a: & b\n", "1:", {"a name of letters and digits after '&' or '*'"});
  expectError("a: *\n", "1:", {"a name of letters and digits after '&' or '*'"});
  expectError("a: &b &c d\n", "1:", {"one anchor at most"});
  expectError("[a, b]: 3\n", "1:1: ", {"a key must be a text"});
  expectError("mesh: {[a, b]: 3}\n", "1:8: ", {"a key must be a text"});
  expectError("mesh: {~: 3}\n", "1:8: ", {"a key must be a text"});
}

TEST(BadDeck, entriesWithoutColonOrBlank) {
  expectError("mesh: {file: a}\nsolver\n", "2:1: ", {"expected 'key: value', got 'solver'"});
  expectError("path:\n  order:15\n  stop: {steps: 3}\n", "3:7: ", {"line 2", "got 'order:15'", "blank"});
  expectError("mesh: {file:a}\n", "1:8: ", {"got 'file:a'", "a blank follows the colon"});
  expectError("poissons_ratio: 0,", "poissons_ratio: 0,3,", "7:82: ", {"'3'", "with a point: 0.3"});
  expectError("radius: 50", "\n    radius: 0,5 }\n  other: {radius: 1,", "17:15: ", {"'5'", "0.3"});
}

TEST(BadDeck, textThatIsNoUtf8) {
  expectError("title: Tr\xE4ger\n", "1:10: ", {"0xe4", "UTF-8"});  // Latin-1
  expectError("a: 1\ntitle: \xC3", "2:8: ", {"0xc3", "UTF-8"});    // cut short
  expectError("title: \xC0\xAF\n", "1:8: ", {"0xc0"});             // overlong
  expectError("title: \xED\xA0\x80\n", "1:8: ", {"0xed"});         // half of a pair
  expectError("\xFF\xFEt\0i\0", "1:1: ", {"0xff"});                // UTF-16
  expectError("a: 1\rtitle: b\n", "1:5: ", {"control character U+000D"});
  expectError("title: a\x04\n", "1:9: ", {"control character U+0004"});
  expectError("title: ä\x7f\n", "1:9: ", {"control character U+007F"});
  expectError("title: ä\xC2\x85\n", "1:9: ", {"control character U+0085"});
  expectError("title: \xE2\x80\xA8\n", "1:8: ", {"control character U+2028"});
}

TEST(BadDeck, aliases) {
  expectError("tools: {roll: *r}\n", "1:15: ", {"no anchor '&r' stands before"});
  expectError("tools: &t {roll: *t}\n", "1:18: ", {"stands within what it names"});
  expectError("tools: &t {roll: {<<: *t}}\n", "1:23: ", {"stands within what it names"});
  expectError("a: &x b\ntools: {*x}\n", "2:9: ", {"'key: *alias'"});
  expectError("a: &x b\ntools: {<<: *x}\n", "2:9: ", {"'<<' takes a map"});
  expectError("tools: {<<: {a: 1}, <<: {b: 1}}\n", "1:21: ", {"'tools/<<' is given twice"});
  // Ten times ten times ...: 10^9 values in 9 lines.
  std::string laughs = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 9; ++i) {
    laughs += fmt::format(
        "a{0}: &a{0} [*a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}]\n", i, i - 1);
  }
  expectError(laughs, "", {"the aliases stand for more than 1000000 values"});
}

TEST(BadDeck, nestedDeeply) {
  const std::string brackets(100000, '[');
  expectError("a: " + brackets, "1:", {"more than 64 deep"});
  expectError("a: " + brackets + std::string(100000, ']'), "1:67: ", {"more than 64 deep"});
  std::string text = "a:\n  ";
  for (int i = 0; i < 100000; ++i) text += "- ";
  expectError(text + "b\n", "2:129: ", {"more than 64 deep"});
  text = "a: ";
  for (int i = 0; i < 100000; ++i) text += "{a: ";
  expectError(text, "1:", {"more than 64 deep"});
  text.clear();
  for (int i = 0; i < 100; ++i) text += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  expectError(text, "65:65: ", {"more than 64 deep"});
}

TEST(BadDeck, listsThatDoNotFit) {
  expectError("blocks: [strip]", "blocks: []", "materials/steel/blocks: expected a list of names",
              {"an empty list"});
  expectError("blocks: [strip]", "blocks: [true, 1]", "materials/steel/blocks: expected a list of names",
              {"the list [true, 1]"});
  expectError("blocks: [strip]", "blocks: [{a: b}]", "materials/steel/blocks: expected a list of names",
              {"a list of maps"});
  expectError("blocks: [strip]", "blocks: [strip, ~]", "materials/steel/blocks: expected a list of names",
              {"[strip, null]"});
  expectError("axis: [0, 1, 0]", "axis: []", "tools/roll/axis: expected a list of 3 finite numbers",
              {"an empty list"});
  const std::string points = "{type: patches, surfaces: {s: {degree: [1, 1], points: ";
  const std::string cylinder = "{type: cylinder, center: [200, 0, -54.4], axis: [0, 1, 0], radius: 50}";
  for (const std::string rows :
       {"[[1, 2, 3], [4]]", "[[1, 2, 3], 4]", "[[1, 2, a]]", "[]", "[[]]", "{a: [1, 2, 3]}"}) {
    expectError(cylinder, points + rows + "}}}",
                "tools/roll/surfaces/s/points: expected a list of lists of 3 finite numbers", {});
  }
  expectError("loads:\n  tip: ", "loads:\n  - ",
              "loads/item 1: has no name; expected a map with the key name", {":14:"});
  expectError("loads:\n  tip: ", "loads:\n  - 3\n  - ", "loads/item 1: has no name", {});
  expectError("tip: {", "- {name: tip, type: volume, blocks: strip, force: [0, 0, 1]}\n  - {name: tip, ",
              "loads/item 2/name: 'tip' is given twice, first on line 14", {":15:"});
}

TEST(BadDeck, textsThatAreNoLine) {
  expectError("title: Strip on a roll", "title: \"a\\tb\"",
              "title: must be one line, without control characters", {});
  expectError("title: Strip on a roll", "title: |\n  a\n  b", "title: must be one line", {"'>'", ":2:"});
  expectError("set: z_min", "set: \"z\\0\"", "contact/lower/set: must be one line", {});
  for (const std::string end : {"\\e[2J", "\\x7f", "\\x85", "\\x9b", "\\u2028", "\\L"}) {
    SCOPED_TRACE(end);
    expectError("title: Strip on a roll", "title: \"a" + end + "\"", "title: must be one line", {});
    expectError("title:", "\"a" + end + "\":", "2:1: a key is at most 200 bytes without control characters",
                {});
    expectError("radius: 50", "radius: \"a" + end + "b\"",
                "tools/roll/radius: expected a finite number, got the text 'a ", {});
  }
}

TEST(BadDeck, unknownKeys) {
  expectError("path:", "paths:", "paths: is not a key here",
              {"did you mean 'path'?", "allowed are title, mesh,"});
  expectError("radius: 50", "raduis: 50", "tools/roll/raduis: is not a key here",
              {"did you mean 'radius'?", "allowed are type, center, axis, radius", ":16:"});
  expectError("order: 15", "zzz: 15", "path/zzz: is not a key here;",
              {"allowed are method, order, accuracy"});
  expectError("{value: 0.5,", "{valeu: 0.5,", "supports/pull/x/valeu: is not a key", {"'value'", ":12:"});
  expectError("{type: cylinder", "{type: plane", "tools/roll/center: is not a key here", {"point, normal"});
  expectError("lengths:", "length:", "mesh/generate/length: is not a key here", {"did you mean 'lengths'?"});
  expectError("{load_factor:", "{load_facto:", "path/stop/load_facto: ", {"'load_factor'"});
}

TEST(BadDeck, missingBlocksAndKeys) {
  expectError("mesh: {file: a}\n", "materials: is missing",
              {"expected a map of named entries, each with law"});
  for (const std::string block : {"materials", "supports", "path"}) {
    std::string text = goodDeck;
    const auto begin = text.find(block + ":");
    auto end = begin;
    do {  // to the next line that is not indented
      end = text.find('\n', end) + 1;
    } while (text[end] == ' ');
    expectError(text.erase(begin, end - begin), block + ": is missing", {"expected a map"});
  }
  expectError("  file: strip.exo\n", "", "mesh/file: is missing; expected a file name", {":3:"});
  expectError(", radius: 50", "", "tools/roll/radius: is missing; expected a number, positive", {":16:"});
  expectError("{type: cylinder, ", "{",
              "tools/roll/type: is missing; expected one of cylinder, plane, sphere", {});
  expectError(", poissons_ratio: 0", "", "materials/steel/poissons_ratio: is missing",
              {"above -1 and below 0.5"});
  expectError("  stop: {load_factor: 0.25}\n", "", "path/stop: is missing", {"load_factor, steps"});
  expectError("{load_factor: 0.25}", "{}", "path/stop: is empty", {"at least one of load_factor"});
  expectError("  roll: {type: cylinder, center: [200, 0, -54.4], axis: [0, 1, 0], radius: 50}\n", "",
              "tools: is empty; expected a map of named entries", {":15:"});
  expectError("path:", "solver: {type: amesos2}\npath:", "solver/name: is missing", {"klu2"});
}

TEST(BadDeck, wrongTypes) {
  expectError("radius: 50", "radius: big", "tools/roll/radius: expected a finite number, got the text 'big'",
              {});
  expectError("radius: 50", "radius: \"50\"",
              "tools/roll/radius: expected a finite number, got the text '50'", {});
  expectError("radius: 50", "radius: [50]", "tools/roll/radius: expected a finite number, got the list [50]",
              {});
  expectError("radius: 50", "radius: {}", "tools/roll/radius: expected a finite number, got an empty map",
              {});
  expectError("radius: 50", "radius: true", "tools/roll/radius: expected a finite number, got true", {});
  expectError("order: 15", "order: 15.5", "path/order: expected a whole number, got 15.5", {});
  expectError("order: 15", "order: 3000000000", "path/order: expected a whole number of at most 2147483647",
              {"got 3000000000"});
  expectError("title: Strip on a roll", "title: no", "title: expected a text, got false", {"quotes", ":2:"});
  expectError("title: Strip on a roll", "title: 3", "title: expected a text, got 3", {"quotes"});
  expectError("title: Strip on a roll", "title: ''", "title: must not be empty", {});
  expectError("title: Strip on a roll", "title:", "title: expected a text, got an empty value", {});
  expectError("axis: [0, 1, 0]", "axis: [0, 1]",
              "tools/roll/axis: expected a list of 3 finite numbers, got the list [0, 1]", {});
  expectError("axis: [0, 1, 0]", "axis: y",
              "tools/roll/axis: expected a list of 3 finite numbers, got the text 'y'", {});
  expectError("axis: [0, 1, 0]", "axis: [[0, 1], [0, 1]]",
              "tools/roll/axis: expected a list of 3 finite numbers", {"a list of lists"});
  expectError("divisions: [10, 2, 1]", "divisions: [10, 2.5, 1]",
              "mesh/generate/divisions: expected a list of 3 whole numbers", {"[10, 2.5, 1]"});
  expectError("set: x_min", "set: 1.5", "supports/clamp/set: expected a name or id, got 1.5", {});
  expectError("blocks: [strip]", "blocks: [1.5]", "materials/steel/blocks: expected a list of names or ids",
              {});
  expectError("blocks: [strip]", "blocks: [strip, strip]", "materials/steel/blocks: 'strip' is given twice",
              {});
  expectError("x: {value: 0.5, per_load_factor: 1.5}", "x: free", "supports/pull/x: expected a finite number",
              {"'free'", ":12:"});
  expectError("total: [0, 0, -100]}", "total: [0, 0, -100], constant: 1}",
              "loads/tip/constant: expected true or false, got 1", {});
  expectError("clamp: {set: x_min, x: 0, y: 0, z: 0}", "clamp: 3",
              "supports/clamp: expected a map of keys, got 3", {});
  expectError("clamp:", "clamp/1:", "supports/clamp/1: a name is made of letters", {});
}

TEST(BadDeck, numbersThatAreNone) {
  for (const std::string word :
       {"nan",  ".nan", "inf", "-inf", ".inf", "1e400", "1e-400", "0x10", "1d3",   "1_000",
        "1:30", "0o7",  "1e",  "e1",   ".",    "+",     "+-1",    "1-2",  "0x1p3", "1 000"}) {
    SCOPED_TRACE(word);
    expectError("radius: 50", "radius: " + word,
                "tools/roll/radius: expected a finite number, got the text '" + word + "'", {":16:"});
    expectError("axis: [0, 1, 0]", "axis: [0, " + word + ", 0]",
                "tools/roll/axis: expected a list of 3 finite numbers, got the list [0, " + word + ", 0]",
                {});
  }
}

TEST(BadDeck, nothingWhereANumberIsWanted) {
  for (const std::string word : {"", "~", "null", "Null", "NULL"}) {
    SCOPED_TRACE(word);
    expectError("radius: 50", "radius: " + word,
                "tools/roll/radius: expected a finite number, got an empty value", {":16:"});
  }
  expectError("axis: [0, 1, 0]", "axis: [0, ~, 0]", "tools/roll/axis: expected a list of 3 finite numbers",
              {"got the list [0, null, 0]"});
  expectError("radius: 50", "radius:", "tools/roll/radius: expected a finite number, got an empty value", {});
  expectError("order: 15", "order: 1,5", "path/order: expected a whole number",
              {"the text '1,5'", "a point: 1.5"});
  expectError("order: 15", "weight: 1,5", "path/weight: expected a finite number, got the text '1,5'",
              {"a point: 1.5"});
}

TEST(BadDeck, valuesOutOfRange) {
  expectError("radius: 50", "radius: -50", "tools/roll/radius: must be positive, got -50", {":16:"});
  expectError("radius: 50", "radius: 0.0", "tools/roll/radius: must be positive, got 0", {});
  expectError("axis: [0, 1, 0]", "axis: [0, 0.0, 0]", "tools/roll/axis: must not be the zero vector", {});
  expectError("order: 15", "order: 0", "path/order: must be from 1 to 60, got 0", {});
  expectError("order: 15", "order: 61", "path/order: must be from 1 to 60, got 61", {});
  expectError("order: 15", "accuracy: 1", "path/accuracy: must be above 0 and below 1, got 1", {});
  expectError("order: 15", "residual: -1e-6", "path/residual: must be above 0 and below 1, got -1e-6", {});
  expectError("order: 15", "direction: 0", "path/direction: must be 1 or -1, got 0", {});
  expectError("load_factor: 0.25", "load_factor: 0", "path/stop/load_factor: must be different from zero",
              {});
  expectError("load_factor: 0.25", "steps: 0", "path/stop/steps: must be at least 1, got 0", {});
  expectError("load_factor: 0.25", "path_length: -1", "path/stop/path_length: must be positive, got -1", {});
  expectError("load_factor: 0.25", "limit_point: 0", "path/stop/limit_point: must be at least 1, got 0", {});
  expectError("load_factor: 0.25", "bifurcation: 1.5", "path/stop/bifurcation: expected a whole number",
              {"1.5"});
  expectError("poissons_ratio: 0,", "poissons_ratio: 0.5,",
              "materials/steel/poissons_ratio: must be above -1 and", {});
  expectError("youngs_modulus: 220000", "youngs_modulus: 0",
              "materials/steel/youngs_modulus: must be positive", {});
  expectError("lengths: [10, 2.0, 1]", "lengths: [10, 2.0, -1]",
              "mesh/generate/lengths: each length must be positive", {"[10, 2.0, -1]"});
  expectError("divisions: [10, 2, 1]", "divisions: [10, 0, 1]",
              "mesh/generate/divisions: each number must be at least 1", {});
  expectError("stiffness: 1.0e3", "stiffness: 0", "contact/lower/stiffness: must be positive, got 0", {});
  expectError("stiffness: 1.0e3", "stiffness: stiff",
              "contact/lower/stiffness: expected a positive number, rigid or auto", {"'stiff'"});
  expectError("regularisation: 0.1", "regularisation: 0.1, reference_gap: 1.0e-4",
              "contact/lower/reference_gap: must be above regularisation/stiffness = 0.0001, got 1.0e-4", {});
  expectError("regularisation: 0.1", "regularisation: 0.1, quadrature_degree: 0",
              "contact/lower/quadrature_degree: must be from 1", {});
  expectError("output:", "output:\n  parts: some", "output/parts: expected true or false", {"'some'"});
  expectError("output:", "output:\n  fields_every: 0", "output/fields_every: must be at least 1, got 0", {});
  expectError("output:", "output:\n  residuals: all", "output/residuals: 'all' is not a choice here",
              {"steps", "points"});
  expectError("output:", "output:\n  points_per_step: 0",
              "output/points_per_step: must be from 1 to 10000, got 0", {});
  const std::string box = "shape: box, lengths: [10, 2.0, 1]";
  expectError(box, "shape: strip, length: 1, width: 1, thickness: -0.8",
              "mesh/generate/thickness: must be positive, got -0.8", {});
  expectError(box, "shape: cylinder_panel, mid_radius: 1, thickness: 2, theta: [0, 90], length: 1",
              "mesh/generate/thickness: must be below twice mid_radius = 1, got 2", {});
  expectError(box, "shape: cylinder_panel, mid_radius: 1, thickness: 0.1, theta: [90, 0], length: 1",
              "mesh/generate/theta: must ascend, got the list [90, 0]", {});
  expectError(box,
              "shape: sphere_panel, mid_radius: 1, thickness: 0.1, longitude: [0, 90], latitude: [0, 90]",
              "mesh/generate/latitude: must stay above -90 and below 90 degrees", {});
}

/// The good deck with another tool.
std::string withTool(const std::string& tool) {
  return changed("{type: cylinder, center: [200, 0, -54.4], axis: [0, 1, 0], radius: 50}", tool);
}

TEST(Deck, tools) {
  const auto read = [](const std::string& tool) {
    const Deck deck = readDeckText(withTool(tool), "tools.yaml");
    std::ostringstream once, twice;
    describe(deck, once);
    describe(readDeckText(once.str(), "tools.yaml"), twice);
    EXPECT_EQ(once.str(), twice.str());
    return deck.tools[0].surface;
  };
  const auto patches = std::get<PatchesTool>(read(
      "{type: patches, reversed: true, thickness: 2, surfaces: {a: {degree: [1, 1], points: [[0, 0, 0], [0, "
      "1, 0.5], [1, 0, 0], [1, 1, 0]]}, b: {degree: [1, 1], points: [[1, 0, 0], [1, 1, 0], [2, 0, 0], [2, "
      "1, 0]], weights: [1, 1, 1, 2], knots_1: [0, 0, 1, 1], knots_2: [0, 0, 1, 1]}}}"));
  ASSERT_EQ(patches.surfaces.size(), 2u);
  EXPECT_TRUE(patches.reversed);
  EXPECT_EQ(patches.thickness, 2.0);
  EXPECT_EQ(patches.surfaces[0].points[1], (Vector3{0, 1, 0.5}));
  EXPECT_TRUE(patches.surfaces[0].weights.empty());
  EXPECT_EQ(patches.surfaces[1].points[3], (Vector3{2, 1, 0}));
  EXPECT_EQ(patches.surfaces[1].weights, (std::vector<double>{1, 1, 1, 2}));
  EXPECT_EQ(patches.surfaces[1].knots[1], (std::vector<double>{0, 0, 1, 1}));
  EXPECT_EQ(std::get<CylinderTool>(
                read("{type: cylinder, center: [1, 2, 3], axis: [0, 1, 0], radius: 4, side: inside}"))
                .side,
            Side::Inside);
  const auto sphere = std::get<SphereTool>(read("{type: sphere, center: [1, 2, 3], radius: 4}"));
  EXPECT_EQ(sphere.center, (Vector3{1, 2, 3}));
  EXPECT_EQ(sphere.radius, 4.0);
  EXPECT_EQ(sphere.side, Side::Outside);
  const auto cone = std::get<ConeTool>(
      read("{type: cone, apex: [1, 2, 3], axis: [0, 0, 2], half_angle: 30, side: inside}"));
  EXPECT_EQ(cone.apex, (Vector3{1, 2, 3}));
  EXPECT_EQ(cone.axis, (Vector3{0, 0, 2}));
  EXPECT_EQ(cone.halfAngle, 30.0);
  EXPECT_EQ(cone.side, Side::Inside);
  const auto torus = std::get<TorusTool>(
      read("{type: torus, center: [1, 2, 3], axis: [0, 1, 0], radius: 5, tube_radius: 1.5}"));
  EXPECT_EQ(torus.radius, 5.0);
  EXPECT_EQ(torus.tubeRadius, 1.5);
  const auto taper = std::get<TaperedRollTool>(
      read("{type: tapered_roll, center: [200, 0, -54], axis: [0, 1, 0], radius: 50, flat: 15, "
           "angle: -5.7, smoothing: 0.04, ends: one}"));
  EXPECT_EQ(taper.flat, 15.0);
  EXPECT_EQ(taper.angle, -5.7);
  EXPECT_EQ(taper.smoothing, 0.04);
  EXPECT_EQ(taper.ends, TaperedRollTool::Ends::One);
  const auto crown = std::get<CrownedRollTool>(
      read("{type: crowned_roll, center: [0, 0, -50], axis: [0, 1, 0], coefficients: [50, 0, -1.0e-4]}"));
  EXPECT_EQ(crown.coefficients, (std::vector<double>{50, 0, -1e-4}));
  const auto table =
      std::get<CrownedRollTool>(read("{type: crowned_roll, center: [0, 0, -50], axis: [0, 1, 0], places: "
                                     "[-10, 0, 10], radii: [49, 50, 49]}"));
  EXPECT_EQ(table.places, (std::vector<double>{-10, 0, 10}));
  EXPECT_EQ(table.radii, (std::vector<double>{49, 50, 49}));
}

TEST(Deck, motions) {
  const auto read = [](const std::string& motion) {
    const std::string text =
        withTool("{type: sphere, center: [0, 0, -9], radius: 1, motion: {" + motion + "}}");
    const Deck deck = readDeckText(text, "tools.yaml");
    std::ostringstream once, twice;
    describe(deck, once);
    describe(readDeckText(once.str(), "tools.yaml"), twice);
    EXPECT_EQ(once.str(), twice.str());
    return deck.tools[0].motion;
  };
  EXPECT_EQ(read("shift: [0, 0, 1.5]").shift, (std::vector<Vector3>{{0, 0, 1.5}}));
  const ToolMotion both =
      read("shift: [[0, 0, 1], [0, 2, 0]], angle: [30], axis: [0, 2, 0], pivot: [1, 2, 3]");
  EXPECT_EQ(both.shift, (std::vector<Vector3>{{0, 0, 1}, {0, 2, 0}}));
  EXPECT_EQ(both.angle, std::vector<double>{30});
  EXPECT_EQ(both.axis, (Vector3{0, 2, 0}));
  EXPECT_EQ(both.pivot, (Vector3{1, 2, 3}));
}

TEST(Deck, contactLaws) {
  const auto read = [](const std::string& law) {
    const std::string text = changed("stiffness: 1.0e3, regularisation: 0.1", law);
    const Deck deck = readDeckText(text, "laws.yaml");
    std::ostringstream once, twice;
    describe(deck, once);
    describe(readDeckText(once.str(), "laws.yaml"), twice);
    EXPECT_EQ(once.str(), twice.str());
    return deck.contacts[0];
  };
  const Contact plain = read("law: hyperbola");
  EXPECT_FALSE(plain.stiffness);
  EXPECT_FALSE(plain.isRigid());
  EXPECT_FALSE(plain.regularisation);
  EXPECT_TRUE(read("law: barrier, regularisation: 0.5").isRigid());
  const Contact power = read("law: power, stiffness: rigid, exponent: 3");
  EXPECT_TRUE(power.isRigid());
  EXPECT_EQ(power.exponent, 3.0);
  const Contact exponential = read("law: exponential, touching: 2, length: auto");
  EXPECT_EQ(exponential.touching, 2.0);
  EXPECT_FALSE(exponential.length);
  const Contact penalty = read("law: penalty, stiffness: auto, length: 0.5");
  EXPECT_FALSE(penalty.stiffness);
  EXPECT_EQ(penalty.length, 0.5);
}

TEST(BadDeck, tools) {
  const std::string cylinder = "{type: cylinder, center: [200, 0, -54.4], axis: [0, 1, 0], radius: 50}";
  const auto refused = [&](const std::string& tool, const std::string& start,
                           const std::vector<std::string>& words) {
    expectError(cylinder, tool, start, words);
  };
  refused("{type: sphere, center: [0, 0, 0], radius: -1}", "tools/roll/radius: must be positive", {"-1"});
  refused("{type: sphere, center: [0, 0, 0], radius: 1, side: below}",
          "tools/roll/side: 'below' is not a choice", {"outside, inside"});
  refused("{type: cone, apex: [0, 0, 0], axis: [0, 1, 0], half_angle: 90}",
          "tools/roll/half_angle: must be above 0 and below 90 degrees", {"90"});
  refused("{type: torus, center: [0, 0, 0], axis: [0, 0, 0], radius: 2, tube_radius: 1}",
          "tools/roll/axis: must not be the zero vector", {});
  refused("{type: tapered_roll, center: [0, 0, 0], axis: [0, 1, 0], radius: 2, flat: 1, angle: 1}",
          "tools/roll/smoothing: is missing", {"positive"});
  refused("{type: crowned_roll, center: [0, 0, 0], axis: [0, 1, 0]}", "tools/roll: needs either coefficients",
          {});
  refused(
      "{type: crowned_roll, center: [0, 0, 0], axis: [0, 1, 0], coefficients: [1], places: [1, 2], radii: "
      "[1, 1]}",
      "tools/roll: needs either coefficients, or places and radii", {});
  refused("{type: crowned_roll, center: [0, 0, 0], axis: [0, 1, 0], places: [1, 2]}",
          "tools/roll/radii: is missing", {});
  refused("{type: crowned_roll, center: [0, 0, 0], axis: [0, 1, 0], coefficients: big}",
          "tools/roll/coefficients: expected a list of finite numbers", {"big"});
}

TEST(Deck, rubberLaws) {
  const auto law = [](const std::string& keys) {
    std::stringstream printed;
    describe(
        readDeckText(changed("law: saint_venant_kirchhoff, youngs_modulus: 220000, poissons_ratio: 0", keys),
                     "x.yaml"),
        printed);
    return readDeckText(printed.str(), "printed.yaml");
  };
  Deck deck = law("law: neo_hookean, youngs_modulus: 2.1, poissons_ratio: 0.4");
  EXPECT_EQ(std::get<NeoHookean>(deck.materials[0].law).youngsModulus, 2.1);
  EXPECT_EQ(largestYoungsModulus(deck), 2.1);
  // E = 9 kappa mu/(3 kappa + mu)
  const double E = 9 * 5.0 * 0.8 / (3 * 5 + 0.8);
  deck = law("law: neo_hookean, shear_modulus: 0.8, bulk_modulus: 5");
  EXPECT_FALSE(std::get<NeoHookean>(deck.materials[0].law).youngsModulus);
  EXPECT_DOUBLE_EQ(largestYoungsModulus(deck), E);
  deck = law("law: mooney_rivlin, c1: 0.5, c2: -0.1, bulk_modulus: 5");
  EXPECT_EQ(std::get<MooneyRivlin>(deck.materials[0].law).c2, -0.1);
  EXPECT_DOUBLE_EQ(largestYoungsModulus(deck), E);
  deck = law("law: yeoh, c1: 0.4, c2: -0.05, c3: 0.01, bulk_modulus: 5");
  EXPECT_EQ(std::get<Yeoh>(deck.materials[0].law).c3, 0.01);
  EXPECT_DOUBLE_EQ(largestYoungsModulus(deck), E);
  deck = law("law: gent, shear_modulus: 0.8, limit: 40, bulk_modulus: 5");
  EXPECT_EQ(std::get<Gent>(deck.materials[0].law).limit, 40);
  EXPECT_DOUBLE_EQ(largestYoungsModulus(deck), E);
  deck = law("law: ogden, mu: [1.2, -0.1], alpha: [1.25, -1], bulk_modulus: 5");
  EXPECT_EQ(std::get<Ogden>(deck.materials[0].law).alpha, (std::vector<double>{1.25, -1}));
  EXPECT_DOUBLE_EQ(largestYoungsModulus(deck), E);
}

TEST(BadDeck, rubberLaws) {
  const auto refused = [](const std::string& keys, const std::string& message) {
    expectError("law: saint_venant_kirchhoff, youngs_modulus: 220000, poissons_ratio: 0", keys, message, {});
  };
  const std::string pair =
      "materials/steel: needs either youngs_modulus and poissons_ratio or shear_modulus and bulk_modulus";
  refused("law: neo_hookean", pair);
  refused("law: neo_hookean, youngs_modulus: 1", pair);
  refused("law: neo_hookean, youngs_modulus: 1, bulk_modulus: 1", pair);
  refused("law: neo_hookean, youngs_modulus: 1, poissons_ratio: 0.3, shear_modulus: 1, bulk_modulus: 1",
          pair);
  refused("law: neo_hookean, shear_modulus: -1, bulk_modulus: 1",
          "materials/steel/shear_modulus: must be positive, got -1");
  refused("law: mooney_rivlin, c1: 0.1, c2: -0.1, bulk_modulus: 1",
          "materials/steel/c2: c1 + c2, half the shear modulus at rest, must be positive, got 0");
  refused("law: mooney_rivlin, c1: 0.1, c2: 0.1", "materials/steel/bulk_modulus: is missing");
  refused("law: yeoh, c1: 0, c2: 1, c3: 1, bulk_modulus: 1", "materials/steel/c1: must be positive, got 0");
  refused("law: gent, shear_modulus: 1, limit: 0, bulk_modulus: 1",
          "materials/steel/limit: must be positive, got 0");
  refused("law: gent, shear_modulus: 1, limit: 5, bulk_modulus: 0",
          "materials/steel/bulk_modulus: must be positive, got 0");
  refused("law: ogden, mu: [], alpha: [], bulk_modulus: 1",
          "materials/steel/mu: expected a list of finite numbers, got an empty list");
  refused("law: ogden, mu: [1, 1, 1, 1, 1, 1, 1], alpha: [1], bulk_modulus: 1",
          "materials/steel/mu: expected one to 6 numbers, got 7");
  refused("law: ogden, mu: [1, 2], alpha: [1], bulk_modulus: 1",
          "materials/steel/alpha: expected as many numbers as mu has, 2, got 1");
  refused("law: ogden, mu: [1, 0], alpha: [1, 2], bulk_modulus: 1", "materials/steel/mu: no number may be 0");
  refused("law: ogden, mu: [1], alpha: [41], bulk_modulus: 1",
          "materials/steel/alpha: no number may be 0 or beyond 40, got 41");
  refused("law: ogden, mu: [1, 1], alpha: [2, -2], bulk_modulus: 1",
          "materials/steel/mu: half the sum of mu alpha, the shear modulus at rest, must be positive, got 0");
}

TEST(BadDeck, choices) {
  expectError("type: cylinder", "type: cilinder", "tools/roll/type: 'cilinder' is not a choice here",
              {"did you mean 'cylinder'?",
               "expected one of cylinder, plane, sphere, cone, torus, tapered_roll, crowned_roll"});
  expectError("law: saint_venant_kirchhoff", "law: mooney", "materials/steel/law: 'mooney' is not a choice",
              {});
  expectError("cell: HEX20", "cell: HEX21", "mesh/generate/cell: 'HEX21' is not a choice here",
              {"HEX8, HEX20, HEX27"});
  expectError("component: z", "component: w", "output/monitors/tip_uz/component: 'w' is not a choice here",
              {"one of x, y, z"});
  expectError("component: z", "component: 3",
              "output/monitors/tip_uz/component: expected one of x, y, z, got 3", {});
  expectError("output:", "output:\n  fields: [displacement, strain]",
              "output/fields: 'strain' is not a choice here", {});
  expectError("output:", "output:\n  fields: [stress, stress]", "output/fields: 'stress' is given twice", {});
  expectError("path:", "solver: {type: pardiso}\npath:", "solver/type: 'pardiso' is not a choice",
              {"mumps, amesos2"});
}

TEST(BadDeck, keysThatContradictEachOther) {
  expectError("total: [0, 0, -100]", "total: [0, 0, -100], pressure: 1",
              "loads/tip: needs exactly one of total, traction, pressure, got total, pressure", {":14:"});
  expectError(", total: [0, 0, -100]", "",
              "loads/tip: needs exactly one of total, traction, pressure, got none", {});
  expectError("type: surface, set: x_max, total: [0, 0, -100]", "type: nodal, set: x_max",
              "loads/tip: needs exactly one of total, per_node, got none", {});
  expectError("clamp: {set: x_min, x: 0, y: 0, z: 0}", "clamp: {set: x_min}",
              "supports/clamp: holds nothing; expected at least one of x, y, z", {":9:"});
  expectError("regularisation: 0.1", "regularisation: 0.1, points: nodes, quadrature_degree: 3",
              "contact/lower/quadrature_degree: has no meaning with points: nodes", {});
  expectError("path:", "solver: {type: mumps, name: klu2}\npath:",
              "solver/name: has no meaning with type: mumps", {});
  expectError("stiffness: 1.0e3, regularisation: 0.1}\npath:", "law: hard}\nsolver: belos\npath:", "solver: ",
              {"contact/lower", "expected mumps"});
}

TEST(BadDeck, references) {
  expectError("tool: roll", "tool: rol", "contact/lower/tool: no entry 'rol' in tools (did you mean 'roll'?)",
              {"there are roll", ":18:"});
  expectError("tools:\n  roll: {type: cylinder, center: [200, 0, -54.4], axis: [0, 1, 0], radius: 50}\n", "",
              "contact/lower/tool: no entry 'roll' in tools; there are none", {});
  expectError("{load_factor: 0.25}", "{displacement: {tip_ux: -50}}",
              "path/stop/displacement/tip_ux: no entry 'tip_ux' in output/monitors (did you mean 'tip_uz'?)",
              {});
  expectError("supports:",
              "  other: {law: saint_venant_kirchhoff, youngs_modulus: 1, poissons_ratio: 0, blocks: "
              "[strip]}\nsupports:",
              "materials/other/blocks: block 'strip' already has the material 'steel'", {":8:"});
  const std::string monitor = "{type: displacement, set: x_max, component: z}";
  expectError(monitor, "{type: contact_force, contact: upper}",
              "output/monitors/tip_uz/contact: no entry 'upper' in contact", {"there are lower"});
  expectError(monitor, "{type: reaction, support: clam, component: z}",
              "output/monitors/tip_uz/support: no entry 'clam' in supports (did you mean 'clamp'?)", {});
  expectError(monitor, "{type: reaction, support: pull, component: z}",
              "output/monitors/tip_uz/component: support 'pull' does not hold z", {});
  std::string text = changed(monitor, "{type: contact_force, contact: lower}");
  text.replace(text.find("{load_factor: 0.25}"), 19, "{displacement: {tip_uz: -50}}");
  expectError(text, "path/stop/displacement/tip_uz: the monitor 'tip_uz' is not of type displacement", {});
  // Without contact the tool is idle and the default fields leave contact out.
  const std::string contact =
      "contact:\n  lower: {tool: roll, set: z_min, stiffness: 1.0e3, regularisation: 0.1}\n";
  EXPECT_EQ(errorOf(changed(contact, "")), "no error");
  std::string withField = changed(contact, "");
  withField.replace(withField.find("output:"), 7, "output:\n  fields: [contact]");
  expectError(withField, "output/fields: 'contact' needs the block contact", {":21:"});
}

TEST(BadDeck, pathKeys) {
  expectError("order: 15", "order: best", "path/order:", {"'best'", "auto"});
  expectError("order: 15", "weight: -1", "path/weight:", {"positive", "-1"});
  expectError("order: 15", "pade: perhaps", "path/pade:", {"'perhaps'", "off, automatic, on"});
  expectError("order: 15", "branches: yes", "path/branches:", {"none, stable, all"});
  expectError("order: 15", "branch_depth: -1", "path/branch_depth:", {"at least 0"});
  expectError("order: 15", "restart: 3", "path/restart:", {"true or false"});
  expectError("load_factor: 0.25", "load_factor: [1, 0]", "path/stop/load_factor:", {"different from zero"});
  expectError("load_factor: 0.25", "monitors: {tip_uz: 1}",
              "path/stop/monitors:", {"did you mean 'monitor'?"});
  expectError("{load_factor: 0.25}", "{bifurcation: 1}\n  critical_points: off",
              "path/stop/bifurcation: ", {"needs path/critical_points: automatic or every_step"});
  expectError("order: 15\n  stop: {load_factor: 0.25}", "method: newton\n  stop: {bifurcation: 1}",
              "path/stop/bifurcation: ", {"needs path/method: series", "newton"});
  expectError("{load_factor: 0.25}", "{bifurcation: 1}\nsolver: auto",
              "path/stop/bifurcation: ", {"that needs solver/type: mumps"});
  expectError("order: 15", "branches: all\n  critical_points: off", "path/branches:", {"critical_points"});
}

TEST(BadDeck, nothingToDrive) {
  std::string text = changed("per_load_factor: 1.5", "per_load_factor: 0");
  EXPECT_EQ(errorOf(text), "no error");
  text.replace(text.find("-100]"), 5, "0]");
  expectError(text, "nothing depends on the load factor", {"per_load_factor"});
  text.replace(text.find("0, 0, 0]}"), 9, "0, 0, 1], constant: true}");
  expectError(text, "nothing depends on the load factor", {"per_load_factor"});
}

// A deck cut off or damaged anywhere is refused in one line or still a deck; nothing else escapes.
TEST(BadDeck, damagedAnywhere) {
  const std::string good = goodDeck;
  int refused = 0;
  const auto tryDeck = [&](const std::string& text) {
    try {
      readDeckText(text, "d.yaml");
    } catch (const DeckError& error) {
      ++refused;
      const std::string line = error.what();
      EXPECT_EQ(line.find("d.yaml:"), 0u) << line;
      EXPECT_EQ(line.find('\n'), std::string::npos) << line << "\n" << text;
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what() << "\n" << text;
    }
  };
  for (std::size_t i = 0; i < good.size(); ++i) {
    tryDeck(good.substr(0, i));
    tryDeck(good.substr(0, i) + good.substr(i + 1));
    tryDeck(good.substr(0, i) + "]{:-'#,"[i % 7] + good.substr(i + 1));
  }
  EXPECT_GT(refused, static_cast<int>(good.size()));  // all but the last prefixes, to begin with
}

// ------------------------------------------------------------------------------------ against the mesh

namespace {

std::string meshErrorOf(const std::string& from, const std::string& to, const fem::Mesh* mesh = nullptr) {
  const Deck deck = readDeckText(changed(from, to), "solid.yaml");
  try {
    checkAgainstMesh(deck,
                     mesh != nullptr ? *mesh : fem::boxMesh(std::get<fem::BoxOptions>(*deck.mesh.generate)));
  } catch (const DeckError& error) {
    return error.what();
  }
  return "no error";
}

void expectMeshError(const std::string& from, const std::string& to, const std::string& start,
                     const std::string& words) {
  const std::string error = meshErrorOf(from, to);
  EXPECT_EQ(behindPlace(error).find(start), 0u) << error;
  EXPECT_NE(error.find(words), std::string::npos) << error;
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
}

// The lines of an earlier run are what its restart file says.
TEST(ProblemLines, OfADamagedFileAreShownInOneLine) {
  const std::vector<std::string> now{"loads/tip/total: 1"};
  EXPECT_EQ(firstDifference({""}, now), " was  and is not there now");
  EXPECT_EQ(firstDifference({"a\nb\x1b: c\rd"}, now), "a b  was c d and is not there now");
  EXPECT_LT(firstDifference({std::string(5000, 'x')}, now).size(), 200u);
}

}  // namespace

TEST(DeckAgainstMesh, namesThatTheMeshLacks) {
  EXPECT_EQ(meshErrorOf("x_min", "x_min"), "no error");
  EXPECT_EQ(meshErrorOf("set: z_min", "set: 1"), "no error");  // by id
  expectMeshError("set: x_min,", "set: x_mn,",
                  "supports/clamp/set: the mesh has no node set or side set 'x_mn'", "did you mean 'x_min'?");
  expectMeshError("blocks: [strip]", "blocks: [stripe]",
                  "materials/steel/blocks: the mesh has no block 'stripe'",
                  "(did you mean 'strip'?); it has the blocks strip");
  // An edge is a node set only.
  expectMeshError("{type: surface, set: x_max,", "{type: surface, set: x_max_z_min,",
                  "loads/tip/set: the mesh has no side set 'x_max_z_min'",
                  "it has the side sets x_min, x_max, y_min, y_max, z_min, z_max");
  EXPECT_EQ(meshErrorOf("{type: surface, set: x_max,", "{type: nodal, set: x_max_z_min,"), "no error");
  expectMeshError("set: z_min,", "set: x_max_z_min,", "contact/lower/set: the mesh has no side set",
                  "side sets");
  EXPECT_EQ(meshErrorOf("set: z_min,", "points: nodes, set: x_max_z_min,"), "no error");
  expectMeshError("{type: displacement, set: x_max,", "{type: displacement, set: tip,",
                  "output/monitors/tip_uz/set: the mesh has no node set or side set 'tip'", "node sets");
  expectMeshError("{type: surface, set: x_max, total: [0, 0, -100]}",
                  "{type: volume, blocks: [roof], force: [0, 0, 1]}",
                  "loads/tip/blocks: the mesh has no block 'roof'", "blocks strip");
}

TEST(DeckAgainstMesh, everyBlockHasOneMaterial) {
  const Deck deck = readDeckText(goodDeck, "solid.yaml");
  fem::Mesh mesh = fem::boxMesh(std::get<fem::BoxOptions>(*deck.mesh.generate));
  mesh.blocks.push_back(mesh.blocks[0]);
  mesh.blocks[1].name = "core";
  mesh.blocks[1].id = 5;
  EXPECT_EQ(meshErrorOf("x_min", "x_min", &mesh),
            "solid.yaml:6:1: materials: the mesh's block 'core' has no material");
  EXPECT_EQ(meshErrorOf("blocks: [strip]", "blocks: [strip, 5]", &mesh), "no error");
  EXPECT_EQ(meshErrorOf("blocks: [strip]", "blocks: [strip, 5, core]", &mesh),
            "solid.yaml:7:91: materials/steel/blocks: block 'core' already has the material 'steel'");
  mesh.blocks[1].name = "a\n\x1b[2J\xC2\x85\xE4";  // of strangers
  EXPECT_EQ(meshErrorOf("x_min", "x_min", &mesh),
            "solid.yaml:6:1: materials: the mesh's block 'a  [2J  ' has no material");
  mesh.blocks.pop_back();
  for (auto& set : mesh.sideSets) {
    set.sides.clear();
  }
  EXPECT_EQ(meshErrorOf("x_min", "x_min", &mesh),
            "solid.yaml:14:29: loads/tip/set: the side set 'x_max' is empty");
}

// ------------------------------------------------------------------------------------------ reference

std::string referenceText() {
  std::ifstream in(std::string(ATRAPOS_DOCS) + "/deck.md");
  std::stringstream docs;
  docs << in.rdbuf();
  return docs.str();
}

/// The last parts of the paths that describeKeys prints.
std::vector<std::string> acceptedKeys() {
  std::ostringstream keys;
  describeKeys(keys);
  std::istringstream lines(keys.str());
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);) {
    const std::string path = line.substr(0, line.find(':'));
    all.push_back(path.substr(path.rfind('/') + 1));
  }
  return all;
}

TEST(DeckReference, explainsEveryKey) {
  const std::string docs = referenceText();
  const auto keys = acceptedKeys();
  for (const std::string& key : keys)
    EXPECT_NE(docs.find("`" + key + "`"), std::string::npos) << "docs/deck.md does not explain " << key;
  EXPECT_GT(keys.size(), 200U);  // there are 320 or so: an empty list would pass the loop
}

// What stands in a column `key` of a table is a key, of some block.
TEST(DeckReference, namesNoOtherKey) {
  const auto keys = acceptedKeys();
  std::istringstream lines(referenceText());
  int column = -1, named = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] != '|') {
      column = -1;
      continue;
    }
    std::vector<std::string> cells;
    std::istringstream row(line.substr(1));
    for (std::string cell; std::getline(row, cell, '|');) cells.push_back(cell);
    for (std::size_t c = 0; column < 0 && c < cells.size(); ++c)
      if (cells[c].rfind(" key", 0) == 0) column = static_cast<int>(c);
    if (column < 0 || column >= static_cast<int>(cells.size())) continue;
    std::istringstream words(cells[column]);
    std::string between, key;
    while (std::getline(words, between, '`') && std::getline(words, key, '`')) {
      EXPECT_EQ(std::count(keys.begin(), keys.end(), key) > 0, true)
          << "docs/deck.md explains '" << key << "', which no block has";
      ++named;
    }
  }
  EXPECT_GT(named, 200);
}
