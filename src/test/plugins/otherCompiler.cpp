// A library that says that it was compiled with another compiler: nothing of it may be called.
#include <cstdlib>

#include "atrapos/plugin/Plugin.hpp"

namespace {
constexpr atrapos::plugin::Abi abi() {
  atrapos::plugin::Abi other;
  other.compiler = "99.1.0";
  return other;
}
}  // namespace

extern "C" {
extern const atrapos::plugin::Description atrapos_plugin;
const atrapos::plugin::Description atrapos_plugin{"a plug-in of Atrapos", abi(), "other",
                                                  [](atrapos::plugin::Registry&) { std::abort(); }};
}
