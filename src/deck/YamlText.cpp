#include "deck/YamlText.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <sstream>

#include "deck/Deck.hpp"
#include "deck/DeckValue.hpp"

namespace atrapos::deck {
namespace {

constexpr int wrapperIndent = 2;

[[noreturn]] void fail(const std::string& file, int line, int column, const std::string& what) {
  throw DeckError(fmt::format("{}: line {}, column {}: {}", file, line, column, what));
}

std::vector<std::string> splitLines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line.back() == '\r') {
      line.pop_back();
    }
    lines.push_back(line);
  }
  return lines;
}

bool isBlank(char c) { return c == ' ' || c == '\t'; }

std::string trimmed(const std::string& s) {
  const auto first = s.find_first_not_of(" \t");
  return first == std::string::npos ? "" : s.substr(first, s.find_last_not_of(" \t") - first + 1);
}

// Teuchos converts these words to 0 and 1 in a list that also holds numbers.
bool isTruthWord(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  return word == "true" || word == "false" || word == "yes" || word == "no";
}

struct Bracket {
  char kind;
  int line, column;
};

// Follows quotes and brackets over the lines of a deck.
class Scanner {
 public:
  Scanner(const std::string& file, std::vector<Bracket>& brackets) : file_(file), brackets_(brackets) {}

  // Returns the line without its comment and trailing blanks; colon = column (0-based) of the first ':' that
  // ends a key outside brackets, if any.
  std::string scan(const std::string& line, int number, std::optional<std::size_t>& colon) {
    char quote = 0;
    std::size_t quoteStart = 0, end = line.size();
    bool valueStart = true;  // a quote opens a text only where a value may begin
    for (std::size_t i = 0; i < line.size(); ++i) {
      const char c = line[i];
      const int column = static_cast<int>(i) + 1;
      if (quote == 0 && c == '#' && (i == 0 || isBlank(line[i - 1]))) {
        end = i;
        break;
      }
      if (static_cast<unsigned char>(c) > 126 || (static_cast<unsigned char>(c) < 32 && c != '\t')) {
        fail(file_, number, column, "only plain ASCII characters are accepted outside comments");
      }
      if (quote != 0) {
        if (quote == '"' && c == '\\') {
          fail(file_, number, column,
               "backslashes are not used in decks; write the text in single quotes without them");
        } else if (c == quote && quote == '\'' && i + 1 < line.size() && line[i + 1] == '\'') {
          ++i;
        } else if (c == quote) {
          quote = 0;
        }
        continue;
      }
      if ((c == '"' || c == '\'') && valueStart) {
        quote = c;
        quoteStart = i;
        valueStart = false;
        continue;
      }
      if (c == '[' || c == '{') {
        brackets_.push_back({c, number, column});
        item_.clear();
        valueStart = true;
        continue;
      }
      if (c == ']' || c == '}' || c == ',') {
        if (!brackets_.empty() && brackets_.back().kind == '[' && isTruthWord(trimmed(item_))) {
          fail(file_, number, column, "a list takes numbers or names, not " + trimmed(item_));
        }
        item_.clear();
        if (c != ',') {
          if (brackets_.empty() || brackets_.back().kind != (c == ']' ? '[' : '{')) {
            fail(file_, number, column, fmt::format("'{}' closes nothing", c));
          }
          brackets_.pop_back();
        }
        valueStart = c == ',';
        continue;
      }
      if (c == ':' && brackets_.empty() && !colon) {
        colon = i;
      }
      item_ += c;
      valueStart = c == ':' || c == '-' || (isBlank(c) && valueStart);
    }
    if (quote != 0) {
      fail(file_, number, static_cast<int>(quoteStart) + 1, "a text in quotes must end on its own line");
    }
    std::string kept = line.substr(0, end);
    kept.erase(kept.find_last_not_of(" \t") + 1);
    return kept;
  }

 private:
  const std::string& file_;
  std::vector<Bracket>& brackets_;
  std::string item_;
};

std::string unquoted(const std::string& key) {
  const bool quoted =
      key.size() >= 2 && (key.front() == '"' || key.front() == '\'') && key.back() == key.front();
  return quoted ? key.substr(1, key.size() - 2) : key;
}

struct Level {
  int indent;
  bool isList;
  std::string prefix;               // key path of the block, with its trailing '/'
  std::map<std::string, int> keys;  // -> line
};

}  // namespace

