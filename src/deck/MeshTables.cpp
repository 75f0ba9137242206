// Keys of the block `mesh`.
#include <cmath>
#include <limits>
#include <stdexcept>

#include "deck/DeckTables.hpp"

namespace atrapos::deck {
namespace {

const Choices<fem::Topology>& cells() {
  using fem::Topology;
  static const Choices<Topology> choices{{"HEX8", Topology::Hex8},      {"HEX20", Topology::Hex20},
                                         {"HEX27", Topology::Hex27},    {"TET4", Topology::Tet4},
                                         {"TET10", Topology::Tet10},    {"WEDGE6", Topology::Wedge6},
                                         {"WEDGE15", Topology::Wedge15}};
  return choices;
}

const Choices<fem::Topology>& planeCells() {
  using fem::Topology;
  static const Choices<Topology> choices{{"QUAD4", Topology::Quad4},
                                         {"QUAD8", Topology::Quad8},
                                         {"QUAD9", Topology::Quad9},
                                         {"TRI3", Topology::Tri3},
                                         {"TRI6", Topology::Tri6}};
  return choices;
}

const Choices<fem::Topology>& shellCells() {
  using fem::Topology;
  static const Choices<Topology> choices{{"SHELL3", Topology::Shell3},
                                         {"SHELL4", Topology::Shell4},
                                         {"SHELL6", Topology::Shell6},
                                         {"SHELL8", Topology::Shell8},
                                         {"SHELL9", Topology::Shell9}};
  return choices;
}

template <class S>
Field<S> divisions(std::string meaning) {
  constexpr std::size_t count = std::tuple_size<decltype(S::divisions)>::value;
  return {"divisions",
          true,
          fmt::format("a list of {} whole numbers, at least 1", count),
          std::move(meaning),
          [](const Value& v, S& s) {
            const auto n = v.integers(count, check::count);
            std::copy(n.begin(), n.end(), s.divisions.begin());
          },
          [](const S& s) {
            return Node{yamlList(s.divisions), {}};
          }};
}

template <class S>
Field<S> pair(std::string key, Need need, std::array<double, 2> S::*member, const Check& check,
              std::string meaning) {
  return {std::move(key),
          need == required,
          fmt::format("a list of 2 {} numbers", check.words),
          std::move(meaning),
          [=, &check](const Value& v, S& s) {
            const auto x = v.reals(2);
            for (const double number : x) {
              if (!check.holds(number)) {
                v.fail(fmt::format("each must be {}, got {}", check.words, v.shown()));
              }
            }
            s.*member = {x[0], x[1]};
          },
          [=](const S& s) {
            return Node{yamlList(s.*member), {}};
          }};
}

Field<fem::QuadrilateralOptions> corners() {
  using Quadrilateral = fem::QuadrilateralOptions;
  return {"corners",
          true,
          "a list of 8 numbers",
          "x and y of the corners, counter-clockwise",
          [](const Value& v, Quadrilateral& s) {
            const auto x = v.reals(s.corners.size());
            std::copy(x.begin(), x.end(), s.corners.begin());
          },
          [](const Quadrilateral& s) {
            return Node{yamlList(s.corners), {}};
          }};
}

template <class S>
Field<S> range(std::string key, double S::*low, double S::*high, std::string meaning) {
  return {std::move(key),
          true,
          "a list of 2 ascending numbers",
          std::move(meaning),
          [=](const Value& v, S& s) {
            const auto x = v.reals(2);
            if (x[0] >= x[1]) {
              v.fail(fmt::format("must ascend, got {}", v.shown()));
            }
            s.*low = x[0];
            s.*high = x[1];
          },
          [=](const S& s) {
            return Node{yamlList(std::array<double, 2>{s.*low, s.*high}), {}};
          }};
}

/// The ends of axes, x_min, x_max, ..., of which each axis may have one.
template <std::size_t N>
const Table<std::array<fem::FineEnd, N>>& fineEnds() {
  using Ends = std::array<fem::FineEnd, N>;
  static const Table<Ends> table = [] {
    Table<Ends> all;
    for (std::size_t axis = 0; axis < N; ++axis)
      for (const bool atMax : {false, true})
        all.push_back(
            {std::string(1, "xyz"[axis]) + (atMax ? "_max" : "_min"), false,
             "a list of a length and a number of elements", "equal elements from this end on",
             [axis, atMax](const Value& v, Ends& ends) {
               if (ends[axis].divisions > 0) v.fail("the other end of this axis is fine already");
               const auto given = v.reals(2);
               const double most = std::numeric_limits<int>::max();
               if (!(given[0] > 0 && given[1] >= 1 && given[1] <= most && given[1] == std::floor(given[1])))
                 v.fail(fmt::format("expected a length above 0 and a whole number of elements, got {}",
                                    v.shown()));
               ends[axis] = {static_cast<int>(given[1]), given[0], atMax};
             },
             [axis, atMax](const Ends& ends) {
               const fem::FineEnd& end = ends[axis];
               if (end.divisions == 0 || end.atMax != atMax) return Node{};
               return Node{yamlList(std::array<double, 2>{end.length, double(end.divisions)}), {}};
             }});
    return all;
  }();
  return table;
}

template <class S>
auto fine() {
  constexpr std::size_t count = std::tuple_size<decltype(S::fine)>::value;
  return block("fine", optional, &S::fine, fineEnds<count>(),
               "ends with equal elements, from which the others grow by one factor");
}

/// Whether they fit, along edges of these lengths.
template <std::size_t N>
void fineFits(const Value& map, const std::array<fem::FineEnd, N>& fine, const std::array<double, N>& lengths,
              const std::array<int, N>& divisions) {
  for (std::size_t axis = 0; axis < N; ++axis) {
    if (fine[axis].divisions == 0) continue;
    const std::string key = std::string(1, "xyz"[axis]) + (fine[axis].atMax ? "_max" : "_min");
    try {
      fem::growth(fine[axis], lengths[axis], divisions[axis]);
    } catch (const std::invalid_argument& error) {
      map.at("fine").at(key).fail(error.what());
    }
  }
}

/// The same of plates and rectangles, which may be graded instead.
template <class S>
void fineFitsPlate(const Value& map, const S& s, const std::array<double, 2>& lengths) {
  if (map.has("fine") && s.grading != 1) map.at("fine").fail("not together with grading");
  fineFits(map, s.fine, lengths, s.divisions);
}

// The keys that every shape ends with.
template <class S>
Table<S> withCells(Table<S> table, const std::string& directions,
                   const Choices<fem::Topology>& choices = cells()) {
  table.push_back(divisions<S>("cells along " + directions));
  table.push_back(choice("cell", optional, &S::topology, choices, "Exodus' name of the cells"));
  table.push_back(text("block", optional, &S::blockName, "a text", "name of the mesh's one block"));
  return table;
}

/// A thickness of shells becomes the block's attribute; 0, printed as nothing, leaves it to `shells`.
template <class S>
Field<S> attributeThickness() {
  auto field =
      real("thickness", optional, &S::thickness, check::positive, "written as the block's attribute");
  field.print = [](const S& s) { return s.thickness > 0 ? Node{yaml(s.thickness), {}} : Node{}; };
  return field;
}

/// Whether a closed direction stays open.
template <class S>
Field<S> slit() {
  return flag("slit", &S::slit, "true: 360 degrees stay open, with two edges at the same place");
}

template <class S>
std::function<void(const Value&, const S&)> outerAboveInner() {
  return [](const Value& map, const S& s) {
    if (s.outerRadius <= s.innerRadius) {
      map.at("outer_radius")
          .fail(fmt::format("must be above inner_radius = {}, got {}", s.innerRadius, s.outerRadius));
    }
  };
}

template <class S>
std::function<void(const Value&, const S&)> thinnerThanRadius() {
  return [](const Value& map, const S& s) {
    if (s.thickness >= 2 * s.midRadius) {
      map.at("thickness")
          .fail(fmt::format("must be below twice mid_radius = {}, got {}", s.midRadius, s.thickness));
    }
  };
}

Field<fem::ShellSphereOptions> shellLatitude() {
  using Sphere = fem::ShellSphereOptions;
  auto latitude = range("latitude", &Sphere::latitudeMin, &Sphere::latitudeMax,
                        "first and last, degrees from the x-y plane, above -90 and below 90");
  latitude.read = [inner = latitude.read](const Value& value, Sphere& s) {
    inner(value, s);
    if (s.latitudeMin <= -90 || s.latitudeMax >= 90) {
      value.fail(fmt::format("must stay above -90 and below 90 degrees, got {}", value.shown()));
    }
  };
  return latitude;
}

/// The plane in which a cylinder goes on; printed only where there is one.
template <class S>
Table<S> tangentPlane() {
  auto length = real("tangent", optional, &S::tangent, check::positive,
                     "length of a plane that continues the cylinder at the last angle");
  auto count = integer("tangent_divisions", optional, &S::tangentDivisions, check::count,
                       "cells along the tangent plane, besides those of divisions");
  for (auto* field : {&length, &count}) {
    field->print = [inner = field->print](const S& s) { return s.tangent > 0 ? inner(s) : Node{}; };
  }
  return {length, count};
}

/// The middle surfaces of shells, in the order of Generate.
void addShells(Variants<GenerateInput, Generate>& v) {
  using Plate = fem::ShellPlateOptions;
  using Cylinder = fem::ShellCylinderOptions;
  using Annulus = fem::ShellAnnulusOptions;
  using Sphere = fem::ShellSphereOptions;
  auto angle = real("angle", optional, &Plate::angle, check::positive,
                    "degrees between the edges, below 180: 90 a rectangle");
  angle.read = [inner = angle.read](const Value& value, Plate& s) {
    inner(value, s);
    if (s.angle >= 180) {
      value.fail(fmt::format("must be below 180 degrees, got {}", value.shown()));
    }
  };
  v.alternatives.push_back(alternative<Generate, Plate>(
      "shell_plate",
      withCells<Plate>({real("length", required, &Plate::length, check::positive, "of the edges along x"),
                        real("width", required, &Plate::width, check::positive, "of the other edges"), angle,
                        vector3("origin", optional, &Plate::origin, "corner of x_min and y_min"),
                        real("grading", optional, &Plate::grading, check::count,
                             "power with which elements grow from the edges inwards"),
                        fine<Plate>(), attributeThickness<Plate>()},
                       "length, width", shellCells()),
      [](const Value& map, const Plate& s) {
        fineFitsPlate(map, s, {s.length, s.width});
      }));
  Table<Cylinder> cylinder{
      real("radius", required, &Cylinder::radius, check::positive, "of the middle surface"),
      range("theta", &Cylinder::thetaMin, &Cylinder::thetaMax, "first and last angle, degrees from z to x"),
      real("length", required, &Cylinder::length, check::positive, "along y"),
      real("y_min", optional, &Cylinder::yMin, check::any, "where the length begins"),
      slit<Cylinder>(),
      attributeThickness<Cylinder>()};
  for (auto& field : tangentPlane<Cylinder>()) cylinder.push_back(std::move(field));
  v.alternatives.push_back(alternative<Generate, Cylinder>(
      "shell_cylinder", withCells<Cylinder>(std::move(cylinder), "theta, y", shellCells()),
      [](const Value& map, const Cylinder& s) {
        if ((s.tangent > 0) != (s.tangentDivisions > 0)) {
          map.fail("tangent and tangent_divisions come together");
        }
        if (s.tangent > 0 && s.thetaMax - s.thetaMin == 360 && !s.slit) {
          map.at("tangent").fail("a closed cylinder has no tangent plane");
        }
      }));
  v.alternatives.push_back(alternative<Generate, Annulus>(
      "shell_annulus",
      withCells<Annulus>(
          {real("inner_radius", required, &Annulus::innerRadius, check::positive, "of the hole"),
           real("outer_radius", required, &Annulus::outerRadius, check::positive, "above inner_radius"),
           range("angle", &Annulus::angleMin, &Annulus::angleMax, "first and last, degrees from x to y"),
           slit<Annulus>(), attributeThickness<Annulus>()},
          "radius, angle", shellCells()),
      outerAboveInner<Annulus>()));
  v.alternatives.push_back(alternative<Generate, Sphere>(
      "shell_sphere",
      withCells<Sphere>({real("radius", required, &Sphere::radius, check::positive, "of the middle surface"),
                         range("longitude", &Sphere::longitudeMin, &Sphere::longitudeMax,
                               "first and last, degrees from x to y"),
                         shellLatitude(), slit<Sphere>(), attributeThickness<Sphere>()},
                        "longitude, latitude", shellCells())));
}

/// In decks its cells are HEX27 where nothing is said, which neither lock in bending, as the HEX8 of
/// fem::boxMesh, nor have motions without energy where a column is one cell wide, as HEX20.
Alternative<Generate> box(Field<fem::BoxOptions> lengths) {
  using Box = fem::BoxOptions;
  constexpr auto cell = fem::Topology::Hex27;
  auto box = alternative<Generate, Box>(
      "box",
      withCells<Box>(
          {std::move(lengths), vector3("origin", optional, &Box::origin, "corner with the least x, y, z"),
           fine<Box>()},
          "x, y, z"),
      [](const Value& map, const Box& s) { fineFits(map, s.fine, s.lengths, s.divisions); });
  box.read = [inner = box.read](const Value& map, Generate& shape) {
    inner(map, shape);
    if (!map.has("cell")) std::get<Box>(shape).topology = cell;
  };
  for (KeyText& text : box.texts)
    if (text.key == "cell") text.standard = wordOf(cell, cells());
  return box;
}

}  // namespace

const Variants<GenerateInput, Generate>& generateVariants() {
  using fem::BoxOptions, fem::StripOptions, fem::CylinderPanelOptions, fem::SpherePanelOptions;
  static const Variants<GenerateInput, Generate> variants = [] {
    auto lengths = vector3("lengths", required, &BoxOptions::lengths, "edges along x, y, z");
    lengths.accepts = "a list of 3 positive numbers";
    lengths.read = [inner = lengths.read](const Value& v, BoxOptions& s) {
      inner(v, s);
      for (const double length : s.lengths) {
        if (length <= 0) {
          v.fail(fmt::format("each length must be positive, got {}", v.shown()));
        }
      }
    };
    Variants<GenerateInput, Generate> v{"shape", &GenerateInput::shape, {}, {}};
    v.alternatives.push_back(box(std::move(lengths)));
    v.alternatives.push_back(alternative<Generate, StripOptions>(
        "strip", withCells<StripOptions>(
                     {real("length", required, &StripOptions::length, check::positive, "along x"),
                      real("width", required, &StripOptions::width, check::positive, "along y"),
                      real("thickness", required, &StripOptions::thickness, check::positive, "along z"),
                      vector3("origin", optional, &StripOptions::origin, "corner with the least x, y, z")},
                     "length, width, thickness")));
    using Cylinder = CylinderPanelOptions;
    v.alternatives.push_back(alternative<Generate, Cylinder>(
        "cylinder_panel",
        withCells<Cylinder>(
            {real("mid_radius", required, &Cylinder::midRadius, check::positive,
                  "radius of the middle surface"),
             real("thickness", required, &Cylinder::thickness, check::positive, "of the panel"),
             range("theta", &Cylinder::thetaMin, &Cylinder::thetaMax,
                   "first and last angle, degrees from z to x"),
             real("length", required, &Cylinder::length, check::positive, "along y"),
             real("y_min", optional, &Cylinder::yMin, check::any, "where the length begins")},
            "theta, y, thickness"),
        thinnerThanRadius<Cylinder>()));
    using Sphere = SpherePanelOptions;
    auto latitude = range("latitude", &Sphere::latitudeMin, &Sphere::latitudeMax,
                          "first and last, degrees from the x-y plane, above -90 and below 90");
    latitude.read = [inner = latitude.read](const Value& value, Sphere& s) {
      inner(value, s);
      if (s.latitudeMin <= -90 || s.latitudeMax >= 90) {
        value.fail(fmt::format("must stay above -90 and below 90 degrees, got {}", value.shown()));
      }
    };
    v.alternatives.push_back(alternative<Generate, Sphere>(
        "sphere_panel",
        withCells<Sphere>({real("mid_radius", required, &Sphere::midRadius, check::positive,
                                "radius of the middle surface"),
                           real("thickness", required, &Sphere::thickness, check::positive, "of the panel"),
                           range("longitude", &Sphere::longitudeMin, &Sphere::longitudeMax,
                                 "first and last, degrees from x to y"),
                           latitude},
                          "longitude, latitude, thickness"),
        thinnerThanRadius<Sphere>()));
    addShells(v);
    using Rectangle = fem::RectangleOptions;
    v.alternatives.push_back(alternative<Generate, Rectangle>(
        "rectangle",
        withCells<Rectangle>(
            {pair("lengths", required, &Rectangle::lengths, check::positive, "edges along x, y"),
             pair("origin", optional, &Rectangle::origin, check::any, "corner with the least x, y"),
             real("grading", optional, &Rectangle::grading, check::count,
                  "power with which elements grow from the edges inwards"),
             fine<Rectangle>()},
            "x, y", planeCells()),
        [](const Value& map, const Rectangle& s) { fineFitsPlate(map, s, s.lengths); }));
    using Annulus = fem::AnnulusOptions;
    v.alternatives.push_back(alternative<Generate, Annulus>(
        "annulus",
        withCells<Annulus>(
            {real("inner_radius", required, &Annulus::innerRadius, check::positive, "of the hole"),
             real("outer_radius", required, &Annulus::outerRadius, check::positive, "above inner_radius"),
             range("angle", &Annulus::angleMin, &Annulus::angleMax, "first and last, degrees from x to y")},
            "radius, angle", planeCells()),
        outerAboveInner<Annulus>()));
    using Quadrilateral = fem::QuadrilateralOptions;
    v.alternatives.push_back(alternative<Generate, Quadrilateral>(
        "quadrilateral", withCells<Quadrilateral>({corners()}, "the first edge, the second", planeCells())));
    v.alternatives.push_back(alternative<Generate, fem::TrussOptions>("truss", trussTable()));
    return v;
  }();
  return variants;
}

const Table<MeshInput>& meshTable() {
  static const Table<MeshInput> table{
      text("file", required, &MeshInput::file, "a file name", "Exodus file, relative to the deck's folder"),
      flag("decomposed", &MeshInput::decomposed, "read from part files, <file>.<ranks>.<rank>"),
      {"generate", false, "a map with shape, ...", "how `atrapos mesh` makes the file",
       [](const Value& v, MeshInput& mesh) {
         GenerateInput input;
         read(generateVariants(), v, input);
         mesh.generate = input.shape;
       },
       [](const MeshInput& mesh) {
         return mesh.generate ? print(generateVariants(), GenerateInput{*mesh.generate}) : Node{};
       }}};
  return table;
}

}  // namespace atrapos::deck
