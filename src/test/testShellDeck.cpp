// What decks say of shells: generated middle surfaces, sections, supports, loads, contact; and what is
// refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "deck/Deck.hpp"

namespace {

using namespace atrapos;
using namespace atrapos::deck;

const char* const goodDeck = R"(mesh:
  file: plate.exo
  generate: {shape: shell_plate, length: 10, width: 2, divisions: [5, 1], block: plate}
materials:
  steel: {law: saint_venant_kirchhoff, youngs_modulus: 220000, poissons_ratio: 0.3, blocks: [plate]}
shells:
  fold_angle: 30
  sections:
    skin: {blocks: [plate], thickness: 0.25}
supports:
  clamp: {set: x_min, condition: clamped}
  side: {set: y_min, condition: symmetry_y, director_x: 0.5}
  tip: {set: x_max_y_max, y: 0, director_z: {value: 0, per_load_factor: 0.1}}
loads:
  line: {type: edge, set: x_max, force: [0, 0, 1]}
  turn: {type: edge, set: x_max, follower_moment: 2}
  bend: {type: edge, set: x_max, moment: [0, 3, 0], constant: true}
  push: {type: edge, set: x_min, follower_force: [0, -1, 0], constant: true}
  pull: {type: edge, set: x_max, total: [3, 0, 0], constant: true}
  wind: {type: surface, set: top, pressure: 0.1, follower: true, at: top}
tools:
  floor: {type: plane, point: [0, 0, -1], normal: [0, 0, 1]}
contact:
  below: {tool: floor, set: bottom, at: bottom, stiffness: 1000, regularisation: 0.1}
  points: {tool: floor, set: x_mid, points: nodes, stiffness: 1000, regularisation: 0.1}
path:
  stop: {load_factor: 1}
)";

std::string changed(const std::string& from, const std::string& to, std::string text = goodDeck) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "the good deck has no '" << from << "'";
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

fem::Mesh meshOf(const Deck& deck) {
  return fem::shellPlateMesh(std::get<fem::ShellPlateOptions>(*deck.mesh.generate));
}

/// The line with which a deck is refused, alone or against a mesh.
std::string errorOf(const std::string& text, const fem::Mesh* mesh = nullptr) {
  try {
    const Deck deck = readDeckText(text, "shell.yaml");
    if (mesh != nullptr) checkAgainstMesh(deck, *mesh);
  } catch (const DeckError& error) {
    return error.what();
  }
  return "no error";
}

/// What a line of error says behind its file and place.
std::string behindPlace(const std::string& error) {
  return error.substr(error.find_first_not_of("0123456789: ", error.find(":") + 1));
}

void expectError(const std::string& from, const std::string& to, const std::string& start,
                 const fem::Mesh* mesh = nullptr) {
  const std::string error = errorOf(changed(from, to), mesh);
  EXPECT_EQ(behindPlace(error).substr(0, start.size()), start) << error;
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
}

fem::Mesh plateMesh() { return meshOf(readDeckText(goodDeck, "shell.yaml")); }

}  // namespace

