#pragma once

#include <algorithm>
#include <cctype>

#include "deck/Fields.hpp"

namespace atrapos::deck {

/// Entries are looked for by their names one by one.
constexpr std::size_t mostEntries = 10000;

inline void checkEntryName(const Value& entry) {
  const std::string key = entry.key();
  const bool word = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.';
  });
  if (!word) {
    entry.failKey("a name is made of letters, digits, '_', '-' and '.'");
  }
}

/// A map of named entries, read and printed by `Kind`, a Table or Variants.
template <class S, class Entry, class Kind>
Field<S> entries(std::string key, Need need, std::vector<Entry> S::*member, const Kind& kind,
                 std::string accepts, std::string meaning) {
  const std::string expected = "a map of named entries, " + accepts;
  return {std::move(key),
          need == required,
          expected,
          std::move(meaning),
          [=, &kind](const Value& v, S& s) {
            const auto all = v.entries().children();
            if (all.empty()) {
              v.fail("is empty; expected " + expected);
            }
            if (all.size() > mostEntries) {
              v.fail(fmt::format("holds {} entries; expected at most {}", all.size(), mostEntries));
            }
            for (const Value& value : all) {
              checkEntryName(value);
              Entry entry{};
              entry.name = value.key();
              read(kind, value, entry);
              (s.*member).push_back(std::move(entry));
            }
          },
          [=, &kind](const S& s) {
            Node node;
            for (const auto& entry : s.*member) {
              node.children.emplace_back(entry.name, print(kind, entry));
            }
            return node;
          }};
}

}  // namespace atrapos::deck
