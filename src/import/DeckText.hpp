#pragma once

#include <string>
#include <vector>

#include "import/Names.hpp"

namespace atrapos::importer {

/// Named entries of a deck's block, one a line.
class DeckEntries {
 public:
  /// Keys as "set: a, x: 0". Returns the entry's name: that which is wanted as far as decks allow it.
  std::string add(const std::string& wanted, const std::string& keys);
  std::size_t size() const { return lines_.size(); }
  std::string text(int indent) const;

 private:
  Names names_;
  std::vector<std::string> lines_;
};

/// [a, 'b c']
std::string listOf(const std::vector<std::string>& names);

}  // namespace atrapos::importer
