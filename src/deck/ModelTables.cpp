// Keys of the blocks that describe the body and what acts on it: materials, loads, contact.
#include <algorithm>
#include <cmath>
#include <limits>

#include "deck/DeckTables.hpp"

namespace atrapos::deck {
namespace {

const Check yieldWidth{[](double x) { return x >= 0 && x <= 0.5; }, "0 to 0.5"};

constexpr const char* setOfNodes = "a node set or side set, name or id";

Field<NodalLoad> nodalForce(const std::string& key, bool perNode, std::string meaning) {
  return {key,
          false,
          "a list of 3 numbers",
          std::move(meaning),
          [=](const Value& v, NodalLoad& s) {
            const auto x = v.reals(3);
            std::copy(x.begin(), x.end(), s.force.begin());
            s.perNode = perNode;
          },
          [=](const NodalLoad& s) {
            return s.perNode == perNode ? Node{yamlList(s.force), {}} : Node{};
          }};
}

Field<SurfaceLoad> surfaceVector(const std::string& key, SurfaceLoad::Kind kind, std::string meaning) {
  return {key,
          false,
          "a list of 3 numbers",
          std::move(meaning),
          [=](const Value& v, SurfaceLoad& s) {
            const auto x = v.reals(3);
            std::copy(x.begin(), x.end(), s.vector.begin());
            s.kind = kind;
          },
          [=](const SurfaceLoad& s) {
            return s.kind == kind ? Node{yamlList(s.vector), {}} : Node{};
          }};
}

Field<EdgeLoad> edgeVector(const std::string& key, EdgeLoad::Kind kind, std::string meaning) {
  return {key,
          false,
          "a list of 3 numbers",
          std::move(meaning),
          [=](const Value& v, EdgeLoad& s) {
            const auto x = v.reals(3);
            std::copy(x.begin(), x.end(), s.vector.begin());
            s.kind = kind;
          },
          [=](const EdgeLoad& s) {
            return s.kind == kind ? Node{yamlList(s.vector), {}} : Node{};
          }};
}

void requireExactlyOne(const Value& map, const std::vector<std::string>& keys) {
  std::vector<std::string> given;
  for (const auto& key : keys) {
    if (map.has(key)) {
      given.push_back(key);
    }
  }
  if (given.size() != 1) {
    map.fail(
        fmt::format("needs exactly one of {}, got {}", joined(keys), given.empty() ? "none" : joined(given)));
  }
}

/// A positive number or one word for its absence.
Field<Contact> positiveOr(std::string key, std::optional<double> Contact::*member, const std::string& word,
                          std::string meaning) {
  return {std::move(key),
          false,
          "a positive number or " + word,
          std::move(meaning),
          [=](const Value& v, Contact& s) {
            if (v.isText() && v.text() == word) {
              (s.*member).reset();
            } else if (v.isText()) {
              v.fail(fmt::format("expected a positive number or {}, got {}", word, v.shown()));
            } else {
              s.*member = v.real(check::positive);
            }
          },
          [=](const Contact& s) {
            return Node{s.*member ? yaml(*(s.*member)) : word, {}};
          }};
}

using ContactLaw = Contact::Law;

const Choices<ContactLaw>& contactLaws() {
  static const Choices<ContactLaw> laws{{"auto", ContactLaw::Auto},
                                        {"hyperbola", ContactLaw::Hyperbola},
                                        {"barrier", ContactLaw::Barrier},
                                        {"power", ContactLaw::Power},
                                        {"exponential", ContactLaw::Exponential},
                                        {"penalty", ContactLaw::Penalty},
                                        {"hard", ContactLaw::Hard},
                                        {"linear", ContactLaw::Linear},
                                        {"power_overclosure", ContactLaw::Overclosure}};
  return laws;
}

/// The field where it has a meaning: with one of these laws. A number of the hyperbola, with zones of the
/// linear law, means that law where the deck names none.
Field<Contact> ofLaws(Field<Contact> field, const std::vector<ContactLaw>& laws) {
  const auto isOf = [=](ContactLaw law) { return std::find(laws.begin(), laws.end(), law) != laws.end(); };
  const auto has = [=](const Contact& s) { return isOf(s.law); };
  field.read = [=, inner = field.read](const Value& v, Contact& s) {
    const ContactLaw meant = s.points == Contact::Points::Zones ? ContactLaw::Linear : ContactLaw::Hyperbola;
    if (s.law == ContactLaw::Auto && isOf(meant)) {
      s.law = meant;
    }
    if (!has(s)) {
      v.fail(fmt::format("has no meaning with law: {}", wordOf(s.law, contactLaws())));
    }
    inner(v, s);
  };
  field.print = [=, inner = field.print](const Contact& s) { return has(s) ? inner(s) : Node{}; };
  return field;
}

/// alpha: a number, or one of two words.
Field<Contact> contactStiffness() {
  const std::string accepts = "a positive number, rigid or auto";
  return {"stiffness",
          false,
          accepts,
          "alpha: pressure per length, with points: nodes force per length; rigid: 1/alpha = 0",
          [=](const Value& v, Contact& s) {
            if (!v.isText()) {
              s.stiffness = v.real(check::positive);
              return;
            }
            s.rigid = v.text() == "rigid";
            if (s.rigid && s.law == ContactLaw::Penalty) {
              v.fail("a penalty has a finite stiffness");
            }
            if (s.rigid && s.hasEdge()) {
              v.fail("a pressure with an edge has a finite stiffness");
            }
            if (!s.rigid && v.text() != "auto") {
              v.fail(fmt::format("expected {}, got {}", accepts, v.shown()));
            }
          },
          [](const Contact& s) {
            return Node{s.rigid ? "rigid" : s.stiffness ? yaml(*s.stiffness) : "auto", {}};
          }};
}

/// A positive number, or infinite: a member of type double, or one that may be missing.
template <class S, class M>
Field<S> bulkModulus(bool needed, M S::*member) {
  constexpr const char* word = "infinite";
  return {"bulk_modulus",
          needed,
          "a positive number, or infinite with formulation: mixed",
          "kappa, a pressure",
          [=](const Value& v, S& s) {
            if (!v.isText()) {
              s.*member = v.real(check::positive);
            } else if (v.text() == word) {
              s.*member = std::numeric_limits<double>::infinity();
            } else {
              v.fail(fmt::format("expected a positive number or {}, got {}", word, v.shown()));
            }
          },
          [=](const S& s) {
            const std::optional<double> bulk = s.*member;
            return !bulk ? Node{} : Node{std::isinf(*bulk) ? word : yaml(*bulk), {}};
          }};
}

const Choices<Material::Formulation>& formulations() {
  static const Choices<Material::Formulation> choices{{"displacement", Material::Formulation::Displacement},
                                                      {"mixed", Material::Formulation::Mixed}};
  return choices;
}

void requireElasticPair(const Value& map, const NeoHookean& m) {
  const bool young = m.youngsModulus || m.poissonsRatio, moduli = m.shearModulus || m.bulkModulus;
  const bool complete =
      young ? m.youngsModulus && m.poissonsRatio : m.shearModulus.has_value() && m.bulkModulus.has_value();
  if (young == moduli || !complete) {
    map.fail("needs either youngs_modulus and poissons_ratio or shear_modulus and bulk_modulus");
  }
}

void requireTerms(const Value& map, const Ogden& m) {
  constexpr std::size_t most = 6;
  constexpr double largest = 40;
  if (m.mu.size() > most) {
    map.at("mu").fail(fmt::format("expected one to {} numbers, got {}", most, m.mu.size()));
  }
  if (m.alpha.size() != m.mu.size()) {
    map.at("alpha").fail(
        fmt::format("expected as many numbers as mu has, {}, got {}", m.mu.size(), m.alpha.size()));
  }
  double shear = 0;
  for (std::size_t i = 0; i < m.mu.size(); ++i) {
    if (m.mu[i] == 0) {
      map.at("mu").fail("no number may be 0");
    }
    if (m.alpha[i] == 0 || std::abs(m.alpha[i]) > largest) {
      map.at("alpha").fail(fmt::format("no number may be 0 or beyond {}, got {}", largest, m.alpha[i]));
    }
    shear += m.mu[i] * m.alpha[i] / 2;
  }
  if (!(shear > 0)) {
    map.at("mu").fail(fmt::format(
        "half the sum of mu alpha, the shear modulus at rest, must be positive, got {:.6g}", shear));
  }
}

}  // namespace

const Variants<Material, decltype(Material::law)>& materialVariants() {
  static const Choices<VonMises::Strains> strains{{"small", VonMises::Strains::Small},
                                                  {"finite", VonMises::Strains::Finite}};
  using V = decltype(Material::law);
  static const Variants<Material, V> variants{
      "law",
      &Material::law,
      {alternative<V, SaintVenantKirchhoff>(
           "saint_venant_kirchhoff", {real("youngs_modulus", required, &SaintVenantKirchhoff::youngsModulus,
                                           check::positive, "E, a pressure"),
                                      real("poissons_ratio", required, &SaintVenantKirchhoff::poissonsRatio,
                                           check::poissonsRatio, "nu")}),
       alternative<V, NeoHookean>(
           "neo_hookean",
           {real("youngs_modulus", &NeoHookean::youngsModulus, check::positive, "E at rest, a pressure"),
            real("poissons_ratio", &NeoHookean::poissonsRatio, check::poissonsRatio, "nu at rest"),
            real("shear_modulus", &NeoHookean::shearModulus, check::positive, "mu, a pressure"),
            bulkModulus(false, &NeoHookean::bulkModulus)},
           requireElasticPair),
       alternative<V, MooneyRivlin>(
           "mooney_rivlin",
           {real("c1", required, &MooneyRivlin::c1, check::any, "factor of the first invariant, a pressure"),
            real("c2", required, &MooneyRivlin::c2, check::any, "of the second; c1 + c2 > 0"),
            bulkModulus(true, &MooneyRivlin::bulkModulus)},
           [](const Value& map, const MooneyRivlin& m) {
             if (!(m.c1 + m.c2 > 0)) {
               map.at("c2").fail(fmt::format(
                   "c1 + c2, half the shear modulus at rest, must be positive, got {}", m.c1 + m.c2));
             }
           }),
       alternative<V, Yeoh>(
           "yeoh",
           {real("c1", required, &Yeoh::c1, check::positive, "half the shear modulus at rest, a pressure"),
            real("c2", required, &Yeoh::c2, check::any, "factor of the square, a pressure"),
            real("c3", required, &Yeoh::c3, check::any, "factor of the cube, a pressure"),
            bulkModulus(true, &Yeoh::bulkModulus)}),
       alternative<V, Gent>("gent", {real("shear_modulus", required, &Gent::shearModulus, check::positive,
                                          "at rest, a pressure"),
                                     real("limit", required, &Gent::limit, check::positive,
                                          "J_m, what the first invariant cannot exceed 3 by"),
                                     bulkModulus(true, &Gent::bulkModulus)}),
       alternative<V, Ogden>("ogden",
                             {reals("mu", required, &Ogden::mu, "mu_p, pressures, one to six"),
                              reals("alpha", required, &Ogden::alpha, "alpha_p, the power of the stretches"),
                              bulkModulus(true, &Ogden::bulkModulus)},
                             requireTerms),
       alternative<V, VonMises>(
           "von_mises",
           {real("youngs_modulus", required, &VonMises::youngsModulus, check::positive, "E, a pressure"),
            real("poissons_ratio", required, &VonMises::poissonsRatio, check::poissonsRatio, "nu"),
            real("yield_stress", required, &VonMises::yieldStress, check::positive, "in tension, a pressure"),
            real("hardening_modulus", optional, &VonMises::hardeningModulus, check::natural,
                 "H, of linear isotropic hardening, a pressure"),
            real("saturation", optional, &VonMises::saturation, check::any,
                 "Q, what Voce's isotropic hardening adds in the end, a pressure"),
            real("exponent", optional, &VonMises::exponent, check::natural,
                 "of Voce's hardening, by plastic strain"),
            real("kinematic_modulus", optional, &VonMises::kinematicModulus, check::natural,
                 "C of Armstrong and Frederick's backstress, a pressure"),
            real("recall", optional, &VonMises::recall, check::natural,
                 "b of the backstress; 0: Prager's rule"),
            real("yield_width", optional, &VonMises::yieldWidth, yieldWidth,
                 "w of a smoothed yield surface: flow begins at about 1 - w of the yield stress, without "
                 "events; 0: a sharp one"),
            choice("strains", optional, &VonMises::strains, strains,
                   "small: with rotations of any size; finite: elastic and plastic parts multiply")},
           [](const Value& map, const VonMises& m) {
             if (m.strains == VonMises::Strains::Finite && m.kinematicModulus != 0) {
               map.at("kinematic_modulus").fail("is for strains: small");
             }
             if (!(m.yieldStress + m.saturation > 0)) {
               map.at("saturation")
                   .fail(fmt::format("must leave some of the yield stress {}, got {}", m.yieldStress,
                                     m.saturation));
             }
           })},
      {names("blocks", required, &Material::blocks, "blocks of the mesh that are made of it"),
       choice("formulation", optional, &Material::formulation, formulations(),
              "mixed: pressures are unknowns too, for nearly incompressible rubber in solids and plane "
              "bodies"),
       expansionField(), dielectricField()}};
  return variants;
}

const Variants<Load, decltype(Load::load)>& loadVariants() {
  using V = decltype(Load::load);
  using Kind = SurfaceLoad::Kind;
  const Field<SurfaceLoad> pressure{"pressure",
                                    false,
                                    "a number",
                                    "force per reference area along the inward reference normal",
                                    [](const Value& v, SurfaceLoad& s) {
                                      s.pressure = v.real();
                                      s.kind = Kind::Pressure;
                                    },
                                    [](const SurfaceLoad& s) {
                                      return s.kind == Kind::Pressure ? Node{yaml(s.pressure), {}} : Node{};
                                    }};
  const Field<EdgeLoad> followerMoment{
      "follower_moment",
      false,
      "a number",
      "moment per reference length about the edge, turning with it; > 0 turns the directors outwards",
      [](const Value& v, EdgeLoad& s) {
        s.moment = v.real();
        s.kind = EdgeLoad::Kind::FollowerMoment;
      },
      [](const EdgeLoad& s) {
        return s.kind == EdgeLoad::Kind::FollowerMoment ? Node{yaml(s.moment), {}} : Node{};
      }};
  static const Variants<Load, V> variants{
      "type",
      &Load::load,
      {alternative<V, NodalLoad>("nodal",
                                 {name("set", required, &NodalLoad::set, setOfNodes, "nodes that are loaded"),
                                  nodalForce("total", false, "force, spread equally over the nodes"),
                                  nodalForce("per_node", true, "force on every node")},
                                 [](const Value& map, const NodalLoad&) {
                                   requireExactlyOne(map, {"total", "per_node"});
                                 }),
       alternative<V, SurfaceLoad>(
           "surface",
           {name("set", required, &SurfaceLoad::set, "a side set, name or id", "faces that are loaded"),
            surfaceVector("total", Kind::Total, "force, spread uniformly over the reference area"),
            surfaceVector("traction", Kind::Traction, "force per reference area"), pressure,
            flag("follower", &SurfaceLoad::follower,
                 "pressure only: true: on the deformed area, along its normal"),
            choice("at", optional, &SurfaceLoad::at, shellPlaces(), "where in the thickness of shells")},
           [](const Value& map, const SurfaceLoad& load) {
             requireExactlyOne(map, {"total", "traction", "pressure"});
             if (load.follower && load.kind != Kind::Pressure) {
               map.at("follower").fail("has a meaning with pressure only");
             }
           }),
       alternative<V, VolumeLoad>(
           "volume", {names("blocks", required, &VolumeLoad::blocks, "blocks that are loaded"),
                      vector3("force", required, &VolumeLoad::force, "force per reference volume")}),
       alternative<V, EdgeLoad>(
           "edge",
           {name("set", required, &EdgeLoad::set, "a side set, name or id",
                 "edges of shells that are loaded"),
            edgeVector("total", EdgeLoad::Kind::Total, "force, spread uniformly over the reference length"),
            edgeVector("force", EdgeLoad::Kind::Force, "force per reference length"),
            edgeVector("moment", EdgeLoad::Kind::Moment,
                       "moment per reference length, not about the director"),
            edgeVector(
                "follower_force", EdgeLoad::Kind::FollowerForce,
                "force per reference length along the edge, outwards, along the director, turning with them"),
            followerMoment},
           [](const Value& map, const EdgeLoad&) {
             requireExactlyOne(map, {"total", "force", "moment", "follower_force", "follower_moment"});
           }),
       alternative<V, MomentLoad>(
           "moment", {name("coupling", required, &MomentLoad::coupling,
                           "the name of a rigid coupling with an axis", "the body that it turns"),
                      real("moment", required, &MomentLoad::moment, check::any, "about the axis")}),
       inflowAlternative(), pluginLoadAlternative()},
      {flag("constant", &Load::constant, "true: not multiplied by the load factor")}};
  return variants;
}

const Table<Contact>& contactTable() {
  static const Choices<Contact::Points> points{{"auto", Contact::Points::Auto},
                                               {"nodes", Contact::Points::Nodes},
                                               {"quadrature", Contact::Points::Quadrature},
                                               {"zones", Contact::Points::Zones}};
  static const Table<Contact> table = [] {
    const auto where =
        choice("points", optional, &Contact::points, points,
               "where the law acts; zones: where lines of the surface are in the tool, integrated "
               "between their limits");
    using Law = ContactLaw;
    auto law = choice("law", optional, &Contact::law, contactLaws(), "pressure as a function of the gap");
    law.read = [inner = law.read](const Value& v, Contact& s) {
      inner(v, s);
      if (s.hasEdge() && s.points != Contact::Points::Zones && s.points != Contact::Points::Auto) {
        v.fail("a pressure with an edge is integrated up to it; expected points: zones beside it");
      }
      if (!s.hasEdge() && s.law != Law::Auto && s.points == Contact::Points::Zones) {
        v.fail("zones begin where the pressure does; expected linear or power_overclosure");
      }
    };
    auto degree = integer("quadrature_degree", optional, &Contact::quadratureDegree, check::degree,
                          "polynomial degree integrated exactly on a face");
    degree.print = [inner = degree.print](const Contact& s) {
      return s.points != Contact::Points::Nodes ? inner(s) : Node{};
    };
    degree.read = [inner = degree.read](const Value& v, Contact& s) {
      if (s.points == Contact::Points::Nodes) {
        v.fail("has no meaning with points: nodes");
      }
      inner(v, s);
    };
    auto gap = positiveOr("reference_gap", &Contact::referenceGap, "initial",
                          "Delta, the gap at which the force is zero; initial: that of each point");
    gap.read = [inner = gap.read](const Value& v, Contact& s) {
      inner(v, s);
      const bool bounded = s.law == ContactLaw::Hyperbola && s.stiffness && s.regularisation;
      const double least = bounded ? *s.regularisation / *s.stiffness : 0.0;
      if (s.referenceGap && *s.referenceGap <= least) {
        v.fail(fmt::format("must be above regularisation/stiffness = {}, got {}", least, v.shown()));
      }
    };
    auto shares =
        choice("shares", optional, &Contact::shares,
               Choices<Contact::Shares>{{"equal", Contact::Shares::Equal},
                                        {"distribution_factors", Contact::Shares::DistributionFactors}},
               "with points: nodes, what part of R, eta and alpha a node has: 1, or its "
               "distribution factor in the node set");
    shares.read = [inner = shares.read](const Value& v, Contact& s) {
      inner(v, s);
      if (s.shares != Contact::Shares::Equal && s.points != Contact::Points::Nodes) {
        v.fail("distribution factors are those of nodes; expected points: nodes beside it");
      }
    };
    shares.print = [inner = shares.print](const Contact& s) {
      return s.points == Contact::Points::Nodes ? inner(s) : Node{};
    };
    using Unknown = Contact::Unknown;
    auto carried =
        choice("carried", optional, &Contact::carried,
               Choices<Contact::Carried>{{"near", Contact::Carried::Near}, {"all", Contact::Carried::All}},
               "by which points the law is carried: all, or those that come nearer than half of Delta");
    carried.read = [inner = carried.read](const Value& v, Contact& s) {
      inner(v, s);
      if (s.carried == Contact::Carried::Near && s.unknown == Unknown::Curve) {
        v.fail("near has no meaning with unknown: curve; expected all");
      }
    };
    auto exponent = real("exponent", optional, &Contact::exponent, check::exponent,
                         "m of the power law; of power_overclosure a whole number");
    exponent.read = [inner = exponent.read](const Value& v, Contact& s) {
      inner(v, s);
      if (s.law == Law::Overclosure &&
          !(s.exponent == std::floor(s.exponent) && s.exponent >= 1 && s.exponent <= 8)) {
        v.fail(fmt::format("zones have Taylor series for whole exponents only; expected 1 to 8, got {}",
                           v.shown()));
      }
    };
    const std::vector<Law> withDelta{Law::Hyperbola, Law::Barrier, Law::Power, Law::Exponential,
                                     Law::Penalty};
    return Table<Contact>{
        name("tool", required, &Contact::tool, "the name of a tool", "what the set may touch"),
        name("set", required, &Contact::set, "a side set (with points: nodes also a node set), name or id",
             "where the body may touch it"),
        where,
        choice("at", optional, &Contact::at, shellPlaces(), "where in the thickness of shells"),
        degree,
        law,
        ofLaws(shares, withDelta),
        ofLaws(contactStiffness(), {Law::Hyperbola, Law::Power, Law::Penalty, Law::Linear, Law::Overclosure}),
        ofLaws(positiveOr("regularisation", &Contact::regularisation, "auto",
                          "eta: a pressure, with points: nodes a force"),
               {Law::Hyperbola, Law::Barrier, Law::Power}),
        ofLaws(exponent, {Law::Power, Law::Overclosure}),
        ofLaws(positiveOr("touching", &Contact::touching, "auto",
                          "R_0 of the exponential law, the pressure (nodes: force) at zero gap"),
               {Law::Exponential}),
        ofLaws(positiveOr("length", &Contact::length, "auto",
                          "l over which the exponential law grows by e or the penalty's corner is smoothed"),
               {Law::Exponential, Law::Penalty}),
        ofLaws(gap, withDelta),
        ofLaws(choice("unknown", optional, &Contact::unknown,
                      Choices<Unknown>{{"displacement", Unknown::Displacement}, {"curve", Unknown::Curve}},
                      "of a point: its displacement alone, or also the place on the curve of its law"),
               {Law::Hyperbola, Law::Barrier}),
        ofLaws(carried, withDelta)};
  }();
  return table;
}

}  // namespace atrapos::deck
