// Keys of the tools. Whether the numbers make a surface is for the tools themselves to say (Registry).
#include "deck/DeckTables.hpp"

#include "deck/Entries.hpp"

namespace atrapos::deck {
namespace {

template <class S>
Field<S> side() {
  return choice("side", optional, &S::side,
                Choices<Side>{{"outside", Side::Outside}, {"inside", Side::Inside}},
                "where the body is: outside, or inside of the hollow tool");
}

template <class S>
Field<S> axis(const std::string& meaning = "direction of the axis, of any length") {
  return direction("axis", required, &S::axis, meaning);
}

void requireOneProfile(const Value& map, const CrownedRollTool& roll) {
  const bool table = !roll.places.empty() || !roll.radii.empty();
  if (table == !roll.coefficients.empty()) {
    map.fail("needs either coefficients, or places and radii");
  }
  if (table && (roll.places.empty() || roll.radii.empty())) {
    map.failMissing(roll.places.empty() ? "places" : "radii", "a list of numbers");
  }
}

template <class S>
Field<S> rows3(std::string key, Need need, std::vector<Vector3> S::*member, std::string meaning) {
  return {std::move(key),
          need == required,
          "a list of lists of 3 numbers",
          std::move(meaning),
          [=](const Value& v, S& s) { s.*member = v.rowsOf3(); },
          [=](const S& s) {
            return Node{yamlRows(s.*member), {}};
          }};
}

Field<SplineSurface> knots(const std::string& key, std::size_t direction) {
  return {key,
          false,
          "a list of numbers",
          "ascending, number of points + degree + 1 in this direction; without knots a Bezier patch",
          [=](const Value& v, SplineSurface& s) { s.knots[direction] = v.reals(); },
          [=](const SplineSurface& s) {
            return s.knots[direction].empty() ? Node{} : Node{yamlList(s.knots[direction]), {}};
          }};
}

void requireMotion(const Value& map, const ToolMotion& motion) {
  if (!motion.moves()) {
    map.fail("moves nothing; expected shift or angle");
  }
  if (!motion.angle.empty() && !map.has("axis")) {
    map.failMissing("axis", "a list of 3 numbers, not all zero");
  }
  if (motion.shift.size() > 3) {
    map.at("shift").fail("expected factors of at most the powers 1, 2, 3 of the load factor");
  }
  if (motion.angle.size() > 3) {
    map.at("angle").fail("expected factors of at most the powers 1, 2, 3 of the load factor");
  }
}

void requireSurfaces(const Value& map, const PatchesTool& patches) {
  if (patches.surfaces.empty() == patches.file.empty()) {
    map.fail("needs either surfaces or file");
  }
}

}  // namespace

const Table<ToolMotion>& motionTable() {
  static const Table<ToolMotion> table{
      rows3("shift", optional, &ToolMotion::shift,
            "shift per load factor, a vector; or up to 3, factors of its powers 1, 2, 3"),
      reals("angle", optional, &ToolMotion::angle,
            "turn in degrees, right-handed about the axis: factors of the powers 1, 2, 3 of the load factor"),
      direction("axis", optional, &ToolMotion::axis, "of the turn, of any length"),
      vector3("pivot", optional, &ToolMotion::pivot, "point on the axis of the turn")};
  return table;
}

const Table<SplineSurface>& splineSurfaceTable() {
  static const Table<SplineSurface> table = [] {
    const Field<SplineSurface> degree{"degree",
                                      true,
                                      "a list of 2 whole numbers, each from 1 to 20",
                                      "in the first and in the second direction",
                                      [](const Value& v, SplineSurface& s) {
                                        const auto p = v.integers(2, check::degree);
                                        s.degree = {p[0], p[1]};
                                      },
                                      [](const SplineSurface& s) {
                                        return Node{yamlList(s.degree), {}};
                                      }};
    return Table<SplineSurface>{
        degree,
        rows3("points", required, &SplineSurface::points,
              "control points, those of the second direction run fastest"),
        reals("weights", optional, &SplineSurface::weights, "of the points, > 0; none: all 1"),
        knots("knots_1", 0), knots("knots_2", 1)};
  }();
  return table;
}

const Variants<Tool, decltype(Tool::surface)>& toolVariants() {
  using V = decltype(Tool::surface);
  using Taper = TaperedRollTool;
  using Crown = CrownedRollTool;
  static const Field<Tool> motion = [] {
    auto field = block("motion", optional, &Tool::motion, motionTable(), "how it moves with the load factor");
    field.read = [inner = field.read](const Value& v, Tool& tool) {
      inner(v, tool);
      requireMotion(v, tool.motion);
    };
    field.print = [inner = field.print](const Tool& tool) {
      return tool.motion.moves() ? inner(tool) : Node{};
    };
    return field;
  }();
  auto surfaces = entries("surfaces", optional, &PatchesTool::surfaces, splineSurfaceTable(),
                          "each with degree, points, ...", "Bezier, B-spline and NURBS surfaces; or");
  surfaces.print = [inner = surfaces.print](const PatchesTool& s) {
    return s.file.empty() ? inner(s) : Node{};
  };
  static const Variants<Tool, V> variants{
      "type",
      &Tool::surface,
      {alternative<V, CylinderTool>(
           "cylinder",
           {vector3("center", required, &CylinderTool::center, "any point of the axis"), axis<CylinderTool>(),
            real("radius", required, &CylinderTool::radius, check::positive, "of the cylinder"),
            side<CylinderTool>()}),
       alternative<V, PlaneTool>(
           "plane", {vector3("point", required, &PlaneTool::point, "any point of the plane"),
                     direction("normal", required, &PlaneTool::normal, "to the free side, of any length")}),
       alternative<V, SphereTool>(
           "sphere", {vector3("center", required, &SphereTool::center, "of the sphere"),
                      real("radius", required, &SphereTool::radius, check::positive, "of the sphere"),
                      side<SphereTool>()}),
       alternative<V, ConeTool>("cone",
                                {vector3("apex", required, &ConeTool::apex, "tip of the cone"),
                                 axis<ConeTool>("direction from the apex into the cone, of any length"),
                                 real("half_angle", required, &ConeTool::halfAngle, check::acuteAngle,
                                      "between the axis and the surface, degrees"),
                                 side<ConeTool>()}),
       alternative<V, TorusTool>(
           "torus",
           {vector3("center", required, &TorusTool::center, "of the torus"), axis<TorusTool>(),
            real("radius", required, &TorusTool::radius, check::positive, "of the tube's centre line"),
            real("tube_radius", required, &TorusTool::tubeRadius, check::positive, "of the tube"),
            side<TorusTool>()}),
       alternative<V, Taper>(
           "tapered_roll",
           {vector3("center", required, &Taper::center, "on the axis, in the middle of the flat part"),
            axis<Taper>("direction of the axis, of any length; with ends: one, to the end that tapers"),
            real("radius", required, &Taper::radius, check::positive, "of the flat part"),
            real("flat", required, &Taper::flat, check::any, "length of the flat part from the center"),
            real("angle", required, &Taper::angle, check::slopeAngle,
                 "of the cone, degrees; above 0: the roll narrows"),
            real("smoothing", required, &Taper::smoothing, check::positive,
                 "length over which the vertex is smoothed"),
            choice("ends", optional, &Taper::ends,
                   Choices<Taper::Ends>{{"both", Taper::Ends::Both}, {"one", Taper::Ends::One}},
                   "which ends taper")}),
       alternative<V, Crown>(
           "crowned_roll",
           {vector3("center", required, &Crown::center, "on the axis, where the place is 0"), axis<Crown>(),
            reals("coefficients", optional, &Crown::coefficients,
                  "radius = sum of coefficient i times place^i, i = 0, 1, ...; or"),
            reals("places", optional, &Crown::places, "places along the axis, ascending, and"),
            reals("radii", optional, &Crown::radii, "the radius at each of them")},
           requireOneProfile),
       alternative<V, PatchesTool>(
           "patches",
           {surfaces,
            text("file", optional, &PatchesTool::file, "a text",
                 "YAML file with such a map under the key surfaces"),
            flag("reversed", &PatchesTool::reversed, "the free side is against S_1 x S_2"),
            real("thickness", &PatchesTool::thickness, check::positive,
                 "how deep the tool is behind its surface; deeper points are behind it and free")},
           requireSurfaces)},
      {motion}};
  return variants;
}

}  // namespace atrapos::deck