TEST(ShellDeck, goodDeckGivesItsValues) {
  const Deck deck = readDeckText(goodDeck, "shell.yaml");
  const auto& plate = std::get<fem::ShellPlateOptions>(*deck.mesh.generate);
  EXPECT_EQ(plate.divisions, (std::array<int, 2>{5, 1}));
  EXPECT_EQ(plate.topology, fem::Topology::Shell8);
  EXPECT_EQ(plate.angle, 90);
  EXPECT_EQ(deck.shells.foldAngle, 30);
  ASSERT_EQ(deck.shells.sections.size(), 1u);
  EXPECT_EQ(deck.shells.sections[0].name, "skin");
  EXPECT_EQ(deck.shells.sections[0].blocks, std::vector<std::string>{"plate"});
  EXPECT_EQ(*deck.shells.sections[0].thickness, 0.25);
  EXPECT_EQ(deck.shells.shear, Shear::Compatible);
  EXPECT_FALSE(deck.shells.sections[0].shear);

  const auto& line = std::get<EdgeLoad>(deck.loads[0].load);
  EXPECT_EQ(line.kind, EdgeLoad::Kind::Force);
  EXPECT_EQ(line.vector, (Vector3{0, 0, 1}));
  const auto& turn = std::get<EdgeLoad>(deck.loads[1].load);
  EXPECT_EQ(turn.kind, EdgeLoad::Kind::FollowerMoment);
  EXPECT_EQ(turn.moment, 2);
  const auto& bend = std::get<EdgeLoad>(deck.loads[2].load);
  EXPECT_EQ(bend.kind, EdgeLoad::Kind::Moment);
  EXPECT_EQ(bend.vector, (Vector3{0, 3, 0}));
  const auto& push = std::get<EdgeLoad>(deck.loads[3].load);
  EXPECT_EQ(push.kind, EdgeLoad::Kind::FollowerForce);
  EXPECT_EQ(push.vector, (Vector3{0, -1, 0}));
  EXPECT_EQ(std::get<EdgeLoad>(deck.loads[4].load).kind, EdgeLoad::Kind::Total);
  EXPECT_TRUE(deck.loads[4].constant);
  const auto& wind = std::get<SurfaceLoad>(deck.loads[5].load);
  EXPECT_TRUE(wind.follower);
  EXPECT_EQ(wind.at, ShellPlace::Top);
  EXPECT_EQ(deck.contacts[0].at, ShellPlace::Bottom);
  EXPECT_EQ(deck.contacts[1].at, ShellPlace::Middle);
  const fem::Mesh mesh = meshOf(deck);
  EXPECT_EQ(errorOf(goodDeck, &mesh), "no error");
}

TEST(ShellDeck, conditionsHoldTheirComponents) {
  struct Case {
    const char *word, *displacement, *director;
  };
  for (const Case& c : {Case{"clamped", "xyz", "xyz"},
                        {"hinged", "xyz", ""},
                        {"symmetry_x", "x", "x"},
                        {"symmetry_y", "y", "y"},
                        {"symmetry_z", "z", "z"}}) {
    SCOPED_TRACE(c.word);
    const Deck deck =
        readDeckText(changed("condition: clamped", std::string("condition: ") + c.word), "s.yaml");
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto held = [&](const char* letters) {
        return std::string(letters).find("xyz"[axis]) != std::string::npos;
      };
      EXPECT_EQ(deck.supports[0].components[axis].has_value(), held(c.displacement));
      EXPECT_EQ(deck.supports[0].director[axis].has_value(), held(c.director));
      if (held(c.displacement)) {
        EXPECT_EQ(deck.supports[0].components[axis]->value, 0);
      }
    }
  }
  const Deck deck = readDeckText(goodDeck, "s.yaml");
  const Support& side = deck.supports[1];
  EXPECT_FALSE(side.components[0]);
  EXPECT_TRUE(side.components[1]);
  EXPECT_EQ(side.director[0]->value, 0.5);
  EXPECT_EQ(side.director[1]->value, 0);
  EXPECT_FALSE(side.director[2]);
  EXPECT_EQ(deck.supports[2].director[2]->perLoadFactor, 0.1);
}

