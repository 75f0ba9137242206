// Coupled problems without closed forms: the same discrete problems by GetFEM (physics.py, physics.csv).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "support/Command.hpp"
#include "support/Folder.hpp"
#include "support/Table.hpp"

namespace atrapos::test {
namespace {

struct Value {
  std::string quantity, x, y;
  double value = 0;
};

std::vector<Value> valuesOf(const std::string& problem) {
  std::ifstream file(ATRAPOS_PEER_DATA "/physics.csv");
  std::vector<Value> values;
  for (std::string line; std::getline(file, line);) {
    std::istringstream cells(line);
    std::string name, number;
    Value v;
    std::getline(cells, name, ',');
    std::getline(cells, v.quantity, ',');
    std::getline(cells, v.x, ',');
    std::getline(cells, v.y, ',');
    std::getline(cells, number, ',');
    if (name != problem) continue;
    v.value = std::stod(number);
    values.push_back(v);
  }
  return values;
}

const std::string mesh = R"(mesh:
  file: plate.exo
  generate: {shape: rectangle, cell: QUAD9, divisions: [8, 4], lengths: [2, 1]}
)";

/// The deck with a monitor for each value of GetFEM's, to load factor 1. Both solve the same discrete
/// problem: differences are the path's residual (1e-10 of the forces) by the problem's condition.
void expectSame(const std::string& problem, const std::string& deck) {
  const std::vector<Value> values = valuesOf(problem);
  ASSERT_GE(values.size(), 4u);
  std::string monitors;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool u = problem == "dielectric" && values[i].quantity[0] == 'u';
    const std::string what = u ? "type: displacement, component: " + values[i].quantity.substr(1)
                               : "type: field, field: " + values[i].quantity;
    monitors +=
        fmt::format("    m{}: {{{}, set: x_lines, near: [{}, {}, 0]}}\n", i, what, values[i].x, values[i].y);
  }
  const TemporaryFolder folder;
  writeFile(folder / "deck.yaml", mesh + deck +
                                      "path: {accuracy: 1.0e-9, residual: 1.0e-10, stop: {load_factor: 1}}\n"
                                      "output:\n  monitors:\n" +
                                      monitors);
  ASSERT_EQ(runAtrapos({"mesh", "-q", "deck.yaml"}, folder.path()).exitCode, 0);
  const CommandResult r = runAtrapos({"run", "-q", "deck.yaml", "-o", "results"}, folder.path());
  ASSERT_EQ(r.exitCode, 0) << r.err;
  const Table path(folder / "results" / "path.csv");
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(path.column("m" + std::to_string(i)).back(), values[i].value, 1e-8)
        << problem << " " << values[i].quantity << " at " << values[i].x << ", " << values[i].y;
}

}  // namespace

TEST(Getfem, Bratu) {
  expectSame("bratu", R"deck(physics:
  reaction: {type: balance, field: u, blocks: [body], conductivity: 1, source: 3*lambda*exp(u)}
supports:
  left: {set: x_min, field: u, value: 0}
  right: {set: x_max, field: u, value: 0}
  bottom: {set: y_min, field: u, value: 0}
  top: {set: y_max, field: u, value: 0}
)deck");
}

TEST(Getfem, ConductorThatHeatsAndRadiates) {
  expectSame("conductor", R"deck(physics:
  current: {type: balance, field: V, blocks: [body], conductivity: 5/(1 + 0.3*T)}
  heat:
    type: balance
    field: T
    blocks: [body]
    conductivity: 1 + 0.1*T
    source: 5/(1 + 0.3*T)*dot(grad(V), grad(V))
fields:
  T: {initial: 1}
loads:
  air: {type: inflow, set: y_max, field: T, amount: 0.5*(1 - T) + 0.1*(1 - T^4)}
supports:
  left: {set: x_min, field: V, value: 0}
  right: {set: x_max, field: V, value: {per_load_factor: 2}}
  bottom: {set: y_min, field: T, value: 1}
  side: {set: x_min, field: T, value: 1}
)deck");
}

TEST(Getfem, PlateInAnElectricField) {
  expectSame("dielectric", R"deck(plane: {kind: strain}
materials:
  elastomer:
    law: neo_hookean
    shear_modulus: 1
    bulk_modulus: 2.6666666666666665
    blocks: [body]
    dielectric: {field: phi, permittivity: 1}
supports:
  left: {set: x_min, x: 0, y: 0}
  ground: {set: y_min, field: phi, value: 0}
  electrode: {set: y_max, field: phi, value: {per_load_factor: 0.5}}
)deck");
}

}  // namespace atrapos::test
