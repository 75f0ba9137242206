// Keys of the whole deck and of its named entries.
#include "deck/DeckTables.hpp"

#include <cctype>

namespace atrapos::deck {
namespace {

void checkEntryName(const Value& entry) {
  const std::string key = entry.key();
  const bool word = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
  });
  if (!word) {
    entry.fail("a name is made of letters, digits, '_', '-' and '.'");
  }
}

/// A map of named entries, read and printed by `Kind`, a Table or Variants.
template <class S, class Entry, class Kind>
Field<S> entries(std::string key, Need need, std::vector<Entry> S::*member, const Kind& kind,
                 std::string accepts, std::string meaning) {
  const std::string expected = "a map of named entries, " + accepts;
  return {std::move(key),
          need == required,
          expected,
          std::move(meaning),
          [=, &kind](const Value& v, S& s) {
            if (v.keys().empty()) {
              v.fail("is empty; expected " + expected);
            }
            for (const auto& name : v.keys()) {
              const Value value = v.at(name);
              checkEntryName(value);
              Entry entry{};
              entry.name = name;
              read(kind, value, entry);
              (s.*member).push_back(std::move(entry));
            }
          },
          [=, &kind](const S& s) {
            Node node;
            for (const auto& entry : s.*member) {
              node.children.emplace_back(entry.name, print(kind, entry));
            }
            return node;
          }};
}

Field<Output> outputFieldList() {
  const auto& choices = outputFields();
  return {"fields",
          false,
          "a list of " + joined(wordsOf(choices)),
          "what the result file holds besides the path",
          [&choices](const Value& v, Output& s) {
            for (const auto& word : v.texts()) {
              const auto field = choose(v, word, choices);
              if (std::find(s.fields.begin(), s.fields.end(), field) != s.fields.end()) {
                v.fail(fmt::format("'{}' is given twice", word));
              }
              s.fields.push_back(field);
            }
          },
          [&choices](const Output& s) {
            std::vector<std::string> words;
            for (const auto field : s.fields) {
              words.push_back(wordOf(field, choices));
            }
            return Node{yamlList(words), {}};
          }};
}

}  // namespace

const Table<Output>& outputTable() {
  static const Table<Output> table{integer("points_per_step", optional, &Output::pointsPerStep, check::count,
                                           "states written per step, its end included"),
                                   outputFieldList(),
                                   entries("monitors", optional, &Output::monitors, monitorVariants(),
                                           "each with type, ...", "numbers followed along the path")};
  return table;
}

const Table<Deck>& deckTable() {
  static const Table<Deck> table = [] {
    auto title = text("title", optional, &Deck::title, "a text", "of the result file");
    auto supports = entries("supports", required, &Deck::supports, supportTable(),
                            "each with set and any of x, y, z", "prescribed displacements");
    supports.read = [inner = supports.read](const Value& v, Deck& deck) {
      inner(v, deck);
      for (const auto& s : deck.supports) {
        if (!s.components[0] && !s.components[1] && !s.components[2]) {
          v.at(s.name).fail("holds nothing; expected at least one of x, y, z");
        }
      }
    };
    auto solver = block("solver", optional, &Deck::solver, solverTable(), "factors the tangent");
    solver.read = [inner = solver.read](const Value& v, Deck& deck) {
      inner(v, deck);
      if (deck.solver.type == Solver::Type::Amesos2 && deck.solver.name.empty()) {
        v.failMissing("name", "Amesos2's name of a solver, for example klu2");
      }
    };
    return Table<Deck>{
        title,
        block("mesh", required, &Deck::mesh, meshTable(), "the body's mesh"),
        entries("materials", required, &Deck::materials, materialVariants(), "each with law, blocks, ...",
                "what the blocks are made of"),
        supports,
        entries("loads", optional, &Deck::loads, loadVariants(), "each with type, ...",
                "dead loads, multiplied by the load factor"),
        entries("tools", optional, &Deck::tools, toolVariants(), "each with type, ...", "rigid surfaces"),
        entries("contact", optional, &Deck::contacts, contactTable(), "each with tool, set, stiffness, ...",
                "which part of the body may touch which tool"),
        block("path", required, &Deck::path, pathTable(), "how to follow the path and where to end"),
        solver,
        block("output", optional, &Deck::output, outputTable(), "what to write")};
  }();
  return table;
}

}  // namespace atrapos::deck
