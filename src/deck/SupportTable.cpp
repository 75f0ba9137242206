// Keys of the entries of `supports`.
#include "deck/DeckTables.hpp"

namespace atrapos::deck {
namespace {

using Condition = Support::Condition;
using Components = std::array<std::optional<Prescribed>, 3> Support::*;

const Choices<Condition>& conditions() {
  static const Choices<Condition> choices{
      {"clamped", Condition::Clamped},      {"hinged", Condition::Hinged},
      {"symmetry_x", Condition::SymmetryX}, {"symmetry_y", Condition::SymmetryY},
      {"symmetry_z", Condition::SymmetryZ}, {"symmetry", Condition::Symmetry}};
  return choices;
}

Field<Support> conditionField() {
  const std::string accepts = "one of " + joined(wordsOf(conditions()));
  return {"condition",
          false,
          accepts,
          "what is held at zero, of shells in displacement and director",
          [](const Value& v, Support& s) {
            s.condition = choose(v, v.text(), conditions());
            for (std::size_t axis = 0; axis < 3; ++axis) {
              if (holds(s.condition, axis, false)) {
                s.components[axis] = Prescribed{};
              }
              if (holds(s.condition, axis, true)) {
                s.director[axis] = Prescribed{};
              }
            }
          },
          [](const Support& s) {
            return Node{wordOf(s.condition, conditions()), {}};
          }};
}

/// A number, or a formula of x, y, z and constants.
Field<Prescribed> numberOrFormula(std::string key, double Prescribed::*number, std::string Prescribed::*text,
                                  std::string meaning) {
  return {std::move(key),
          false,
          "a number or a formula of x, y, z",
          std::move(meaning),
          [=](const Value& v, Prescribed& p) {
            if (v.isText()) {
              p.*text = v.text();
            } else {
              p.*number = v.real();
            }
          },
          [=](const Prescribed& p) {
            if (!(p.*text).empty()) {
              return Node{yaml(p.*text), {}};
            }
            return Node{yaml(p.*number), {}};
          }};
}

const Table<Prescribed>& prescribedTable() {
  static const Table<Prescribed> table{
      numberOrFormula("value", &Prescribed::value, &Prescribed::valueFormula, "at load factor 0"),
      numberOrFormula("per_load_factor", &Prescribed::perLoadFactor, &Prescribed::perLoadFactorFormula,
                      "added times the load factor")};
  return table;
}

constexpr const char* prescribedText =
    "a number or a formula of x, y, z, or a map with value, per_load_factor";

Field<Support> fieldValue() {
  return {"value",
          false,
          prescribedText,
          "what the field, or the displacement along the normal, is held at",
          [](const Value& v, Support& s) { s.value = prescribed(v); },
          [](const Support& s) { return s.value ? printed(*s.value) : Node{}; }};
}

/// x, y or z of the displacement or the director: a number, or a map with value and per_load_factor.
Field<Support> component(std::size_t axis, bool director) {
  const Components components = director ? &Support::director : &Support::components;
  const std::string letter(1, "xyz"[axis]);
  return {director ? "director_" + letter : letter,
          false,
          prescribedText,
          director
              ? "prescribed displacement along " + letter + " of the directors of shells, top against middle"
              : "prescribed displacement along " + letter,
          [=](const Value& v, Support& s) {
            if (holds(s.condition, axis, director)) {
              v.fail(fmt::format("is held by condition: {} already", wordOf(s.condition, conditions())));
            }
            (s.*components)[axis] = prescribed(v);
          },
          [=](const Support& s) {
            if (!(s.*components)[axis] || holds(s.condition, axis, director)) {
              return Node{};
            }
            return printed(*(s.*components)[axis]);
          }};
}

}  // namespace

Prescribed prescribed(const Value& v) {
  Prescribed p;
  if (v.isMap() && !v.isEmptyMap()) {
    read(prescribedTable(), v, p);
  } else if (v.isText()) {
    p.valueFormula = v.text();
  } else {
    p.value = v.real();
  }
  return p;
}

Node printed(const Prescribed& p) {
  const bool plain = !p.driven() && p.valueFormula.empty();
  return plain ? Node{yaml(p.value), {}} : print(prescribedTable(), p);
}

bool holds(Support::Condition condition, std::size_t axis, bool director) {
  switch (condition) {
    case Support::Condition::None:
    case Support::Condition::Symmetry:
      return false;
    case Support::Condition::Clamped:
      return true;
    case Support::Condition::Hinged:
      return !director;
    case Support::Condition::SymmetryX:
      return axis == 0;
    case Support::Condition::SymmetryY:
      return axis == 1;
    case Support::Condition::SymmetryZ:
      return axis == 2;
  }
  return false;
}

const Table<Support>& supportTable() {
  static const Table<Support> table{
      name("set", required, &Support::set, "a node set or side set, name or id", "nodes that are held"),
      conditionField(),
      component(0, false),
      component(1, false),
      component(2, false),
      component(0, true),
      component(1, true),
      component(2, true),
      direction<Support>("normal", &Support::normal,
                         "in place of x, y, z: what is held is the displacement along it"),
      name("field", optional, &Support::field, "the name of a field",
           "a scalar field that is held here in place of displacements"),
      fieldValue()};
  return table;
}

}  // namespace atrapos::deck
