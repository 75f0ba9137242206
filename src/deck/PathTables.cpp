// Keys of the blocks that say how to go along the path and what to write: path, solver, output.
#include <set>

#include "deck/DeckTables.hpp"

namespace atrapos::deck {
namespace {

const Choices<Component>& allComponents() {
  static const Choices<Component> choices{
      {"x", Component::X}, {"y", Component::Y}, {"z", Component::Z}, {"normal", Component::Normal}};
  return choices;
}

const Choices<Component>& axes() {
  static const Choices<Component> choices{{"x", Component::X}, {"y", Component::Y}, {"z", Component::Z}};
  return choices;
}

Field<ContactForceMonitor> nearestPoint() {
  return {"near",
          false,
          "a list of 3 numbers",
          "only the point nearest to this place of the undeformed body",
          [](const Value& v, ContactForceMonitor& s) {
            if (s.component != Component::Normal) {
              v.fail("has a meaning with component: normal only");
            }
            const auto x = v.reals(3);
            s.near = Vector3{x[0], x[1], x[2]};
          },
          [](const ContactForceMonitor& s) {
            return s.near ? Node{yamlList(*s.near), {}} : Node{};
          }};
}

Field<Stop> stopDisplacement() {
  return {"displacement",
          false,
          "a map of displacement monitors' names to values",
          "ends where a monitor takes its value",
          [](const Value& v, Stop& s) {
            for (const auto& monitor : v.keys()) {
              s.displacement[monitor] = v.at(monitor).real();
            }
          },
          [](const Stop& s) {
            Node node;
            for (const auto& [monitor, value] : s.displacement) {
              node.children.emplace_back(monitor, Node{yaml(value), {}});
            }
            return node;
          }};
}

}  // namespace

const Choices<OutputField>& outputFields() {
  static const Choices<OutputField> choices{{"displacement", OutputField::Displacement},
                                            {"stress", OutputField::Stress},
                                            {"nodal_stress", OutputField::NodalStress},
                                            {"contact", OutputField::Contact},
                                            {"reaction", OutputField::Reaction}};
  return choices;
}
std::string wordOf(Component component) { return wordOf(component, allComponents()); }

const Table<Stop>& stopTable() {
  static const Table<Stop> table{
      real("load_factor", &Stop::loadFactor, check::nonzero, "ends where the load factor takes this value"),
      integer("steps", optional, &Stop::steps, check::count, "largest number of steps"),
      real("path_length", &Stop::pathLength, check::positive, "ends at this length of the path"),
      stopDisplacement()};
  return table;
}

const Table<Path>& pathTable() {
  static const Table<Path> table = [] {
    auto stop =
        block("stop", required, &Path::stop, stopTable(), "where the path ends: whichever comes first");
    stop.read = [inner = stop.read](const Value& v, Path& s) {
      inner(v, s);
      if (v.keys().empty()) {
        v.fail("is empty; expected at least one of " + joined(keysOf(stopTable())));
      }
    };
    return Table<Path>{
        integer("order", optional, &Path::order, check::order, "order K of the series"),
        real("accuracy", optional, &Path::accuracy, check::fraction,
             "delta of eq. (36), sets the length of a step"),
        real("residual", optional, &Path::residual, check::fraction, "bound of the relative residual"),
        integer("direction", optional, &Path::direction, check::direction,
                "1: the load factor first grows, -1: falls"),
        stop};
  }();
  return table;
}

const Table<Solver>& solverTable() {
  using Type = Solver::Type;
  static const Choices<Type> types{{"mumps", Type::Mumps}, {"amesos2", Type::Amesos2}};
  static const Table<Solver> table = [] {
    auto amesos =
        text("name", optional, &Solver::name, "a text", "Amesos2's name of a solver, with type: amesos2");
    amesos.read = [inner = amesos.read](const Value& v, Solver& s) {
      if (s.type == Type::Mumps) {
        v.fail("has no meaning with type: mumps");
      }
      inner(v, s);
    };
    return Table<Solver>{choice("type", optional, &Solver::type, types, "package that factors the tangent"),
                         amesos};
  }();
  return table;
}

const Variants<Monitor, decltype(Monitor::quantity)>& monitorVariants() {
  using V = decltype(Monitor::quantity);
  using Reduce = DisplacementMonitor::Reduce;
  static const Choices<Reduce> reductions{{"mean", Reduce::Mean}, {"sum", Reduce::Sum}};
  static const Variants<Monitor, V> variants{
      "type",
      &Monitor::quantity,
      {alternative<V, DisplacementMonitor>(
           "displacement",
           {name("set", required, &DisplacementMonitor::set, "a node set or side set, name or id",
                 "its nodes"),
            choice("component", required, &DisplacementMonitor::component, axes(), "which displacement"),
            choice("reduce", optional, &DisplacementMonitor::reduce, reductions, "over the set's nodes")}),
       alternative<V, ContactForceMonitor>(
           "contact_force",
           {name("contact", required, &ContactForceMonitor::contact, "the name of a contact", "whose force"),
            choice("component", optional, &ContactForceMonitor::component, allComponents(),
                   "normal: sum of the normal forces; x, y, z: of their resultant on the body"),
            nearestPoint()}),
       alternative<V, ReactionMonitor>(
           "reaction", {name("support", required, &ReactionMonitor::support, "the name of a support",
                             "whose force on the body"),
                        choice("component", required, &ReactionMonitor::component, axes(), "which force")})},
      {}};
  return variants;
}

}  // namespace atrapos::deck