YamlText::YamlText(const std::string& text, const std::string& file) : file_(file), lines_(splitLines(text)) {
  if (!lines_.empty() && lines_[0].compare(0, 3, "\xEF\xBB\xBF") == 0) {
    lines_[0].erase(0, 3);
  }
  yaml_ = "deck:\n";
  pieces_.emplace_back();
  std::vector<Bracket> brackets;
  std::vector<Level> levels;
  Scanner scanner(file_, brackets);
  std::string lastKeyPath, output;

  for (int number = 1; number <= static_cast<int>(lines_.size()); ++number) {
    const bool continues = !brackets.empty();
    std::optional<std::size_t> colon;
    const std::string kept = scanner.scan(line(number), number, colon);
    const auto first = kept.find_first_not_of(" \t");
    if (first == std::string::npos) {
      continue;
    }
    const std::string content = kept.substr(first);
    const int column = static_cast<int>(first) + 1;
    if (continues) {
      output += ' ';
      pieces_.back().push_back({static_cast<int>(output.size()), number, column});
      output += content;
    } else {
      if (kept.substr(0, first).find('\t') != std::string::npos) {
        fail(file_, number, 1, "indentation takes spaces, not tabs");
      }
      if (content == "---" && levels.empty()) {
        continue;
      }
      if (content == "---" || content == "..." || content[0] == '%') {
        fail(file_, number, column, "a deck is one YAML document without directives");
      }
      const bool listItem = content == "-" || content.compare(0, 2, "- ") == 0;
      if (levels.empty() && (listItem || content[0] == '[' || content[0] == '{')) {
        fail(file_, number, column,
             "a deck is a map of blocks such as 'mesh: ...', one per line, not a list");
      }
      if (!listItem && !colon) {
        fail(file_, number, column, fmt::format("expected 'key: value', got '{}'", shortened(content)));
      }
      if (listItem && isTruthWord(trimmed(content.substr(1)))) {
        fail(file_, number, column, "a list takes numbers or names, not " + trimmed(content.substr(1)));
      }
      const int indent = static_cast<int>(first);
      if (levels.empty() || indent > levels.back().indent) {
        levels.push_back({indent, listItem, lastKeyPath.empty() ? "" : lastKeyPath + "/", {}});
      } else {
        while (!levels.empty() && indent < levels.back().indent) {
          levels.pop_back();
        }
        if (levels.empty() || indent != levels.back().indent) {
          fail(file_, number, column, "the indentation matches no enclosing block");
        }
        if (listItem != levels.back().isList) {
          fail(file_, number, column,
               listItem ? "a list item must be indented below its key" : "expected a list item, '- ...'");
        }
      }
      if (!listItem) {
        const std::string key = unquoted(trimmed(kept.substr(first, *colon - first)));
        const auto [previous, isNew] = levels.back().keys.emplace(key, number);
        if (!isNew) {
          fail(file_, number, column,
               fmt::format("'{}{}' is given twice, first on line {}", levels.back().prefix, key,
                           previous->second));
        }
        lastKeyPath = levels.back().prefix + key;
        lineOfPath_[lastKeyPath] = number;
        const std::string value = trimmed(kept.substr(*colon + 1));
        if (!value.empty() && (value[0] == '|' || value[0] == '>')) {
          fail(file_, number, column,
               "texts over several lines are not used in decks; write one line in quotes");
        }
      }
      output = std::string(wrapperIndent, ' ') + kept;
      pieces_.push_back({{wrapperIndent, number, 1}});
    }
    if (brackets.empty()) {
      yaml_ += output + '\n';
    }
  }
  if (!brackets.empty()) {
    fail(file_, brackets.back().line, brackets.back().column,
         fmt::format("'{}' is never closed", brackets.back().kind));
  }
  if (levels.empty()) {
    throw DeckError(file_ + ": the deck is empty; expected the blocks mesh, materials, supports, path, ...");
  }
}

int YamlText::lineOf(const std::string& path) const {
  for (std::string prefix = path;;) {
    const auto found = lineOfPath_.find(prefix);
    if (found != lineOfPath_.end()) {
      return found->second;
    }
    const auto slash = prefix.rfind('/');
    if (slash == std::string::npos) {
      return 0;
    }
    prefix.erase(slash);
  }
}

YamlText::Position YamlText::original(int line, int column) const {
  const auto index = std::min(static_cast<std::size_t>(std::max(line, 2)) - 1, pieces_.size() - 1);
  const auto& pieces = pieces_[index];
  const Piece* piece = &pieces.front();
  for (const auto& candidate : pieces) {
    if (candidate.start <= column - 1) {
      piece = &candidate;
    }
  }
  return {piece->line, piece->column + std::max(0, column - 1 - piece->start)};
}

}  // namespace atrapos::deck
