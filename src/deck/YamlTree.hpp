#pragma once

#include <memory>
#include <string>
#include <vector>

namespace atrapos::deck {

struct YamlNode;
using YamlTree = std::shared_ptr<const YamlNode>;

/// A key of a map, with its line in the file.
struct YamlKey {
  std::string name;
  int line = 0;
};

/// A value of a YAML file as it is written. Aliases share the node that they name; merge keys are resolved.
struct YamlNode {
  enum class Kind { Nothing, Scalar, List, Map };
  Kind kind = Kind::Nothing;
  bool quoted = false;          ///< a scalar that is a text whatever it looks like
  int line = 0;                 ///< where it begins
  std::string text;             ///< of a scalar
  std::vector<YamlKey> keys;    ///< of a map, in the file's order
  std::vector<YamlTree> items;  ///< of a list; of a map the values of its keys
};

/// The map that a text holds. Throws DeckError for what is not YAML, or is more than a deck may have (tags,
/// several documents, keys given twice, ...), with line and column.
YamlTree readYaml(const std::string& text, const std::string& file);

}  // namespace atrapos::deck
