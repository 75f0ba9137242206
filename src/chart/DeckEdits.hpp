#pragma once

#include <string>

#include "deck/YamlTree.hpp"

namespace atrapos::chart {

/// The tree with another value under keys, "a/b/c": maps are made where there are none, no value takes the
/// key away. Throws std::invalid_argument, one line, where a part of the keys names what is no map.
deck::YamlTree replaced(const deck::YamlTree& root, const std::string& keys, const deck::YamlTree& value);

/// The value under keys, "a/b/c"; none where there is none.
deck::YamlTree valueAt(const deck::YamlTree& root, const std::string& keys);

/// A text as a value.
deck::YamlTree textValue(const std::string& text);

/// A tree as YAML: a key of the root a line, what is below in braces.
std::string yamlText(const deck::YamlTree& root);
/// A value on one line.
std::string onOneLine(const deck::YamlTree& value);

}  // namespace atrapos::chart
