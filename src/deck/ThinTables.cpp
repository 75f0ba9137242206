// Keys of the blocks `membranes` and `bars`.
#include "deck/DeckTables.hpp"

namespace atrapos::deck {
namespace {

Field<ThinSection> prestress() {
  auto field = real("prestress", optional, &ThinSection::prestress, check::any,
                    "second Piola-Kirchhoff stress at rest, tension positive");
  field.print = [inner = field.print](const ThinSection& s) { return s.prestress == 0 ? Node{} : inner(s); };
  return field;
}

}  // namespace

const Table<ThinSection>& membraneTable() {
  static const Table<ThinSection> table{
      names("blocks", required, &ThinSection::blocks, "blocks of the mesh with surfaces in space"),
      real("thickness", required, &ThinSection::size, check::positive, "of the membranes"), prestress()};
  return table;
}

const Table<ThinSection>& barTable() {
  static const Table<ThinSection> table{
      names("blocks", required, &ThinSection::blocks, "blocks of the mesh with bars"),
      real("area", required, &ThinSection::size, check::positive, "of the cross-section"), prestress()};
  return table;
}

}  // namespace atrapos::deck
