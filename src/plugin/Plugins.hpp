#pragma once

#include <string>
#include <vector>

#include "atrapos/plugin/Plugin.hpp"
#include "deck/Deck.hpp"

/// Libraries with physics of others' making. They are code: nothing but the command line loads one
/// (docs/trust.md).
namespace atrapos::plugins {

struct Plugin {
  std::string name, file;
  std::vector<plugin::Law> physics, loads;
};

/// Loads a library, for as long as the program runs. Throws std::invalid_argument, one line that begins with
/// the file: it cannot be loaded, is no plug-in, was compiled with something else, or has a name that is
/// taken.
void load(const std::string& file);

/// Those loaded, in that order.
const std::vector<Plugin>& loaded();

/// Throws DeckError where the deck names a plug-in that is not loaded.
void require(const deck::Deck& deck);

/// The law that an entry of a deck names, with its parameters. Throws DeckError at `path`, the entry's.
struct Chosen {
  const plugin::Law* law = nullptr;
  plugin::Parameters parameters;
};
/// What its law makes of the parameters. Throws what it throws, and std::invalid_argument where it makes
/// none.
std::unique_ptr<fem::PointLaw> lawOf(const Chosen& chosen);
Chosen physicsOf(const deck::Deck& deck, const std::string& path, const deck::PluginLaw& entry);
Chosen loadOf(const deck::Deck& deck, const std::string& path, const deck::PluginLaw& entry);

}  // namespace atrapos::plugins
