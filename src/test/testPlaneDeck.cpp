// What decks say of plane bodies: generated rectangles, what they stand for, and what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "deck/Deck.hpp"

namespace {

using namespace atrapos;
using namespace atrapos::deck;

const char* const goodDeck = R"(mesh:
  file: plate.exo
  generate: {shape: rectangle, lengths: [4, 2], origin: [1, 0], divisions: [5, 3], cell: TRI6, grading: 2}
plane: {kind: stress, thickness: 0.5}
materials:
  steel: {law: saint_venant_kirchhoff, youngs_modulus: 220000, poissons_ratio: 0.3, blocks: [body]}
supports:
  clamp: {set: x_min, condition: clamped}
loads:
  pull: {type: surface, set: x_max, total: [1, 2, 0]}
  weight: {type: volume, blocks: [body], force: [0, -1, 0]}
  tip: {type: nodal, set: x_max_y_max, total: [0, 1, 0]}
path:
  stop: {load_factor: 1}
output:
  monitors:
    tip: {type: displacement, set: x_max, component: y}
)";

std::string changed(const std::string& from, const std::string& to) {
  std::string text = goodDeck;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "the good deck has no '" << from << "'";
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

fem::Mesh meshOf(const Deck& deck) {
  return fem::rectangleMesh(std::get<fem::RectangleOptions>(*deck.mesh.generate));
}

/// The line with which the changed deck is refused against its own mesh, or against this one.
std::string errorOf(const std::string& from, const std::string& to, const fem::Mesh* mesh = nullptr) {
  try {
    const Deck deck = readDeckText(changed(from, to), "plane.yaml");
    checkAgainstMesh(deck, mesh != nullptr ? *mesh : meshOf(deck));
  } catch (const DeckError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST(PlaneDeck, goodDeckGivesItsValues) {
  const Deck deck = readDeckText(goodDeck, "plane.yaml");
  const auto& rectangle = std::get<fem::RectangleOptions>(*deck.mesh.generate);
  EXPECT_EQ(rectangle.lengths, (std::array<double, 2>{4, 2}));
  EXPECT_EQ(rectangle.origin, (std::array<double, 2>{1, 0}));
  EXPECT_EQ(rectangle.divisions, (std::array<int, 2>{5, 3}));
  EXPECT_EQ(rectangle.topology, fem::Topology::Tri6);
  EXPECT_EQ(rectangle.grading, 2);
  ASSERT_TRUE(deck.plane);
  EXPECT_EQ(deck.plane->kind, Plane::Kind::Stress);
  EXPECT_EQ(*deck.plane->thickness, 0.5);
  EXPECT_NO_THROW(checkAgainstMesh(deck, meshOf(deck)));
  EXPECT_FALSE(readDeckText(changed("{kind: stress, thickness: 0.5}", "{kind: axisymmetric}"), "plane.yaml")
                   .plane->thickness);
}

TEST(PlaneDeck, fineEnds) {
  const std::string graded = "grading: 2", fine = "fine: {x_min: [1, 2], y_max: [0.25, 1]}";
  const Deck deck = readDeckText(changed(graded, fine), "plane.yaml");
  const auto& options = std::get<fem::RectangleOptions>(*deck.mesh.generate);
  EXPECT_EQ(options.fine[0].divisions, 2);
  EXPECT_EQ(options.fine[0].length, 1);
  EXPECT_FALSE(options.fine[0].atMax);
  EXPECT_EQ(options.fine[1].divisions, 1);
  EXPECT_EQ(options.fine[1].length, 0.25);
  EXPECT_TRUE(options.fine[1].atMax);
  std::ostringstream first, second;
  describe(deck, first);
  EXPECT_NE(first.str().find("x_min"), std::string::npos);
  describe(readDeckText(first.str(), "plane.yaml"), second);
  EXPECT_EQ(first.str(), second.str());
  const std::string at = "plane.yaml:3:110: mesh/generate/fine/x_min: ";
  EXPECT_EQ(errorOf(graded, "fine: {x_min: [1, 2], x_max: [1, 2]}"),
            "plane.yaml:3:125: mesh/generate/fine/x_max: the other end of this axis is fine already");
  EXPECT_EQ(errorOf(graded, "fine: {x_min: [1, 2.5]}"),
            at + "expected a length above 0 and a whole number of elements, got the list [1, 2.5]");
  EXPECT_EQ(errorOf(graded, "fine: {x_min: [4, 2]}"),
            at + "fine elements over 4 of a length of 4: must be above 0 and below it");
  EXPECT_EQ(errorOf(graded, "fine: {x_min: [3, 2]}"),
            at + "3 elements beside 2 fine ones of 1.5 would be smaller than these: 1 is left for them");
  EXPECT_NE(errorOf(graded, "fine: {z_min: [1, 2]}").find("z_min"), std::string::npos);
  EXPECT_EQ(errorOf(graded, "grading: 2, fine: {x_min: [1, 2]}"),
            "plane.yaml:3:108: mesh/generate/fine: not together with grading");
}

TEST(PlaneDeck, annulusGivesItsValues) {
  const std::string rectangle =
      "{shape: rectangle, lengths: [4, 2], origin: [1, 0], divisions: [5, 3], cell: TRI6, grading: 2}";
  const std::string annulus =
      "{shape: annulus, inner_radius: 1, outer_radius: 1.5, angle: [0, 90], divisions: [2, 8], cell: QUAD9}";
  const Deck deck = readDeckText(changed(rectangle, annulus), "plane.yaml");
  const auto& options = std::get<fem::AnnulusOptions>(*deck.mesh.generate);
  EXPECT_EQ(options.innerRadius, 1);
  EXPECT_EQ(options.outerRadius, 1.5);
  EXPECT_EQ(options.angleMax, 90);
  EXPECT_EQ(options.divisions, (std::array<int, 2>{2, 8}));
  EXPECT_EQ(options.topology, fem::Topology::Quad9);
  std::ostringstream first, second;
  describe(deck, first);
  describe(readDeckText(first.str(), "plane.yaml"), second);
  EXPECT_EQ(first.str(), second.str());
  EXPECT_EQ(
      errorOf(rectangle,
              "{shape: annulus, inner_radius: 2, outer_radius: 1.5, angle: [0, 90], divisions: [2, 8]}"),
      "plane.yaml:3:61: mesh/generate/outer_radius: must be above inner_radius = 2, got 1.5");
}

TEST(PlaneDeck, quadrilateralGivesItsCorners) {
  const Deck deck = readDeckText(
      changed(
          "{shape: rectangle, lengths: [4, 2], origin: [1, 0], divisions: [5, 3], cell: TRI6, grading: 2}",
          "{shape: quadrilateral, corners: [0, 0, 48, 44, 48, 60, 0, 44], divisions: [2, 8]}"),
      "plane.yaml");
  EXPECT_EQ(std::get<fem::QuadrilateralOptions>(*deck.mesh.generate).corners,
            (std::array<double, 8>{0, 0, 48, 44, 48, 60, 0, 44}));
  std::ostringstream first, second;
  describe(deck, first);
  describe(readDeckText(first.str(), "plane.yaml"), second);
  EXPECT_EQ(first.str(), second.str());
}

TEST(PlaneDeck, mixedFormulations) {
  const std::string steel =
      "{law: saint_venant_kirchhoff, youngs_modulus: 220000, poissons_ratio: 0.3, blocks: [body]}";
  const auto said = [&](const std::string& material, const std::string& kind = "strain") -> std::string {
    std::string text = changed(steel, material);
    const auto at = text.find("kind: stress");
    text.replace(at, 12, "kind: " + kind);
    try {
      const Deck deck = readDeckText(text, "plane.yaml");
      std::ostringstream first, second;
      describe(deck, first);
      describe(readDeckText(first.str(), "plane.yaml"), second);
      EXPECT_EQ(first.str(), second.str());
      return deck.materials[0].formulation == Material::Formulation::Mixed ? "mixed" : "displacement";
    } catch (const DeckError& error) {
      return error.what();
    }
  };
  const std::string rubber = "{law: neo_hookean, shear_modulus: 1, bulk_modulus: infinite, blocks: [body]";
  EXPECT_EQ(said(rubber + ", formulation: mixed}"), "mixed");
  EXPECT_EQ(said("{law: yeoh, c1: 1, c2: 0, c3: 0, bulk_modulus: 9, blocks: [body]}"), "displacement");
  EXPECT_EQ(said(rubber + "}"),
            "plane.yaml:6:61: materials/steel/bulk_modulus: infinite needs formulation: mixed");
  EXPECT_EQ(said(rubber + ", formulation: mixed}", "stress"),
            "plane.yaml:6:100: materials/steel/formulation: volumes are free in plane stress; expected "
            "formulation: "
            "displacement");
  EXPECT_EQ(
      said("{law: saint_venant_kirchhoff, youngs_modulus: 1, poissons_ratio: 0.3, blocks: [body], "
           "formulation: mixed}"),
      "plane.yaml:6:109: materials/steel/formulation: is for laws of rubber: this one has no volumetric "
      "part that pressures could be of; expected formulation: displacement");
  EXPECT_EQ(
      said("{law: neo_hookean, shear_modulus: 3, bulk_modulus: 2, blocks: [body], formulation: mixed}"),
      "plane.yaml:6:93: materials/steel/formulation: needs Lame's lambda > 0 at rest: poissons_ratio > 0, "
      "or bulk_modulus > 2/3 shear_modulus; expected formulation: displacement");
  EXPECT_EQ(
      said("{law: gent, shear_modulus: 1, limit: 9, bulk_modulus: large, blocks: [body]}"),
      "plane.yaml:6:64: materials/steel/bulk_modulus: expected a positive number or infinite, got the text "
      "'large'");
}

TEST(PlaneDeck, describedDeckReadsBack) {
  std::ostringstream first, second;
  describe(readDeckText(goodDeck, "plane.yaml"), first);
  describe(readDeckText(first.str(), "plane.yaml"), second);
  EXPECT_EQ(first.str(), second.str());
  EXPECT_NE(first.str().find("kind: stress"), std::string::npos) << first.str();
}

TEST(PlaneDeck, whatIsNotPlaneIsRefused) {
  EXPECT_EQ(errorOf("plane: {kind: stress, thickness: 0.5}\n", ""),
            "plane.yaml: plane: missing; the mesh is a plane one, so the deck says what it stands for: kind: "
            "strain, stress or axisymmetric");
  const fem::Mesh box = fem::boxMesh({});
  EXPECT_EQ(errorOf("total: [1, 2, 0]", "total: [1, 2, 0]", &box),
            "plane.yaml:4:1: plane: the mesh has three dimensions; expected one with QUAD or TRI in two");
  EXPECT_EQ(errorOf("condition: clamped", "x: 0, z: 0"),
            "plane.yaml:8:32: supports/clamp/z: a plane body has no z");
  EXPECT_EQ(errorOf("condition: clamped", "condition: symmetry_z"),
            "plane.yaml:8:34: supports/clamp/condition: a plane body has no z");
  for (const auto& [from, to, place] :
       {std::array<const char*, 3>{"total: [1, 2, 0]", "total: [1, 2, 3]", "plane.yaml:10:3: loads/pull"},
        {"force: [0, -1, 0]", "force: [0, 0, -1]", "plane.yaml:11:3: loads/weight"},
        {"total: [0, 1, 0]", "total: [0, 1, 1]", "plane.yaml:12:3: loads/tip"},
        {"component: y", "component: z", "plane.yaml:17:5: output/monitors/tip"}})
    EXPECT_EQ(errorOf(from, to), std::string(place) + ": a plane body has no z");
}

TEST(PlaneDeck, badValuesAreNamed) {
  EXPECT_EQ(errorOf("kind: stress, thickness: 0.5", "kind: axisymmetric, thickness: 0.5"),
            "plane.yaml:4:40: plane/thickness: is not for kind: axisymmetric");
  EXPECT_EQ(errorOf("kind: stress", "kind: shear").substr(0, 43),
            "plane.yaml:4:15: plane/kind: 'shear' is not");
  EXPECT_EQ(errorOf("lengths: [4, 2]", "lengths: [4, 0]"),
            "plane.yaml:3:41: mesh/generate/lengths: each must be positive, got the list [4, 0]");
}

namespace {

/// The line with which a contact with these keys is refused; the law that it has where it is not.
std::string zonesOf(const std::string& keys) {
  const std::string text =
      "tools:\n  roll: {type: cylinder, center: [2, -9, 0], axis: [0, 0, 1], radius: 8}\n"
      "contact:\n  lower: {tool: roll, set: y_min, " +
      keys + "}\npath:\n";
  try {
    const Deck deck = readDeckText(changed("path:\n", text), "plane.yaml");
    checkAgainstMesh(deck, meshOf(deck));
    std::ostringstream first, second;
    describe(deck, first);
    describe(readDeckText(first.str(), "plane.yaml"), second);
    EXPECT_EQ(first.str(), second.str());
    const Contact::Law law = deck.contacts[0].law;
    return law == Contact::Law::Linear ? "linear" : law == Contact::Law::Auto ? "open" : "another law";
  } catch (const DeckError& error) {
    return error.what();
  }
}

}  // namespace

TEST(PlaneDeck, zonesHavePressuresWithAnEdge) {
  EXPECT_EQ(zonesOf("points: zones"), "open");
  EXPECT_EQ(zonesOf("law: linear"), "linear");
  EXPECT_EQ(zonesOf("points: zones, law: linear, stiffness: 100"), "linear");
  EXPECT_EQ(zonesOf("points: zones, law: power_overclosure, stiffness: 100, exponent: 3"), "another law");
  EXPECT_EQ(zonesOf("points: zones, law: penalty"),
            "plane.yaml:16:55: contact/lower/law: zones begin where the pressure does; expected linear or "
            "power_overclosure");
  EXPECT_EQ(
      zonesOf("points: quadrature, law: linear"),
      "plane.yaml:16:60: contact/lower/law: a pressure with an edge is integrated up to it; expected points: "
      "zones beside it");
  EXPECT_EQ(zonesOf("points: zones, law: power_overclosure, exponent: 1.5"),
            "plane.yaml:16:84: contact/lower/exponent: zones have Taylor series for whole exponents only; "
            "expected 1 to "
            "8, got 1.5");
  EXPECT_EQ(zonesOf("points: zones, stiffness: rigid"),
            "plane.yaml:16:61: contact/lower/stiffness: a pressure with an edge has a finite stiffness");
}
