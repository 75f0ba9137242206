#include "plugin/Plugins.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "atrapos/physics/BalanceLaw.hpp"

namespace atrapos::plugins {
namespace {

std::vector<Plugin>& all() {
  static std::vector<Plugin> plugins;
  return plugins;
}

[[noreturn]] void refuse(const std::string& file, std::string why) {
  std::replace(why.begin(), why.end(), '\n', ' ');
  throw std::invalid_argument(fmt::format("{}: {}", file, why));
}

std::string describe(const plugin::Abi& abi) {
  return fmt::format("interface {}, compiler {}, strings {}, Kokkos {}, sizes {}", abi.interface,
                     abi.compiler, abi.strings, abi.kokkos, fmt::join(abi.sizes, "/"));
}

/// Takes a plug-in's laws, each as what it says of itself allows.
class Laws final : public plugin::Registry {
 public:
  explicit Laws(Plugin& plugin) : plugin_(plugin) {}
  void addPhysics(plugin::Law law) override { add(plugin_.physics, std::move(law), "physics"); }
  void addLoad(plugin::Law law) override { add(plugin_.loads, std::move(law), "load"); }

 private:
  static void add(std::vector<plugin::Law>& to, plugin::Law law, const char* kind) {
    if (law.name.empty() || !law.make || law.fields < 1 || law.fields > physics::mostFields)
      throw std::invalid_argument(fmt::format("its {} '{}' has no name, no law or no fields from 1 to {}",
                                              kind, law.name, physics::mostFields));
    if (std::any_of(to.begin(), to.end(), [&](const plugin::Law& other) { return other.name == law.name; }))
      throw std::invalid_argument(fmt::format("has two of the {} '{}'", kind, law.name));
    to.push_back(std::move(law));
  }
  Plugin& plugin_;
};

using List = std::vector<plugin::Law> Plugin::*;

Chosen chosen(const deck::Deck& deck, const std::string& path, const deck::PluginLaw& entry, List list) {
  std::vector<std::string> known;
  const plugin::Law* law = nullptr;
  for (const Plugin& plugin : all()) {
    if (std::find(deck.plugins.begin(), deck.plugins.end(), plugin.name) == deck.plugins.end()) continue;
    for (const plugin::Law& one : plugin.*list) {
      known.push_back(one.name);
      if (one.name == entry.law) law = &one;
    }
  }
  if (law == nullptr)
    deck::failAt(
        deck, path + "/law",
        fmt::format("the deck's plug-ins have no '{}' here, only: {}", entry.law, fmt::join(known, ", ")));
  if (static_cast<int>(entry.fields.size()) != law->fields)
    deck::failAt(deck, path + "/fields",
                 fmt::format("has {} fields; expected {}", entry.fields.size(), law->fields));
  Chosen result{law, entry.parameters};
  for (const auto& [name, value] : entry.parameters)
    if (law->parameters.count(name) == 0) {
      std::vector<std::string> names;
      for (const auto& parameter : law->parameters) names.push_back(parameter.first);
      deck::failAt(
          deck, path + "/parameters",
          fmt::format("'{}' has no parameter '{}', only: {}", law->name, name, fmt::join(names, ", ")));
    }
  for (const auto& [name, value] : law->parameters) {
    if (result.parameters.count(name) > 0) continue;
    if (!value) deck::failAt(deck, path, fmt::format("'{}' needs parameters/{}, a number", law->name, name));
    result.parameters[name] = *value;
  }
  return result;
}

}  // namespace

void load(const std::string& file) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(file, none)) refuse(file, "there is no such file");
  // With a slash in it the name is that of this file, whatever libraries the system knows.
  void* library = dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* why = dlerror();
    refuse(file, fmt::format("cannot be loaded: {}", why != nullptr ? why : "no reason is known"));
  }
  const auto* description = static_cast<const plugin::Description*>(dlsym(library, plugin::symbol));
  const plugin::Description own;
  if (description == nullptr || description->mark == nullptr || std::strcmp(description->mark, own.mark) != 0)
    refuse(file, fmt::format("is no plug-in of Atrapos, it has no '{}' (ATRAPOS_PLUGIN)", plugin::symbol));
  if (const std::string has = describe(description->abi), needs = describe(own.abi); has != needs)
    refuse(file, fmt::format("was compiled with ({}), this program with ({}); compile it anew with this "
                             "installation's headers and compiler",
                             has, needs));
  Plugin plugin{description->name, file, {}, {}};
  for (const Plugin& other : all())
    if (other.name == plugin.name)
      refuse(file,
             fmt::format("its name '{}' is that of {}, which is loaded already", plugin.name, other.file));
  Laws laws(plugin);
  try {
    description->fill(laws);
  } catch (const std::exception& error) {
    refuse(file, error.what());
  }
  all().push_back(std::move(plugin));
}

const std::vector<Plugin>& loaded() { return all(); }

void require(const deck::Deck& deck) {
  for (const std::string& name : deck.plugins)
    if (std::none_of(all().begin(), all().end(), [&](const Plugin& p) { return p.name == name; }))
      deck::failAt(
          deck, "plugins",
          fmt::format("needs the plug-in '{}', which is a program, not data, and is not loaded by a deck: "
                      "if you trust it, say where it is with --plugin FILE",
                      name));
}

std::unique_ptr<fem::PointLaw> lawOf(const Chosen& chosen) {
  auto law = chosen.law->make(chosen.parameters);
  if (!law) throw std::invalid_argument(fmt::format("'{}' makes no law", chosen.law->name));
  return law;
}

Chosen physicsOf(const deck::Deck& deck, const std::string& path, const deck::PluginLaw& entry) {
  return chosen(deck, path, entry, &Plugin::physics);
}
Chosen loadOf(const deck::Deck& deck, const std::string& path, const deck::PluginLaw& entry) {
  return chosen(deck, path, entry, &Plugin::loads);
}

}  // namespace atrapos::plugins
