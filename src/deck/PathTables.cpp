// Keys of the blocks that say how to go along the path and what to write: path, solver, output.
#include <fmt/format.h>

#include <vector>

#include "deck/DeckTables.hpp"
#include "deck/Entries.hpp"

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

/// A place, or none.
template <class M>
Field<M> anyPlace(std::string key, std::optional<Vector3> M::*member, std::string meaning) {
  return {std::move(key),
          false,
          "a list of 3 numbers",
          std::move(meaning),
          [member](const Value& v, M& s) {
            const auto x = v.reals(3);
            s.*member = Vector3{x[0], x[1], x[2]};
          },
          [member](const M& s) {
            return s.*member ? Node{yamlList(*(s.*member)), {}} : Node{};
          }};
}

/// A place of which a monitor sees the nearest point only.
template <class M>
Field<M> nearestPoint(std::string meaning) {
  return anyPlace("near", &M::near, std::move(meaning));
}

Field<ContactForceMonitor> nearestContactPoint() {
  auto field =
      nearestPoint<ContactForceMonitor>("only the point nearest to this place of the undeformed body");
  field.read = [inner = field.read](const Value& v, ContactForceMonitor& s) {
    if (s.component != Component::Normal) {
      v.fail("has a meaning with component: normal only");
    }
    inner(v, s);
  };
  return field;
}

/// One of x, y, z, or none.
template <class M>
Field<M> anyAxis(std::string meaning) {
  const std::string accepts = "one of " + joined(wordsOf(axes()));
  return {"component",
          false,
          accepts,
          std::move(meaning),
          [](const Value& v, M& s) { s.component = choose(v, v.text(), axes()); },
          [](const M& s) {
            return s.component ? Node{wordOf(*s.component, axes()), {}} : Node{};
          }};
}

Field<ContactForceMonitor> lineOfPoints() {
  return {"along",
          false,
          "a list of 3 numbers",
          "with near: all points on the line through that point in this direction",
          [](const Value& v, ContactForceMonitor& s) {
            if (!s.near) {
              v.fail("needs near beside it");
            }
            const auto x = v.reals(3);
            if (x[0] == 0 && x[1] == 0 && x[2] == 0) {
              v.fail("must not be the zero vector");
            }
            s.along = Vector3{x[0], x[1], x[2]};
          },
          [](const ContactForceMonitor& s) {
            return s.along ? Node{yamlList(*s.along), {}} : Node{};
          }};
}

/// One number, or a list of them.
std::vector<double> oneOrMore(const Value& v, const Check& check) {
  if (!v.isList()) {
    return {v.real(check)};
  }
  const auto values = v.reals();
  for (const double value : values) {
    if (!check.holds(value)) {
      v.fail(fmt::format("must be {}, got {}", check.words, value));
    }
  }
  return values;
}

Node oneOrMore(const std::vector<double>& values) {
  return values.size() == 1 ? Node{yaml(values[0]), {}} : Node{yamlList(values), {}};
}

/// `zeroToo`: a stage may go back to 0.
Field<Stop> stopLoadFactor(bool zeroToo) {
  return {"load_factor",
          false,
          zeroToo ? "a number or a list of numbers" : "a number or a list of numbers, different from zero",
          "ends where the load factor takes one of these values",
          [zeroToo](const Value& v, Stop& s) {
            s.loadFactors = oneOrMore(v, zeroToo ? check::any : check::nonzero);
          },
          [](const Stop& s) { return s.loadFactors.empty() ? Node{} : oneOrMore(s.loadFactors); }};
}

Field<Stop> stopMonitors(std::string key, std::string accepts) {
  return {std::move(key),
          false,
          std::move(accepts),
          "ends where a monitor takes a value",
          [](const Value& v, Stop& s) {
            for (const Value& each : v.children()) {
              s.monitors[each.key()] = oneOrMore(each, check::any);
            }
          },
          [](const Stop& s) {
            Node node;
            for (const auto& [monitor, values] : s.monitors) {
              node.children.emplace_back(monitor, oneOrMore(values));
            }
            return node;
          }};
}

Field<Path> orderOrAuto() {
  return {
      "order",
      false,
      fmt::format("a whole number, {}, or auto", check::order.words),
      "order K of the series; auto: the cheapest by the costs measured while running",
      [](const Value& v, Path& s) {
        if (v.isText() && v.text() == "auto") {
          s.autoOrder = true;
          return;
        }
        if (v.isText()) {
          v.fail(fmt::format("expected a whole number, {}, or auto, got {}", check::order.words, v.shown()));
        }
        s.order = v.integer(check::order);
      },
      [](const Path& s) {
        return Node{s.autoOrder ? "auto" : yaml(s.order), {}};
      }};
}

