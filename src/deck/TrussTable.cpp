// Keys of meshes of bars.
#include "deck/DeckTables.hpp"
#include "deck/Entries.hpp"

namespace atrapos::deck {
namespace {

using Truss = fem::TrussOptions;

Field<Truss> nodes() {
  return {"nodes",
          true,
          "a list of lists of 3 finite numbers",
          "places, numbered from 1",
          [](const Value& v, Truss& s) { s.nodes = v.rowsOf3(); },
          [](const Truss& s) {
            return Node{yamlRows(s.nodes), {}};
          }};
}

Field<Truss> bars() {
  static constexpr const char* expected = "a list of lists of 2 whole numbers";
  return {"bars",
          true,
          expected,
          "the nodes at the ends of each",
          [](const Value& v, Truss& s) {
            for (const Value& row : v.list(expected)) {
              const auto ends = row.integers(2, check::count);
              s.bars.push_back({ends[0], ends[1]});
            }
          },
          [](const Truss& s) {
            return Node{yamlRows(s.bars), {}};
          }};
}

Field<Truss> sets() {
  static constexpr const char* expected = "a map of names to lists of whole numbers";
  return {"sets",
          false,
          expected,
          "node sets",
          [](const Value& v, Truss& s) {
            if (!v.isMap()) {
              v.fail(fmt::format("expected {}, got {}", expected, v.shown()));
            }
            for (const Value& set : v.children()) {
              checkEntryName(set);
              s.sets.push_back({set.key(), set.integers(check::count)});
            }
          },
          [](const Truss& s) {
            Node node;
            for (const auto& set : s.sets) {
              node.children.emplace_back(set.name, Node{yamlList(set.nodes), {}});
            }
            return node;
          }};
}

}  // namespace

const Table<fem::TrussOptions>& trussTable() {
  static const Table<Truss> table{
      nodes(), bars(), sets(),
      text("block", optional, &Truss::blockName, "a text", "name of the mesh's one block")};
  return table;
}

}  // namespace atrapos::deck
