// Keys of decks with a model problem instead of a mesh and what belongs to it.
#include "atrapos/models/Models.hpp"
#include "deck/DeckTables.hpp"

namespace atrapos::deck {
namespace {

Field<ModelProblem> modelName() {
  Choices<std::string> choices;
  for (const auto& name : models::names()) {
    choices.emplace_back(name, name);
  }
  return choice("name", required, &ModelProblem::name, choices, "which model problem");
}

Field<ModelProblem> modelParameters() {
  return {"parameters",
          false,
          "a map of the problem's parameters to numbers",
          "those that are not given have their defaults",
          [](const Value& v, ModelProblem& s) {
            const auto defaults = models::parameters(s.name);
            std::vector<std::string> allowed;
            for (const auto& [name, value] : defaults) {
              allowed.push_back(name);
            }
            refuseUnknownKeys(v, allowed);
            for (const Value& each : v.children()) {
              s.parameters[each.key()] = each.real();
            }
          },
          [](const ModelProblem& s) {
            Node node;
            for (const auto& [name, value] : s.parameters) {
              node.children.emplace_back(name, Node{yaml(value), {}});
            }
            return node;
          }};
}

}  // namespace

const Table<ModelProblem>& modelTable() {
  static const Table<ModelProblem> table{modelName(), modelParameters()};
  return table;
}

const Table<Deck>& problemDeckTable() {
  static const Table<Output> output = pathRowKeys();
  static const Table<Deck> table = [] {
    Field<Deck> problem{
        "problem",
        true,
        "a map with " + joined(keysOf(modelTable())),
        "a model problem instead of a mesh",
        [](const Value& v, Deck& deck) { read(modelTable(), v, deck.problem.emplace()); },
        [](const Deck& deck) { return deck.problem ? print(modelTable(), *deck.problem) : Node{}; }};
    return Table<Deck>{
        text("title", optional, &Deck::title, "a text", "of the run"), problem,
        block("path", optional, &Deck::path, modelPathTable(), "how to follow the path and where to end"),
        solverField(), block("output", optional, &Deck::output, output, "what to write")};
  }();
  return table;
}

}  // namespace atrapos::deck
