// A plug-in for decks: soap films, whose tension is the same at any slope (docs/plugins.md).
#include <cmath>

#include "atrapos/fem/PointLawOf.hpp"
#include "atrapos/plugin/Plugin.hpp"

using atrapos::taylor::Passive;

/// A film of height u over a plane, with pressure from below:
///
///     -div(tension grad u / sqrt(1 + |grad u|^2)) = pressure lambda
///
/// in: grad u (3), u, the load factor; out: tension grad u / sqrt(1 + |grad u|^2) (3), -pressure lambda
struct Film {
  static constexpr int numInputs = 5, numOutputs = 4, numData = 0;
  static constexpr bool symmetric = true;
  double tension = 1, pressure = 1;  ///< force per length, force per area

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const Passive<T>*, T* out) const {
    using std::sqrt;
    const T stretch = sqrt(1.0 + in[0] * in[0] + in[1] * in[1] + in[2] * in[2]);
    for (int i = 0; i < 3; ++i) out[i] = tension * in[i] / stretch;
    out[3] = -pressure * in[4];
  }
};

/// A force per length along a side, upwards. in: u, the load factor; out: -force lambda
struct Pull {
  static constexpr int numInputs = 2, numOutputs = 1, numData = 0;
  static constexpr bool symmetric = true;
  double force = 0;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const Passive<T>*, T* out) const {
    out[0] = -force * in[1];
  }
};

ATRAPOS_PLUGIN(soap, [](atrapos::plugin::Registry& registry) {
  atrapos::plugin::Law film;
  film.name = "film";
  film.parameters = {{"tension", 1.0}, {"pressure", 0.0}};
  film.make = [](const atrapos::plugin::Parameters& p) {
    return atrapos::fem::pointLaw(Film{p.at("tension"), p.at("pressure")});
  };
  // Friction at rest: what makes a film a matter of Hopf points, with other fields beside it.
  film.capacity = [](const atrapos::plugin::Parameters&, const double*, const double*, double* c) {
    c[0] = 1;
  };
  registry.addPhysics(film);

  atrapos::plugin::Law pull;
  pull.name = "pull";
  pull.parameters = {{"force", std::nullopt}};  // a deck has to say it
  pull.make = [](const atrapos::plugin::Parameters& p) {
    return atrapos::fem::pointLaw(Pull{p.at("force")});
  };
  registry.addLoad(pull);
})
