#include "deck/DeckReferences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "atrapos/physics/Formulas.hpp"
#include "deck/DeckTables.hpp"
#include "deck/Stages.hpp"

namespace atrapos::deck {
namespace {

template <class Entry>
std::vector<std::string> namesOf(const std::vector<Entry>& entries) {
  std::vector<std::string> names;
  for (const auto& entry : entries) {
    names.push_back(entry.name);
  }
  return names;
}

/// Throws at `v` where `name` is none of `entries`.
template <class Entry>
const Entry& find(const Value& v, const std::string& name, const std::vector<Entry>& entries,
                  const char* block) {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) { return entry.name == name; });
  if (found == entries.end()) {
    const auto names = namesOf(entries);
    v.fail(fmt::format("no entry '{}' in {}{}; there {}", name, block, suggestion(name, names),
                       names.empty() ? "are none" : "are " + joined(names)));
  }
  return *found;
}

void requireField(const Value& v, const std::string& field, const Deck& deck) {
  const auto fields = scalarFields(deck);
  if (std::find(fields.begin(), fields.end(), field) == fields.end()) {
    v.fail(fmt::format("no physics has a field '{}'{}; there {}", field, suggestion(field, fields),
                       fields.empty() ? "are none" : "are " + joined(fields)));
  }
}

/// A formula that may refer to all fields of the deck; which of them are there is checked with the mesh.
void checkFormula(const Value& v, const std::string& text, const Deck& deck, physics::Place place) {
  try {
    physics::checkFormula(text, scalarFields(deck), deck.constants, place);
  } catch (const formula::FormulaError& e) {
    v.fail(e.what());
  }
}

/// What the name of a field must be, at the value that says it.
void checkFieldName(const Value& v, const std::string& field, const Deck& deck) {
  if (!physics::isFreeName(field) || field == "displacement") {
    v.fail(fmt::format("'{}' cannot be the name of a field; {}", field, freeNames));
  }
  if (deck.constants.count(field) != 0) {
    v.fail(fmt::format("'{}' is the name of a constant already", field));
  }
}

/// What scalar fields do to a material.
void checkInField(const Value& root, const Material& material, const Deck& deck) {
  if (material.expansion.empty() && !material.dielectric) {
    return;
  }
  const Value at = root.at("materials").entries().at(material.name);
  const Value v = at.at(material.dielectric ? "dielectric" : "expansion");
  if (!std::holds_alternative<SaintVenantKirchhoff>(material.law) &&
      !std::holds_alternative<NeoHookean>(material.law) &&
      !std::holds_alternative<MooneyRivlin>(material.law)) {
    v.fail("is for the laws saint_venant_kirchhoff, neo_hookean and mooney_rivlin");
  }
  if (material.formulation == Material::Formulation::Mixed) {
    v.fail("is not for formulation: mixed");
  }
  if (!material.expansion.empty()) {
    checkFormula(at.at("expansion"), material.expansion, deck, physics::Place::shell);
  }
  if (!material.dielectric) {
    return;
  }
  if (!material.expansion.empty()) {
    v.fail("stands beside expansion; expected one of them");
  }
  if (deck.plane && deck.plane->kind == Plane::Kind::Axisymmetric) {
    v.fail("is not for axisymmetric bodies");
  }
  const std::string& field = material.dielectric->field;
  checkFieldName(v.at("field"), field, deck);
  for (const auto& entry : deck.physics) {
    const auto* own = std::get_if<PluginLaw>(&entry.law);
    if (const auto* balance = std::get_if<ScalarBalance>(&entry.law);
        (balance != nullptr && balance->field == field) ||
        (own != nullptr && std::count(own->fields.begin(), own->fields.end(), field) > 0)) {
      v.at("field").fail(
          fmt::format("physics/{} has a balance of '{}', whose rows are no charges", entry.name, field));
    }
  }
}

