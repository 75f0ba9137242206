#pragma once

#include <string>
#include <utility>
#include <vector>

#include "deck/YamlTree.hpp"

namespace atrapos::chart {

/// Keys of the deck, "a/b/c", and what stands there in place of the deck's value; no value: the key goes.
using Edits = std::vector<std::pair<std::string, deck::YamlTree>>;

/// "key=value ..." for people.
std::string settingsOf(const Edits& edits);

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
