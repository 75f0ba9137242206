#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "deck/DeckValue.hpp"

namespace atrapos::deck {

/// A piece of YAML to print: a scalar or list as text, or a map of named pieces. Empty: nothing to print.
struct Node {
  std::string text;
  std::vector<std::pair<std::string, Node>> children;
  bool empty() const { return text.empty() && children.empty(); }
};

/// One key of a block of the deck: how it is read into S, how it is printed, what the user is told about it.
template <class S>
struct Field {
  std::string key;
  bool required = false;
  std::string accepts;  ///< follows "expected"
  std::string meaning;
  std::function<void(const Value&, S&)> read;
  std::function<Node(const S&)> print;
  std::string unless = {};  ///< another key of the block, with which this one need not be there
};

/// All keys of a block, in the order in which they are read, checked and printed.
template <class S>
using Table = std::vector<Field<S>>;

/// What a reader of the reference is told about a key.
struct KeyText {
  std::string key, accepts;
  std::string standard;  ///< the default, of keys that need not be there and have a plain one
  std::string meaning;
};

template <class S>
std::vector<KeyText> textsOf(const Table<S>& table) {
  const S standard{};
  std::vector<KeyText> texts;
  for (const auto& field : table) {
    const Node node = field.print(standard);
    const bool plain = node.children.empty() && !field.required;
    texts.push_back({field.key, field.accepts, plain ? node.text : "", field.meaning});
  }
  return texts;
}

template <class S>
std::vector<std::string> keysOf(const Table<S>& table) {
  std::vector<std::string> keys;
  for (const auto& field : table) {
    keys.push_back(field.key);
  }
  return keys;
}

/// Throws for a key of the map that is not among the allowed ones.
inline void refuseUnknownKeys(const Value& map, const std::vector<std::string>& allowed) {
  for (const auto& key : map.keys()) {
    if (std::find(allowed.begin(), allowed.end(), key) == allowed.end()) {
      map.at(key).failKey(
          fmt::format("is not a key here{}; allowed are {}", suggestion(key, allowed), joined(allowed)));
    }
  }
}

/// Reads the keys of a table into s; keys that are absent leave s's defaults, other keys are not looked at.
template <class S>
void readFields(const Table<S>& table, const Value& map, S& s) {
  for (const auto& field : table) {
    if (map.has(field.key)) {
      field.read(map.at(field.key), s);
    } else if (field.required && (field.unless.empty() || !map.has(field.unless))) {
      map.failMissing(field.key, field.accepts);
    }
  }
}

/// Reads a whole block into s.
template <class S>
void read(const Table<S>& table, const Value& map, S& s) {
  refuseUnknownKeys(map, keysOf(table));
  readFields(table, map, s);
}

template <class S>
Node print(const Table<S>& table, const S& s) {
  Node node;
  for (const auto& field : table) {
    Node child = field.print(s);
    if (!child.empty()) {
      node.children.emplace_back(field.key, std::move(child));
    }
  }
  return node;
}

// ------------------------------------------------------------------------------- printing of plain values

inline std::string yaml(double x) { return fmt::format("{}", x); }
inline std::string yaml(int x) { return fmt::format("{}", x); }

/// In single quotes, except where the text is a plain word.
std::string yaml(const std::string& text);

template <class List>
std::string yamlList(const List& list) {
  std::string text;
  for (const auto& item : list) {
    text += (text.empty() ? "[" : ", ") + yaml(item);
  }
  return text.empty() ? "" : text + "]";
}

/// Of lists.
template <class Rows>
std::string yamlRows(const Rows& rows) {
  std::string text;
  for (const auto& row : rows) {
    text += (text.empty() ? "[" : ", ") + yamlList(row);
  }
  return text.empty() ? "" : text + "]";
}

// ------------------------------------------------------------------------------- the kinds of fields

enum class Need { Optional, Required };
constexpr Need required = Need::Required;
constexpr Need optional = Need::Optional;

template <class S>
Field<S> real(std::string key, Need need, double S::*member, const Check& check, std::string meaning) {
  return {std::move(key),
          need == required,
          fmt::format("a number, {}", check.words),
          std::move(meaning),
          [=](const Value& v, S& s) { s.*member = v.real(check); },
          [=](const S& s) {
            return Node{yaml(s.*member), {}};
          }};
}

template <class S>
Field<S> real(std::string key, std::optional<double> S::*member, const Check& check, std::string meaning) {
  return {std::move(key),
          false,
          fmt::format("a number, {}", check.words),
          std::move(meaning),
          [=](const Value& v, S& s) { s.*member = v.real(check); },
          [=](const S& s) {
            return s.*member ? Node{yaml(*(s.*member)), {}} : Node{};
          }};
}

template <class S>
Field<S> integer(std::string key, Need need, int S::*member, const Check& check, std::string meaning) {
  return {std::move(key),
          need == required,
          fmt::format("a whole number, {}", check.words),
          std::move(meaning),
          [=](const Value& v, S& s) { s.*member = v.integer(check); },
          [=](const S& s) {
            return Node{yaml(s.*member), {}};
          }};
}

template <class S>
Field<S> integer(std::string key, std::optional<int> S::*member, const Check& check, std::string meaning) {
  return {std::move(key),
          false,
          fmt::format("a whole number, {}", check.words),
          std::move(meaning),
          [=](const Value& v, S& s) { s.*member = v.integer(check); },
          [=](const S& s) {
            return s.*member ? Node{yaml(*(s.*member)), {}} : Node{};
          }};
}

template <class S>
Field<S> flag(std::string key, bool S::*member, std::string meaning) {
  return {std::move(key),
          false,
          "true or false",
          std::move(meaning),
          [=](const Value& v, S& s) { s.*member = v.boolean(); },
          [=](const S& s) {
            return Node{s.*member ? "true" : "false", {}};
          }};
}

/// A name or id in the mesh, or the name of another entry.
template <class S>
Field<S> name(std::string key, Need need, std::string S::*member, std::string accepts, std::string meaning) {
  return {std::move(key),
          need == required,
          std::move(accepts),
          std::move(meaning),
          [=](const Value& v, S& s) { s.*member = v.name(); },
          [=](const S& s) {
            return (s.*member).empty() ? Node{} : Node{yaml(s.*member), {}};
          }};
}

template <class S>
Field<S> text(std::string key, Need need, std::string S::*member, std::string accepts, std::string meaning) {
  return {std::move(key),
          need == required,
          std::move(accepts),
          std::move(meaning),
          [=](const Value& v, S& s) { s.*member = v.text(); },
          [=](const S& s) {
            return (s.*member).empty() ? Node{} : Node{yaml(s.*member), {}};
          }};
}

template <class S>
Field<S> names(std::string key, Need need, std::vector<std::string> S::*member, std::string meaning) {
  return {std::move(key),
          need == required,
          "a list of names or ids",
          std::move(meaning),
          [=](const Value& v, S& s) { s.*member = v.names(); },
          [=](const S& s) {
            return Node{yamlList(s.*member), {}};
          }};
}

template <class S>
Field<S> vector3(std::string key, Need need, std::array<double, 3> S::*member, std::string meaning) {
  return {std::move(key),
          need == required,
          "a list of 3 numbers",
          std::move(meaning),
          [=](const Value& v, S& s) {
            const auto x = v.reals(3);
            std::copy(x.begin(), x.end(), (s.*member).begin());
          },
          [=](const S& s) {
            return Node{yamlList(s.*member), {}};
          }};
}

/// A list of numbers of any length.
template <class S>
Field<S> reals(std::string key, Need need, std::vector<double> S::*member, std::string meaning) {
  return {std::move(key),
          need == required,
          "a list of numbers",
          std::move(meaning),
          [=](const Value& v, S& s) { s.*member = v.reals(); },
          [=](const S& s) {
            return (s.*member).empty() ? Node{} : Node{yamlList(s.*member), {}};
          }};
}

/// A direction: three numbers that are not all zero.
template <class S>
Field<S> direction(std::string key, Need need, std::array<double, 3> S::*member, std::string meaning) {
  auto field = vector3(std::move(key), need, member, std::move(meaning));
  field.read = [member, inner = field.read](const Value& v, S& s) {
    inner(v, s);
    if ((s.*member)[0] == 0 && (s.*member)[1] == 0 && (s.*member)[2] == 0) {
      v.fail("must not be the zero vector");
    }
  };
  field.accepts = "a list of 3 numbers, not all zero";
  return field;
}

template <class E>
using Choices = std::vector<std::pair<std::string, E>>;

template <class E>
std::vector<std::string> wordsOf(const Choices<E>& choices) {
  std::vector<std::string> words;
  for (const auto& choice : choices) {
    words.push_back(choice.first);
  }
  return words;
}

/// The choice that a text names; throws with the list of choices.
template <class E>
E choose(const Value& v, const std::string& word, const Choices<E>& choices) {
  for (const auto& choice : choices) {
    if (choice.first == word) {
      return choice.second;
    }
  }
  const auto words = wordsOf(choices);
  v.fail(fmt::format("'{}' is not a choice here{}; expected one of {}", word, suggestion(word, words),
                     joined(words)));
}

template <class E>
std::string wordOf(E value, const Choices<E>& choices) {
  for (const auto& choice : choices) {
    if (choice.second == value) {
      return choice.first;
    }
  }
  return "";
}

template <class S, class E>
Field<S> choice(std::string key, Need need, E S::*member, Choices<E> choices, std::string meaning) {
  const std::string accepts = "one of " + joined(wordsOf(choices));
  return {std::move(key),
          need == required,
          accepts,
          std::move(meaning),
          [=](const Value& v, S& s) {
            if (!v.isText()) {
              v.fail(fmt::format("expected {}, got {}", accepts, v.shown()));
            }
            s.*member = choose(v, v.text(), choices);
          },
          [=](const S& s) {
            return Node{wordOf(s.*member, choices), {}};
          }};
}

/// A block inside a block.
template <class S, class Inner>
Field<S> block(std::string key, Need need, Inner S::*member, const Table<Inner>& table, std::string meaning) {
  return {std::move(key),
          need == required,
          "a map with " + joined(keysOf(table)),
          std::move(meaning),
          [=](const Value& v, S& s) { read(table, v, s.*member); },
          [=](const S& s) { return print(table, s.*member); }};
}

}  // namespace atrapos::deck
