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
#include <random>
#include <sstream>

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

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::string operator()(std::string text) {
    for (std::size_t n = 1 + below(4); n > 0; --n) text = once(text);
    return text;
  }
  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }

 private:
  std::string once(const std::string& text) {
    switch (below(8)) {
      case 0: {  // a value
        static const std::vector<std::string> values{"",
                                                     "~",
                                                     "0",
                                                     "-1",
                                                     "1e308",
                                                     "-1e308",
                                                     "1e-308",
                                                     "1e999",
                                                     "nan",
                                                     ".inf",
                                                     "2147483647",
                                                     "2147483648",
                                                     "99999999999999999999",
                                                     "true",
                                                     "[]",
                                                     "{}",
                                                     "[1, 2]",
                                                     "[[1, 2, 3]]",
                                                     "{x: 1}",
                                                     "'",
                                                     "\"",
                                                     "&a",
                                                     "*a",
                                                     "!!int 3",
                                                     "<<: *a",
                                                     "|",
                                                     ">",
                                                     "- ",
                                                     "#",
                                                     "\t",
                                                     "\xff",
                                                     "\xc2\x85",
                                                     "0x10",
                                                     "1_000",
                                                     "auto"};
        const auto at = text.find(": ", below(text.size()));
        if (at == std::string::npos) return text;
        const auto end = text.find_first_of(",}\n", at + 2);
        return text.substr(0, at + 2) + values[below(values.size())] +
               (end == std::string::npos ? "" : text.substr(end));
      }
      case 1: {  // a byte
        std::string changed = text;
        if (!changed.empty()) changed[below(changed.size())] = static_cast<char>(random_());
        return changed;
      }
      case 2: {  // signs of YAML
        static const std::string signs = "{}[],:-&*!|>'\"#%@`\n \t";
        std::string changed = text;
        changed.insert(below(changed.size() + 1),
                       std::string(1 + below(below(20) == 0 ? 3000 : 3), signs[below(signs.size())]));
        return changed;
      }
      case 3:
        return text.substr(0, below(text.size()));
      default: {
        auto lines = linesOf(text);
        if (lines.empty()) return text;
        const std::size_t i = below(lines.size()), j = below(lines.size());
        switch (below(4)) {
          case 0:
            lines.erase(lines.begin() + static_cast<long>(i));
            break;
          case 1:
            lines.insert(lines.begin() + static_cast<long>(j), lines[i]);
            break;
          case 2:
            std::swap(lines[i], lines[j]);
            break;
          default:
            lines[i].insert(0, below(6), ' ');
        }
        std::string changed;
        for (const auto& line : lines) changed += line + '\n';
        return changed;
      }
    }
  }

  static std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }

  std::mt19937 random_;
};

TEST(Mutants, DecksAreReadOrRefusedWithOneLine) {
  const char* const asked = std::getenv("ATRAPOS_MUTANTS");
  const int mutants = asked != nullptr ? std::atoi(asked) : 3000;
  const auto bases = examples();
  ASSERT_GT(bases.size(), 10u);
  Mutator mutate(8);
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
