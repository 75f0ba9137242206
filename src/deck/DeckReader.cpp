#include <fmt/format.h>

#include <Teuchos_ParameterList.hpp>
#include <Teuchos_YamlParameterListCoreHelpers.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "deck/DeckReferences.hpp"
#include "deck/DeckTables.hpp"
#include "deck/Entries.hpp"
#include "deck/YamlText.hpp"

namespace atrapos::deck {
namespace {

constexpr const char* listOfMaps = "a list of maps is not accepted; write a map of named entries instead";

/// One line from Teuchos' message of several, at its place in the deck.
std::string explained(const std::string& message, const YamlText& text) {
  std::smatch match;
  std::string place, what;
  YamlText::Position at;
  if (std::regex_search(message, match, std::regex("line ([0-9]+) column ([0-9]+)"))) {
    // The reader names the column after the character that it refuses.
    at = text.original(std::stoi(match[1]), std::max(1, std::stoi(match[2]) - 1));
    place = fmt::format("line {}, column {}: ", at.line, at.column);
  }
  const bool listItem = at.line > 0 && std::regex_search(text.line(at.line), std::regex("^\\s*- "));
  if (std::regex_search(message, match, std::regex("Parameter \"(.*)\" already exists"))) {
    what = fmt::format("'{}' is given twice in one map", match[1].str());
  } else if (message.find("arrays can't be empty") != std::string::npos) {
    what = "a list must not be empty";
  } else if (message.find("sub-arrays are different sizes") != std::string::npos) {
    what = "the lists in a list must have the same length";
  } else if (message.find("any_cast") != std::string::npos) {
    what = listOfMaps;
  } else if (std::regex_search(message, match, std::regex("Expected one of (\\{.*\\})\nGot: (.*)"))) {
    const std::string expected = match[1], got = match[2];
    if (got == ":") {
      what = listItem ? listOfMaps : "unexpected ':'; a text that holds ':' needs quotes";
    } else if (got == "INDENT") {
      what = "this line is indented more than the one before, which begins no block";
    } else if (got.size() == 1) {
      what = fmt::format("unexpected '{}' (a text with special characters needs quotes); accepted here: {}",
                         got, expected);
    } else {
      what = fmt::format("unexpected {}; accepted here: {}", got, expected);
    }
  } else {
    what = message;
    for (char& c : what) {
      c = c == '\n' ? ' ' : c;
    }
  }
  return place + what;
}

Teuchos::RCP<Teuchos::ParameterList> parse(const YamlText& text, const std::string& file) {
  try {
    return Teuchos::getParametersFromYamlString(text.yaml());
  } catch (const std::exception& error) {
    throw DeckError(fmt::format("{}: {}", file, explained(error.what(), text)));
  }
}

std::string readText(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (!in || (in.peek() != EOF && !(text << in.rdbuf()))) {
    throw DeckError(fmt::format("{}: cannot be read: {}", file, std::strerror(errno)));
  }
  return text.str();
}

/// A file of surfaces: a deck with the one key `surfaces`.
struct SurfaceFile {
  std::vector<SplineSurface> surfaces;
};

std::vector<SplineSurface> readSurfaces(const std::string& file) {
  static const Table<SurfaceFile> table{entries("surfaces", required, &SurfaceFile::surfaces,
                                                splineSurfaceTable(), "each with degree, points, ...",
                                                "Bezier, B-spline and NURBS surfaces")};
  const YamlText yaml(readText(file), file);
  const auto list = parse(yaml, file);
  SurfaceFile content;
  read(table, Value(*list, yaml, file), content);
  return content.surfaces;
}

/// Reads what the tools have in files beside the deck.
void readToolFiles(const Value& root, const std::filesystem::path& folder, Deck& deck) {
  for (Tool& tool : deck.tools) {
    auto* patches = std::get_if<PatchesTool>(&tool.surface);
    if (patches == nullptr || patches->file.empty()) {
      continue;
    }
    const auto path = (folder / patches->file).lexically_normal();
    if (!std::filesystem::is_regular_file(path)) {
      root.at("tools").at(tool.name).at("file").fail(
          fmt::format("the file '{}' does not exist", path.string()));
    }
    patches->surfaces = readSurfaces(path.string());
  }
}

}  // namespace

double largestYoungsModulus(const Deck& deck) {
  double largest = 0;
  for (const Material& material : deck.materials) {
    largest = std::max(largest, std::visit([](const auto& law) { return law.youngsModulus; }, material.law));
  }
  return largest;
}

Deck readDeckText(const std::string& text, const std::string& file) {
  const YamlText yaml(text, file);
  const auto list = parse(yaml, file);
  const Value root(*list, yaml, file);

  Deck deck;
  deck.file = file;
  deck.text = text;
  const std::filesystem::path path(file);
  if (root.has("problem")) {
    read(problemDeckTable(), root, deck);
    checkBranches(root, deck);
    checkMethod(root, deck);
    if (deck.title.empty()) {
      deck.title = path.stem().string();
    }
    return deck;
  }
  read(deckTable(), root, deck);
  if (deck.output.fields.empty()) {
    deck.output.fields = {OutputField::Displacement, OutputField::Stress, OutputField::Reaction};
    if (!deck.contacts.empty()) {
      deck.output.fields.push_back(OutputField::Contact);
    }
  }
  checkReferences(root, deck);
  checkMethod(root, deck);

  readToolFiles(root, path.parent_path(), deck);
  if (deck.title.empty()) {
    deck.title = path.stem().string();
  }
  deck.mesh.path = (path.parent_path() / deck.mesh.file).lexically_normal().string();
  return deck;
}

Deck readDeck(const std::string& file) {
  if (std::filesystem::is_directory(file)) {
    throw DeckError(file + ": is a folder; expected a deck file");
  }
  return readDeckText(readText(file), file);
}

}  // namespace atrapos::deck
