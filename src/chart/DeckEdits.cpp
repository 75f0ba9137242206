#include "chart/DeckEdits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "deck/DeckValue.hpp"

namespace atrapos::chart {
namespace {

using deck::YamlNode;
using deck::YamlTree;

bool isEmpty(const YamlTree& value) { return !value || value->kind == YamlNode::Kind::Nothing; }

std::ptrdiff_t placeOf(const YamlNode& map, const std::string& key) {
  const auto at =
      std::find_if(map.keys.begin(), map.keys.end(), [&](const auto& k) { return k.name == key; });
  return at == map.keys.end() ? -1 : at - map.keys.begin();
}

/// In double quotes, whatever it holds.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n')
      result += "\\n";
    else if (c == '\t')
      result += "\\t";
    else
      result += c;
  }
  return result + '"';
}

}  // namespace

YamlTree replaced(const YamlTree& root, const std::string& keys, const YamlTree& value) {
  const std::size_t slash = keys.find('/');
  const std::string key = keys.substr(0, slash);
  YamlNode node;
  if (!isEmpty(root)) node = *root;
  if (!isEmpty(root) && node.kind != YamlNode::Kind::Map)
    throw std::invalid_argument(fmt::format("'{}' stands below what is no map", keys));
  node.kind = YamlNode::Kind::Map;
  const std::ptrdiff_t at = placeOf(node, key);
  if (slash == std::string::npos && isEmpty(value)) {
    if (at >= 0) {
      node.keys.erase(node.keys.begin() + at);
      node.items.erase(node.items.begin() + at);
    }
    return std::make_shared<const YamlNode>(std::move(node));
  }
  const YamlTree below = slash == std::string::npos
                             ? value
                             : replaced(at >= 0 ? node.items[at] : YamlTree(), keys.substr(slash + 1), value);
  if (at >= 0) {
    node.items[at] = below;
  } else {
    node.keys.push_back({key, 0});
    node.items.push_back(below);
  }
  return std::make_shared<const YamlNode>(std::move(node));
}

YamlTree valueAt(const YamlTree& root, const std::string& keys) {
  if (isEmpty(root) || root->kind != YamlNode::Kind::Map) return {};
  const std::size_t slash = keys.find('/');
  const std::ptrdiff_t at = placeOf(*root, keys.substr(0, slash));
  if (at < 0) return {};
  return slash == std::string::npos ? root->items[at] : valueAt(root->items[at], keys.substr(slash + 1));
}

YamlTree textValue(const std::string& text) {
  YamlNode node;
  node.kind = YamlNode::Kind::Scalar;
  node.quoted = true;
  node.text = text;
  return std::make_shared<const YamlNode>(std::move(node));
}

std::string onOneLine(const YamlTree& value) {
  if (isEmpty(value)) return "~";
  std::string text;
  switch (value->kind) {
    case YamlNode::Kind::Scalar:
      return value->quoted || deck::readsAsText(value->text) ? quoted(value->text) : value->text;
    case YamlNode::Kind::List:
      for (const YamlTree& item : value->items) text += (text.empty() ? "" : ", ") + onOneLine(item);
      return "[" + text + "]";
    default:
      for (std::size_t i = 0; i < value->keys.size(); ++i)
        text += (i == 0 ? "" : ", ") + quoted(value->keys[i].name) + ": " + onOneLine(value->items[i]);
      return "{" + text + "}";
  }
}

std::string yamlText(const YamlTree& root) {
  std::string text;
  for (std::size_t i = 0; i < root->keys.size(); ++i)
    text += quoted(root->keys[i].name) + ": " + onOneLine(root->items[i]) + '\n';
  return text;
}

std::string settingsOf(const Edits& edits) {
  std::string text;
  for (const auto& [keys, value] : edits) text += (text.empty() ? "" : " ") + keys + "=" + onOneLine(value);
  return text;
}

}  // namespace atrapos::chart
