#include "deck/DeckValue.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Teuchos_Array.hpp>
#include <Teuchos_TwoDArray.hpp>
#include <algorithm>
#include <climits>
#include <cmath>
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

template <class T>
const T* as(const Teuchos::ParameterEntry* entry) {
  return entry != nullptr && entry->isType<T>() ? &Teuchos::getValue<T>(*entry) : nullptr;
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

template <class T>
std::string shownList(const Teuchos::Array<T>& list) {
  return fmt::format("the list [{}]",
                     shortened(fmt::format("{}", fmt::join(list.begin(), list.end(), ", "))));
}

}  // namespace

std::string shortened(const std::string& text) {
  constexpr std::size_t most = 60;
  return text.size() <= most ? text : text.substr(0, most) + "...";
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

Value::Value(const Teuchos::ParameterList& root, const YamlText& text, const std::string& file)
    : list_(&root), yaml_(&text), file_(&file) {}

Value::Value(const Value& parent, const std::string& key)
    : entry_(&parent.list_->getEntry(key)),
      yaml_(parent.yaml_),
      file_(parent.file_),
      key_(key),
      path_(parent.path_.empty() ? key : parent.path_ + "/" + key) {
  if (entry_->isList()) {
    list_ = &parent.list_->sublist(key);
  }
}

void Value::fail(const std::string& what) const {
  const int line = yaml_->lineOf(path_);
  throw DeckError(fmt::format("{}: {}{}{}{}", *file_, path_, path_.empty() ? "" : ": ", what,
                              line > 0 ? fmt::format(" (line {})", line) : ""));
}

void Value::failMissing(const std::string& key, const std::string& accepts) const {
  const int line = yaml_->lineOf(path_);
  throw DeckError(fmt::format("{}: {}{}{}: is missing; expected {}{}", *file_, path_,
                              path_.empty() ? "" : "/", key, accepts,
                              line > 0 ? fmt::format(" (line {})", line) : ""));
}

bool Value::isText() const { return as<std::string>(entry_) != nullptr; }

bool Value::isList() const { return entry_ != nullptr && entry_->isArray(); }

std::vector<std::string> Value::keys() const {
  if (!isMap()) {
    fail(fmt::format("expected a map of keys, got {}", shown()));
  }
  std::vector<std::string> keys;
  for (auto it = list_->begin(); it != list_->end(); ++it) {
    keys.push_back(list_->name(it));
  }
  return keys;
}

bool Value::has(const std::string& key) const { return list_ != nullptr && list_->isParameter(key); }

Value Value::at(const std::string& key) const { return Value(*this, key); }

std::string Value::shown() const {
  if (isMap()) {
    return isEmptyMap() ? "nothing" : "a map";
  }
  if (const auto* v = as<bool>(entry_)) {
    return *v ? "true" : "false";
  }
  if (const auto* v = as<int>(entry_)) {
    return fmt::format("{}", *v);
  }
  if (const auto* v = as<long long>(entry_)) {
    return fmt::format("{}", *v);
  }
  if (const auto* v = as<double>(entry_)) {
    return fmt::format("{}", *v);
  }
  if (const auto* v = as<std::string>(entry_)) {
    return fmt::format("the text '{}'", shortened(*v));
  }
  if (const auto* v = as<Teuchos::Array<int>>(entry_)) {
    return shownList(*v);
  }
  if (const auto* v = as<Teuchos::Array<long long>>(entry_)) {
    return shownList(*v);
  }
  if (const auto* v = as<Teuchos::Array<double>>(entry_)) {
    return shownList(*v);
  }
  if (const auto* v = as<Teuchos::Array<std::string>>(entry_)) {
    return shownList(*v);
  }
  return "a list of lists";
}

double Value::real(const Check& check) const {
  double x = 0;
  if (const auto* i = as<int>(entry_)) {
    x = *i;
  } else if (const auto* l = as<long long>(entry_)) {
    x = static_cast<double>(*l);
  } else if (const auto* d = as<double>(entry_)) {
    x = *d;
  } else {
    fail(fmt::format("expected a finite number, got {}", shown()));
  }
  if (!std::isfinite(x) || !check.holds(x)) {
    fail(fmt::format("must be {}, got {}", check.words, shown()));
  }
  return x;
}

int Value::integer(const Check& check) const {
  const auto* i = as<int>(entry_);
  if (i == nullptr) {
    fail(fmt::format("expected a whole number of at most {}, got {}", INT_MAX, shown()));
  }
  if (!check.holds(*i)) {
    fail(fmt::format("must be {}, got {}", check.words, *i));
  }
  return *i;
}

bool Value::boolean() const {
  const auto* v = as<bool>(entry_);
  if (v == nullptr) {
    fail(fmt::format("expected true or false, got {}", shown()));
  }
  return *v;
}

std::string Value::text() const {
  const auto* v = as<std::string>(entry_);
  if (v == nullptr) {
    fail(fmt::format("expected a text, got {}{}", shown(),
                     isMap() ? "" : " (put it in quotes to make it a text)"));
  }
  if (v->empty()) {
    fail("must not be empty");
  }
  return *v;
}

std::string Value::name() const {
  if (const auto* i = as<int>(entry_)) {
    return std::to_string(*i);
  }
  if (const auto* l = as<long long>(entry_)) {
    return std::to_string(*l);
  }
  if (!isText()) {
    fail(fmt::format("expected a name or id, got {}", shown()));
  }
  return text();
}

std::vector<double> Value::realList() const {
  std::vector<double> x;
  if (const auto* i = as<Teuchos::Array<int>>(entry_)) {
    x.assign(i->begin(), i->end());
  } else if (const auto* l = as<Teuchos::Array<long long>>(entry_)) {
    x.assign(l->begin(), l->end());
  } else if (const auto* d = as<Teuchos::Array<double>>(entry_)) {
    x.assign(d->begin(), d->end());
  }
  if (!std::all_of(x.begin(), x.end(), [](double v) { return std::isfinite(v); })) {
    x.clear();
  }
  return x;
}

std::vector<double> Value::reals(std::size_t size) const {
  const std::vector<double> x = realList();
  if (x.size() != size) {
    fail(fmt::format("expected a list of {} finite numbers, got {}", size, shown()));
  }
  return x;
}

std::vector<double> Value::reals() const {
  const std::vector<double> x = realList();
  if (x.empty()) {
    fail(fmt::format("expected a list of finite numbers, got {}", shown()));
  }
  return x;
}

std::vector<std::array<double, 3>> Value::rowsOf3() const {
  std::vector<std::array<double, 3>> rows;
  const auto take = [&](const auto* table) {
    if (table == nullptr || table->getNumCols() != 3) {
      return;
    }
    for (Teuchos::Ordinal i = 0; i < table->getNumRows(); ++i) {
      rows.push_back({static_cast<double>((*table)(i, 0)), static_cast<double>((*table)(i, 1)),
                      static_cast<double>((*table)(i, 2))});
    }
  };
  take(as<Teuchos::TwoDArray<int>>(entry_));
  take(as<Teuchos::TwoDArray<long long>>(entry_));
  take(as<Teuchos::TwoDArray<double>>(entry_));
  const auto single = realList();
  if (single.size() == 3) {
    rows.push_back({single[0], single[1], single[2]});
  }
  for (const auto& row : rows) {
    for (const double x : row) {
      if (!std::isfinite(x)) {
        fail(fmt::format("must be finite numbers, got {}", x));
      }
    }
  }
  if (rows.empty()) {
    fail(fmt::format("expected a list of lists of 3 finite numbers, got {}", shown()));
  }
  return rows;
}

std::vector<int> Value::integers(std::size_t size, const Check& check) const {
  const auto* list = as<Teuchos::Array<int>>(entry_);
  if (list == nullptr || static_cast<std::size_t>(list->size()) != size) {
    fail(fmt::format("expected a list of {} whole numbers, got {}", size, shown()));
  }
  for (const int i : *list) {
    if (!check.holds(i)) {
      fail(fmt::format("each number must be {}, got {}", check.words, shown()));
    }
  }
  return {list->begin(), list->end()};
}

std::vector<std::string> Value::texts() const {
  if (isText()) {
    return {text()};
  }
  const auto* list = as<Teuchos::Array<std::string>>(entry_);
  if (list == nullptr) {
    fail(fmt::format("expected a text or a list of texts, got {}", shown()));
  }
  return {list->begin(), list->end()};
}

std::vector<std::string> Value::names() const {
  std::vector<std::string> names;
  if (const auto* s = as<Teuchos::Array<std::string>>(entry_)) {
    names.assign(s->begin(), s->end());
  } else if (const auto* i = as<Teuchos::Array<int>>(entry_)) {
    for (const int id : *i) {
      names.push_back(std::to_string(id));
    }
  } else if (const auto* l = as<Teuchos::Array<long long>>(entry_)) {
    for (const long long id : *l) {
      names.push_back(std::to_string(id));
    }
  } else if (isText() || as<int>(entry_) != nullptr || as<long long>(entry_) != nullptr) {
    names.push_back(name());
  } else {
    fail(fmt::format("expected a list of names or ids, got {}", shown()));
  }
  std::set<std::string> seen;
  for (const auto& name : names) {
    if (name.empty()) {
      fail("a name must not be empty");
    }
    if (!seen.insert(name).second) {
      fail(fmt::format("'{}' is given twice", name));
    }
  }
  return names;
}

}  // namespace atrapos::deck