TEST(ShellDeck, everyShapeReadsItsKeys) {
  const auto shape = [](const std::string& text) {
    return *readDeckText(changed("shape: shell_plate, length: 10, width: 2, divisions: [5, 1]", text),
                         "s.yaml")
                .mesh.generate;
  };
  const auto skew = std::get<fem::ShellPlateOptions>(shape(
      "shape: shell_plate, length: 1, width: 2, angle: 30, origin: [1, 2, 3], thickness: 0.5, divisions: [3, "
      "4], cell: SHELL9"));
  EXPECT_EQ(skew.angle, 30);
  EXPECT_EQ(skew.origin, (Vector3{1, 2, 3}));
  EXPECT_EQ(skew.thickness, 0.5);
  EXPECT_EQ(skew.topology, fem::Topology::Shell9);
  const auto cylinder =
      std::get<fem::ShellCylinderOptions>(shape("shape: shell_cylinder, radius: 5, theta: [-40, 40], length: "
                                                "7, y_min: -1, slit: true, divisions: [3, 4]"));
  EXPECT_EQ(cylinder.thetaMin, -40);
  EXPECT_EQ(cylinder.yMin, -1);
  EXPECT_TRUE(cylinder.slit);
  EXPECT_EQ(cylinder.tangentDivisions, 0);
  const auto onRoll = std::get<fem::ShellCylinderOptions>(shape(
      "shape: shell_cylinder, radius: 5, theta: [-90, 0], length: 7, tangent: 10, tangent_divisions: 6, "
      "divisions: [3, 4]"));
  EXPECT_EQ(onRoll.tangent, 10);
  EXPECT_EQ(onRoll.tangentDivisions, 6);
  const std::string roll = "shape: shell_cylinder, radius: 5, length: 7, divisions: [3, 4], theta: ";
  EXPECT_THROW(shape(roll + "[-90, 0], tangent: 10"), std::exception);
  EXPECT_THROW(shape(roll + "[-90, 270], tangent: 10, tangent_divisions: 6"), std::exception);
  const auto annulus = std::get<fem::ShellAnnulusOptions>(
      shape("shape: shell_annulus, inner_radius: 6, outer_radius: 10, angle: [0, 360], divisions: [3, 12]"));
  EXPECT_EQ(annulus.outerRadius, 10);
  EXPECT_TRUE(annulus.slit);
  const auto sphere = std::get<fem::ShellSphereOptions>(
      shape("shape: shell_sphere, radius: 10, longitude: [0, 90], latitude: [0, 72], divisions: [3, 4]"));
  EXPECT_EQ(sphere.latitudeMax, 72);
  EXPECT_FALSE(sphere.slit);
}

TEST(ShellDeck, describedDeckReadsBack) {
  for (const std::string& text :
       {std::string(goodDeck), changed("thickness: 0.25", "thickness: attribute"),
        changed("shape: shell_plate, length: 10, width: 2, divisions: [5, 1]",
                "shape: shell_cylinder, radius: 5, theta: [-40, 40], length: 7, "
                "thickness: 0.1, tangent: 2, tangent_divisions: 5, divisions: [3, 4]"),
        changed("condition: clamped", "condition: hinged")}) {
    std::ostringstream first, second;
    describe(readDeckText(text, "shell.yaml"), first);
    describe(readDeckText(first.str(), "shell.yaml"), second);
    EXPECT_EQ(first.str(), second.str());
    EXPECT_NE(first.str().find("shells:\n  fold_angle: 30"), std::string::npos) << first.str();
    EXPECT_NE(first.str().find("\n    director_z: {value: 0, per_load_factor: 0.1}\n"), std::string::npos)
        << first.str();
  }
  // Nothing of shells stands in a deck without them.
  std::ostringstream plain;
  describe(
      readDeckText(changed("shells:\n  fold_angle: 30\n  sections:\n    skin: {blocks: [plate], thickness: "
                           "0.25}\n",
                           ""),
                   "shell.yaml"),
      plain);
  EXPECT_EQ(plain.str().find("shells:"), std::string::npos);
}

