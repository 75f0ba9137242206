#include "import/DeckText.hpp"

#include <cctype>

#include "deck/Fields.hpp"

namespace atrapos::importer {

std::string DeckEntries::add(const std::string& wanted, const std::string& keys) {
  std::string letters;
  for (const char c : wanted.substr(0, 100)) {
    const bool allowed = static_cast<unsigned char>(c) < 128 &&
                         (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.');
    letters += allowed ? c : '_';
  }
  const std::string name = names_.take(letters);
  lines_.push_back(deck::yaml(name) + ": {" + keys + "}");
  return name;
}

std::string DeckEntries::text(int indent) const {
  std::string text;
  for (const std::string& line : lines_)
    text += std::string(static_cast<std::size_t>(indent), ' ') + line + '\n';
  return text;
}

std::string listOf(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + deck::yaml(name);
  return "[" + list + "]";
}

}  // namespace atrapos::importer