/// A rigid body that turns about an axis.
const Coupling& hingedBody(const Value& v, const std::string& name, const Deck& deck) {
  const Coupling& coupling = find(v, name, deck.couplings, "couplings");
  if (!coupling.axis) {
    v.fail(fmt::format(
        "coupling '{}' has no axis, about which its body turns; expected one of kind: rigid with axis",
        name));
  }
  return coupling;
}

/// The way of an inflow: a set, or a contact whose pressure is a function of the gap.
void checkWay(const Value& at, const InflowLoad& inflow, const Deck& deck) {
  if (!at.has("set") && !at.has("contact")) {
    at.failMissing("set", "a side set, or instead of it contact, the name of a contact");
  }
  if (!at.has("contact")) {
    return;
  }
  const Value v = at.at("contact");
  if (at.has("set")) {
    v.fail("stands beside set; expected one of them");
  }
  const Contact& contact = find(v, inflow.contact, deck.contacts, "contact");
  if (contact.points == Contact::Points::Nodes || contact.points == Contact::Points::Zones ||
      contact.law == Contact::Law::Hard || contact.hasEdge() || contact.unknown == Contact::Unknown::Curve) {
    v.fail(
        fmt::format("the pressure of contact '{}' is no function of the gap at points of faces; expected "
                    "points: quadrature, unknown: displacement and another law than hard",
                    contact.name));
  }
  if (deck.path.sharpen) {
    v.fail("not with path/sharpen, which changes the law of the contact");
  }
}

/// Formulas of what a support prescribes.
void checkPrescribed(const Value& at, const Support& support, const Deck& deck) {
  const auto check = [&](const std::string& key, const std::optional<Prescribed>& p) {
    if (!p) {
      return;
    }
    for (const auto& [inside, text] :
         {std::pair{"value", &p->valueFormula}, {"per_load_factor", &p->perLoadFactorFormula}}) {
      if (!text->empty()) {
        const Value v = at.at(key);
        const Value said = v.isMap() ? v.at(inside) : v;
        try {
          physics::checkFormula(*text, {}, deck.constants, physics::Place::reference);
        } catch (const formula::FormulaError& e) {
          said.fail(fmt::format("expected a finite number or a formula of x, y, z; this text {}", e.what()));
        }
      }
    }
  };
  for (std::size_t i = 0; i < 3; ++i) {
    check(std::string(1, "xyz"[i]), support.components[i]);
    check(std::string("director_") + "xyz"[i], support.director[i]);
  }
  check("value", support.value);
}

/// Velocities and pressure of a flow are fields of its own.
void checkFlowNames(const Value& at, const Physics& entry, const Deck& deck) {
  const auto& flow = std::get<FluidFlow>(entry.law);
  std::vector<std::string> own = flow.velocity;
  own.push_back(flow.pressure);
  for (std::size_t i = 0; i < own.size(); ++i) {
    const Value v = at.at(i + 1 < own.size() ? "velocity" : "pressure");
    checkFieldName(v, own[i], deck);
    bool twice = std::count(own.begin(), own.end(), own[i]) > 1;
    for (const auto& other : deck.physics) {
      const auto* balance = std::get_if<ScalarBalance>(&other.law);
      const bool force = balance != nullptr && i + 1 < own.size() && balance->conductivity == "0" &&
                         balance->capacity.empty();
      twice = twice || (balance != nullptr && balance->field == own[i] && !force);
      const auto* law = std::get_if<PluginLaw>(&other.law);
      twice = twice || (law != nullptr && std::count(law->fields.begin(), law->fields.end(), own[i]) > 0);
    }
    if (twice) {
      v.fail(
          fmt::format("'{}' has a balance already; expected a field of its own for each, and of "
                      "velocities balances with a source alone, a force",
                      own[i]));
    }
  }
}

/// What an entry with a plug-in's law needs, whatever the plug-in says of it.
void checkPluginLaw(const Value& at, const PluginLaw& entry, const Deck& deck) {
  if (deck.plugins.empty()) {
    at.at("law").fail("needs the block plugins, with the name of the plug-in that has it");
  }
  for (const std::string& field : entry.fields) {
    checkFieldName(at.at("fields"), field, deck);
  }
}