TEST(ShellDeck, valuesOutOfRange) {
  expectError("thickness: 0.25", "thickness: 0", "shells/sections/skin/thickness: must be positive, got 0");
  expectError("thickness: 0.25", "thickness: thin",
              "shells/sections/skin/thickness: expected a positive number or attribute, got the text 'thin'");
  expectError("fold_angle: 30", "fold_angle: 180", "shells/fold_angle: must be below 180 degrees, got 180");
  expectError("condition: clamped", "condition: fixed",
              "supports/clamp/condition: 'fixed' is not a choice here");
  expectError("condition: clamped", "condition: clamped, x: 0",
              "supports/clamp/x: is held by condition: clamped already");
  expectError("condition: symmetry_y, director_x: 0.5", "condition: symmetry_y, director_y: 0.5",
              "supports/side/director_y: is held by condition: symmetry_y already");
  expectError(", condition: clamped", "",
              "supports/clamp: holds nothing; expected at least one of x, y, z, condition");
  expectError(
      "force: [0, 0, 1]", "force: [0, 0, 1], moment: [1, 0, 0]",
      "loads/line: needs exactly one of total, force, moment, follower_force, follower_moment, got force, "
      "moment");
  expectError("follower_moment: 2", "follower_moment: [0, 2, 0]", "loads/turn/follower_moment: expected a");
  expectError("follower_moment: 2", "follower: true, force: [0, 0, 1]",
              "loads/turn/follower: is not a key here");
  expectError("pressure: 0.1", "traction: [0, 0, 1]",
              "loads/wind/follower: has a meaning with pressure only");
  expectError("at: top", "at: outside", "loads/wind/at: 'outside' is not a choice here");
  expectError("divisions: [5, 1]", "divisions: [5, 1, 1]", "mesh/generate/divisions: ");
  expectError("divisions: [5, 1]", "divisions: [5, 1], cell: HEX8",
              "mesh/generate/cell: 'HEX8' is not a choice");
  expectError("divisions: [5, 1]", "divisions: [5, 1], angle: 180",
              "mesh/generate/angle: must be below 180 degrees, got 180");
  expectError("    skin: {blocks: [plate], thickness: 0.25}\n",
              "    skin: {blocks: [plate], thickness: 0.25}\n    more: {blocks: [plate]}\n",
              "shells/sections/more/blocks: block 'plate' already has the section 'skin'");
}

TEST(ShellDeck, whatIsWrittenOfShells) {
  const std::string text = std::string(goodDeck) + R"(output:
  shells: body
  monitors:
    middle: {type: contact_force, contact: points, near: [5, 1, 0]}
    across: {type: contact_force, contact: points, near: [5, 1, 0], along: [0, 2, 0]}
    total: {type: contact_force, contact: points}
)";
  const Deck deck = readDeckText(text, "shell.yaml");
  EXPECT_EQ(deck.output.shells, Output::Shells::Body);
  EXPECT_EQ(*std::get<ContactForceMonitor>(deck.output.monitors[0].quantity).near, (Vector3{5, 1, 0}));
  EXPECT_FALSE(std::get<ContactForceMonitor>(deck.output.monitors[0].quantity).along);
  EXPECT_EQ(*std::get<ContactForceMonitor>(deck.output.monitors[1].quantity).along, (Vector3{0, 2, 0}));
  EXPECT_FALSE(std::get<ContactForceMonitor>(deck.output.monitors[2].quantity).near);
  std::ostringstream first, second;
  describe(deck, first);
  describe(readDeckText(first.str(), "shell.yaml"), second);
  EXPECT_EQ(first.str(), second.str());
  EXPECT_EQ(readDeckText(goodDeck, "shell.yaml").output.shells, Output::Shells::Surface);
  EXPECT_EQ(errorOf(changed("points, near: [5, 1, 0]}", "points, component: x, near: [5, 1, 0]}", text)),
            "shell.yaml:31:72: output/monitors/middle/near: has a meaning with component: normal only");
  EXPECT_EQ(errorOf(changed("near: [5, 1, 0], along: [0, 2, 0]", "along: [0, 2, 0]", text)),
            "shell.yaml:32:59: output/monitors/across/along: needs near beside it");
  EXPECT_EQ(errorOf(changed("along: [0, 2, 0]", "along: [0, 0, 0]", text)),
            "shell.yaml:32:76: output/monitors/across/along: must not be the zero vector");
  EXPECT_NE(errorOf(changed("shells: body", "shells: solid", text)).find("output/shells: 'solid' is not a"),
            std::string::npos);
}

TEST(ShellDeck, shearOfAllOrOfSomeBlocks) {
  const Deck all = readDeckText(changed("fold_angle: 30", "shear: assumed"), "s.yaml");
  EXPECT_EQ(all.shells.shear, Shear::Assumed);
  const Deck some = readDeckText(changed("thickness: 0.25}", "thickness: 0.25, shear: assumed}"), "s.yaml");
  EXPECT_EQ(some.shells.shear, Shear::Compatible);
  EXPECT_EQ(*some.shells.sections[0].shear, Shear::Assumed);
  std::ostringstream printed;
  describe(some, printed);
  EXPECT_EQ(*readDeckText(printed.str(), "s.yaml").shells.sections[0].shear, Shear::Assumed);
  expectError("fold_angle: 30", "shear: tied", "shells/shear: 'tied' is not a choice here");
  expectError("thickness: 0.25}", "thickness: 0.25, shear: tied}",
              "shells/sections/skin/shear: 'tied' is not a choice here");
}

