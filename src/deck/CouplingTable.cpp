// Keys of the entries of `couplings`.
#include "deck/DeckTables.hpp"

namespace atrapos::deck {

const Table<Coupling>& couplingTable() {
  using Kind = Coupling::Kind;
  static const Choices<Kind> kinds{{"plane", Kind::Plane},
                                   {"rigid", Kind::Rigid},
                                   {"equal", Kind::Equal},
                                   {"shell_on_solid", Kind::ShellOnSolid}};
  static const Field<Coupling> normal{"normal",
                                      false,
                                      "a list of 3 numbers, not all zero",
                                      "of a plane: the nodes keep one displacement along it",
                                      [](const Value& v, Coupling& c) {
                                        const auto x = v.reals(3);
                                        c.normal = Vector3{x[0], x[1], x[2]};
                                        if (x[0] == 0 && x[1] == 0 && x[2] == 0) {
                                          v.fail("must not be the zero vector");
                                        }
                                      },
                                      [](const Coupling& c) {
                                        return c.normal ? Node{yamlList(*c.normal), {}} : Node{};
                                      }};
  static const Table<Coupling> table{
      choice("kind", required, &Coupling::kind, kinds, "what the nodes keep to"),
      name("set", required, &Coupling::set, "a node set or side set, name or id", "nodes that move together"),
      normal,
      name("reference", optional, &Coupling::reference, "a node set of one node, name or id",
           "of a rigid body: a point of it, where supports and loads may be; no cell need have it")};
  return table;
}

}  // namespace atrapos::deck
