// Keys of the tools. Whether the numbers make a surface is for the tools themselves to say (Registry).
#include "deck/DeckTables.hpp"

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

}  // namespace

const Variants<Tool, decltype(Tool::surface)>& toolVariants() {
  using V = decltype(Tool::surface);
  using Taper = TaperedRollTool;
  using Crown = CrownedRollTool;
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
           requireOneProfile)},
      {}};
  return variants;
}

}  // namespace atrapos::deck
