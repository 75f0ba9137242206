#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace atrapos::deck {

/// The most bytes that a deck, or a file beside it, may have: more takes minutes and gigabytes to be read.
constexpr std::size_t mostBytes = 8000000;

/// The bytes of a file, no more than a little over mostBytes. Throws DeckError where it cannot be read.
std::string readText(const std::string& file);

/// The text of a YAML file, for a parser that counts bytes from 0.
class YamlSource {
 public:
  /// Throws DeckError where the text is not UTF-8, has control characters or is larger than mostBytes. A
  /// byte-order mark, carriage returns before line feeds and blanks at the end go.
  YamlSource(const std::string& text, const std::string& file);

  const std::string& text() const { return text_; }
  /// Line by its number from 0, empty beyond the last.
  std::string line(int number) const;

  /// Offset of a line's byte in the text, that of the text's end beyond the last line.
  std::size_t offset(int line, int column) const;
  /// The character that begins at an offset, none at the text's end.
  std::string character(std::size_t offset) const;
  /// Number from 1 of the line in which a byte stands.
  std::size_t lineOf(std::size_t offset) const;

  /// Throws DeckError `file:line:column: what`, from 1, columns in characters.
  [[noreturn]] void fail(std::size_t offset, const std::string& what) const;
  /// Throws DeckError `file: what`.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void checkCharacters() const;

  std::string file_, text_;
  std::vector<std::size_t> starts_;  // of the lines
};

}  // namespace atrapos::deck
