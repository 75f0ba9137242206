// Keys of the block `plane`.
#include "deck/DeckTables.hpp"

namespace atrapos::deck {
namespace {

const Choices<Plane::Kind>& kinds() {
  static const Choices<Plane::Kind> choices{{"strain", Plane::Kind::Strain},
                                            {"stress", Plane::Kind::Stress},
                                            {"axisymmetric", Plane::Kind::Axisymmetric}};
  return choices;
}

}  // namespace

const Table<Plane>& planeTable() {
  static const Table<Plane> table{
      choice("kind", required, &Plane::kind, kinds(),
             "plane strain, plane stress, or a body about the y axis with x as radius"),
      real("thickness", &Plane::thickness, check::positive,
           "of the body, 1 where it is not given; not for kind: axisymmetric")};
  return table;
}

Field<Deck> planeField() {
  return {"plane",
          false,
          "a map with kind, thickness",
          "the body that a plane mesh stands for",
          [](const Value& v, Deck& deck) {
            Plane plane;
            read(planeTable(), v, plane);
            if (plane.kind == Plane::Kind::Axisymmetric && plane.thickness) {
              v.at("thickness").fail("is not for kind: axisymmetric");
            }
            deck.plane = plane;
          },
          [](const Deck& deck) { return deck.plane ? print(planeTable(), *deck.plane) : Node{}; }};
}

}  // namespace atrapos::deck