void checkPhysics(const Value& root, const Deck& deck) {
  for (const auto& entry : deck.physics) {
    const Value at = root.at("physics").entries().at(entry.name);
    if (const auto* balance = std::get_if<ScalarBalance>(&entry.law)) {
      checkFieldName(at.at("field"), balance->field, deck);
    } else if (const auto* own = std::get_if<PluginLaw>(&entry.law)) {
      checkPluginLaw(at, *own, deck);
    } else {
      checkFlowNames(at, entry, deck);
    }
  }
  for (const auto& entry : deck.physics) {
    const auto* balance = std::get_if<ScalarBalance>(&entry.law);
    if (balance == nullptr) {
      continue;
    }
    const Value at = root.at("physics").entries().at(entry.name);
    if (at.has("conductivity")) {
      checkFormula(at.at("conductivity"), balance->conductivity, deck, physics::Place::body);
    }
    if (at.has("source")) {
      checkFormula(at.at("source"), balance->source, deck, physics::Place::body);
    }
    if (at.has("capacity")) {
      checkFormula(at.at("capacity"), balance->capacity, deck, physics::Place::body);
    }
  }
  for (const auto& material : deck.materials) {
    checkInField(root, material, deck);
  }
  for (const auto& field : deck.fields) {
    const Value at = root.at("fields").entries().at(field.name);
    requireField(at, field.name, deck);
    checkFormula(at.at("initial"), field.initial, deck, physics::Place::reference);
  }
  for (const auto& load : deck.loads) {
    if (const auto* inflow = std::get_if<InflowLoad>(&load.load)) {
      const Value at = root.at("loads").entries().at(load.name);
      requireField(at.at("field"), inflow->field, deck);
      checkWay(at, *inflow, deck);
      checkFormula(at.at("amount"), inflow->amount, deck, placeOf(*inflow));
      if (load.constant) {
        at.at("constant").fail("has no meaning with type: inflow, whose formula says lambda itself");
      }
    }
    if (const auto* moment = std::get_if<MomentLoad>(&load.load)) {
      const Value at = root.at("loads").entries().at(load.name).at("coupling");
      const Coupling& coupling = hingedBody(at, moment->coupling, deck);
      if (coupling.angle) {
        at.fail(fmt::format("coupling '{}' has its angle given; a moment turns a body whose angle is free",
                            coupling.name));
      }
    }
    if (const auto* own = std::get_if<PluginLoad>(&load.load)) {
      const Value at = root.at("loads").entries().at(load.name);
      checkPluginLaw(at, own->law, deck);
      for (const std::string& field : own->law.fields) {
        requireField(at.at("fields"), field, deck);
      }
      if (load.constant) {
        at.at("constant").fail("has no meaning with type: plugin, whose law reads the load factor itself");
      }
    }
  }
  for (const auto& coupling : deck.couplings) {
    for (const EquationTerm& term : coupling.terms) {
      if (term.unknown != "x" && term.unknown != "y" && term.unknown != "z") {
        requireField(root.at("couplings").entries().at(coupling.name).at("terms"), term.unknown, deck);
      }
    }
  }
  for (const auto& support : deck.supports) {
    checkPrescribed(root.at("supports").entries().at(support.name), support, deck);
    if (!support.field.empty()) {
      requireField(root.at("supports").entries().at(support.name).at("field"), support.field, deck);
    }
  }
  if (!scalarFields(deck).empty() && !deck.path.imperfections.empty()) {
    root.at("path")
        .at("imperfections")
        .fail("their shapes are of displacements alone; not with scalar fields");
  }
}

void checkMaterials(const Value& materials, const Deck& deck) {
  std::map<std::string, std::string> materialOf;
  for (const auto& material : deck.materials) {
    for (const auto& block : material.blocks) {
      const auto [previous, isNew] = materialOf.emplace(block, material.name);
      if (!isNew) {
        materials.at(material.name)
            .at("blocks")
            .fail(fmt::format("block '{}' already has the material '{}'", block, previous->second));
      }
    }
  }
}

