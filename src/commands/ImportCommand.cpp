#include "commands/ImportCommand.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <stdexcept>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "commands/MeshCommand.hpp"
#include "deck/Characters.hpp"
#include "deck/Deck.hpp"
#include "deck/Fields.hpp"
#include "import/Import.hpp"
#include "output/Files.hpp"

namespace atrapos {
namespace {

import::Model readModel(const std::string& file, import::Deck deck){
    std::string ending = std::filesystem::path(file).extension().string();
std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
if (ending == ".inp") return import::readInp(file, deck);
throw std::invalid_argument(
    fmt::format("{}: its ending says no format; expected .inp (Abaqus, CalculiX)", file));
}  // namespace

void requirePlaceForMesh(const std::string& file, const std::string& input) {
  requireOwn(file, Made::mesh, {input});
  std::error_code error;
  if (std::filesystem::exists(file, error) && exodus::ResultReader(file).numSteps() > 0)
    throw std::invalid_argument(fmt::format("{} holds results, which the mesh would replace", file));
}

std::string count(std::size_t n, const std::string& what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

}  // namespace atrapos

void importFile(const ImportWords& words, std::ostream& out) {
  const auto stem = std::filesystem::path(words.file).stem();
  const std::string mesh = words.output.empty() ? stem.string() + ".exo" : words.output;
  const std::string deckFile = std::filesystem::path(mesh).replace_extension(".yaml").string();
  requirePlaceForMesh(mesh, words.file);
  if (words.deck && std::filesystem::exists(deckFile))
    throw std::invalid_argument(
        fmt::format("{} is there already, and decks are not replaced; expected another --output", deckFile));
  const import::Model model = readModel(words.file, words.deck ? import::Deck::yes : import::Deck::no);
  std::string text;
  if (words.deck) {
    text = fmt::format("# Made by atrapos import of {}\nmesh: {{file: {}}}\n{}", deck::plainLine(words.file),
                       deck::yaml(std::filesystem::path(mesh).filename().string()), model.deck);
    deck::readDeckText(text, deckFile);  // constants that no law takes, say
  }
  exodus::writeMesh(model.mesh, mesh);
  if (words.deck) replaceFile(deckFile, text);
  if (words.quiet) return;
  out << fmt::format("{}: {}, {}, {}\n", mesh, describeMesh(model.mesh),
                     count(model.mesh.nodeSets.size(), "node set"),
                     count(model.mesh.sideSets.size(), "side set"));
  if (words.deck) out << fmt::format("{}: a deck, for atrapos run\n", deckFile);
  for (const std::string& remark : model.remarks) out << deck::plainLine(remark) << '\n';
}

}  // namespace atrapos
