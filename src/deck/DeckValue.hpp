#pragma once

#include <Teuchos_ParameterList.hpp>
#include <array>
#include <string>
#include <vector>

#include "deck/YamlText.hpp"

namespace atrapos::deck {

/// What a number must be beyond being a finite number.
struct Check {
  bool (*holds)(double);
  const char* words;  ///< follows "must be"
};

namespace check {
extern const Check any, positive, nonzero, fraction, fractionOrZero, count, natural, order, degree, direction,
    poissonsRatio, acuteAngle, slopeAngle, exponent;
}

/// A value of the deck with its key path. Every accessor throws DeckError where the value is not of its kind.
class Value {
 public:
  Value(const Teuchos::ParameterList& root, const YamlText& text, const std::string& file);

  bool isMap() const { return list_ != nullptr; }
  bool isEmptyMap() const { return list_ != nullptr && list_->numParams() == 0; }
  bool isText() const;
  /// A list of numbers or texts.
  bool isList() const;

  /// Keys of a map, in the deck's order.
  std::vector<std::string> keys() const;
  bool has(const std::string& key) const;
  Value at(const std::string& key) const;
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
  /// One or more texts.
  std::vector<std::string> texts() const;
  /// One or more different names or ids.
  std::vector<std::string> names() const;

  /// "the text 'x'", "3.5", "a map", ... for messages.
  std::string shown() const;

  /// Throws `deck: key/path: what (line n)`.
  [[noreturn]] void fail(const std::string& what) const;
  /// Throws an error about a missing key of this map.
  [[noreturn]] void failMissing(const std::string& key, const std::string& accepts) const;

 private:
  std::vector<double> realList() const;
  Value(const Value& parent, const std::string& key);

  const Teuchos::ParameterEntry* entry_ = nullptr;
  const Teuchos::ParameterList* list_ = nullptr;
  const YamlText* yaml_;
  const std::string* file_;
  std::string key_, path_;
};

/// " (did you mean 'x'?)" for the candidate nearest to a word in edit distance, or nothing where none is
/// near.
std::string suggestion(const std::string& word, const std::vector<std::string>& candidates);

/// A text cut to a length that suits a message.
std::string shortened(const std::string& text);

/// "a, b, c"
std::string joined(const std::vector<std::string>& words);

}  // namespace atrapos::deck
