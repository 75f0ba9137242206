#pragma once

#include "atrapos/physics/Formulas.hpp"
#include "deck/Deck.hpp"
#include "deck/Fields.hpp"
#include "deck/Variants.hpp"

namespace atrapos::deck {

/// Generate as a member, so that it can be read like any other block with kinds.
struct GenerateInput {
  Generate shape;
};

// The keys of every block of a deck. Alternatives stand in the order of the std::variant they fill.
const Variants<GenerateInput, Generate>& generateVariants();
const Variants<Material, decltype(Material::law)>& materialVariants();
const Table<Shells>& shellsTable();
const Table<Plane>& planeTable();
/// The block `plane`, which a deck may not have.
Field<Deck> planeField();
const Table<ShellSection>& shellSectionTable();
const Table<ShellJoint>& shellJointTable();
const Table<ThinSection>& membraneTable();
const Table<ThinSection>& barTable();
/// What names of fields and constants are like; follows "cannot be the name of a ...".
constexpr const char* freeNames =
    "expected letters, digits and _, no digit in front, and none of lambda, x, y, z, zeta, contact_pressure, "
    "contact_gap, pi and the functions";
/// The block `constants`, which a deck may not have.
Field<Deck> constantsField();
const Table<ScalarField>& scalarFieldTable();
const Variants<Physics, decltype(Physics::law)>& physicsVariants();
const Table<ElectricField>& dielectricTable();
/// The keys `expansion` and `dielectric` of materials.
Field<Material> expansionField();
Field<Material> dielectricField();
/// Where the formula of an inflow stands.
inline physics::Place placeOf(const InflowLoad& inflow) {
  return inflow.contact.empty() ? physics::Place::surface : physics::Place::contact;
}
/// The load of type inflow.
Alternative<decltype(Load::load)> inflowAlternative();
Alternative<decltype(Load::load)> pluginLoadAlternative();
Field<Deck> pluginsField();
const Table<Support>& supportTable();
/// A vector of any length but 0.
template <class S>
Field<S> direction(std::string key, std::optional<Vector3> S::*member, std::string meaning) {
  return {std::move(key),
          false,
          "a list of 3 numbers, not all zero",
          std::move(meaning),
          [=](const Value& v, S& s) {
            const auto x = v.reals(3);
            s.*member = Vector3{x[0], x[1], x[2]};
            if (x[0] == 0 && x[1] == 0 && x[2] == 0) {
              v.fail("must not be the zero vector");
            }
          },
          [=](const S& s) {
            return s.*member ? Node{yamlList(*(s.*member)), {}} : Node{};
          }};
}
const Table<Coupling>& couplingTable();
/// A number, a formula of x, y, z or a map with value and per_load_factor.
Prescribed prescribed(const Value& v);
Node printed(const Prescribed& p);
const Variants<Load, decltype(Load::load)>& loadVariants();
const Variants<Tool, decltype(Tool::surface)>& toolVariants();
const Table<ToolMotion>& motionTable();
const Table<SplineSurface>& splineSurfaceTable();
const Table<Contact>& contactTable();
const Table<Stop>& stopTable();
const Table<Stage>& stageTable();
const Table<Path>& pathTable();
/// The same for model problems, which bring stops of their own.
const Table<Path>& modelPathTable();
const Table<Solver>& solverTable();
const Variants<Monitor, decltype(Monitor::quantity)>& monitorVariants();
const Table<Output>& outputTable();
/// Keys of output in both kinds of decks.
Table<Output> pathRowKeys();
const Table<MeshInput>& meshTable();
const Table<fem::TrussOptions>& trussTable();
const Table<Deck>& deckTable();
const Table<ModelProblem>& modelTable();
/// The keys of decks with a model problem.
const Table<Deck>& problemDeckTable();
/// The block solver of both kinds of decks.
Field<Deck> solverField();

/// Where in a shell's thickness, with their words.
const Choices<ShellPlace>& shellPlaces();

/// How paths are followed, with their words.
const Choices<Path::Method>& methods();

/// Uses of Pade forms, with their words.
const Choices<path::PadeUse>& padeUses();

/// The output fields with their words, in the order that messages give them.
const Choices<OutputField>& outputFields();
std::string wordOf(Component component);

}  // namespace atrapos::deck
