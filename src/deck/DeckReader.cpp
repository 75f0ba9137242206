#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "deck/DeckReferences.hpp"
#include "deck/DeckTables.hpp"
#include "deck/Entries.hpp"

namespace atrapos::deck {
namespace {

/// A file of surfaces: a deck with the one key `surfaces`.
struct SurfaceFile {
  std::vector<SplineSurface> surfaces;
};

std::vector<SplineSurface> readSurfaces(const std::string& file) {
  static const Table<SurfaceFile> table{entries("surfaces", required, &SurfaceFile::surfaces,
                                                splineSurfaceTable(), "each with degree, points, ...",
                                                "Bezier, B-spline and NURBS surfaces")};
  SurfaceFile content;
  read(table, Value(readYaml(readText(file), file)), content);
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

// ------------------------------------------------------------------ Young's modulus at rest, one line each
double isotropic(double shear, double bulk) { return 9 * shear / (3 + shear / bulk); }

double youngsModulus(const SaintVenantKirchhoff& m) { return m.youngsModulus; }
double youngsModulus(const NeoHookean& m) {
  return m.youngsModulus ? *m.youngsModulus : isotropic(m.shearModulus.value(), m.bulkModulus.value());
}
double youngsModulus(const MooneyRivlin& m) { return isotropic(2 * (m.c1 + m.c2), m.bulkModulus); }
double youngsModulus(const Yeoh& m) { return isotropic(2 * m.c1, m.bulkModulus); }
double youngsModulus(const Gent& m) { return isotropic(m.shearModulus, m.bulkModulus); }
double youngsModulus(const Ogden& m) {
  return isotropic(std::inner_product(m.mu.begin(), m.mu.end(), m.alpha.begin(), 0.0) / 2, m.bulkModulus);
}
double youngsModulus(const VonMises& m) { return m.youngsModulus; }

}  // namespace

double largestYoungsModulus(const Deck& deck) {
  double largest = 0;
  for (const Material& material : deck.materials) {
    largest = std::max(largest, std::visit([](const auto& law) { return youngsModulus(law); }, material.law));
  }
  return largest;
}

Deck readDeckText(const std::string& text, const std::string& file) {
  const Value root(readYaml(text, file));

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
    if (!deck.materials.empty()) {
      deck.output.fields = {OutputField::Displacement, OutputField::Stress, OutputField::Reaction};
    }
    if (!scalarFields(deck).empty()) {
      deck.output.fields.push_back(OutputField::Field);
    }
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

void failAt(const Deck& deck, const std::string& keys, const std::string& what) {
  if (deck.text.empty()) {
    throw DeckError(plainLine(fmt::format("{}: {}: {}", deck.file, keys, what)));
  }
  Value(readYaml(deck.text, deck.file)).failUnder(keys, what);
}

Deck readDeck(const std::string& file) {
  if (std::filesystem::is_directory(file)) {
    throw DeckError(file + ": is a folder; expected a deck file");
  }
  return readDeckText(readText(file), file);
}

}  // namespace atrapos::deck