Field<Path> imperfections() {
  return {"imperfections",
          false,
          "a number or a list of numbers, different from zero",
          "each adds the path of an imperfect structure, in the shape of the first bifurcation point's null "
          "vector",
          [](const Value& v, Path& s) { s.imperfections = oneOrMore(v, check::nonzero); },
          [](const Path& s) { return s.imperfections.empty() ? Node{} : oneOrMore(s.imperfections); }};
}

Field<Path> imperfectionsAs(bool ofModel) {
  static const Choices<Path::Imperfection> kinds{{"load", Path::Imperfection::Load},
                                                 {"geometry", Path::Imperfection::Geometry}};
  auto field =
      choice("imperfections_as", optional, &Path::imperfectionsAs, kinds,
             "what imperfections are: a small constant force, or nodes of the undeformed mesh moved by "
             "the null vector");
  if (ofModel) {
    field.read = [inner = field.read](const Value& v, Path& s) {
      inner(v, s);
      if (s.imperfectionsAs == Path::Imperfection::Geometry) {
        v.fail("geometry needs a mesh, which a model problem does not have; expected load");
      }
    };
  }
  return field;
}

Field<Path> accuracyOfMethod() {
  return {"accuracy",
          false,
          fmt::format("a number, {}", check::fraction.words),
          "delta of eq. (36), sets the length of a step; Newton steps: largest distance of the path from the "
          "cubic between their ends, without it only the ends are wanted",
          [](const Value& v, Path& s) {
            const double accuracy = v.real(check::fraction);
            if (s.series()) {
              s.accuracy = accuracy;
            } else {
              s.cubicAccuracy = accuracy;
            }
          },
          [](const Path& s) {
            if (s.series()) {
              return Node{yaml(s.accuracy), {}};
            }
            return s.cubicAccuracy ? Node{yaml(*s.cubicAccuracy), {}} : Node{};
          }};
}

/// A key that Newton steps do not know; the key `method` is read before.
Field<Path> ofSeries(Field<Path> field) {
  field.read = [inner = field.read](const Value& v, Path& s) {
    if (!s.series()) {
      v.fail(fmt::format("needs method: series, the deck has method: {}", wordOf(s.method, methods())));
    }
    inner(v, s);
  };
  field.print = [inner = field.print](const Path& s) { return s.series() ? inner(s) : Node{}; };
  return field;
}

Table<Stop> stopKeys(const Table<Stop>& monitors, bool zeroToo = false) {
  Table<Stop> keys{
      stopLoadFactor(zeroToo),
      integer("steps", optional, &Stop::steps, check::count, "largest number of steps of a branch"),
      real("path_length", &Stop::pathLength, check::positive, "ends at this length of the path"),
      integer("limit_point", &Stop::limitPoint, check::count,
              "ends with the step on which the load factor turns for this many-th time"),
      integer("bifurcation", &Stop::bifurcation, check::count,
              "ends with the step that passes this many-th bifurcation point")};
  keys.insert(keys.end(), monitors.begin(), monitors.end());
  return keys;
}

template <class S>
Field<S> stopBlock(Need need, const Table<Stop>& stops) {
  auto stop = block("stop", need, &S::stop, stops, "where the path ends: whichever comes first");
  stop.read = [inner = stop.read, keys = keysOf(stops)](const Value& v, S& s) {
    inner(v, s);
    if (v.keys().empty()) {
      v.fail("is empty; expected at least one of " + joined(keys));
    }
  };
  return stop;
}

Table<Path> pathKeys(const Table<Stop>& stops, Need needStop, bool ofModel) {
  static const Choices<Path::Critical> searches{{"off", Path::Critical::Off},
                                                {"automatic", Path::Critical::Automatic},
                                                {"every_step", Path::Critical::EveryStep}};
  static const Choices<path::Follow> follows{
      {"none", path::Follow::none}, {"stable", path::Follow::stable}, {"all", path::Follow::all}};
  return {
      choice("method", optional, &Path::method, methods(),
             "how the path is followed: Taylor series, or arc-length steps by full or modified Newton"),
      ofSeries(orderOrAuto()),
      accuracyOfMethod(),
      real("residual", optional, &Path::residual, check::fraction, "bound of the relative residual"),
      ofSeries(
          real("jump", optional, &Path::jump, check::fractionOrZero,
               "largest relative residual that is corrected where contact points go on to another patch of "
               "their tool; 0: the path ends there")),
      integer("direction", optional, &Path::direction, check::direction,
              "1: the load factor first grows, -1: falls; of model problems: its own sense, or the other"),
      real("weight", &Path::weight, check::positive,
           "w of the path parameter: of displacements against the load factor"),
      ofSeries(choice("pade", optional, &Path::pade, padeUses(),
                      "where rational series stand in for polynomials")),
      ofSeries(choice("critical_points", optional, &Path::criticalPoints, searches,
                      "which bifurcation points are looked for")),
      ofSeries(flag("hopf", &Path::hopf,
                    "looks for Hopf points, where a pair of eigenvalues crosses the imaginary axis: of "
                    "balances and flows with unsymmetric tangents")),
      ofSeries(integer("hopf_eigenvalues", optional, &Path::hopfEigenvalues, check::count,
                       "how many eigenvalues next to zero are computed for that at each step's end")),
      ofSeries(choice("branches", optional, &Path::branches, follows,
                      "which branches are followed at bifurcation points")),
      ofSeries(integer("branch_depth", optional, &Path::branchDepth, check::natural,
                       "most bifurcations between the first path and a branch")),
      ofSeries(integer("branch_count", optional, &Path::branchCount, check::natural,
                       "most branches followed besides the first path")),
      ofSeries(imperfections()),
      ofSeries(imperfectionsAs(ofModel)),
      flag("restart", &Path::restart, "keeps what `atrapos run --restart` needs, at every step"),
      ofSeries(real("sharpen", &Path::sharpen, check::fraction,
                    "at the path's end eta of all contacts falls by this factor, towards hard contact")),
      stopBlock<Path>(needStop, stops)};
}

