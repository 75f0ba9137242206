// Files of surfaces with changes at random: each makes a tool over which places have projections or none, or
// is refused with one line.
#include <gtest/gtest.h>

#include <Kokkos_Core.hpp>

#include <optional>

#include "TextMutants.hpp"
#include "TextMutator.hpp"
#include "deck/Deck.hpp"
#include "scene/DeckTool.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

const std::string kSurfaces =
                      "surfaces:\n"
                      "  saddle: {degree: [2, 1], points: [[0, -9, 0], [0, 9, 0], [5, -9, 2], [5, 9, 2], "
                      "[10, -9, 0], [10, 9, 0]],"
                      "\n           weights: [1, 1, 0.7, 0.7, 1, 1]}\n"
                      "  roll:\n    degree: [2, 1]\n    points: [[11, 3, 0], [11, -3, 0], [11, 3, 1], [11, "
                      "-3, 1], [10, 3, 1], "
                      "[10, -3, 1],\n             [9, 3, 1], [9, -3, 1], [9, 3, 0], [9, -3, 0]]\n"
                      "    weights: [1, 1, 0.7, 0.7, 1, 1, 0.7, 0.7, 1, 1]\n"
                      "    knots_1: [0, 0, 0, 1, 1, 2, 2, 2]\n    knots_2: [0, 0, 1, 1]\n",
                  kDeck =
                      "mesh: {file: m.exo}\n"
                      "materials:\n  m: {law: saint_venant_kirchhoff, youngs_modulus: 1000, "
                      "poissons_ratio: 0.3, blocks: [b]}\n"
                      "supports:\n  clamp: {set: x_min, x: 0, y: 0, z: 0}\n"
                      "tools:\n  die: {type: patches, file: die.yaml, motion: {shift: [0, 0, -1]}}\n"
                      "contact:\n  top: {tool: die, set: z_max}\n"
                      "path:\n  stop: {load_factor: 1}\n";

/// Numbers in lists too.
Language lists() {
  Language language = yaml();
  language.separators = ":[,";
  language.ends = ",]}\n";
  return language;
}

/// Numbers for numbers: surfaces that are folded, flat or far away.
Language numbers() {
  Language language = lists();
  language.separators = "[,";
  language.values = {" 0", " 1", " -1", " 2", " -9", " 9", " 0.5", " 1e-9", " 1e9", " 1e200", " 5.0"};
  return language;
}

/// The tool of the deck in the folder, asked for places around it.
void askTool(const std::string& deckFile) {
  const deck::Deck deck = deck::readDeckText(kDeck, deckFile);
  const SceneTools made = sceneTools(deck);
  for (const double x : {-3.0, 0.0, 5.0, 9.5, 40.0})
    for (const double z : {-2.0, 0.0, 1.2}) {
      const double place[4] = {x, 0.5, z, 0.3};
      made.tools.at(0)->project(place);
    }
}

TEST(Mutants, SurfacesAreReadOrRefusedWithOneLine) {
  const Kokkos::ScopeGuard kokkos;  // patches are held in its arrays
  TemporaryFolder folder;
  const std::string deckFile = (folder / "d.yaml").string(), file = (folder / "die.yaml").string();
  writeFile(file, kSurfaces);
  askTool(deckFile);
  TextMutator mutate(lists(), 8), change(numbers(), 9);
  TextMutants mutants(1500);
  mutants.tryAll(
      "surfaces",
      [&](int m) {
        return m % 2 == 0 ? mutate(kSurfaces) : change.withOtherValue(change.withOtherValue(kSurfaces));
      },
      [&](int, const std::string& text, std::optional<std::string>& line) {
        writeFile(file, text);
        try {
          askTool(deckFile);
        } catch (const deck::DeckError& e) {
          line = e.what();
          ASSERT_TRUE(line->rfind(deckFile, 0) == 0 || line->rfind(file, 0) == 0) << *line;
        }
      });
  EXPECT_GT(mutants.read(), mutants.number() / 20);
  EXPECT_GT(mutants.refused(), mutants.number() / 4);
}

}  // namespace
}  // namespace atrapos::test
