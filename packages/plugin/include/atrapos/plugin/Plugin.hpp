#pragma once

#include <Kokkos_Core.hpp>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "atrapos/fem/PointLaw.hpp"

/// Physics of one's own for decks (docs/plugins.md): a shared library with a source of this kind,
///
///     #include "atrapos/fem/PointLawOf.hpp"
///     #include "atrapos/plugin/Plugin.hpp"
///
///     struct Film { ... };  // taylor/Law.hpp
///
///     ATRAPOS_PLUGIN(soap, [](atrapos::plugin::Registry& registry) {
///       registry.addPhysics({"film", 1, {{"pressure", 1.0}}, [](const auto& p) {
///                              return atrapos::fem::pointLaw(Film{p.at("pressure")});
///                            }});
///     })
///
/// which `atrapos run DECK --plugin FILE` loads. It is compiled with the compiler, Trilinos and Atrapos of
/// the program that loads it, which compares what it was compiled with before it calls anything of it.
namespace atrapos::plugin {

/// Numbers of a deck by their names.
using Parameters = std::map<std::string, double>;

/// A law for scalar fields, under a name. The fields are those that a deck names, in its order.
struct Law {
  std::string name;  ///< as decks say it
  int fields = 1;    ///< how many meet in it, 1 to 4
  /// Its parameters, each with what it is where a deck does not say it; without that a deck has to.
  std::map<std::string, std::optional<double>> parameters{};
  /// In a body: in, for each field its gradient (3) and its value; out, their work conjugates. On sides:
  /// values alone. The load factor is a last input, where there is one more; data: the place x, y, z, or
  /// none. What it throws is told to the user as the deck's error.
  std::function<std::unique_ptr<fem::PointLaw>(const Parameters&)> make{};
  /// In a body: what each field stores by its value, c in c du/dt, where Hopf points are looked for; the
  /// inputs of a law that reads load factor and place. Empty: nothing.
  std::function<void(const Parameters&, const double* in, const double* data, double* c)> capacity{};
};

/// What a plug-in hands its laws to.
class Registry {
 public:
  virtual ~Registry() = default;
  virtual void addPhysics(Law law) = 0;  ///< `type: plugin` in a deck's `physics`
  virtual void addLoad(Law law) = 0;     ///< `type: plugin` in its `loads`
};

/// What a library is compiled with, in plain numbers and texts.
struct Abi {
  int interface = 1;  ///< of this header and PointLaw; a change of either raises it
  const char* compiler = __VERSION__;
#ifdef _GLIBCXX_USE_CXX11_ABI
  int strings = _GLIBCXX_USE_CXX11_ABI;
#else
  int strings = -1;
#endif
  int kokkos = KOKKOS_VERSION;
  int sizes[4] = {static_cast<int>(sizeof(fem::LawShape)), static_cast<int>(sizeof(fem::PointBatch)),
                  static_cast<int>(sizeof(fem::SeriesOrder)), static_cast<int>(sizeof(Law))};
};

/// What a library shows of itself: plain data, which are looked at before anything is called.
struct Description {
  const char* mark = "a plug-in of Atrapos";
  Abi abi;
  const char* name = nullptr;
  void (*fill)(Registry&) = nullptr;
};

/// The symbol of a library's Description.
constexpr const char* symbol = "atrapos_plugin";

}  // namespace atrapos::plugin

/// Outside of namespaces, once in a library: its name, as decks and messages say it, and what adds its laws.
#define ATRAPOS_PLUGIN(name, ...)                                                                    \
  extern "C" {                                                                                       \
  __attribute__((visibility("default"))) extern const atrapos::plugin::Description atrapos_plugin;   \
  const atrapos::plugin::Description atrapos_plugin{"a plug-in of Atrapos", {}, #name, __VA_ARGS__}; \
  }
