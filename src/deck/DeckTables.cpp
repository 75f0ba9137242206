// Keys of the whole deck and of its named entries.
#include "deck/DeckTables.hpp"

#include "deck/Entries.hpp"

namespace atrapos::deck {
namespace {

Field<Output> outputFieldList() {
  const auto& choices = outputFields();
  return {"fields",
          false,
          "a list of " + joined(wordsOf(choices)),
          "what the result file holds besides the path",
          [&choices](const Value& v, Output& s) {
            for (const auto& word : v.texts()) {
              const auto field = choose(v, word, choices);
              if (std::find(s.fields.begin(), s.fields.end(), field) != s.fields.end()) {
                v.fail(fmt::format("'{}' is given twice", word));
              }
              s.fields.push_back(field);
            }
          },
          [&choices](const Output& s) {
            std::vector<std::string> words;
            for (const auto field : s.fields) {
              words.push_back(wordOf(field, choices));
            }
            return Node{yamlList(words), {}};
          }};
}

/// Printed only where it is not the default: most meshes have no shells.
Field<Output> outputShells() {
  using Shells = Output::Shells;
  static const Choices<Shells> choices{{"surface", Shells::Surface}, {"body", Shells::Body}};
  auto field = choice("shells", optional, &Output::shells, choices,
                      "shells in the result file: their middle surfaces, or solids with their thickness");
  field.print = [inner = field.print](const Output& s) {
    return s.shells == Shells::Surface ? Node{} : inner(s);
  };
  return field;
}

}  // namespace

Table<Output> pathRowKeys() {
  using Residuals = Output::Residuals;
  static const Choices<Residuals> residuals{{"steps", Residuals::Steps}, {"points", Residuals::Points}};
  return {integer("points_per_step", optional, &Output::pointsPerStep, check::rows,
                  "rows of path.csv per step, its end included"),
          choice("residuals", optional, &Output::residuals, residuals,
                 "rows of path.csv with the path's residual: at the ends of steps, or all")};
}

const Table<Output>& outputTable() {
  static const Table<Output> table = [] {
    Table<Output> keys = pathRowKeys();
    keys.insert(keys.end(),
                {outputFieldList(),
                 integer("fields_every", optional, &Output::fieldsEvery, check::count,
                         "steps from one state in the result file to the next"),
                 outputShells(), flag("parts", &Output::parts, "on several ranks, a result file for each"),
                 entries("monitors", optional, &Output::monitors, monitorVariants(), "each with type, ...",
                         "numbers followed along the path")});
    return keys;
  }();
  return table;
}

/// Also a type alone, as in `solver: auto`.
Field<Deck> solverField() {
  auto solver = block("solver", optional, &Deck::solver, solverTable(), "factors the tangent");
  solver.read = [inner = solver.read](const Value& v, Deck& deck) {
    if (v.isText())
      solverTable().front().read(v, deck.solver);
    else
      inner(v, deck);
    if (deck.solver.type == Solver::Type::Amesos2 && deck.solver.name.empty()) {
      v.failMissing("name", "Amesos2's name of a solver, for example klu2");
    }
  };
  return solver;
}

const Table<Deck>& deckTable() {
  static const Table<Deck> table = [] {
    auto title = text("title", optional, &Deck::title, "a text", "of the result file");
    auto materials =
        entries("materials", required, &Deck::materials, materialVariants(), "each with law, blocks, ...",
                "what the blocks are made of; with physics of those that deform");
    materials.unless = "physics";
    auto supports = entries("supports", required, &Deck::supports, supportTable(),
                            "each with set and any of condition, x, y, z, director_x, director_y, "
                            "director_z, or normal, or field and value",
                            "prescribed displacements, or values of a field");
    supports.unless = "physics";
    supports.read = [inner = supports.read](const Value& v, Deck& deck) {
      inner(v, deck);
      for (const auto& s : deck.supports) {
        const auto given = [](const auto& component) { return component.has_value(); };
        const bool moves = std::any_of(s.components.begin(), s.components.end(), given) ||
                           std::any_of(s.director.begin(), s.director.end(), given);
        const Value support = v.entries().at(s.name);
        if (!s.field.empty() && moves) {
          support.at("field").fail("stands beside displacements; expected a support of its own");
        }
        if (!s.field.empty() && !s.value) {
          support.failMissing("value", "what the field is held at");
        }
        if (s.normal && (moves || !s.field.empty())) {
          support.at("normal").fail("stands beside what else is held; expected a support of its own");
        }
        const bool symmetry = s.condition == Support::Condition::Symmetry;
        if (symmetry && !s.normal) {
          support.failMissing("normal", "that of the plane of symmetry, a list of 3 numbers, not all zero");
        }
        if (symmetry && s.value) {
          support.at("value").fail("stands beside condition: symmetry, which holds at 0");
        }
        if (s.field.empty() && !s.normal && s.value) {
          support.failMissing("field", "the name of the field with this value, or normal, a direction");
        }
        if (s.field.empty() && !s.normal && !moves) {
          support.fail(
              "holds nothing; expected at least one of x, y, z, condition, director_x, director_y, "
              "director_z, or normal, or field and value");
        }
      }
    };
    auto couplings = entries("couplings", optional, &Deck::couplings, couplingTable(),
                             "each with kind, set, ...", "nodes that move together");
    couplings.read = [inner = couplings.read](const Value& v, Deck& deck) {
      inner(v, deck);
      for (const auto& c : deck.couplings) {
        using Kind = Coupling::Kind;
        const Value entry = v.at(c.name);
        const auto needed = [&](const char* key, bool given, Kind kind, const char* accepts) {
          if (c.kind == kind && !given) entry.failMissing(key, accepts);
        };
        const auto only = [&](const char* key, bool given, Kind kind, const char* word) {
          if (c.kind != kind && given) entry.at(key).fail(fmt::format("is for kind: {} alone", word));
        };
        needed("terms", !c.terms.empty(), Kind::Equation,
               "a list of at least two lists of a set, x, y, z or a field, and a factor");
        only("terms", !c.terms.empty(), Kind::Equation, "equation");
        if (c.kind != Kind::Equation && c.set.empty()) {
          entry.failMissing("set", "a node set or side set, name or id");
        }
        if (c.kind == Kind::Equation && !c.set.empty()) {
          entry.at("set").fail("is not for kind: equation, whose terms have sets");
        }
        needed("normal", c.normal.has_value(), Kind::Plane,
               "the plane's normal, a list of 3 numbers, not all zero");
        only("normal", c.normal.has_value(), Kind::Plane, "plane");
        only("reference", !c.reference.empty(), Kind::Rigid, "rigid");
        only("axis", c.axis.has_value(), Kind::Rigid, "rigid");
        if (c.angle && !c.axis) {
          entry.failMissing("axis", "the direction that the angle is about, a list of 3 numbers");
        }
        needed("to", !c.to.empty(), Kind::Tie, "the side set of the surface that leads");
        only("to", !c.to.empty(), Kind::Tie, "tie");
        only("reach", c.reach.has_value(), Kind::Tie, "tie");
      }
    };
    auto shells =
        block("shells", optional, &Deck::shells, shellsTable(), "thickness, folds and joints of shells");
    shells.print = [inner = shells.print](const Deck& deck) {
      const Shells& s = deck.shells;
      const bool plain = s.sections.empty() && s.joints.empty() && s.foldAngle == Shells{}.foldAngle &&
                         s.shear == Shells{}.shear && s.metalPoints == Shells{}.metalPoints;
      return plain ? Node{} : inner(deck);
    };
    return Table<Deck>{
        title,
        block("mesh", required, &Deck::mesh, meshTable(), "the body's mesh"),
        pluginsField(),
        constantsField(),
        materials,
        entries("physics", optional, &Deck::physics, physicsVariants(), "each with type, blocks, ...",
                "balances of scalar fields: heat, current, reaction and diffusion"),
        entries("fields", optional, &Deck::fields, scalarFieldTable(), "each with initial",
                "where the fields of physics begin; 0 without an entry"),
        planeField(),
        shells,
        entries("membranes", optional, &Deck::membranes, membraneTable(),
                "each with blocks, thickness, prestress", "surfaces in space that do not bend"),
        entries("bars", optional, &Deck::bars, barTable(), "each with blocks, area, prestress",
                "of trusses: lines in space that carry forces along themselves"),
        supports,
        couplings,
        entries("loads", optional, &Deck::loads, loadVariants(), "each with type, ...",
                "dead loads, multiplied by the load factor"),
        entries("tools", optional, &Deck::tools, toolVariants(), "each with type, ...", "rigid surfaces"),
        entries("contact", optional, &Deck::contacts, contactTable(), "each with tool, set, stiffness, ...",
                "which part of the body may touch which tool"),
        block("path", required, &Deck::path, pathTable(), "how to follow the path and where to end"),
        solverField(),
        block("output", optional, &Deck::output, outputTable(), "what to write")};
  }();
  return table;
}

}  // namespace atrapos::deck
