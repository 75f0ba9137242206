// Keys of the block `shells`.
#include "deck/DeckTables.hpp"
#include "deck/Entries.hpp"

namespace atrapos::deck {

const Choices<ShellPlace>& shellPlaces() {
  static const Choices<ShellPlace> choices{
      {"top", ShellPlace::Top}, {"middle", ShellPlace::Middle}, {"bottom", ShellPlace::Bottom}};
  return choices;
}

namespace {

const Choices<Shear>& shears() {
  static const Choices<Shear> choices{{"compatible", Shear::Compatible}, {"assumed", Shear::Assumed}};
  return choices;
}

/// A section's own choice, where it has one.
Field<ShellSection> sectionShear() {
  const std::string accepts = "one of " + joined(wordsOf(shears()));
  return {"shear",
          false,
          accepts,
          "transverse shear strains of these blocks",
          [=](const Value& v, ShellSection& s) {
            if (!v.isText()) {
              v.fail(fmt::format("expected {}, got {}", accepts, v.shown()));
            }
            s.shear = choose(v, v.text(), shears());
          },
          [](const ShellSection& s) {
            return s.shear ? Node{wordOf(*s.shear, shears()), {}} : Node{};
          }};
}

}  // namespace

const Table<ShellSection>& shellSectionTable() {
  static const Table<ShellSection> table{
      names("blocks", required, &ShellSection::blocks, "blocks of the mesh with shells"),
      {"thickness", false, "a positive number or attribute",
       "of the shells; attribute: the blocks' own, by element or by node",
       [](const Value& v, ShellSection& s) {
         if (v.isText() && v.text() == "attribute") {
           s.thickness.reset();
         } else if (v.isText()) {
           v.fail(fmt::format("expected a positive number or attribute, got {}", v.shown()));
         } else {
           s.thickness = v.real(check::positive);
         }
       },
       [](const ShellSection& s) {
         return Node{s.thickness ? yaml(*s.thickness) : "attribute", {}};
       }},
      sectionShear()};
  return table;
}

const Table<ShellJoint>& shellJointTable() {
  using Kind = ShellJoint::Kind;
  static const Choices<Kind> kinds{{"rigid", Kind::Rigid}, {"hinge", Kind::Hinge}};
  static const Table<ShellJoint> table{
      name("set", required, &ShellJoint::set, "a node set or side set, name or id",
           "nodes where shells meet"),
      choice("joint", required, &ShellJoint::kind, kinds,
             "rigid: angles between the shells stay and moments pass; hinge: they share the displacement "
             "alone")};
  return table;
}

const Table<Shells>& shellsTable() {
  static const Table<Shells> table = [] {
    auto angle = real("fold_angle", optional, &Shells::foldAngle, check::positive,
                      "degrees, below 180: faces at a node share a director up to this angle; beyond it they "
                      "meet in a joint");
    angle.read = [inner = angle.read](const Value& v, Shells& s) {
      inner(v, s);
      if (s.foldAngle >= 180) {
        v.fail(fmt::format("must be below 180 degrees, got {}", v.shown()));
      }
    };
    return Table<Shells>{angle,
                         entries("joints", optional, &Shells::joints, shellJointTable(),
                                 "each with set, joint", "joints of shells that are not rigid"),
                         choice("shear", optional, &Shells::shear, shears(),
                                "transverse shear strains; assumed: for thin plates with clamped edges or "
                                "skew corners"),
                         integer("thickness_points", optional, &Shells::metalPoints, check::throughThickness,
                                 "points through the thickness where the material yields"),
                         entries("sections", optional, &Shells::sections, shellSectionTable(),
                                 "each with blocks, thickness, shear", "thickness of the shells")};
  }();
  return table;
}

}  // namespace atrapos::deck
