#include "deck/DeckValue.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <climits>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "deck/Deck.hpp"

namespace atrapos::deck {

namespace check {
const Check any{[](double) { return true; }, "finite"};
const Check positive{[](double x) { return x > 0; }, "positive"};
const Check nonzero{[](double x) { return x != 0; }, "different from zero"};
const Check fraction{[](double x) { return x > 0 && x < 1; }, "above 0 and below 1"};
const Check fractionOrZero{[](double x) { return x >= 0 && x < 1; }, "at least 0 and below 1"};
const Check count{[](double x) { return x >= 1; }, "at least 1"};
const Check natural{[](double x) { return x >= 0; }, "at least 0"};
const Check order{[](double x) { return x >= 1 && x <= 60; }, "from 1 to 60"};
const Check degree{[](double x) { return x >= 1 && x <= 20; }, "from 1 to 20"};
const Check direction{[](double x) { return x == 1 || x == -1; }, "1 or -1"};
const Check poissonsRatio{[](double x) { return x > -1 && x < 0.5; }, "above -1 and below 0.5"};
const Check acuteAngle{[](double x) { return x > 0 && x < 90; }, "above 0 and below 90 degrees"};
const Check slopeAngle{[](double x) { return x > -90 && x < 90; }, "above -90 and below 90 degrees"};
const Check exponent{[](double x) { return x >= 1 && x <= 16; }, "from 1 to 16"};
}  // namespace check

namespace {

using Kind = YamlNode::Kind;

/// Decimal notation, the whole text.
template <class T>
std::optional<T> parsed(const std::string& text, const char* characters) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  if (text.find_first_not_of(characters) != std::string::npos) return {};
  T value{};
  const char* end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data() + (plus ? 1 : 0), end, value);
  if (error != std::errc() || last != end) return {};
  return value;
}

std::optional<long long> wholeNumber(const YamlNode& node) {
  if (node.kind != Kind::Scalar || node.quoted) return {};
  return parsed<long long>(node.text, "+-0123456789");
}

std::optional<int> smallNumber(const YamlNode& node) {
  const auto i = wholeNumber(node);
  if (!i || *i > INT_MAX || *i < INT_MIN) return {};
  return static_cast<int>(*i);
}

std::optional<double> number(const YamlNode& node) {
  if (node.kind != Kind::Scalar || node.quoted) return {};
  return parsed<double>(node.text, "+-0123456789.eE");
}

std::optional<bool> truth(const YamlNode& node) {
  if (node.kind != Kind::Scalar || node.quoted) return {};
  std::string word = node.text;
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  if (word == "true" || word == "yes") return true;
  if (word == "false" || word == "no") return false;
  return {};
}

bool isText(const YamlNode& node) { return node.kind == Kind::Scalar && !number(node) && !truth(node); }

std::optional<std::string> textOf(const YamlNode& node) {
  if (!isText(node)) return {};
  return node.text;
}

std::optional<std::string> nameOf(const YamlNode& node) {
  const auto id = wholeNumber(node);
  return id ? std::to_string(*id) : textOf(node);
}

/// What `of` makes of every item; nothing where it makes nothing of one.
template <class T>
std::vector<T> all(const std::vector<YamlTree>& items, std::optional<T> (*of)(const YamlNode&)) {
  std::vector<T> values;
  for (const YamlTree& item : items) {
    const auto value = of(*item);
    if (!value) return {};
    values.push_back(*value);
  }
  return values;
}

/// As it is written.
std::string shownScalar(const YamlNode& node) { return node.kind == Kind::Nothing ? "null" : node.text; }

bool holds(const YamlNode& list, Kind kind) {
  return std::any_of(list.items.begin(), list.items.end(),
                     [=](const auto& item) { return item->kind == kind; });
}

std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) {
    row[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row[b.size()];
}

}  // namespace

bool readsAsText(const std::string& word) {
  YamlNode node;
  node.kind = Kind::Scalar;
  node.text = word;
  const bool null = word.empty() || word == "null" || word == "Null" || word == "NULL";
  return !null && isText(node);
}

std::string beginOf(const std::string& text, std::size_t bytes) {
  std::size_t size = std::min(bytes, text.size());
  while (size > 0 && size < text.size() && (static_cast<unsigned char>(text[size]) & 0xC0) == 0x80) --size;
  return text.substr(0, size);
}