/// The bulk modulus that a law says; none where it has no such key.
std::optional<double> bulkModulus(const SaintVenantKirchhoff&) { return std::nullopt; }
std::optional<double> bulkModulus(const VonMises&) { return std::nullopt; }
template <class Law>
std::optional<double> bulkModulus(const Law& law) {
  return law.bulkModulus;
}

/// Lame's lambda at rest, its sign at least.
double lambda(const NeoHookean& m) {
  return m.poissonsRatio ? *m.poissonsRatio : m.bulkModulus.value() - 2 * m.shearModulus.value() / 3;
}

/// What pressures as unknowns are for, and what is not there with them.
void checkFormulations(const Value& root, const Deck& deck) {
  for (const auto& material : deck.materials) {
    const Value at = root.at("materials").at(material.name);
    const bool mixed = material.formulation == Material::Formulation::Mixed;
    const auto bulk = std::visit([](const auto& law) { return bulkModulus(law); }, material.law);
    if (bulk && std::isinf(*bulk) && !mixed) {
      at.at("bulk_modulus").fail("infinite needs formulation: mixed");
    }
    if (!mixed) {
      continue;
    }
    const Value formulation = at.at("formulation");
    if (!bulk && !std::holds_alternative<NeoHookean>(material.law)) {
      formulation.fail(
          "is for laws of rubber: this one has no volumetric part that pressures could be of; expected "
          "formulation: displacement");
    }
    if (const auto* law = std::get_if<NeoHookean>(&material.law); law != nullptr && !(lambda(*law) > 0)) {
      formulation.fail(
          "needs Lame's lambda > 0 at rest: poissons_ratio > 0, or bulk_modulus > 2/3 shear_modulus; "
          "expected "
          "formulation: displacement");
    }
    if (deck.plane && deck.plane->kind == Plane::Kind::Stress) {
      formulation.fail("volumes are free in plane stress; expected formulation: displacement");
    }
    if (!deck.path.imperfections.empty()) {
      root.at("path")
          .at("imperfections")
          .fail(fmt::format("their shapes are of displacements alone; expected formulation: displacement in "
                            "materials/{}, or a small constant load",
                            material.name));
    }
  }
}

void checkSections(const Value& root, const Deck& deck) {
  std::map<std::string, std::string> sectionOf;
  for (const auto& section : deck.shells.sections) {
    for (const auto& block : section.blocks) {
      const auto [previous, isNew] = sectionOf.emplace(block, section.name);
      if (!isNew) {
        root.at("shells")
            .at("sections")
            .at(section.name)
            .at("blocks")
            .fail(fmt::format("block '{}' already has the section '{}'", block, previous->second));
      }
    }
  }
}

/// Columns of the tables that have the monitors beside them (PathTable).
const std::vector<std::string> columns{
    "step",       "branch",   "path_length",          "load_factor",     "kind",
    "nullity",    "residual", "negative_eigenvalues", "negative_change", "frequency",
    "uncertainty"};

