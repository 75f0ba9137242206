// Keys of the entries of `couplings`.
#include "deck/DeckTables.hpp"

namespace atrapos::deck {

const Table<Coupling>& couplingTable() {
  using Kind = Coupling::Kind;
  static const Choices<Kind> kinds{{"plane", Kind::Plane}, {"rigid", Kind::Rigid},
                                   {"equal", Kind::Equal}, {"shell_on_solid", Kind::ShellOnSolid},
                                   {"tie", Kind::Tie},     {"equation", Kind::Equation}};
  constexpr const char* termsText = "a list of at least two lists of a set, x, y, z or a field, and a factor";
  static const Field<Coupling> terms{
      "terms",
      false,
      termsText,
      "of an equation: factors times unknowns, whose sum is 0; the first follows",
      [](const Value& v, Coupling& c) {
        for (const Value& row : v.list(termsText)) {
          const std::vector<Value> term = row.list(termsText);
          if (term.size() != 3) {
            row.fail("expected a set, x, y, z or a field, and a factor");
          }
          c.terms.push_back({term[0].name(), term[1].text(), term[2].real(check::nonzero)});
        }
        if (c.terms.size() < 2) {
          v.fail(std::string("expected ") + termsText);
        }
      },
      [](const Coupling& c) {
        std::string rows;
        for (const EquationTerm& term : c.terms) {
          rows += fmt::format("{}[{}, {}, {}]", rows.empty() ? "" : ", ", yaml(term.set), yaml(term.unknown),
                              yaml(term.factor));
        }
        return rows.empty() ? Node{} : Node{"[" + rows + "]", {}};
      }};
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
      name("set", optional, &Coupling::set, "a node set or side set, name or id",
           "nodes that move together; required but for an equation"),
      terms,
      direction<Coupling>("normal", &Coupling::normal,
                          "of a plane: the nodes keep one displacement along it"),
      name("reference", optional, &Coupling::reference, "a node set of one node, name or id",
           "of a rigid body: a point of it, where supports and loads may be; no cell need have it"),
      direction<Coupling>("axis", &Coupling::axis, "of a rigid body: it turns about this direction alone"),
      angle,
      name("to", optional, &Coupling::to, "a side set, name or id", "of a tie: the surface that leads"),
      real("reach", &Coupling::reach, check::positive,
           "of a tie: how far apart the surfaces may be, as a share of the size of their faces")};
  return table;
}

}  // namespace atrapos::deck
