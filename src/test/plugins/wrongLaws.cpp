// Laws that do not keep what they say.
#include <stdexcept>

#include "atrapos/fem/PointLawOf.hpp"
#include "atrapos/plugin/Plugin.hpp"

/// Of one field, without its gradient.
struct Short {
  static constexpr int numInputs = 1, numOutputs = 1, numData = 0;
  static constexpr bool symmetric = true;
  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const atrapos::taylor::Passive<T>*, T* out) const {
    out[0] = 2.0 * in[0];
  }
};

ATRAPOS_PLUGIN(wrong, [](atrapos::plugin::Registry& registry) {
  registry.addPhysics({"short", 1, {}, [](const auto&) { return atrapos::fem::pointLaw(Short{}); }, {}});
  registry.addPhysics({"throwing",
                       1,
                       {},
                       [](const auto&) -> std::unique_ptr<atrapos::fem::PointLaw> {
                         throw std::invalid_argument("tension must be positive");
                       },
                       {}});
  registry.addPhysics(
      {"none", 1, {}, [](const auto&) -> std::unique_ptr<atrapos::fem::PointLaw> { return nullptr; }, {}});
})
