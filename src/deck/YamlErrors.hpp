#pragma once

#include <yaml-cpp/exceptions.h>

#include <string>
#include <vector>

#include "deck/YamlSource.hpp"

namespace atrapos::deck {

/// How far the parser had come; places count bytes of the text.
struct YamlProgress {
  std::size_t lastBegin = 0;              ///< of the last scalar, or of the list or map that began after it
  std::vector<std::size_t> openBrackets;  ///< begins of the brackets that are open, the innermost last
  int endedList = -1;  ///< column of the items of the list in a block that has just ended; -1: something else
};

/// Throws DeckError with place and cause of an error of yaml-cpp, and none of its words.
[[noreturn]] void explain(const YAML::Exception& error, const YamlSource& source,
                          const YamlProgress& progress);

/// What to say of a text that stands where an entry should.
std::string noEntry(const std::string& text);

}  // namespace atrapos::deck
