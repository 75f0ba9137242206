#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "deck/Characters.hpp"
#include "deck/YamlTree.hpp"

namespace atrapos::deck {

/// What a number must be beyond being a finite number.
struct Check {
  bool (*holds)(double);
  const char* words;  ///< follows "must be"
};

namespace check {
extern const Check any, positive, nonzero, fraction, fractionOrZero, count, rows, natural, order, degree,
    direction, poissonsRatio, acuteAngle, slopeAngle, exponent, throughThickness;
}

/// A value of the deck with its key path. Every accessor throws DeckError where the value is not of its kind.
class Value {
 public:
  explicit Value(const YamlFile& file);

  /// Nothing counts as an empty map.
  bool isMap() const;
  bool isEmptyMap() const { return isMap() && node_->items.empty(); }
  bool isText() const;
  bool isList() const { return node_->kind == YamlNode::Kind::List; }

  /// Keys of a map, in the deck's order.
  std::vector<std::string> keys() const;
  bool has(const std::string& key) const;
  /// The value of a key, which is there.
  Value at(const std::string& key) const;
  /// The values of a map, in the deck's order.
  std::vector<Value> children() const;
  /// Named entries: a map, or a list of maps each with the key `name`, as a map.
  Value entries() const;
  /// As it is written.
  const YamlTree& tree() const { return node_; }
  /// The key under which the value stands.
  const std::string& key() const { return key_; }

  double real(const Check& check = check::any) const;
  int integer(const Check& check = check::any) const;
  bool boolean() const;
  std::string text() const;
  /// A name of the mesh's: a text, or an id given as a whole number.
  std::string name() const;
  std::vector<double> reals(std::size_t size) const;
  /// One or more finite numbers.
  std::vector<double> reals() const;
  /// Rows of three numbers, at least one; a list of three numbers is one row.
  std::vector<std::array<double, 3>> rowsOf3() const;
  std::vector<int> integers(std::size_t size, const Check& check) const;
  /// One or more.
  std::vector<int> integers(const Check& check) const;
  /// The items of a list, at least one; `expected` says what it is to be a list of.
  std::vector<Value> list(const std::string& expected) const;
  /// One or more texts.
  std::vector<std::string> texts() const;
  /// One or more different names or ids.
  std::vector<std::string> names() const;

  /// "the text 'x'", "3.5", "a map", ... for messages.
  std::string shown() const;

  /// Throws DeckError `deck:line:column: key/path: what` with the place of the value, of a map's key. The
  /// whole deck has no place.
  [[noreturn]] void fail(const std::string& what) const;
  /// The same about the key itself.
  [[noreturn]] void failKey(const std::string& what) const;
  /// The same about a missing key of this map.
  [[noreturn]] void failMissing(const std::string& key, const std::string& accepts) const;
  /// The same about `keys`, "a/b", below this value, with the place of the last one that is there.
  [[noreturn]] void failUnder(const std::string& keys, const std::string& what) const;

 private:
  static constexpr std::size_t any = 0;

  Value(YamlTree item, const Value& list);
  Value(YamlTree node, const Value& parent, const YamlKey& key);
  /// The path of a key below this value.
  std::string under(const std::string& keys) const;
  /// Where the value is to be looked for.
  std::size_t begin() const;
  [[noreturn]] void fail(std::size_t begin, const std::string& path, const std::string& what) const;
  /// What `of` makes of the items of a list, so many or at least one; throws where it makes nothing of one.
  template <class T>
  std::vector<T> all(std::optional<T> (*of)(const YamlNode&), const std::string& expected,
                     std::size_t size = any) const;
  /// Of a list; none of anything else.
  const std::vector<YamlTree>& items() const;
  /// The text, or each, without line ends after it; throws where it is empty or has control characters.
  std::string oneLine(std::string text) const;
  std::vector<std::string> oneLine(std::vector<std::string> texts) const;

  YamlTree node_;
  std::shared_ptr<const YamlSource> source_;
  std::string key_, path_;
  std::size_t keyBegin_ = 0;
  bool isRoot_ = true;
};

/// " (did you mean 'x'?)" for the candidate nearest to a word in edit distance, or nothing where none is
/// near.
std::string suggestion(const std::string& word, const std::vector<std::string>& candidates);

/// Whether these characters without quotes are a text: neither a number, nor true, false, yes or no, nor
/// null.
bool readsAsText(const std::string& word);

/// "a, b, c", cut after forty.
std::string joined(const std::vector<std::string>& words);

}  // namespace atrapos::deck
