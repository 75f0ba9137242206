#include "commands/MapCommand.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>

#include "deck/DeckTables.hpp"

namespace atrapos {
namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& word, const std::string& accepted) {
  throw std::invalid_argument(fmt::format("{} '{}': expected {}", option, word, accepted));
}

int order(const std::string& word) {
  if (word == "auto") return 0;
  char* end = nullptr;
  const long order = std::strtol(word.c_str(), &end, 10);
  if (*end != 0 || order < 1 || order > 60) refuse("--orders", word, "whole numbers from 1 to 60 or auto");
  return static_cast<int>(order);
}

path::PadeUse pade(const std::string& word) {
  for (const auto& [name, use] : deck::padeUses())
    if (word == name) return use;
  refuse("--pade", word, "off, automatic or on");
}

}  // namespace

MapOptions mapOptions(const MapWords& words) {
  MapOptions options;
  if (!words.orders.empty()) options.orders.clear();
  for (const std::string& word : words.orders) options.orders.push_back(order(word));
  if (!words.deltas.empty()) options.deltas = words.deltas;
  for (const double delta : options.deltas)
    if (!(delta > 0 && delta < 1))
      refuse("--deltas", fmt::format("{:g}", delta), "numbers above 0 and below 1");
  if (!words.pades.empty()) options.pades.clear();
  for (const std::string& word : words.pades) options.pades.push_back(pade(word));
  if (!words.output.empty()) options.file = words.output;
  return options;
}

}  // namespace atrapos
