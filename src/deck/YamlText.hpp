#pragma once

#include <map>
#include <string>
#include <vector>

namespace atrapos::deck {

/// Prepares a deck's text for Teuchos' YAML reader and remembers where everything stood.
///
/// That reader takes one top-level map entry only, cannot break a [list] or {map} over lines, reads
/// ASCII only and silently drops lines whose indentation matches no enclosing block. So: comments and blank
/// lines go, open brackets are joined with the lines that follow, all is indented under one key, and what
/// would be lost or misread is refused here with its line and column.
class YamlText {
 public:
  /// Throws DeckError.
  YamlText(const std::string& text, const std::string& file);

  /// What to hand to Teuchos.
  const std::string& yaml() const { return yaml_; }

  /// Line (1-based) of the deck on which the key path `a/b/c` or its nearest enclosing key stands; 0:
  /// unknown.
  int lineOf(const std::string& path) const;

  struct Position {
    int line = 0, column = 0;
  };
  /// Place in the deck of a place (both 1-based) in yaml().
  Position original(int line, int column) const;

  /// Line of the deck, as written.
  const std::string& line(int number) const { return lines_[static_cast<std::size_t>(number) - 1]; }

 private:
  struct Piece {
    int start;  // 0-based column in the output line
    int line, column;
  };

  std::string file_;
  std::vector<std::string> lines_;
  std::string yaml_;
  std::vector<std::vector<Piece>> pieces_;  // [output line]
  std::map<std::string, int> lineOfPath_;
};

}  // namespace atrapos::deck
