// Keys of scalar fields and what acts on them: constants, fields, physics, inflow.
#include <fmt/format.h>

#include "atrapos/physics/Formulas.hpp"
#include "deck/DeckTables.hpp"
#include "deck/Entries.hpp"

namespace atrapos::deck {
namespace {

constexpr const char* formulaText = "a number or a formula";

template <class S>
Field<S> formula(std::string key, Need need, std::string S::*member, std::string meaning) {
  return {std::move(key),
          need == required,
          formulaText,
          std::move(meaning),
          [=](const Value& v, S& s) { s.*member = v.isText() ? v.text() : yaml(v.real()); },
          [=](const S& s) {
            return (s.*member).empty() ? Node{} : Node{yaml(s.*member), {}};
          }};
}

const PluginLaw& lawOf(const PluginLaw& s) { return s; }
PluginLaw& lawOf(PluginLaw& s) { return s; }
const PluginLaw& lawOf(const PluginLoad& s) { return s.law; }
PluginLaw& lawOf(PluginLoad& s) { return s.law; }

/// Keys of an entry with a plug-in's law.
template <class S>
Table<S> pluginTable() {
  return {
      Field<S>{"law", true, "a name", "a law of one of the deck's plug-ins",
               [](const Value& v, S& s) { lawOf(s).law = v.name(); },
               [](const S& s) {
                 return lawOf(s).law.empty() ? Node{} : Node{yaml(lawOf(s).law), {}};
               }},
      Field<S>{"fields", true, "a list of names", "the fields that it is for, in its order",
               [](const Value& v, S& s) { lawOf(s).fields = v.names(); },
               [](const S& s) {
                 return Node{yamlList(lawOf(s).fields), {}};
               }},
      Field<S>{"parameters", false, "a map of names to numbers", "its parameters that are not what it says",
               [](const Value& v, S& s) {
                 for (const Value& each : v.children()) {
                   lawOf(s).parameters[each.key()] = each.real();
                 }
               },
               [](const S& s) {
                 Node node;
                 for (const auto& [name, value] : lawOf(s).parameters) {
                   node.children.emplace_back(name, Node{yaml(value), {}});
                 }
                 return node;
               }}};
}

}  // namespace

Field<Deck> pluginsField() {
  return {"plugins",
          false,
          "a list of names",
          "plug-ins whose laws it uses; the command line says where they are (--plugin FILE)",
          [](const Value& v, Deck& deck) {
            deck.plugins = v.names();
            for (const std::string& name : deck.plugins) {
              if (!physics::isFreeName(name)) {
                v.fail(
                    fmt::format("'{}' is no name of a plug-in; expected a name, whose file the command line "
                                "says with --plugin FILE",
                                name));
              }
            }
          },
          [](const Deck& deck) {
            return deck.plugins.empty() ? Node{} : Node{yamlList(deck.plugins), {}};
          }};
}

Alternative<decltype(Load::load)> pluginLoadAlternative() {
  static const Table<PluginLoad> table = [] {
    auto keys = pluginTable<PluginLoad>();
    keys.push_back(name("set", required, &PluginLoad::set, "a side set, name or id", "where it acts"));
    return keys;
  }();
  return alternative<decltype(Load::load), PluginLoad>("plugin", table);
}

Field<Deck> constantsField() {
  return {"constants",
          false,
          "a map of names to numbers",
          "constants that formulas may refer to",
          [](const Value& v, Deck& deck) {
            if (!v.isMap() || v.isEmptyMap()) {
              v.fail("expected a map of names to numbers, got " + v.shown());
            }
            for (const Value& constant : v.children()) {
              if (!physics::isFreeName(constant.key())) {
                constant.failKey("cannot be the name of a constant; " + std::string(freeNames));
              }
              deck.constants[constant.key()] = constant.real();
            }
          },
          [](const Deck& deck) {
            Node node;
            for (const auto& [name, value] : deck.constants) {
              node.children.emplace_back(name, Node{yaml(value), {}});
            }
            return node;
          }};
}

const Table<ScalarField>& scalarFieldTable() {
  static const Table<ScalarField> table{
      formula("initial", required, &ScalarField::initial, "values at load factor 0, of x, y, z")};
  return table;
}

const Variants<Physics, decltype(Physics::law)>& physicsVariants() {
  using V = decltype(Physics::law);
  static const Variants<Physics, V> variants{
      "type",
      &Physics::law,
      {alternative<V, ScalarBalance>(
           "balance",
           {name("field", required, &ScalarBalance::field, "a name", "the field whose balance it is"),
            formula("conductivity", optional, &ScalarBalance::conductivity,
                    "flux by negative gradient: of the fields, lambda, x, y, z"),
            formula("source", optional, &ScalarBalance::source,
                    "amount per volume that comes up: of the same, and of gradients"),
            formula("capacity", optional, &ScalarBalance::capacity,
                    "amount per volume by value, of the same: what Hopf points depend on; 1 where no entry "
                    "says it")},
           [](const Value& map, const ScalarBalance&) {
             if (!map.has("conductivity") && !map.has("source")) {
               map.fail("says nothing; expected conductivity, source or both");
             }
           }),
       alternative<V, FluidFlow>(
           "flow",
           {names("velocity", required, &FluidFlow::velocity, "the fields of its components along x, y, z"),
            name("pressure", required, &FluidFlow::pressure, "a name", "the field of the pressure"),
            real("viscosity", required, &FluidFlow::viscosity, check::positive,
                 "dynamic: pressure times time"),
            real("density", optional, &FluidFlow::density, check::natural,
                 "mass per volume; 0: creeping flow")}),
       alternative<V, PluginLaw>("plugin", pluginTable<PluginLaw>())},
      {names("blocks", required, &Physics::blocks, "where it acts")}};
  return variants;
}

Field<Material> expansionField() {
  return formula("expansion", optional, &Material::expansion,
                 "growth of lengths without stress: of one field, lambda, x, y, z; for "
                 "saint_venant_kirchhoff, neo_hookean and mooney_rivlin in solids and plane bodies");
}

const Table<ElectricField>& dielectricTable() {
  static const Table<ElectricField> table{
      name("field", required, &ElectricField::field, "a name", "the electric potential"),
      real("permittivity", required, &ElectricField::permittivity, check::positive,
           "eps, of the deformed material")};
  return table;
}

Field<Material> dielectricField() {
  return {"dielectric",
          false,
          "a map with field, permittivity",
          "an electric field acts in the material; for saint_venant_kirchhoff, neo_hookean and mooney_rivlin "
          "in solids and plane bodies",
          [](const Value& v, Material& m) {
            ElectricField field;
            read(dielectricTable(), v, field);
            m.dielectric = field;
          },
          [](const Material& m) { return m.dielectric ? print(dielectricTable(), *m.dielectric) : Node{}; }};
}

Alternative<decltype(Load::load)> inflowAlternative() {
  return alternative<decltype(Load::load), InflowLoad>(
      "inflow", {name("set", optional, &InflowLoad::set, "a side set, name or id", "where it flows in"),
                 name("contact", optional, &InflowLoad::contact, "the name of a contact",
                      "through which it flows in, instead of set"),
                 name("field", required, &InflowLoad::field, "the name of a field", "of what"),
                 formula("amount", required, &InflowLoad::amount,
                         "per area: of the fields there, lambda, x, y, z, through a contact contact_pressure and "
                         "contact_gap; the load factor counts where it says lambda")});
}

std::vector<std::string> scalarFields(const Deck& deck) {
  std::vector<std::string> fields;
  const auto add = [&](const std::string& field) {
    if (std::find(fields.begin(), fields.end(), field) == fields.end()) {
      fields.push_back(field);
    }
  };
  for (const auto& entry : deck.physics) {
    if (const auto* balance = std::get_if<ScalarBalance>(&entry.law)) {
      add(balance->field);
      continue;
    }
    if (const auto* own = std::get_if<PluginLaw>(&entry.law)) {
      for (const std::string& field : own->fields) {
        add(field);
      }
      continue;
    }
    const auto& flow = std::get<FluidFlow>(entry.law);
    for (const std::string& component : flow.velocity) {
      add(component);
    }
    add(flow.pressure);
  }
  for (const auto& material : deck.materials) {
    if (material.dielectric) {
      add(material.dielectric->field);
    }
  }
  return fields;
}

}  // namespace atrapos::deck