std::string shortened(const std::string& text) {
  constexpr std::size_t most = 60;
  std::string line = beginOf(text, most) + (text.size() > most ? "..." : "");
  std::replace_if(
      line.begin(), line.end(), [](unsigned char c) { return c < 32; }, ' ');
  return line;
}

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string suggestion(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string* nearest = nullptr;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const auto& candidate : candidates) {
    const auto distance = editDistance(word, candidate);
    if (distance < least && distance < candidate.size()) {
      least = distance;
      nearest = &candidate;
    }
  }
  return nearest == nullptr ? "" : fmt::format(" (did you mean '{}'?)", *nearest);
}

Value::Value(YamlTree root, const std::string& file) : node_(std::move(root)), file_(&file) {}

Value::Value(YamlTree node, const Value& parent, const YamlKey& key)
    : node_(std::move(node)),
      file_(parent.file_),
      key_(key.name),
      path_(parent.path_.empty() ? key.name : parent.path_ + "/" + key.name),
      line_(key.line) {}

std::string Value::place() const { return line_ > 0 ? fmt::format(" (line {})", line_) : ""; }

void Value::fail(const std::string& what) const {
  throw DeckError(fmt::format("{}: {}{}{}{}", *file_, path_, path_.empty() ? "" : ": ", what, place()));
}

void Value::failMissing(const std::string& key, const std::string& accepts) const {
  throw DeckError(fmt::format("{}: {}{}{}: is missing; expected {}{}", *file_, path_,
                              path_.empty() ? "" : "/", key, accepts, place()));
}

bool Value::isMap() const { return node_->kind == Kind::Map || node_->kind == Kind::Nothing; }

bool Value::isText() const { return deck::isText(*node_); }

std::vector<std::string> Value::keys() const {
  if (!isMap()) {
    fail(fmt::format("expected a map of keys, got {}", shown()));
  }
  std::vector<std::string> keys;
  for (const YamlKey& key : node_->keys) {
    keys.push_back(key.name);
  }
  return keys;
}

bool Value::has(const std::string& key) const {
  return std::any_of(node_->keys.begin(), node_->keys.end(), [&](const YamlKey& k) { return k.name == key; });
}

Value Value::at(const std::string& key) const {
  if (isList()) {
    return entries().at(key);
  }
  for (std::size_t i = 0; i < node_->keys.size(); ++i) {
    if (node_->keys[i].name == key) {
      return Value(node_->items[i], *this, node_->keys[i]);
    }
  }
  throw std::logic_error("the deck has no " + path_ + "/" + key);
}

Value Value::entries() const {
  if (!isList()) {
    return *this;
  }
  auto map = std::make_shared<YamlNode>();
  map->kind = Kind::Map;
  std::map<std::string, int> lines;
  for (const YamlTree& item : node_->items) {
    const Value each(item, *this, {"item " + std::to_string(lines.size() + 1), item->line});
    if (!each.has("name")) {
      each.fail("has no name; expected a map with the key name, or one map with an entry for each name");
    }
    const Value name = each.at("name");
    const auto [previous, isNew] = lines.emplace(name.name(), item->line);
    if (!isNew) {
      name.fail(fmt::format("'{}' is given twice, first on line {}", previous->first, previous->second));
    }
    auto entry = std::make_shared<YamlNode>(*item);
    const auto at = std::find_if(entry->keys.begin(), entry->keys.end(),
                                 [](const YamlKey& k) { return k.name == "name"; });
    entry->items.erase(entry->items.begin() + (at - entry->keys.begin()));
    entry->keys.erase(at);
    map->keys.push_back({previous->first, item->line});
    map->items.push_back(std::move(entry));
  }
  Value value = *this;
  value.node_ = std::move(map);
  return value;
}

std::string Value::shown() const {
  if (isMap()) {
    return isEmptyMap() ? "nothing" : "a map";
  }
  if (!isList()) {
    const auto flag = truth(*node_);
    return flag       ? (*flag ? "true" : "false")
           : isText() ? fmt::format("the text '{}'", shortened(node_->text))
                      : node_->text;
  }
  if (node_->items.empty()) {
    return "an empty list";
  }
  if (holds(*node_, Kind::Map) || holds(*node_, Kind::List)) {
    return holds(*node_, Kind::Map) ? "a list of maps" : "a list of lists";
  }
  std::vector<std::string> words;
  for (const YamlTree& item : node_->items) {
    words.push_back(shownScalar(*item));
  }
  return fmt::format("the list [{}]", shortened(joined(words)));
}

