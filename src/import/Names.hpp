#pragma once

#include <string>
#include <unordered_map>

namespace atrapos::importer {

/// A name as messages, decks and Exodus hold it: UTF-8 on one line, at most 200 bytes, not empty.
std::string plainName(const std::string& name);

/// Names of one kind of things, each given once.
class Names {
 public:
  /// plainName, with a number behind it where it has been given already.
  std::string take(const std::string& wanted);
  bool isTaken(const std::string& name) const { return given_.count(name) > 0; }

 private:
  std::unordered_map<std::string, int> given_;  ///< and the last number behind it
};

}  // namespace atrapos::importer