TEST(ShellDeck, sharesOfNodes) {
  const std::string shares = "set: y_lines, points: nodes, shares: distribution_factors";
  const Deck deck = readDeckText(changed("set: x_mid, points: nodes", shares), "s.yaml");
  EXPECT_EQ(deck.contacts[0].shares, Contact::Shares::Equal);
  EXPECT_EQ(deck.contacts[1].shares, Contact::Shares::DistributionFactors);
  std::ostringstream printed;
  describe(deck, printed);
  EXPECT_EQ(readDeckText(printed.str(), "s.yaml").contacts[1].shares, Contact::Shares::DistributionFactors);
  fem::Mesh mesh = plateMesh();
  EXPECT_EQ(errorOf(changed("set: x_mid, points: nodes", shares), &mesh), "no error");
  expectError("at: bottom, stiffness", "at: bottom, shares: distribution_factors, stiffness",
              "contact/below/shares: distribution factors are those of nodes; expected points: nodes");
  expectError("set: x_mid, points: nodes, stiffness: 1000, regularisation: 0.1",
              "set: x_mid, points: nodes, law: hard, shares: distribution_factors",
              "contact/points/shares: has no meaning with law: hard");
  expectError("set: x_mid, points: nodes", "set: x_mid, points: nodes, shares: distribution_factors",
              "contact/points/shares: the mesh has no distribution factors for the node set 'x_mid'", &mesh);
  expectError("set: x_mid, points: nodes", "set: bottom, points: nodes, shares: distribution_factors",
              "contact/points/shares: 'bottom' is a side set; distribution factors are those of a node set",
              &mesh);
  fem::NodeSet& set = mesh.nodeSets.at(static_cast<std::size_t>(fem::findNodeSet(mesh, "y_lines")));
  set.factors[2] = 0;
  for (int n = 0; n < mesh.numNodes(); ++n) mesh.nodeIds.push_back(1000 + n);  // the file's numbers are told
  expectError("set: x_mid, points: nodes", shares,
              "contact/points/shares: the distribution factor of node " +
                  std::to_string(set.nodes[2] + 1000) + " in the node set 'y_lines' is 0, must be positive",
              &mesh);
}

TEST(ShellDeck, jointsAreRigidUnlessTheyAreNamed) {
  EXPECT_TRUE(readDeckText(goodDeck, "shell.yaml").shells.joints.empty());
  const std::string text = changed("  fold_angle: 30\n",
                                   "  fold_angle: 30\n  joints:\n    lid: {set: x_min, joint: hinge}\n    "
                                   "end: {set: x_max, joint: rigid}\n");
  const Deck deck = readDeckText(text, "shell.yaml");
  ASSERT_EQ(deck.shells.joints.size(), 2u);
  EXPECT_EQ(deck.shells.joints[0].set, "x_min");
  EXPECT_EQ(deck.shells.joints[0].kind, ShellJoint::Kind::Hinge);
  EXPECT_EQ(deck.shells.joints[1].kind, ShellJoint::Kind::Rigid);
  std::ostringstream printed;
  describe(deck, printed);
  EXPECT_EQ(readDeckText(printed.str(), "s.yaml").shells.joints[0].kind, ShellJoint::Kind::Hinge);
  expectError("fold_angle: 30", "joints: {lid: {set: x_min, joint: loose}}",
              "shells/joints/lid/joint: 'loose' is not a choice here");
  expectError("fold_angle: 30", "joints: {lid: {set: x_min}}", "shells/joints/lid/joint: ");
  const fem::Mesh mesh = plateMesh();
  expectError("fold_angle: 30", "joints: {lid: {set: x_mix, joint: hinge}}",
              "shells/joints/lid/set: the mesh has no node set or side set 'x_mix'", &mesh);
}

