#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace atrapos::importer {

/// Most bytes of an input file and of all that it includes.
constexpr std::size_t mostInpBytes = std::size_t{1} << 30;

/// A place in an input file, for messages.
struct InpPlace {
  const std::string* file = nullptr;
  int line = 0;  ///< from 1

  std::string text() const;                               ///< "model.inp:12"
  [[noreturn]] void fail(const std::string& what) const;  ///< throws Error, "model.inp:12: what"
};

/// One line of data, split at its commas. Fields are without blanks around them and may be empty.
struct InpLine {
  InpPlace place;
  std::vector<std::string_view> fields;

  /// The field, empty where the line has not so many.
  std::string_view at(std::size_t i) const { return i < fields.size() ? fields[i] : std::string_view(); }
};

/// A keyword with its parameters and data.
struct InpCard {
  struct Parameter {
    std::string name;   ///< in capitals, without blanks
    std::string value;  ///< as written, without quotes; empty where there is none
  };
  struct Data {
    const std::string* file;
    int firstLine;
    std::string_view text;
  };

  std::string keyword;  ///< in capitals, without blanks: "SOLIDSECTION"
  InpPlace place;
  std::vector<Parameter> parameters;
  std::vector<Data> data;

  /// The parameter's value; null where the card does not have it.
  const std::string* find(std::string_view name) const;
  bool has(std::string_view name) const { return find(name) != nullptr; }
  /// The value in capitals, `otherwise` where there is none.
  std::string word(std::string_view name, const std::string& otherwise = {}) const;
};

/// Goes through the lines of a card's data; lines that are empty or comments are passed over.
class InpLines {
 public:
  explicit InpLines(const InpCard& card) : card_(card) {}
  /// False at the end.
  bool next(InpLine& line);

 private:
  const InpCard& card_;
  std::size_t part_ = 0, position_ = 0;
  int lines_ = 0;  ///< passed in this part
};

/// An input file and what it includes, cut into cards.
class InpSource {
 public:
  /// Throws Error where a file cannot be read, is no regular one, or is beyond the budgets.
  explicit InpSource(const std::string& file);

  const std::vector<InpCard>& cards() const { return cards_; }

 private:
  void read(const std::string& file, const InpPlace& from, int depth);
  void begin(std::string_view line, const InpPlace& place);
  void include(const InpCard& card, const std::string& name, int depth);

  struct Text {
    std::string file, content;
  };
  std::vector<std::unique_ptr<Text>> texts_;  ///< cards point into them
  std::vector<InpCard> cards_;
  std::size_t bytes_ = 0;
};

/// In capitals, as names are compared.
std::string inCapitals(std::string_view text);

/// Whole number of a field. Throws Error where it is none, or not within the range.
long long inpInteger(std::string_view field, const InpPlace& place, const char* what, long long least,
                     long long most);
/// Whether a field is a whole number.
bool isInteger(std::string_view field);
/// Number of a field, as Fortran writes them too (1.5D3); 0 where it is empty.
double inpNumber(std::string_view field, const InpPlace& place, const char* what);

}  // namespace atrapos::importer
