#pragma once

#include <memory>
#include <string>
#include <vector>

#include "deck/YamlSource.hpp"

namespace atrapos::deck {

struct YamlNode;
using YamlTree = std::shared_ptr<const YamlNode>;

/// A key of a map.
struct YamlKey {
  std::string name;
  std::size_t begin = 0;  ///< in the file's text
};

/// A value of a YAML file as it is written. Aliases share the node that they name; merge keys are resolved.
struct YamlNode {
  enum class Kind { Nothing, Scalar, List, Map };
  Kind kind = Kind::Nothing;
  bool quoted = false;          ///< a scalar that is a text whatever it looks like
  std::size_t begin = 0;        ///< in the file's text
  std::string text;             ///< of a scalar
  std::vector<YamlKey> keys;    ///< of a map, in the file's order
  std::vector<YamlTree> items;  ///< of a list; of a map the values of its keys
};

/// What a file holds, and the text for messages.
struct YamlFile {
  std::shared_ptr<const YamlSource> source;
  YamlTree root;  ///< a map
};

/// The map that a text holds. Throws DeckError for what is not YAML, or is more than a deck may have (tags,
/// several documents, keys given twice, ...), with line and column.
YamlFile readYaml(const std::string& text, const std::string& file);

}  // namespace atrapos::deck
