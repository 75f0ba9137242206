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
const Check rows{[](double x) { return x >= 1 && x <= 10000; }, "from 1 to 10000"};
const Check order{[](double x) { return x >= 1 && x <= 60; }, "from 1 to 60"};
const Check throughThickness{[](double x) { return x >= 2 && x <= 10; }, "from 2 to 10"};
const Check degree{[](double x) { return x >= 1 && x <= 20; }, "from 1 to 20"};
const Check direction{[](double x) { return x == 1 || x == -1; }, "1 or -1"};
const Check poissonsRatio{[](double x) { return x > -1 && x < 0.5; }, "above -1 and below 0.5"};
const Check acuteAngle{[](double x) { return x > 0 && x < 90; }, "above 0 and below 90 degrees"};
const Check slopeAngle{[](double x) { return x > -90 && x < 90; }, "above -90 and below 90 degrees"};
const Check exponent{[](double x) { return x >= 1 && x <= 16; }, "from 1 to 16"};
}  // namespace check

namespace {

using Kind = YamlNode::Kind;

constexpr std::size_t longestText = 4096;  // as of a path

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

std::optional<double> number(const YamlNode& node) {
  if (node.kind != Kind::Scalar || node.quoted) return {};
  return parsed<double>(node.text, "+-0123456789.eE");
}

std::optional<int> smallNumber(const YamlNode& node) {
  const auto x = number(node);
  if (!x || *x != std::trunc(*x) || *x > INT_MAX || *x < INT_MIN) return {};
  return static_cast<int>(*x);
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

/// As it is written.
std::string shownScalar(const YamlNode& node) { return node.kind == Kind::Nothing ? "null" : node.text; }

/// A hint where a text without quotes is a number but for its comma.
std::string commaHint(YamlNode text) {
  const auto comma = text.text.find(',');
  if (comma == std::string::npos) return "";
  text.text[comma] = '.';
  return number(text) ? fmt::format(" (decimals are written with a point: {})", shortened(text.text)) : "";
}

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

std::string joined(const std::vector<std::string>& words) {
  constexpr std::size_t most = 40;
  if (words.size() > most) {
    return fmt::format("{}, ... ({} in all)", fmt::join(words.begin(), words.begin() + most, ", "),
                       words.size());
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string suggestion(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string* nearest = nullptr;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  constexpr std::size_t longest = 100;  // the distance costs the product of the lengths
  for (const auto& candidate : candidates) {
    if (word.size() > longest || candidate.size() > longest) continue;
    const auto distance = editDistance(word, candidate);
    if (distance < least && distance < candidate.size()) {
      least = distance;
      nearest = &candidate;
    }
  }
  return nearest == nullptr ? "" : fmt::format(" (did you mean '{}'?)", *nearest);
}

Value::Value(const YamlFile& file) : node_(file.root), source_(file.source) {}

Value::Value(YamlTree item, const Value& list) : Value(list) { node_ = std::move(item); }

Value::Value(YamlTree node, const Value& parent, const YamlKey& key)
    : node_(std::move(node)),
      source_(parent.source_),
      key_(key.name),
      path_(parent.under(key.name)),
      keyBegin_(key.begin),
      isRoot_(false) {}

std::string Value::under(const std::string& keys) const { return path_.empty() ? keys : path_ + "/" + keys; }

void Value::fail(std::size_t begin, const std::string& path, const std::string& what) const {
  const std::string line = path.empty() ? what : path + ": " + what;
  isRoot_ ? source_->fail(line) : source_->fail(begin, line);
}

std::size_t Value::begin() const { return isMap() ? keyBegin_ : node_->begin; }

void Value::fail(const std::string& what) const { fail(begin(), path_, what); }

void Value::failKey(const std::string& what) const { fail(keyBegin_, path_, what); }

void Value::failMissing(const std::string& key, const std::string& accepts) const {
  fail(keyBegin_, under(key), "is missing; expected " + accepts);
}

void Value::failUnder(const std::string& keys, const std::string& what) const {
  Value deepest = *this;
  for (std::size_t i = 0, end = 0; i < keys.size(); i = end + 1) {
    end = std::min(keys.find('/', i), keys.size());
    const std::string key = keys.substr(i, end - i);
    const Value map = deepest.entries();
    if (!map.has(key)) break;
    deepest = map.at(key);
  }
  deepest.fail(deepest.begin(), under(keys), what);
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
  throw std::logic_error("the deck has no " + under(key));
}

std::vector<Value> Value::children() const {
  std::vector<Value> children;
  const auto count = keys().size();  // throws where it is not a map
  for (std::size_t i = 0; i < count; ++i) {
    children.push_back(Value(node_->items[i], *this, node_->keys[i]));
  }
  return children;
}

Value Value::entries() const {
  if (!isList()) {
    return *this;
  }
  auto map = std::make_shared<YamlNode>();
  map->kind = Kind::Map;
  std::map<std::string, std::size_t> begins;
  for (const YamlTree& item : node_->items) {
    const Value each(item, *this, {fmt::format("item {}", begins.size() + 1), item->begin});
    if (!each.has("name")) {
      each.fail("has no name; expected a map with the key name, or one map with an entry for each name");
    }
    const Value name = each.at("name");
    const auto [previous, isNew] = begins.emplace(name.name(), name.begin());
    if (!isNew) {
      name.fail(fmt::format("'{}' is given twice, first on line {}", previous->first,
                            source_->lineOf(previous->second)));
    }
    auto entry = std::make_shared<YamlNode>(*item);
    const auto at = std::find_if(entry->keys.begin(), entry->keys.end(),
                                 [](const YamlKey& k) { return k.name == "name"; });
    entry->items.erase(entry->items.begin() + (at - entry->keys.begin()));
    entry->keys.erase(at);
    map->keys.push_back({previous->first, name.begin()});
    map->items.push_back(std::move(entry));
  }
  Value value = *this;
  value.node_ = std::move(map);
  return value;
}

std::string Value::shown() const {
  if (isMap()) {
    return node_->kind == Kind::Nothing ? "an empty value" : isEmptyMap() ? "an empty map" : "a map";
  }
  if (!isList()) {
    const auto flag = truth(*node_);
    return flag       ? (*flag ? "true" : "false")
           : isText() ? fmt::format("the text '{}'{}", shortened(node_->text), commaHint(*node_))
                      : shortened(node_->text);
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
    fail("expected a finite number, got " + shown());
  }
  if (!check.holds(*x)) {
    fail(fmt::format("must be {}, got {}", check.words, shown()));
  }
  return *x;
}

int Value::integer(const Check& check) const {
  const auto i = smallNumber(*node_);
  if (!i) {
    const auto x = number(*node_);
    const bool large = x && *x == std::trunc(*x);
    fail(fmt::format("expected a whole number{}, got {}", large ? fmt::format(" of at most {}", INT_MAX) : "",
                     shown()));
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
  if (hasControl(text)) {
    fail("must be one line, without control characters (a block of lines that begins with '>' is joined)");
  }
  if (text.size() > longestText) {
    fail(fmt::format("must have at most {} bytes, has {}", longestText, text.size()));
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

template <class T>
std::vector<T> Value::all(std::optional<T> (*of)(const YamlNode&), const std::string& expected,
                          std::size_t size) const {
  const auto refuse = [&](std::size_t begin) {
    fail(begin, path_, fmt::format("expected {}, got {}", expected, shown()));
  };
  std::vector<T> values;
  for (const YamlTree& item : items()) {
    const auto value = of(*item);
    if (!value) refuse(item->begin);
    values.push_back(*value);
  }
  if (size == any ? values.empty() : values.size() != size) refuse(begin());
  return values;
}

std::vector<double> Value::reals(std::size_t size) const {
  return all(number, fmt::format("a list of {} finite numbers", size), size);
}

std::vector<double> Value::reals() const { return all(number, "a list of finite numbers"); }

std::vector<std::array<double, 3>> Value::rowsOf3() const {
  constexpr const char* expected = "a list of lists of 3 finite numbers";
  std::vector<std::array<double, 3>> rows;
  const auto add = [&](const Value& row) {
    const auto x = row.all(number, expected, 3);
    rows.push_back({x[0], x[1], x[2]});
  };
  if (!items().empty() && items().front()->kind == Kind::Scalar) {
    add(*this);
    return rows;
  }
  for (const YamlTree& item : items()) {
    add(Value(item, *this));
  }
  if (rows.empty()) {
    fail(fmt::format("expected {}, got {}", expected, shown()));
  }
  return rows;
}

std::vector<int> Value::integers(std::size_t size, const Check& check) const {
  const std::string expected =
      size == any ? "a list of whole numbers" : fmt::format("a list of {} whole numbers", size);
  const auto list = all(smallNumber, expected, size);
  if (!std::all_of(list.begin(), list.end(), [&](int i) { return check.holds(i); })) {
    fail(fmt::format("each number must be {}, got {}", check.words, shown()));
  }
  return list;
}

std::vector<int> Value::integers(const Check& check) const { return integers(any, check); }

std::vector<Value> Value::list(const std::string& expected) const {
  std::vector<Value> values;
  for (const YamlTree& item : items()) {
    values.push_back(Value(item, *this));
  }
  if (values.empty()) {
    fail(fmt::format("expected {}, got {}", expected, shown()));
  }
  return values;
}

std::vector<std::string> Value::texts() const {
  return oneLine(isText() ? std::vector<std::string>{node_->text} : all(textOf, "a text or a list of texts"));
}

std::vector<std::string> Value::names() const {
  const auto single = nameOf(*node_);
  const auto names =
      oneLine(single ? std::vector<std::string>{*single} : all(nameOf, "a list of names or ids"));
  std::set<std::string> seen;
  for (const auto& name : names) {
    if (!seen.insert(name).second) {
      fail(fmt::format("'{}' is given twice", name));
    }
  }
  return names;
}

}  // namespace atrapos::deck