// Said once for all, it is printed also where the deck says nothing else of shells.
TEST(ShellDeck, shearAloneIsPrinted) {
  const std::string text = changed(
      "  fold_angle: 30\n  sections:\n    skin: {blocks: [plate], thickness: 0.25}\n", "  shear: assumed\n");
  std::ostringstream printed;
  describe(readDeckText(text, "shell.yaml"), printed);
  EXPECT_EQ(readDeckText(printed.str(), "s.yaml").shells.shear, Shear::Assumed);
}

TEST(ShellDeck, platesCanBeGraded) {
  const Deck deck = readDeckText(changed("divisions: [5, 1]", "grading: 1.5, divisions: [5, 1]"), "s.yaml");
  EXPECT_EQ(std::get<fem::ShellPlateOptions>(*deck.mesh.generate).grading, 1.5);
  expectError("divisions: [5, 1]", "grading: 0.5, divisions: [5, 1]",
              "mesh/generate/grading: must be at least 1, got 0.5");
}

TEST(ShellDeck, directorsCanBeAllThatIsDriven) {
  std::string text = changed("per_load_factor: 0.1", "per_load_factor: 0");
  for (const char* line : {"  line: {type: edge, set: x_max, force: [0, 0, 1]}\n",
                           "  turn: {type: edge, set: x_max, follower_moment: 2}\n",
                           "  wind: {type: surface, set: top, pressure: 0.1, follower: true, at: top}\n"})
    text = changed(line, "", text);
  EXPECT_NE(errorOf(text).find("nothing depends on the load factor"), std::string::npos);
  EXPECT_EQ(errorOf(changed("director_z: {value: 0, per_load_factor: 0}",
                            "director_z: {value: 0, per_load_factor: 0.1}", text)),
            "no error");
}

TEST(ShellDeckAgainstMesh, edgesAndFacesAreToldApart) {
  const fem::Mesh mesh = plateMesh();
  expectError("type: edge, set: x_max, force", "type: edge, set: top, force",
              "loads/line/set: side 1 of element 1 in the side set 'top' is no edge of a shell", &mesh);
  expectError("type: surface, set: top", "type: surface, set: x_max",
              "loads/wind/set: the side set 'x_max' has edges of shells; expected faces", &mesh);
  expectError("set: bottom, at", "set: y_max, at",
              "contact/below/set: the side set 'y_max' has edges of shells", &mesh);
  expectError("blocks: [plate], thickness", "blocks: [roof], thickness",
              "shells/sections/skin/blocks: the mesh has no block 'roof'", &mesh);
  expectError("    skin: {blocks: [plate], thickness: 0.25}\n",
              "    skin: {blocks: [plate], thickness: 0.25}\n    more: {blocks: [1]}\n",
              "shells/sections/more/blocks: block '1' already has the section 'skin'", &mesh);
}

TEST(ShellDeckAgainstMesh, solidsHaveNeitherDirectorsNorTopAndBottom) {
  fem::StripOptions options;
  options.blockName = "plate";
  const fem::Mesh mesh = fem::stripMesh(options);
  expectError("x_max", "x_max", "shells/sections/skin/blocks: block 'plate' has HEX20, no shells", &mesh);
  const std::string text = changed(
      "shells:\n  fold_angle: 30\n  sections:\n    skin: {blocks: [plate], thickness: "
      "0.25}\n",
      "");
  const auto error = [&](const std::string& from, const std::string& to) {
    return errorOf(changed(from, to, text), &mesh);
  };
  EXPECT_EQ(error("x_max", "x_max"),
            "shell.yaml:8:57: supports/side/director_x: no node of 'y_min' belongs to shells, so there is no "
            "director");
  // A condition holds what is there.
  const std::string plain =
      changed(", director_x: 0.5", "", changed(", director_z: {value: 0, per_load_factor: 0.1}", "", text));
  EXPECT_NE(errorOf(plain, &mesh).find("in the side set 'x_max' is no edge of a shell"), std::string::npos);
  std::string faces = plain;
  for (const char* line : {"  line: {type: edge, set: x_max, force: [0, 0, 1]}\n",
                           "  turn: {type: edge, set: x_max, follower_moment: 2}\n",
                           "  bend: {type: edge, set: x_max, moment: [0, 3, 0], constant: true}\n",
                           "  push: {type: edge, set: x_min, follower_force: [0, -1, 0], constant: true}\n",
                           "  pull: {type: edge, set: x_max, total: [3, 0, 0], constant: true}\n"})
    faces = changed(line, "", faces);
  EXPECT_EQ(errorOf(faces, &mesh),
            "shell.yaml:11:70: loads/wind/at: the side set 'top' has faces of solids; top and bottom are for "
            "shells");
  faces = changed(", at: top", "", faces);
  EXPECT_EQ(
      errorOf(faces, &mesh),
      "shell.yaml:15:41: contact/below/at: the side set 'bottom' has faces of solids; top and bottom are for "
      "shells");
}