/// Names of entries, where there are any.
Field<Stage> namedEntries(std::string key, std::vector<std::string> Stage::*member, std::string meaning) {
  auto field = names(std::move(key), optional, member, std::move(meaning));
  field.accepts = "a list of names of entries";
  field.print = [inner = field.print, member](const Stage& s) {
    return (s.*member).empty() ? Node{} : inner(s);
  };
  return field;
}

}  // namespace

const Choices<Path::Method>& methods() {
  static const Choices<Path::Method> choices{{"series", Path::Method::Series},
                                             {"newton", Path::Method::Newton},
                                             {"modified_newton", Path::Method::ModifiedNewton}};
  return choices;
}

const Choices<path::PadeUse>& padeUses() {
  static const Choices<path::PadeUse> choices{
      {"off", path::PadeUse::off}, {"automatic", path::PadeUse::automatic}, {"on", path::PadeUse::on}};
  return choices;
}

const Choices<OutputField>& outputFields() {
  static const Choices<OutputField> choices{{"displacement", OutputField::Displacement},
                                            {"field", OutputField::Field},
                                            {"stress", OutputField::Stress},
                                            {"nodal_stress", OutputField::NodalStress},
                                            {"contact", OutputField::Contact},
                                            {"reaction", OutputField::Reaction}};
  return choices;
}
std::string wordOf(Component component) { return wordOf(component, allComponents()); }

namespace {

Table<Stop> sceneStopKeys(bool zeroToo) {
  auto displacement =
      stopMonitors("displacement", "a map of displacement monitors' names to values, or to lists of values");
  displacement.print = [](const Stop&) { return Node{}; };  // with all others
  return stopKeys({displacement, stopMonitors("monitor",
                                              "a map of names of monitors of type displacement or field to "
                                              "values, or to lists of values")},
                  zeroToo);
}

}  // namespace

const Table<Stop>& stopTable() {
  static const Table<Stop> table = sceneStopKeys(false);
  return table;
}

const Table<Stage>& stageTable() {
  static const Table<Stop> stops = sceneStopKeys(true);
  static const Table<Stage> table = [] {
    auto release =
        namedEntries("release", &Stage::release,
                     "supports that are taken away: their forces fall as the load factor goes from 0 to 1");
    release.read = [inner = release.read](const Value& v, Stage& s) {
      inner(v, s);
      s.stop.loadFactors = {1};
    };
    return Table<Stage>{
        namedEntries(
            "drives", &Stage::drives,
            "loads, supports, tools, materials and physics that follow the load factor of this stage; "
            "without it all; others stay as they are"),
        release,
        integer("direction", &Stage::direction, check::direction,
                "1: the load factor first grows, -1: falls; without it towards stop/load_factor"),
        stopBlock<Stage>(optional, stops)};
  }();
  return table;
}

const Table<Path>& pathTable() {
  static const Table<Path> table = [] {
    Table<Path> keys = pathKeys(stopTable(), required, false);
    keys.back().unless = "stages";
    keys.back().print = [inner = keys.back().print](const Path& s) {
      return s.stages.empty() ? inner(s) : Node{};
    };
    keys.push_back(entries("stages", optional, &Path::stages, stageTable(), "each with drives, stop, ...",
                           "parts of the path, one after another, each from where the one before has ended"));
    return keys;
  }();
  return table;
}

const Table<Path>& modelPathTable() {
  static const Table<Stop> stop =
      stopKeys({stopMonitors("monitor", "a map of the problem's monitors to values, or to lists of values")});
  static const Table<Path> table = pathKeys(stop, optional, true);
  return table;
}

