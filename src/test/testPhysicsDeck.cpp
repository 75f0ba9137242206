// What decks say of scalar fields: good ones give their values, bad ones one line.
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "deck/Deck.hpp"

namespace {

using namespace atrapos;
using namespace atrapos::deck;

const char* const goodDeck = R"deck(mesh:
  file: plate.exo
  generate: {shape: rectangle, lengths: [4, 2], divisions: [4, 2], cell: QUAD8}
constants: {k: 3, T0: 20}
physics:
  heat: {type: balance, field: T, blocks: [body], conductivity: k*(1 + 0.01*T), source: "lambda*dot(grad(V), grad(V))"}
  current: {type: balance, field: V, blocks: [body], conductivity: 2}
fields:
  T: {initial: T0 + x}
supports:
  ground: {set: x_min, field: V, value: 0}
  pole: {set: x_max, field: V, value: {value: 1, per_load_factor: 2}}
loads:
  air: {type: inflow, set: y_max, field: T, amount: 5*(T0 - T)}
path:
  stop: {monitor: {middle: 7}}
output:
  monitors:
    middle: {type: field, field: T, set: y_max, near: [2, 2, 0]}
    current: {type: reaction, support: pole}
)deck";

std::string changed(const std::string& from, const std::string& to) {
  std::string text = goodDeck;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "the good deck has no '" << from << "'";
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string errorOf(const std::string& from, const std::string& to) {
  try {
    const Deck deck = readDeckText(changed(from, to), "heat.yaml");
    checkAgainstMesh(deck, fem::rectangleMesh(std::get<fem::RectangleOptions>(*deck.mesh.generate)));
  } catch (const DeckError& error) {
    return error.what();
  }
  return "no error";
}

void expectError(const std::string& from, const std::string& to, const std::string& words) {
  EXPECT_NE(errorOf(from, to).find(words), std::string::npos) << errorOf(from, to);
}

}  // namespace

TEST(PhysicsDeck, GoodDeckGivesItsValues) {
  const Deck deck = readDeckText(goodDeck, "heat.yaml");
  EXPECT_EQ(scalarFields(deck), (std::vector<std::string>{"T", "V"}));
  EXPECT_EQ(deck.constants.at("T0"), 20);
  const auto& heat = std::get<ScalarBalance>(deck.physics[0].law);
  EXPECT_EQ(heat.conductivity, "k*(1 + 0.01*T)");
  EXPECT_EQ(std::get<ScalarBalance>(deck.physics[1].law).source, "0");
  EXPECT_EQ(deck.supports[1].value->perLoadFactor, 2);
  EXPECT_EQ(std::get<InflowLoad>(deck.loads[0].load).amount, "5*(T0 - T)");
  EXPECT_EQ(deck.path.stop.monitors.at("middle"), std::vector<double>{7});
  EXPECT_EQ(deck.output.fields, std::vector<OutputField>{OutputField::Field});
  EXPECT_EQ(errorOf("k: 3", "k: 3"), "no error");
}

TEST(PhysicsDeck, DescriptionReadsBack) {
  std::ostringstream once, twice;
  describe(readDeckText(goodDeck, "heat.yaml"), once);
  describe(readDeckText(once.str(), "heat.yaml"), twice);
  EXPECT_EQ(once.str(), twice.str());
  EXPECT_NE(once.str().find("k*(1 + 0.01*T)"), std::string::npos) << once.str();
}

TEST(PhysicsDeck, BadDecksAreRefusedInOneLine) {
  expectError("conductivity: 2", "conductivity: 2*W",
              "physics/current/conductivity: does not know 'W'; known are T, T0, V, k, lambda, x, y, z, pi");
  expectError("conductivity: 2", "conductivity: 2*", "is no formula: it ends too early");
  expectError("conductivity: 2}", "}",
              "physics/current: says nothing; expected conductivity, source or both");
  expectError("field: V, blocks", "field: exp, blocks",
              "'exp' cannot be the name of a field; expected letters");
  expectError("field: V, blocks", "field: k, blocks", "'k' is the name of a constant already");
  expectError("k: 3", "lambda: 3", "constants/lambda: cannot be the name of a constant");
  expectError("k: 3", "k: three", "constants/k: expected a finite number");
  expectError("field: V, blocks: [body]", "field: V, blocks: [boddy]", "the mesh has no block 'boddy'");
  expectError("T: {initial: T0 + x}", "S: {initial: 1}", "fields/S: no physics has a field 'S'");
  expectError("initial: T0 + x", "initial: T0 + lambda", "fields/T/initial: does not know 'lambda'");
  expectError("field: V, value: 0", "field: S, value: 0",
              "supports/ground/field: no physics has a field 'S'");
  expectError("field: V, value: 0", "field: V", "supports/ground/value: is missing");
  expectError("field: V, value: 0", "value: 0", "supports/ground/field: is missing");
  expectError("field: V, value: 0", "field: V, value: 0, x: 0", "stands beside displacements");
  expectError("amount: 5*(T0 - T)", "amount: \"dot(grad(T), grad(T))\"",
              "has grad where no field has a gradient");
  expectError("amount: 5*(T0 - T)", "amount: 1, constant: true", "has no meaning with type: inflow");
  expectError("set: y_max, field: T, amount", "set: top, field: T, amount", "the mesh has no side set 'top'");
  expectError("support: pole", "support: pole, component: x", "whose inflow has no components");
  expectError("{middle: 7}", "{current: 7}",
              "the monitor 'current' is not of type displacement, rotation or field");
  expectError("  monitors:\n    middle", "  fields: [stress]\n  monitors:\n    middle",
              "'stress' needs the block materials");
  expectError("value: {value: 1, per_load_factor: 2}}", "value: 1}", "no error");
}

/// Hopf points are those of balances and flows, on a path of series with MUMPS.
TEST(PhysicsDeck, HopfPointsAreRefusedWhereTheyHaveNoMeaning) {
  const std::string path = "path:\n";
  ASSERT_NE(std::string(goodDeck).find(path), std::string::npos);
  const auto with = [&](const std::string& more) { return path + "  hopf: true\n" + more; };
  expectError(path, with("  critical_points: off\n"),
              "path/hopf: needs path/critical_points: automatic or every_step");
  expectError(path, with("  method: newton\n"), "path/hopf");
  expectError(path, "solver: {type: belos}\n" + with(""),
              "path/hopf: eigenvalues are found by the factored tangent");
  expectError(path, with("  hopf_eigenvalues: 0\n"), "path/hopf_eigenvalues: must be at least 1, got 0");
  expectError("conductivity: 2", "conductivity: 2, capacity: 2*W",
              "physics/current/capacity: does not know 'W'");
}

/// Nothing in the deck says lambda.
TEST(PhysicsDeck, SomethingDependsOnTheLoadFactor) {
  std::string text = changed("source: \"lambda*dot", "source: \"dot");
  const std::string driven = "value: {value: 1, per_load_factor: 2}";
  text.replace(text.find(driven), driven.size(), "value: 1");
  try {
    readDeckText(text, "heat.yaml");
    FAIL();
  } catch (const DeckError& error) {
    EXPECT_NE(std::string(error.what()).find("nothing depends on the load factor"), std::string::npos)
        << error.what();
  }
}