// Couplings: what each kind needs, and that the deck is printed as it was read.
TEST(ShellDeck, couplings) {
  const std::string text = changed("loads:\n", R"(couplings:
  end: {kind: plane, set: x_max, normal: [2, 0, 0]}
  rim: {kind: rigid, set: y_max}
  pair: {kind: equal, set: x_mid}
loads:
)");
  const Deck deck = readDeckText(text, "shell.yaml");
  ASSERT_EQ(deck.couplings.size(), 3u);
  EXPECT_EQ(deck.couplings[0].name, "end");
  EXPECT_EQ(deck.couplings[0].kind, Coupling::Kind::Plane);
  EXPECT_EQ(*deck.couplings[0].normal, (Vector3{2, 0, 0}));
  EXPECT_EQ(deck.couplings[1].kind, Coupling::Kind::Rigid);
  EXPECT_EQ(deck.couplings[1].set, "y_max");
  EXPECT_FALSE(deck.couplings[1].normal);
  std::ostringstream printed;
  describe(deck, printed);
  const Deck again = readDeckText(printed.str(), "shell.yaml");
  ASSERT_EQ(again.couplings.size(), 3u);
  EXPECT_EQ(*again.couplings[0].normal, (Vector3{2, 0, 0}));
  EXPECT_EQ(again.couplings[2].kind, Coupling::Kind::Equal);

  const auto refused = [&](const std::string& from, const std::string& to, const std::string& start) {
    const fem::Mesh mesh = plateMesh();
    const std::string error = errorOf(changed(from, to, text), &mesh);
    EXPECT_EQ(behindPlace(error).substr(0, start.size()), start) << error;
  };
  refused(", normal: [2, 0, 0]", "", "couplings/end/normal");
  refused("normal: [2, 0, 0]", "normal: [0, 0, 0]", "couplings/end/normal: must not be the zero vector");
  refused("{kind: rigid, set: y_max}", "{kind: rigid, set: y_max, normal: [1, 0, 0]}",
          "couplings/rim/normal: is for kind: plane alone");
  refused("kind: equal", "kind: same", "couplings/pair/kind: 'same' is not a choice here");
  refused("set: y_max", "set: y_mox", "couplings/rim/set: the mesh has no node set or side set 'y_mox'");
}

