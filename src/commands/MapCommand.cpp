#include "commands/MapCommand.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <iostream>
#include <stdexcept>

#include "chart/DeckEdits.hpp"
#include "commands/FailureMap.hpp"
#include "commands/MeshCommand.hpp"
#include "commands/ModelCase.hpp"
#include "commands/SceneCase.hpp"
#include "commands/Stages.hpp"
#include "deck/DeckTables.hpp"
#include "plugin/Plugins.hpp"

namespace atrapos {
namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& word, const std::string& accepted) {
  throw std::invalid_argument(fmt::format("{} '{}': expected {}", option, word, accepted));
}

int order(const std::string& word) {
  if (word == "auto") return 0;
  char* end = nullptr;
  const long order = std::strtol(word.c_str(), &end, 10);
  if (*end != 0 || order < 1 || order > 60) refuse("--orders", word, "whole numbers from 1 to 60 or auto");
  return static_cast<int>(order);
}

/// A key of a deck and values for it.
struct Varied {
  std::string key;
  std::vector<deck::YamlTree> values;
};

Varied varied(const std::string& word) {
  constexpr const char* const expected = "KEY=LIST, as path/direction=[1, -1]";
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos || equals == 0) refuse("--vary", word, expected);
  const std::string key = word.substr(0, equals);
  deck::YamlTree list;
  try {
    list = chart::valueAt(deck::readYaml("list: " + word.substr(equals + 1), "--vary").root, "list");
  } catch (const deck::DeckError&) {
    refuse("--vary", word, expected);
  }
  if (!list || list->kind != deck::YamlNode::Kind::List || list->items.empty())
    refuse("--vary", word, expected);
  return {key, list->items};
}

/// A deck with values of its own.
struct Variant {
  deck::Deck deck;
  std::string values;      ///< "key=value ..."
  bool makesMesh = false;  ///< of mesh/generate, which may be another one than that of the file
};

Variant variantOf(const deck::Deck& deck, const chart::Edits& edits) {
  if (edits.empty()) return {deck, "", false};
  Variant variant{{}, chart::settingsOf(edits), false};
  deck::YamlTree root = deck::readYaml(deck.text, deck.file).root;
  for (const auto& [key, value] : edits) {
    variant.makesMesh = variant.makesMesh || key.rfind("mesh/generate", 0) == 0;
    try {
      root = chart::replaced(root, key, value);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("--vary {}: {}: {}", variant.values, deck.file, error.what()));
    }
  }
  try {
    variant.deck = deck::readDeckText(chart::yamlText(root), deck.file);
  } catch (const deck::DeckError& error) {
    throw std::invalid_argument(fmt::format("--vary {}: {}", variant.values, error.what()));
  }
  return variant;
}

std::vector<Variant> variantsOf(const deck::Deck& deck, const std::vector<Varied>& vary) {
  std::vector<chart::Edits> all(1);
  for (const Varied& varied : vary) {
    std::vector<chart::Edits> more;
    for (const chart::Edits& edits : all)
      for (const deck::YamlTree& value : varied.values) {
        more.push_back(edits);
        more.back().emplace_back(varied.key, value);
      }
    all = std::move(more);
  }
  std::vector<Variant> variants;
  for (const chart::Edits& edits : all) variants.push_back(variantOf(deck, edits));
  return variants;
}

MapProblem problemOf(const Variant& variant) {
  const deck::Deck& deck = variant.deck;
  MapProblem problem{deck, variant.values, nullptr};
  if (deck.problem) {
    problem.first = std::make_unique<ModelCase>(deck);
    return problem;
  }
  DeckMesh mesh = variant.makesMesh ? DeckMesh(generateMesh(deck)) : readDeckMesh(deck);
  const deck::Deck first = firstDeck(deck, mesh);
  problem.first = std::make_unique<SceneCase>(std::make_unique<Scene>(first, std::move(mesh)));
  return problem;
}

path::PadeUse pade(const std::string& word) {
  for (const auto& [name, use] : deck::padeUses())
    if (word == name) return use;
  refuse("--pade", word, "off, automatic or on");
}

MapOptions mapOptions(const MapWords& words) {
  MapOptions options;
  if (!words.orders.empty()) options.orders.clear();
  for (const std::string& word : words.orders) options.orders.push_back(order(word));
  if (!words.deltas.empty()) options.deltas = words.deltas;
  for (const double delta : options.deltas)
    if (!(delta > 0 && delta < 1))
      refuse("--deltas", fmt::format("{:g}", delta), "numbers above 0 and below 1");
  if (!words.pades.empty()) options.pades.clear();
  for (const std::string& word : words.pades) options.pades.push_back(pade(word));
  if (!words.output.empty()) options.file = words.output;
  return options;
}

}  // namespace

void makeMap(const MapWords& words) {
  MapOptions options = mapOptions(words);
  options.progress = words.quiet ? nullptr : &std::cout;
  std::vector<Varied> vary;
  for (const std::string& word : words.vary) vary.push_back(varied(word));
  std::vector<MakeProblem> problems;
  for (const std::string& file : words.decks) {
    const deck::Deck deck = deck::readDeck(file);
    for (Variant& variant : variantsOf(deck, vary)) {
      plugins::require(variant.deck);
      if (!variant.deck.path.series())
        deck::failAt(variant.deck, "path/method", "the map varies the settings of series; expected series");
      problems.push_back([variant = std::move(variant)] { return problemOf(variant); });
    }
  }
  writeMap(problems, words.decks, options);
}

}  // namespace atrapos
