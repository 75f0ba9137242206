#include "scene/DeckMesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "atrapos/exodus/JoinedMesh.hpp"
#include "atrapos/exodus/MeshFile.hpp"
#include "machine/PartExchange.hpp"
#include "machine/Ranks.hpp"

namespace atrapos {
namespace {

/// All parts, each read by one rank. What is wrong with one is thrown on all.
std::vector<exodus::MeshPart> readParts(const std::string& file, int count) {
  std::vector<exodus::MeshPart> parts;
  if (ranks::count() == 1) {
    for (int p = 0; p < count; ++p) parts.push_back(exodus::readPart(exodus::partName(file, count, p)));
    return parts;
  }
  std::string own;
  bool fine = true;
  try {
    own = packed(exodus::readPart(exodus::partName(file, count, ranks::own())));
  } catch (const exodus::Error& e) {
    fine = false;
    own = e.what();
  }
  const auto mark = ranks::gather(fine ? "+" : "-"), all = ranks::gather(own);
  for (std::size_t r = 0; r < all.size(); ++r)
    if (mark[r] == "-") throw exodus::Error(all[r]);
  for (const std::string& bytes : all) parts.push_back(unpacked(bytes));
  return parts;
}

/// How many parts to read.
int numberOfParts(const deck::Deck& deck) {
  const std::string& file = deck.mesh.path;
  const std::vector<int> found = exodus::findParts(file);
  if (found.empty())
    deck::failAt(
        deck, "mesh/decomposed",
        fmt::format("there are no part files {0}.<ranks>.<rank>; `atrapos split {0} N` makes them of a "
                    "whole mesh",
                    file));
  const std::string which =
      fmt::format("{} is cut into {} parts", file, fmt::join(found, " and again into "));
  if (ranks::count() == 1) {
    if (found.size() == 1) return found.front();
    deck::failAt(deck, "mesh/file",
                 which + "; one rank joins the parts of one decomposition: remove the others");
  }
  if (std::find(found.begin(), found.end(), ranks::count()) == found.end())
    deck::failAt(
        deck, "mesh/file",
        fmt::format("{}, but runs on {} ranks: start mpirun -np {}, or cut it anew with `atrapos split`",
                    which, ranks::count(), found.front()));
  return ranks::count();
}

}  // namespace

DeckMesh readDeckMesh(const deck::Deck& deck) {
  const std::string& file = deck.mesh.path;
  const bool whole = ranks::any(std::filesystem::exists(file));
  try {
    if (deck.mesh.decomposed || (!whole && ranks::any(!exodus::findParts(file).empty()))) {
      const auto parts = readParts(file, numberOfParts(deck));
      exodus::JoinedMesh joined = exodus::join(parts, file);
      if (ranks::count() == 1) return std::move(joined.mesh);
      return {std::move(joined.mesh), std::move(joined.partOfElement)};
    }
    if (!whole)
      deck::failAt(
          deck, "mesh/file",
          fmt::format("{} does not exist{}", file,
                      deck.mesh.generate ? fmt::format("; `atrapos mesh {}` makes it", deck.file) : ""));
    return exodus::readMesh(file);
  } catch (const exodus::Error& e) {
    deck::failAt(deck, "mesh/file", e.what());
  }
}

}  // namespace atrapos