void checkMonitor(const Value& v, const Monitor& monitor, const Deck& deck) {
  if (std::find(columns.begin(), columns.end(), monitor.name) != columns.end()) {
    v.failKey("is the name of a column of path.csv or points.csv; expected none of " + joined(columns));
  }
  if (const auto* force = std::get_if<ContactForceMonitor>(&monitor.quantity)) {
    find(v.at("contact"), force->contact, deck.contacts, "contact");
  } else if (const auto* area = std::get_if<ContactAreaMonitor>(&monitor.quantity)) {
    find(v.at("contact"), area->contact, deck.contacts, "contact");
  } else if (const auto* pressure = std::get_if<ContactPressureMonitor>(&monitor.quantity)) {
    find(v.at("contact"), pressure->contact, deck.contacts, "contact");
  } else if (const auto* center = std::get_if<ContactCenterMonitor>(&monitor.quantity)) {
    find(v.at("contact"), center->contact, deck.contacts, "contact");
  } else if (const auto* spread = std::get_if<ContactSpreadMonitor>(&monitor.quantity)) {
    find(v.at("contact"), spread->contact, deck.contacts, "contact");
  } else if (const auto* field = std::get_if<FieldMonitor>(&monitor.quantity)) {
    requireField(v.at("field"), field->field, deck);
  } else if (const auto* rotation = std::get_if<RotationMonitor>(&monitor.quantity)) {
    hingedBody(v.at("coupling"), rotation->coupling, deck);
  } else if (const auto* moment = std::get_if<MomentMonitor>(&monitor.quantity)) {
    if (!hingedBody(v.at("coupling"), moment->coupling, deck).angle) {
      v.at("coupling")
          .fail(fmt::format(
              "the body of coupling '{}' turns freely: no moment drives it; expected one with angle",
              moment->coupling));
    }
  } else if (const auto* reaction = std::get_if<ReactionMonitor>(&monitor.quantity)) {
    const auto& support = find(v.at("support"), reaction->support, deck.supports, "supports");
    if (!support.field.empty()) {
      if (v.has("component")) {
        v.at("component")
            .fail(fmt::format("support '{}' holds a field, whose inflow has no components", support.name));
      }
      return;
    }
    if (support.normal) {
      if (v.has("component")) {
        v.at("component")
            .fail(fmt::format("support '{}' holds along its normal alone; its reaction is the force along it",
                              support.name));
      }
      return;
    }
    if (!v.has("component")) {
      v.failMissing("component", "one of x, y, z");
    }
    if (!support.components[static_cast<std::size_t>(*reaction->component)]) {
      v.at("component")
          .fail(fmt::format("support '{}' does not hold {}", support.name, wordOf(*reaction->component)));
    }
  }
}

void checkStop(const Value& stop, const Stop& read, const Deck& deck) {
  for (const auto& [name, values] : read.monitors) {
    const bool older = stop.has("displacement") && stop.at("displacement").has(name);
    const Value v = stop.at(older ? "displacement" : "monitor").at(name);
    const auto& monitor = find(v, name, deck.output.monitors, "output/monitors");
    if (!std::holds_alternative<DisplacementMonitor>(monitor.quantity) &&
        (older || (!std::holds_alternative<FieldMonitor>(monitor.quantity) &&
                   !std::holds_alternative<RotationMonitor>(monitor.quantity)))) {
      v.fail(fmt::format("the monitor '{}' is not of type displacement{}", name,
                         older ? "" : ", rotation or field"));
    }
  }
}

void checkSomethingIsDriven(const Value& root, const Deck& deck) {
  if (drivenOf(deck).empty()) {
    root.fail(
        "nothing depends on the load factor; expected a load that is neither constant nor zero, a support "
        "with "
        "per_load_factor, a contact with a tool that moves, or a formula with lambda");
  }
}

/// A stop at points that nothing looks for would never come.
void checkBifurcationStop(const Value& v, const Deck& deck) {
  if (!deck.path.series()) {
    v.fail(fmt::format("needs path/method: series, the deck has path/method: {}",
                       wordOf(deck.path.method, methods())));
  }
  if (deck.path.criticalPoints == Path::Critical::Off) {
    v.fail("needs path/critical_points: automatic or every_step");
  }
  if (deck.solver.type != Solver::Type::Mumps) {
    v.fail(
        "bifurcation points are found by the number of negative eigenvalues, that needs solver/type: mumps");
  }
}

void checkHopf(const Value& v, const Deck& deck) {
  if (deck.physics.empty()) {
    v.fail("is for fields that have rates, which displacements do not; expected a deck with physics");
  }
  if (deck.path.criticalPoints == Path::Critical::Off) {
    v.fail("needs path/critical_points: automatic or every_step");
  }
  if (deck.solver.type != Solver::Type::Mumps) {
    v.fail("eigenvalues are found by the factored tangent, that needs solver/type: mumps");
  }
}

}  // namespace