// Rigid bodies about an axis, their moments and angles; ties.
TEST(ShellDeck, hingesAndTies) {
  const std::string text =
      changed("path:\n", R"(couplings:
  free: {kind: rigid, set: y_max, axis: [0, 3, 0]}
  driven: {kind: rigid, set: x_mid, axis: [1, 0, 0], angle: {value: 5, per_load_factor: 90}}
  seam: {kind: tie, set: top, to: bottom, reach: 0.2}
output:
  monitors:
    angle: {type: rotation, coupling: free}
    torque: {type: moment, coupling: driven}
path:
)",
              changed("loads:\n", "loads:\n  twist: {type: moment, coupling: free, moment: 3}\n"));
  const Deck deck = readDeckText(text, "shell.yaml");
  std::ostringstream printed;
  describe(deck, printed);
  for (const Deck& d : {deck, readDeckText(printed.str(), "shell.yaml")}) {
    ASSERT_EQ(d.couplings.size(), 3u);
    EXPECT_EQ(*d.couplings[0].axis, (Vector3{0, 3, 0}));
    EXPECT_FALSE(d.couplings[0].angle);
    EXPECT_EQ(d.couplings[1].angle->value, 5);
    EXPECT_EQ(d.couplings[1].angle->perLoadFactor, 90);
    EXPECT_EQ(d.couplings[2].kind, Coupling::Kind::Tie);
    EXPECT_EQ(d.couplings[2].to, "bottom");
    EXPECT_EQ(*d.couplings[2].reach, 0.2);
    EXPECT_EQ(std::get<MomentLoad>(d.loads[0].load).moment, 3);
    EXPECT_EQ(std::get<RotationMonitor>(d.output.monitors[0].quantity).coupling, "free");
    EXPECT_EQ(std::get<MomentMonitor>(d.output.monitors[1].quantity).coupling, "driven");
  }
  std::string good = text;
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& start) {
    const std::string error = errorOf(changed(from, to, good));
    EXPECT_EQ(behindPlace(error).substr(0, start.size()), start) << error;
  };
  refused("axis: [0, 3, 0]", "axis: [0, 0, 0]", "couplings/free/axis: must not be the zero vector");
  refused("axis: [1, 0, 0], ", "", "couplings/driven/axis: is missing");
  refused("per_load_factor: 90", "per_load_factor: x", "couplings/driven/angle: a body has one angle");
  refused("{kind: tie, ", "{kind: tie, axis: [1, 0, 0], ", "couplings/seam/axis: is for kind: rigid alone");
  refused(", to: bottom", "", "couplings/seam/to: is missing");
  refused("reach: 0.2", "reach: 0", "couplings/seam/reach: ");
  refused("kind: tie", "kind: equal", "couplings/seam/to: is for kind: tie alone");
  refused("kind: tie, set: top, to: bottom", "kind: equal, set: top",
          "couplings/seam/reach: is for kind: tie alone");
  refused("coupling: free, moment", "coupling: frei, moment",
          "loads/twist/coupling: no entry 'frei' in couplings");
  refused("coupling: free, moment", "coupling: seam, moment",
          "loads/twist/coupling: coupling 'seam' has no axis");
  refused("coupling: free, moment", "coupling: driven, moment",
          "loads/twist/coupling: coupling 'driven' has its angle given");
  refused("rotation, coupling: free", "rotation, coupling: seam",
          "output/monitors/angle/coupling: coupling 'seam' has no axis");
  refused("moment, coupling: driven}", "moment, coupling: free}",
          "output/monitors/torque/coupling: the body of coupling 'free' turns freely");
  good = changed(
      "  seam:", "  lever: {kind: equation, terms: [[x_min, z, 1], [y_min, z, -2.5]]}\n  seam:", text);
  const Deck levered = readDeckText(good, "shell.yaml");
  std::ostringstream again;
  describe(levered, again);
  for (const Deck& d : {levered, readDeckText(again.str(), "shell.yaml")}) {
    ASSERT_EQ(d.couplings[2].terms.size(), 2u);
    EXPECT_EQ(d.couplings[2].terms[1].set, "y_min");
    EXPECT_EQ(d.couplings[2].terms[1].unknown, "z");
    EXPECT_EQ(d.couplings[2].terms[1].factor, -2.5);
  }
  refused(", terms: [[x_min, z, 1], [y_min, z, -2.5]]", "", "couplings/lever/terms: is missing");
  refused(", [y_min, z, -2.5]", "", "couplings/lever/terms: expected a list of at least two lists");
  refused("[y_min, z, -2.5]", "[y_min, -2.5]", "couplings/lever/terms");
  refused("-2.5", "0", "couplings/lever/terms");
  refused("[y_min, z, ", "[y_min, T, ", "couplings/lever/terms: ");
  refused("equation, ", "equation, set: y_max, ", "couplings/lever/set: is not for kind: equation");
  refused("equation, ", "equal, set: y_max, ", "couplings/lever/terms: is for kind: equation alone");
  refused("kind: tie, set: top, ", "kind: tie, ", "couplings/seam/set: is missing");
  const fem::Mesh mesh = plateMesh();
  EXPECT_NE(errorOf(changed("to: bottom", "to: roof", text), &mesh)
                .find("couplings/seam/to: the mesh has no side set 'roof'"),
            std::string::npos);
}