namespace {

const Choices<Solver::Type>& solverTypes() {
  using Type = Solver::Type;
  static const Choices<Type> types{
      {"mumps", Type::Mumps}, {"amesos2", Type::Amesos2}, {"belos", Type::Belos}, {"auto", Type::Auto}};
  return types;
}

/// A key that only solvers of one type have.
Field<Solver> onlyWith(Solver::Type type, Field<Solver> field) {
  field.read = [=, inner = field.read](const Value& v, Solver& s) {
    if (s.type != type) {
      v.fail(fmt::format("has no meaning with type: {}; it belongs to type: {}",
                         wordOf(s.type, solverTypes()), wordOf(type, solverTypes())));
    }
    inner(v, s);
  };
  field.print = [=, inner = field.print](const Solver& s) { return s.type == type ? inner(s) : Node{}; };
  return field;
}

}  // namespace

const Table<Solver>& solverTable() {
  using Type = Solver::Type;
  using Preconditioner = Solver::Preconditioner;
  static const Choices<Preconditioner> preconditioners{{"single_factor", Preconditioner::SingleFactor},
                                                       {"ilu", Preconditioner::Ilu}};
  static const Table<Solver> table{
      choice("type", optional, &Solver::type, solverTypes(), "package that solves with the tangent"),
      onlyWith(Type::Amesos2, text("name", optional, &Solver::name, "a text", "Amesos2's name of a solver")),
      onlyWith(Type::Belos, choice("preconditioner", optional, &Solver::preconditioner, preconditioners,
                                   "a factor in single precision, or an incomplete one")),
      onlyWith(Type::Belos, real("low_rank", &Solver::lowRank, check::fraction,
                                 "part of dense blocks that the single-precision factor drops")),
      onlyWith(Type::Auto, real("memory", &Solver::memory, check::positive, "GB that the solver may take"))};
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
            choice("reduce", optional, &DisplacementMonitor::reduce, reductions, "over the set's nodes"),
            nearestPoint<DisplacementMonitor>(
                "only the set's node nearest to this place of the undeformed body")}),
       alternative<V, ContactForceMonitor>(
           "contact_force",
           {name("contact", required, &ContactForceMonitor::contact, "the name of a contact", "whose force"),
            choice("component", optional, &ContactForceMonitor::component, allComponents(),
                   "normal: sum of the normal forces; x, y, z: of their resultant on the body"),
            nearestContactPoint(), lineOfPoints()}),
       alternative<V, ContactAreaMonitor>("contact_area",
                                          {name("contact", required, &ContactAreaMonitor::contact,
                                                "the name of a contact over faces or edges", "whose area")}),
       alternative<V, ContactPressureMonitor>(
           "contact_pressure",
           {name("contact", required, &ContactPressureMonitor::contact,
                 "the name of a contact over faces or edges", "whose largest pressure"),
            nearestPoint<ContactPressureMonitor>(
                "the pressure at the point nearest to this place of the undeformed body")}),
       alternative<V, ContactCenterMonitor>(
           "contact_center",
           {name("contact", required, &ContactCenterMonitor::contact, "the name of a contact",
                 "whose normal forces' centre"),
            choice("component", required, &ContactCenterMonitor::component, axes(), "which coordinate")}),
       alternative<V, ContactSpreadMonitor>(
           "contact_spread",
           {name("contact", required, &ContactSpreadMonitor::contact, "the name of a contact",
                 "whose normal forces' root-mean-square distance from their centre"),
            anyAxis<ContactSpreadMonitor>("the distance along this axis only"),
            anyPlace("about", &ContactSpreadMonitor::about,
                     "a place in space in place of the centre, as on the symmetry plane of half a body")}),
       alternative<V, ReactionMonitor>(
           "reaction", {name("support", required, &ReactionMonitor::support, "the name of a support",
                             "whose force on the body"),
                        anyAxis<ReactionMonitor>(
                            "which force; a support of a field has an inflow, one with a normal the force "
                            "along it, and no components")}),
       alternative<V, FieldMonitor>(
           "field",
           {name("field", required, &FieldMonitor::field, "the name of a field", "which field"),
            name("set", required, &FieldMonitor::set, "a node set or side set, name or id", "its nodes"),
            choice("reduce", optional, &FieldMonitor::reduce, reductions, "over the set's nodes"),
            nearestPoint<FieldMonitor>("only the set's node nearest to this place of the undeformed body")}),
       alternative<V, RotationMonitor>(
           "rotation", {name("coupling", required, &RotationMonitor::coupling,
                             "the name of a rigid coupling with an axis", "whose angle, in degrees")}),
       alternative<V, MomentMonitor>(
           "moment", {name("coupling", required, &MomentMonitor::coupling,
                           "the name of a rigid coupling with an angle", "whose moment about the axis")})},
      {}};
  return variants;
}

}  // namespace atrapos::deck
