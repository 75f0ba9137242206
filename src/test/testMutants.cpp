// Decks with changes at random: each is read, or refused with one line.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

#include "TextMutants.hpp"
#include "TextMutator.hpp"
#include "deck/Deck.hpp"

namespace atrapos::deck {
namespace {

struct Base {
  std::string file, text;
};

std::vector<Base> examples() {
  std::vector<Base> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(ATRAPOS_EXAMPLES)) {
    if (entry.path().extension() != ".yaml") continue;
    std::ifstream in(entry.path());
    all.push_back({entry.path().string(), {std::istreambuf_iterator<char>(in), {}}});
  }
  std::sort(all.begin(), all.end(), [](const Base& a, const Base& b) { return a.file < b.file; });
  return all;
}

TEST(Mutants, DecksAreReadOrRefusedWithOneLine) {
  const auto bases = examples();
  ASSERT_GT(bases.size(), 10u);
  test::TextMutator mutate(test::yaml(), 8);
  std::string file;
  test::TextMutants mutants(3000);
  mutants.tryAll(
      std::to_string(bases.size()) + " decks",
      [&](int) {
        const Base& base = bases[mutate.below(bases.size())];
        file = base.file;
        return mutate(base.text);
      },
      [&](int, const std::string& text, std::optional<std::string>& line) {
        try {
          const Deck deck = readDeckText(text, file);
          std::ostringstream described;
          describe(deck, described);
          readDeckText(described.str(), file);  // reads back, whatever it was made of
        } catch (const DeckError& e) {
          line = e.what();
          ASSERT_EQ(line->rfind(file, 0), 0u) << *line;
        }
      });
  EXPECT_GT(mutants.read(), mutants.number() / 20);
  EXPECT_GT(mutants.refused(), mutants.number() / 4);
}

}  // namespace
}  // namespace atrapos::deck
