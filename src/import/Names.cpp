#include "import/Names.hpp"

#include "deck/Characters.hpp"

namespace atrapos::importer {

std::string plainName(const std::string& name) {
  std::string plain = deck::plainLine(deck::beginOf(name, 200));
  while (!plain.empty() && plain.back() == ' ') plain.pop_back();
  return plain.empty() ? "unnamed" : plain;
}

std::string Names::take(const std::string& wanted) {
  const std::string plain = plainName(wanted);
  std::string name = plain;
  while (!given_.emplace(name, 1).second) name = plain + "_" + std::to_string(++given_[plain]);
  return name;
}

}  // namespace atrapos::importer
