#include "import/InpSource.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "deck/Characters.hpp"
#include "import/Import.hpp"

namespace atrapos::importer {
namespace {

constexpr int mostIncludes = 16;         // within each other
constexpr std::size_t mostFiles = 1000;  // in all
constexpr std::size_t mostFields = 100000;
constexpr std::size_t mostCards = 2'000'000;

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

bool isComment(std::string_view line) { return line.substr(0, 2) == "**"; }

/// The line at a position of a text, without its end; the position moves behind it.
std::string_view lineAt(std::string_view text, std::size_t& position) {
  const std::size_t end = std::min(text.find('\n', position), text.size());
  const std::string_view line = text.substr(position, end - position);
  position = end + 1;
  return line;
}

/// At commas outside of quotes.
std::vector<std::string_view> split(std::string_view line, const InpPlace& place) {
  std::vector<std::string_view> fields;
  bool quoted = false;
  std::size_t first = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i < line.size() && (line[i] != ',' || quoted)) continue;
    if (fields.size() == mostFields) place.fail(fmt::format("has more than {} fields", mostFields));
    fields.push_back(trimmed(line.substr(first, i - first)));
    first = i + 1;
  }
  return fields;
}

std::string unquoted(std::string_view text) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return std::string(text);
}

std::string compact(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (!isBlank(c)) result += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

/// Keywords whose data may be in a file of their own.
bool takesFile(const std::string& keyword) {
  static const std::array<const char*, 7> all{"NODE",     "ELEMENT", "NSET", "ELSET",
                                              "BOUNDARY", "CLOAD",   "DLOAD"};
  return std::find(all.begin(), all.end(), keyword) != all.end();
}

}  // namespace

std::string InpPlace::text() const { return fmt::format("{}:{}", deck::plainLine(*file), line); }

void InpPlace::fail(const std::string& what) const { throw Error(text() + ": " + what); }

const std::string* InpCard::find(std::string_view name) const {
  for (const Parameter& parameter : parameters)
    if (parameter.name == name) return &parameter.value;
  return nullptr;
}

std::string InpCard::word(std::string_view name, const std::string& otherwise) const {
  const std::string* value = find(name);
  return value != nullptr ? inCapitals(*value) : otherwise;
}

bool InpLines::next(InpLine& line) {
  for (; part_ < card_.data.size(); ++part_, position_ = 0, lines_ = 0) {
    const InpCard::Data& data = card_.data[part_];
    while (position_ < data.text.size()) {
      const std::string_view text = trimmed(lineAt(data.text, position_));
      line.place = {data.file, data.firstLine + lines_++};
      if (text.empty() || isComment(text)) continue;
      line.fields = split(text, line.place);
      return true;
    }
  }
  return false;
}

InpSource::InpSource(const std::string& file) {
  read(file, {}, 0);
  if (cards_.empty())
    throw Error(file + ": has no keyword; an input file of Abaqus or CalculiX has lines as *NODE");
}

