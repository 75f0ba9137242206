#pragma once

#include <algorithm>
#include <cstddef>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace atrapos::test {

/// Where a language has its values, and what is likely to trouble its reader.
struct Language {
  std::string separators;           ///< each stands before a value
  std::string ends;                 ///< what a value ends at
  std::vector<std::string> values;  ///< that are put in the place of others
  std::string signs;                ///< that mean something
  bool indents = false;             ///< whether blanks before a line do
};

Language yaml();
/// Input files of Abaqus and CalculiX.
Language inp();

/// Changes texts at random, in one to four places: values, bytes, signs, lines deleted, doubled, swapped and
/// indented, the end cut off.
class TextMutator {
 public:
  TextMutator(Language language, unsigned seed) : language_(std::move(language)), random_(seed) {}

  std::string operator()(std::string text) {
    for (std::size_t n = 1 + below(4); n > 0; --n) text = once(text);
    return text;
  }
  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }

  /// With another value in one place, for any text.
  std::string withOtherValue(const std::string& text) {
    const std::size_t at = text.find_first_of(language_.separators, below(text.size()));
    if (at == std::string::npos) return text;
    const std::size_t end = text.find_first_of(language_.ends, at + 1);
    return text.substr(0, at + 1) + language_.values[below(language_.values.size())] +
           (end == std::string::npos ? "" : text.substr(end));
  }

 private:
  std::string once(const std::string& text) {
    switch (below(8)) {
      case 0:
        return withOtherValue(text);
      case 1: {
        std::string changed = text;
        if (!changed.empty()) changed[below(changed.size())] = static_cast<char>(random_());
        return changed;
      }
      case 2: {
        std::string changed = text;
        changed.insert(below(changed.size() + 1),
                       std::string(1 + below(below(20) == 0 ? 3000 : 3),
                                   language_.signs[below(language_.signs.size())]));
        return changed;
      }
      case 3:
        return text.substr(0, below(text.size()));
      default:
        return withOtherLines(text);
    }
  }

  std::string withOtherLines(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    if (lines.empty()) return text;
    const std::size_t i = below(lines.size()), j = below(lines.size());
    switch (below(language_.indents ? 4 : 3)) {
      case 0:
        lines.erase(lines.begin() + static_cast<long>(i));
        break;
      case 1: {
        const std::string line = lines[i];
        lines.insert(lines.begin() + static_cast<long>(j), line);
        break;
      }
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

  Language language_;
  std::mt19937 random_;
};

inline Language yaml() {
  return {":",
          ",}\n",
          {"",        " ~",      " 0",          " -1",
           " 1e308",  " -1e308", " 1e-308",     " 1e999",
           " nan",    " .inf",   " 2147483647", " 2147483648",
           " true",   " []",     " {}",         " 99999999999999999999",
           " [1, 2]", " {x: 1}", " '",          " [[1, 2, 3]]",
           " \"",     " &a",     " *a",         " !!int 3",
           " <<: *a", " |",      " >",          " - ",
           " #",      " \t",     " \xff",       " \xc2\x85",
           " 0x10",   " 1_000",  " auto"},
          "{}[],:-&*!|>'\"#%@`\n \t",
          true};
}

inline Language inp() {
  return {",=",
          ",\n",
          {"",           "0",
           "-1",         "1e308",
           "-1e308",     "1e999",
           "nan",        "inf",
           "2147483647", "1.",
           "2147483648", "+-1",
           "1D3",        "both",
           "all",        "\"a, b\"",
           "*NODE",      "x=\"y",
           "\xff",       "99999999999999999999",
           "\xc2\x85",   "S9",
           "P0",         "\"",
           "=",          "1, 2147483647, 1"},
          std::string("*,=\"\n\r\t .\0GENERATE", 19),
          false};
}

}  // namespace atrapos::test