void checkBranches(const Value& root, const Deck& deck) {
  if (deck.path.branches != path::Follow::none && deck.solver.type != Solver::Type::Mumps) {
    root.at("path")
        .at("branches")
        .fail("branches are found by the number of negative eigenvalues, which needs solver/type: mumps");
  }
  if (deck.path.branches != path::Follow::none && deck.path.criticalPoints == Path::Critical::Off) {
    root.at("path").at("branches").fail("needs critical_points: automatic or every_step");
  }
  if (deck.path.hopf) {
    checkHopf(root.at("path").at("hopf"), deck);
  }
  if (deck.path.stop.bifurcation) {
    checkBifurcationStop(root.at("path").at("stop").at("bifurcation"), deck);
  }
}

void checkMethod(const Value& root, Deck& deck) {
  if (deck.path.series()) {
    return;
  }
  const std::string has = fmt::format("the deck has path/method: {}", wordOf(deck.path.method, methods()));
  for (const auto& contact : deck.contacts) {
    if (contact.law == Contact::Law::Hard) {
      const Value at = root.at("contact").at(contact.name);
      (at.has("law") ? at.at("law") : at).fail("hard contact needs path/method: series, " + has);
    }
  }
  if (root.has("output") && root.at("output").has("points_per_step") && deck.output.pointsPerStep != 1) {
    root.at("output")
        .at("points_per_step")
        .fail("Newton steps have points at their ends only; expected 1, or path/method: series, " + has);
  }
  deck.output.pointsPerStep = 1;
}

namespace {

/// A released support is there once, and has not gone before.
void checkRelease(const Value& v, const Deck& deck, std::vector<std::string>& gone) {
  for (const std::string& name : v.names()) {
    if (find(v, name, deck.supports, "supports").normal) {
      v.fail(fmt::format("support '{}' holds along a normal, which stays; released are supports along axes",
                         name));
    }
    if (std::find(gone.begin(), gone.end(), name) != gone.end()) {
      v.fail(fmt::format("'{}' has been released by a stage before", name));
    }
    gone.push_back(name);
  }
}

/// What a stage drives has a name of its own and one load factor, which the stages before have left it at.
void checkDriven(const Value& at, const Stage& stage, const Deck& deck,
                 std::map<std::string, int>& lastDrivenBy, int number) {
  const auto all = drivenOf(deck);
  const std::string key = at.has("drives") ? "drives" : "";
  const Value v = key.empty() ? at : at.at(key);
  for (const std::string& name : stage.drives) {
    const auto count =
        std::count_if(all.begin(), all.end(), [&](const Driven& entry) { return entry.name == name; });
    if (count > 1) {
      v.fail(
          fmt::format("'{}' is the name of {} entries that depend on the load factor; expected other names",
                      name, count));
    }
    if (count == 0) {
      const auto names = namesOf(all);
      v.fail(fmt::format("no entry '{}' depends on the load factor{}; those that do are {}", name,
                         suggestion(name, names), joined(names)));
    }
  }
  const Driven* first = nullptr;
  const auto driven = drivenBy(deck, stage);
  const auto stageBefore = [&](const Driven& entry) {
    const auto found = lastDrivenBy.find(fmt::format("{}/{}", static_cast<int>(entry.kind), entry.name));
    return found == lastDrivenBy.end() ? -1 : found->second;
  };
  for (const Driven& entry : driven) {
    if (first != nullptr && stageBefore(entry) != stageBefore(*first)) {
      v.fail(fmt::format(
          "'{}' and '{}' were last driven by different stages, and stand at different load factors; "
          "expected stages that drive one of them each",
          first->name, entry.name));
    }
    first = first == nullptr ? &entry : first;
  }
  for (const Driven& entry : driven) {
    lastDrivenBy[fmt::format("{}/{}", static_cast<int>(entry.kind), entry.name)] = number;
  }
}

/// What stages are not there with, and what each of them needs.
void checkStages(const Value& path, const Deck& deck) {
  const auto refuse = [&](const char* key, bool given, const char* expected) {
    if (given) {
      path.at(key).failKey(std::string("is not for a path in stages") + expected);
    }
  };
  refuse("stop", path.has("stop"), "; expected it in each stage");
  refuse("direction", deck.path.direction != 1, "; expected it in each stage");
  refuse("branches", deck.path.branches != path::Follow::none, "");
  refuse("imperfections", !deck.path.imperfections.empty(), "");
  refuse("sharpen", deck.path.sharpen.has_value(), "");
  if (!deck.plugins.empty()) {
    path.at("stages").failKey("are not for decks with plug-ins, whose laws have one load factor");
  }
  std::map<std::string, int> lastDrivenBy;
  std::vector<std::string> gone;
  const auto entries = path.at("stages").entries().children();
  for (std::size_t s = 0; s < entries.size(); ++s) {
    const Value& at = entries[s];
    const Stage& stage = deck.path.stages[s];
    if (at.has("release") && at.has("drives")) {
      at.at("drives").failKey("stands beside release; expected one of them");
    }
    if (at.has("release")) {
      checkRelease(at.at("release"), deck, gone);
    } else if (!at.has("stop")) {
      at.failMissing("stop", "a map with load_factor or another way to end");
    } else {
      checkDriven(at, stage, deck, lastDrivenBy, static_cast<int>(s));
    }
    if (at.has("stop")) {
      checkStop(at.at("stop"), stage.stop, deck);
      if (stage.stop.bifurcation) {
        checkBifurcationStop(at.at("stop").at("bifurcation"), deck);
      }
    }
  }
}

void checkSolver(const Value& root, const Deck& deck) {
  if (!deck.solver.mayIterate()) return;
  for (const auto& contact : deck.contacts)
    if (contact.law == Contact::Law::Hard)
      root.at("solver").fail("iterations do not converge on the tangents of hard contact (contact/" +
                             contact.name + "); expected mumps");
}

}  // namespace