void InpSource::read(const std::string& file, const InpPlace& from, int depth) {
  const auto fail = [&](const std::string& what) {
    if (from.file == nullptr) throw Error(file + ": " + what);
    from.fail(fmt::format("'{}' {}", deck::shortened(file), what));
  };
  if (depth > mostIncludes)
    fail(fmt::format("is included {} deep; expected at most {}", depth, mostIncludes));
  if (texts_.size() >= mostFiles) fail(fmt::format("is one file too many; expected at most {}", mostFiles));
  std::error_code error;
  if (!std::filesystem::exists(file, error)) fail("does not exist");
  if (!std::filesystem::is_regular_file(file, error)) fail("is no regular file");
  const auto size = std::filesystem::file_size(file, error);
  if (error || size > mostInpBytes || bytes_ + size > mostInpBytes)
    fail(fmt::format("is too large; expected at most {} bytes with all that is included", mostInpBytes));
  bytes_ += size;
  texts_.push_back(std::make_unique<Text>());
  Text& text = *texts_.back();
  text.file = file;
  text.content.resize(size);
  std::ifstream in(file, std::ios::binary);
  if (!in || !in.read(text.content.data(), static_cast<std::streamsize>(size))) fail("cannot be read");

  const std::string_view content = text.content;
  std::size_t position = 0, data = 0;  // data: where lines without a keyword began
  int number = 0, dataLine = 1;
  const auto finishData = [&](std::size_t end) {
    if (end > data && !cards_.empty())
      cards_.back().data.push_back({&text.file, dataLine, content.substr(data, end - data)});
  };
  std::string keyword;
  while (position < content.size()) {
    const std::size_t begin_ = position;
    const std::string_view line = trimmed(lineAt(content, position));
    ++number;
    if (line.empty() || line.front() != '*' || isComment(line)) {
      if (cards_.empty() && !line.empty() && !isComment(line))
        InpPlace{&text.file, number}.fail(
            "is before the first keyword; expected a line as *NODE or a comment **");
      continue;
    }
    finishData(begin_);
    const InpPlace place{&text.file, number};
    keyword = line;
    while (keyword.back() == ',' && position < content.size()) {  // goes on
      keyword += trimmed(lineAt(content, position));
      ++number;
    }
    begin(keyword, place);
    data = std::min(position, content.size());
    dataLine = number + 1;
    if (cards_.back().keyword == "INCLUDE") {
      const InpCard card = cards_.back();
      cards_.pop_back();  // what is included goes on where the card before is
      const std::string* name = card.find("INPUT");
      if (name == nullptr || name->empty()) place.fail("*INCLUDE: expected INPUT=file");
      include(card, *name, depth);
    } else if (const std::string* name = cards_.back().find("INPUT");
               name != nullptr && takesFile(cards_.back().keyword)) {
      include(cards_.back(), *name, depth);
    }
  }
  finishData(content.size());
}

void InpSource::begin(std::string_view line, const InpPlace& place) {
  if (cards_.size() == mostCards)
    place.fail(fmt::format("is one keyword too many; expected at most {}", mostCards));
  const auto fields = split(line.substr(1), place);
  InpCard card;
  card.keyword = compact(fields.front());
  card.place = place;
  for (std::size_t i = 1; i < fields.size(); ++i) {
    if (fields[i].empty()) continue;
    const std::size_t equal = fields[i].find('=');
    InpCard::Parameter parameter;
    parameter.name = compact(fields[i].substr(0, equal));
    if (equal != std::string_view::npos) parameter.value = unquoted(trimmed(fields[i].substr(equal + 1)));
    card.parameters.push_back(std::move(parameter));
  }
  cards_.push_back(std::move(card));
}

void InpSource::include(const InpCard& card, const std::string& name, int depth) {
  const InpPlace place = card.place;
  if (name.find('\0') != std::string::npos) place.fail("the name of the included file is none");
  const auto folder = std::filesystem::path(*place.file).parent_path();
  read((folder / name).lexically_normal().string(), place, depth + 1);
}

std::string inCapitals(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return result;
}

bool isInteger(std::string_view field) {
  if (!field.empty() && (field.front() == '+' || field.front() == '-')) field.remove_prefix(1);
  return !field.empty() &&
         std::all_of(field.begin(), field.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
}

long long inpInteger(std::string_view field, const InpPlace& place, const char* what, long long least,
                     long long most) {
  std::string_view digits = field;
  if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
  long long value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  // 3. is a whole number too.
  const std::string_view rest(end, static_cast<std::size_t>(digits.data() + digits.size() - end));
  if (error != std::errc() || (!rest.empty() && rest != ".") || value < least || value > most)
    place.fail(fmt::format("'{}' is no {}; expected a whole number from {} to {}",
                           deck::shortened(std::string(field)), what, least, most));
  return value;
}

double inpNumber(std::string_view field, const InpPlace& place, const char* what) {
  if (field.empty()) return 0;
  std::string text(field.front() == '+' ? field.substr(1) : field);
  for (char& c : text)
    if (c == 'd' || c == 'D') c = 'e';
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool tiny = error == std::errc::result_out_of_range && text.find("e-") != std::string::npos;
  if (tiny) value = 0;
  if ((error != std::errc() && !tiny) || end != text.data() + text.size() || !std::isfinite(value))
    place.fail(fmt::format("'{}' is no {}; expected a number", deck::shortened(std::string(field)), what));
  return value;
}

}  // namespace atrapos::importer