double Value::real(const Check& check) const {
  const auto x = number(*node_);
  if (!x) {
    const bool comma = isText() && node_->text.find(',') != std::string::npos;
    fail(fmt::format("expected a finite number, got {}{}", shown(),
                     comma ? " (decimals are written with a point: 0.3)" : ""));
  }
  if (!check.holds(*x)) {
    fail(fmt::format("must be {}, got {}", check.words, shown()));
  }
  return *x;
}

int Value::integer(const Check& check) const {
  const auto i = smallNumber(*node_);
  if (!i) {
    const bool notation = number(*node_) && !wholeNumber(*node_);
    const auto kind = notation ? "without point and exponent" : fmt::format("of at most {}", INT_MAX);
    fail(fmt::format("expected a whole number {}, got {}", kind, shown()));
  }
  if (!check.holds(*i)) {
    fail(fmt::format("must be {}, got {}", check.words, *i));
  }
  return *i;
}

bool Value::boolean() const {
  const auto flag = truth(*node_);
  if (!flag) {
    fail(fmt::format("expected true or false, got {}", shown()));
  }
  return *flag;
}

std::string Value::oneLine(std::string text) const {
  text.erase(text.find_last_not_of('\n') + 1);  // of a block of lines
  if (text.empty()) {
    fail("must not be empty");
  }
  if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 32 || c == 127; })) {
    fail("must be one line, without control characters (a block of lines that begins with '>' is joined)");
  }
  return text;
}

std::vector<std::string> Value::oneLine(std::vector<std::string> texts) const {
  for (auto& text : texts) {
    text = oneLine(std::move(text));
  }
  return texts;
}

std::string Value::text() const {
  if (!isText()) {
    fail(fmt::format("expected a text, got {}{}", shown(),
                     node_->kind == Kind::Scalar ? " (put it in quotes to make it a text)" : ""));
  }
  return oneLine(node_->text);
}

std::string Value::name() const {
  const auto name = nameOf(*node_);
  if (!name) {
    fail(fmt::format("expected a name or id, got {}", shown()));
  }
  return oneLine(*name);
}

const std::vector<YamlTree>& Value::items() const {
  static const std::vector<YamlTree> none;
  return isList() ? node_->items : none;
}

std::vector<double> Value::reals(std::size_t size) const {
  const auto x = all(items(), number);
  if (x.size() != size) {
    fail(fmt::format("expected a list of {} finite numbers, got {}", size, shown()));
  }
  return x;
}

std::vector<double> Value::reals() const {
  const auto x = all(items(), number);
  if (x.empty()) {
    fail(fmt::format("expected a list of finite numbers, got {}", shown()));
  }
  return x;
}

std::vector<std::array<double, 3>> Value::rowsOf3() const {
  const auto single = all(items(), number);
  if (single.size() == 3) {
    return {{single[0], single[1], single[2]}};
  }
  std::vector<std::array<double, 3>> rows;
  for (const YamlTree& item : items()) {
    const auto row = item->kind == Kind::List ? all(item->items, number) : std::vector<double>{};
    if (row.size() != 3) {
      rows.clear();
      break;
    }
    rows.push_back({row[0], row[1], row[2]});
  }
  if (rows.empty()) {
    fail(fmt::format("expected a list of lists of 3 finite numbers, got {}", shown()));
  }
  return rows;
}

std::vector<int> Value::integers(std::size_t size, const Check& check) const {
  const auto list = all(items(), smallNumber);
  if (list.size() != size) {
    fail(fmt::format("expected a list of {} whole numbers, got {}", size, shown()));
  }
  if (!std::all_of(list.begin(), list.end(), [&](int i) { return check.holds(i); })) {
    fail(fmt::format("each number must be {}, got {}", check.words, shown()));
  }
  return list;
}

std::vector<std::string> Value::texts() const {
  const auto texts = isText() ? std::vector<std::string>{node_->text} : all(items(), textOf);
  if (texts.empty()) {
    fail(fmt::format("expected a text or a list of texts, got {}", shown()));
  }
  return oneLine(texts);
}

std::vector<std::string> Value::names() const {
  const auto single = nameOf(*node_);
  const auto names = oneLine(single ? std::vector<std::string>{*single} : all(items(), nameOf));
  if (names.empty()) {
    fail(fmt::format("expected a list of names or ids, got {}", shown()));
  }
  std::set<std::string> seen;
  for (const auto& name : names) {
    if (!seen.insert(name).second) {
      fail(fmt::format("'{}' is given twice", name));
    }
  }
  return names;
}

}  // namespace atrapos::deck
