// Decks with changes at random: each is read, or refused with one line. ATRAPOS_MUTANTS asks for more of them
// (scripts/fuzz).
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

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
  const char* const asked = std::getenv("ATRAPOS_MUTANTS");
  const int mutants = asked != nullptr ? std::atoi(asked) : 3000;
  const auto bases = examples();
  ASSERT_GT(bases.size(), 10u);
  test::TextMutator mutate(test::yaml(), 8);
  int read = 0, refused = 0;
  double slowest = 0;
  for (int m = 0; m < mutants; ++m) {
    const Base& base = bases[mutate.below(bases.size())];
    const std::string text = mutate(base.text);
    const auto start = std::chrono::steady_clock::now();
    try {
      const Deck deck = readDeckText(text, base.file);
      std::ostringstream described;
      describe(deck, described);
      readDeckText(described.str(), base.file);  // reads back, whatever it was made of
      ++read;
    } catch (const DeckError& e) {
      const std::string line = e.what();
      ASSERT_EQ(line.find('\n'), std::string::npos) << line << "\n" << text;
      ASSERT_EQ(line.rfind(base.file, 0), 0u) << line;
      ++refused;
    } catch (const std::exception& e) {
      FAIL() << "mutant " << m << ": " << e.what() << "\n" << text;
    }
    slowest =
        std::max(slowest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  EXPECT_LT(slowest, 10);
  EXPECT_GT(read, mutants / 20);
  EXPECT_GT(refused, mutants / 4);
  std::cout << mutants << " mutants of " << bases.size() << " decks: " << read << " read, " << refused
            << " refused, the slowest in " << slowest << " s\n";
}

}  // namespace
}  // namespace atrapos::deck