void checkReferences(const Value& root, const Deck& deck) {
  if (!deck.materials.empty()) {
    checkMaterials(root.at("materials"), deck);
    checkFormulations(root, deck);
  }
  checkPhysics(root, deck);
  checkSections(root, deck);
  if (root.has("contact")) {
    for (const Value& contact : root.at("contact").entries().children()) {
      find(contact.at("tool"), contact.at("tool").name(), deck.tools, "tools");
    }
  }
  if (!deck.output.monitors.empty()) {
    const auto monitors = root.at("output").at("monitors").entries().children();
    for (std::size_t i = 0; i < monitors.size(); ++i) {
      checkMonitor(monitors[i], deck.output.monitors[i], deck);
    }
  }
  const Value path = root.at("path");
  if (path.has("stop")) {
    checkStop(path.at("stop"), deck.path.stop, deck);
  }
  checkBranches(root, deck);
  checkSolver(root, deck);
  if (deck.path.sharpen) {
    const auto hasEta = [](const Contact& c) {
      const bool open = c.law == Contact::Law::Auto && c.points != Contact::Points::Zones;
      return (open || c.law == Contact::Law::Hyperbola || c.law == Contact::Law::Barrier) &&
             c.unknown == Contact::Unknown::Displacement;
    };
    if (deck.contacts.empty() || !std::all_of(deck.contacts.begin(), deck.contacts.end(), hasEta)) {
      root.at("path").at("sharpen").fail(
          "needs contacts with the law hyperbola or barrier and unknown: displacement");
    }
  }
  const auto& fields = deck.output.fields;
  if (deck.contacts.empty() &&
      std::find(fields.begin(), fields.end(), OutputField::Contact) != fields.end()) {
    root.at("output").at("fields").fail("'contact' needs the block contact");
  }
  for (const auto field : fields) {
    const bool scalar = field == OutputField::Field;
    if (scalar ? scalarFields(deck).empty() : deck.materials.empty()) {
      root.at("output").at("fields").fail(fmt::format("'{}' needs the block {}",
                                                      wordOf(field, outputFields()),
                                                      scalar ? "physics, or a dielectric" : "materials"));
    }
  }
  checkSomethingIsDriven(root, deck);
  if (path.has("stages")) {
    checkStages(path, deck);
  }
}

}  // namespace atrapos::deck
