#pragma once

#include "Inputs.hpp"
#include "Laws.hpp"
#include "OperationCount.hpp"
#include "atrapos/contact/ContactLaw.hpp"
#include "atrapos/formula/Parse.hpp"
#include "atrapos/solid/Gent.hpp"
#include "atrapos/solid/MooneyRivlin.hpp"
#include "atrapos/solid/NeoHookean.hpp"
#include "atrapos/solid/Ogden.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"
#include "atrapos/solid/Yeoh.hpp"

namespace atrapos::bench {

/// H around rest.
inline Domain gradients() {
  return {std::vector<double>(9, 0.0), std::vector<double>(9, 0.1), std::vector<double>(9, 0.1), 0.0};
}

/// Bratu's balance, -div grad u = lambda exp(u), as a template and as a formula that is read when the program
/// runs. in: grad u (3), u, lambda; out: grad u, minus the source.
struct BratuTemplate {
  static constexpr int numInputs = 5, numOutputs = 4, numData = 0;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    using std::exp;
    for (int i = 0; i < 3; ++i) out[i] = in[i];
    out[3] = T(-(in[4] * exp(in[3])));
  }
};
struct BratuFormula {
  static constexpr int numInputs = 5, numOutputs = 4, numData = 0;
  formula::Program program;

  BratuFormula() {
    formula::Builder builder;
    const formula::Symbols symbols{{{"u", builder.input(3)}, {"lambda", builder.input(4)}}, {}};
    program = builder.program(
        {formula::parse("1", symbols, builder), formula::parse("lambda*exp(u)", symbols, builder)});
  }
  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    T result[2];
    formula::evaluate(program, in, data, result);
    for (int i = 0; i < 3; ++i) out[i] = T(result[0] * in[i]);
    out[3] = T(-result[1]);
  }
  /// What is useful of it is what the template does.
  void operator()(const Counted* in, const double* data, Counted* out) const {
    BratuTemplate{}(in, data, out);
  }
};

/// Calls f(name, law, domain) for laws that peers do not run: the solids' of rubber, formulas.
template <class F>
void forEachAlone(const F& f) {
  const Domain balance{std::vector<double>(5, 0.5), std::vector<double>(5, 0.1), std::vector<double>(5, 0.1),
                       0.0};
  f("template_bratu", BratuTemplate{}, balance);
  f("formula_bratu", BratuFormula{}, balance);
  f("rubber_neo_hookean", solid::NeoHookean::fromModuli(0.8, 1.7), gradients());
  f("rubber_yeoh", solid::Yeoh::fromModuli(0.4, -0.02, 0.01, 1.7), gradients());
  f("rubber_gent", solid::Gent::fromModuli(0.8, 20, 1.7), gradients());
  f("rubber_mooney_rivlin", solid::MooneyRivlin::fromModuli(0.3, 0.1, 1.7), gradients());
  f("rubber_ogden", solid::Ogden::fromModuli({1.2}, {1.3}, 1.7), gradients());
  f("rubber_ogden_3", solid::Ogden::fromModuli({6.3, 0.012, -0.1}, {1.3, 5, -2}, 1.7), gradients());
}

/// Calls f(name, law, peerLaw, domain) for every other law of the benchmark. peerLaw is what the peers run:
/// the same where they can, for contact its closed form (they have no implicit functions).
template <class F>
void forEachCase(const F& f) {
  const Domain gradient = gradients();
  const solid::SaintVenantKirchhoff linear{1.2, 0.8};
  f("saint_venant_kirchhoff", linear, linear, gradient);
  const NeoHookean hyperelastic{1.2, 0.8};
  f("neo_hookean", hyperelastic, hyperelastic, gradient);

  // Millimetres: a roll of radius 50 under points 2 to 5 mm away, stiffness and regularisation of paper 4.1.
  const double axis[3] = {0, 0, -54}, radius = 50;
  const contact::RegularisedPressure pressure{1e-3, 0.1};
  const auto onRoll = [&](double y, double spread) {
    return Domain{{0, y, -0.5}, {5, spread, 1}, {0.5, spread, 0.5}, 4.0};
  };
  {
    contact::ContactLaw<contact::Cylinder> law;
    ContactClosedForm<CylinderProfile> closed;
    for (int i = 0; i < 3; ++i) law.tool.center[i] = closed.center[i] = axis[i];
    law.tool.radius = closed.profile.radius = radius;
    law.pressure = closed.pressure = pressure;
    f("contact_cylinder", law, closed, onRoll(0, 5));
  }
  {
    contact::ContactLaw<TaperedRoll> law;
    ContactClosedForm<TaperedProfile> closed;
    for (int i = 0; i < 3; ++i) law.tool.center[i] = closed.center[i] = axis[i];
    law.tool.profile = closed.profile = {radius, 15, 0.1, 23};
    law.pressure = closed.pressure = pressure;
    // Near the edge of the taper, in steps below 1/sharpness: further away tanh is a constant.
    f("contact_tapered_roll", law, closed, onRoll(15, 0.03));
  }
}

}  // namespace atrapos::bench
