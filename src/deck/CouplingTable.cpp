// Keys of the entries of `couplings`.
#include "deck/DeckTables.hpp"

namespace atrapos::deck {

const Table<Coupling>& couplingTable() {
  using Kind = Coupling::Kind;
  static const Choices<Kind> kinds{{"plane", Kind::Plane},
                                   {"rigid", Kind::Rigid},
                                   {"equal", Kind::Equal},
                                   {"shell_on_solid", Kind::ShellOnSolid},
                                   {"tie", Kind::Tie}};
  const auto direction = [](std::string key, std::optional<Vector3> Coupling::*member, std::string meaning) {
    return Field<Coupling>{std::move(key),
                           false,
                           "a list of 3 numbers, not all zero",
                           std::move(meaning),
                           [=](const Value& v, Coupling& c) {
                             const auto x = v.reals(3);
                             c.*member = Vector3{x[0], x[1], x[2]};
                             if (x[0] == 0 && x[1] == 0 && x[2] == 0) {
                               v.fail("must not be the zero vector");
                             }
                           },
                           [=](const Coupling& c) {
                             return c.*member ? Node{yamlList(*(c.*member)), {}} : Node{};
                           }};
  };
  static const Field<Coupling> angle{
      "angle",
      false,
      "a number, or a map with value, per_load_factor",
      "degrees by which a rigid body turns about its axis; without: freely",
      [](const Value& v, Coupling& c) {
        c.angle = prescribed(v);
        if (!c.angle->valueFormula.empty() || !c.angle->perLoadFactorFormula.empty()) {
          v.fail("a body has one angle; expected a number, or a map with value, per_load_factor");
        }
      },
      [](const Coupling& c) { return c.angle ? printed(*c.angle) : Node{}; }};
  static const Table<Coupling> table{
      choice("kind", required, &Coupling::kind, kinds, "what the nodes keep to"),
      name("set", required, &Coupling::set, "a node set or side set, name or id", "nodes that move together"),
      direction("normal", &Coupling::normal, "of a plane: the nodes keep one displacement along it"),
      name("reference", optional, &Coupling::reference, "a node set of one node, name or id",
           "of a rigid body: a point of it, where supports and loads may be; no cell need have it"),
      direction("axis", &Coupling::axis, "of a rigid body: it turns about this direction alone"),
      angle,
      name("to", optional, &Coupling::to, "a side set, name or id", "of a tie: the surface that leads"),
      real("reach", &Coupling::reach, check::positive,
           "of a tie: how far apart the surfaces may be, as a share of the size of their faces")};
  return table;
}

}  // namespace atrapos::deck
