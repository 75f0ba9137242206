#pragma once

#include <variant>

#include "deck/Fields.hpp"

namespace atrapos::deck {

/// One kind of a block whose keys depend on a selecting key (`type: cylinder`).
template <class Variant>
struct Alternative {
  std::string word;
  std::vector<std::string> keys;
  std::function<void(const Value&, Variant&)> read;
  std::function<Node(const Variant&)> print;  ///< empty where the variant holds another kind
  std::vector<KeyText> texts;
};

/// `finish` checks what involves several keys; it may be empty.
template <class Variant, class A>
Alternative<Variant> alternative(std::string word, const Table<A>& table,
                                 std::function<void(const Value&, const A&)> finish = {}) {
  Alternative<Variant> alternative;
  alternative.word = std::move(word);
  alternative.keys = keysOf(table);
  alternative.read = [=](const Value& map, Variant& variant) {
    A a{};
    readFields(table, map, a);
    if (finish) {
      finish(map, a);
    }
    variant = std::move(a);
  };
  alternative.print = [=](const Variant& variant) {
    const auto* a = std::get_if<A>(&variant);
    return a == nullptr ? Node{} : print(table, *a);
  };
  alternative.texts = textsOf(table);
  return alternative;
}

/// A block of type E whose member `variant` holds the alternative that `selector` names; `common` are the
/// keys that every kind has.
template <class E, class Variant>
struct Variants {
  std::string selector;
  Variant E::*variant;
  std::vector<Alternative<Variant>> alternatives;
  Table<E> common;
};

template <class E, class Variant>
std::vector<std::string> wordsOf(const Variants<E, Variant>& variants) {
  std::vector<std::string> words;
  for (const auto& alternative : variants.alternatives) {
    words.push_back(alternative.word);
  }
  return words;
}

template <class E, class Variant>
void read(const Variants<E, Variant>& variants, const Value& map, E& e) {
  const auto words = wordsOf(variants);
  const auto keys = map.keys();  // throws where it is not a map
  if (!map.has(variants.selector)) {
    map.failMissing(variants.selector, "one of " + joined(words));
  }
  Choices<std::size_t> choices;
  for (std::size_t i = 0; i < words.size(); ++i) {
    choices.emplace_back(words[i], i);
  }
  const Value selected = map.at(variants.selector);
  const auto& alternative = variants.alternatives[choose(selected, selected.text(), choices)];
  std::vector<std::string> allowed{variants.selector};
  allowed.insert(allowed.end(), alternative.keys.begin(), alternative.keys.end());
  for (const auto& field : variants.common) {
    allowed.push_back(field.key);
  }
  refuseUnknownKeys(map, allowed);
  alternative.read(map, e.*(variants.variant));
  readFields(variants.common, map, e);
}

template <class E, class Variant>
Node print(const Variants<E, Variant>& variants, const E& e) {
  Node node;
  const auto& variant = e.*(variants.variant);
  const auto& alternative = variants.alternatives[variant.index()];
  node.children.emplace_back(variants.selector, Node{alternative.word, {}});
  for (auto& child : alternative.print(variant).children) {
    node.children.push_back(child);
  }
  for (auto& child : print(variants.common, e).children) {
    node.children.push_back(child);
  }
  return node;
}

}  // namespace atrapos::deck
