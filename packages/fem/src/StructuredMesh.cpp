#include "atrapos/fem/StructuredMesh.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "FineAxis.hpp"

namespace atrapos::fem {

namespace {

using Lattice = std::array<int, 3>;  // a point or an offset on the lattice, directions a, b, c
using Point = std::array<double, 3>;

enum class Shape { Hex, Tet, Wedge };

Shape shapeOf(Topology topology) {
  switch (topology) {
    case Topology::Hex8:
    case Topology::Hex20:
    case Topology::Hex27:
      return Shape::Hex;
    case Topology::Tet4:
    case Topology::Tet10:
      return Shape::Tet;
    case Topology::Wedge6:
    case Topology::Wedge15:
      return Shape::Wedge;
    default:
      throw std::invalid_argument(std::string("structured mesh: ") + topologyName(topology) +
                                  " fills no solid body; shells have generators of their own");
  }
}

// Corner positions in a unit cell of the elements that fill it.
const std::vector<std::vector<Lattice>>& cornersInCell(Shape shape) {
  static const std::vector<std::vector<Lattice>> hex = {
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
  static const std::vector<std::vector<Lattice>> wedges = {
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}},
      {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
  // Kuhn's split: six tets around the diagonal from 000 to 111. It cuts opposite faces alike, so
  // neighbouring cells conform.
  static const std::vector<std::vector<Lattice>> tets = {
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}, {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 1, 1}},
      {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {1, 1, 1}}, {{0, 0, 0}, {0, 1, 1}, {0, 0, 1}, {1, 1, 1}},
      {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}}, {{0, 0, 0}, {1, 0, 1}, {1, 0, 0}, {1, 1, 1}}};
  return shape == Shape::Hex ? hex : shape == Shape::Wedge ? wedges : tets;
}

// The corners between which each node after the corners lies, in Exodus' order: mid-edge nodes, then
// for HEX27 the centroid and the face centres (bottom, top, -x, +x, -y, +y in reference coordinates).
const std::vector<std::vector<int>>& nodesBetweenCorners(Shape shape) {
  static const std::vector<std::vector<int>> hex = {
      {0, 1},       {1, 2},       {2, 3},       {3, 0},       {0, 4},       {1, 5}, {2, 6},
      {3, 7},       {4, 5},       {5, 6},       {6, 7},       {7, 4},       {0, 6}, {0, 1, 2, 3},
      {4, 5, 6, 7}, {0, 3, 4, 7}, {1, 2, 5, 6}, {0, 1, 4, 5}, {2, 3, 6, 7},
  };
  static const std::vector<std::vector<int>> wedge = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 4},
                                                      {2, 5}, {3, 4}, {4, 5}, {5, 3}};
  static const std::vector<std::vector<int>> tet = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  return shape == Shape::Hex ? hex : shape == Shape::Wedge ? wedge : tet;
}

// Corners of each side, in Exodus' side order.
const std::vector<std::vector<int>>& sideCorners(Shape shape) {
  static const std::vector<std::vector<int>> hex = {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6},
                                                    {0, 4, 7, 3}, {0, 3, 2, 1}, {4, 5, 6, 7}};
  static const std::vector<std::vector<int>> wedge = {
      {0, 1, 4, 3}, {1, 2, 5, 4}, {0, 3, 5, 2}, {0, 2, 1}, {3, 4, 5}};
  static const std::vector<std::vector<int>> tet = {{0, 1, 3}, {1, 2, 3}, {0, 3, 2}, {0, 2, 1}};
  return shape == Shape::Hex ? hex : shape == Shape::Wedge ? wedge : tet;
}

// What the lattice is to become.
struct Body {
  std::string title;
  std::string blockName;
  Topology topology = Topology::Hex8;
  std::array<int, 3> divisions{};
  std::array<std::array<std::string, 2>, 3> faceNames;  // [direction][min, max]
  std::function<Point(const Point&)> position;          // of lattice coordinates in [0, 1]^3
};

// Lattice points are two to a cell in each direction, so that every node of a quadratic element,
// and nothing else, is a point; elements without such nodes use the even points only.
class LatticeMesher {
 public:
  explicit LatticeMesher(const Body& body)
      : body_(body),
        shape_(shapeOf(body.topology)),
        size_{2 * body.divisions[0] + 1, 2 * body.divisions[1] + 1, 2 * body.divisions[2] + 1},
        axes_{0, 1, 2} {
    std::stable_sort(axes_.begin(), axes_.end(), [&](int i, int j) { return size_[i] > size_[j]; });
    elements_ = elementOffsets();
  }

  Mesh build() {
    mesh_.title = body_.title;
    numberNodes();
    addBlock();
    addNodeSets();
    addSideSets();
    return std::move(mesh_);
  }

 private:
  std::vector<std::vector<Lattice>> elementOffsets() const {
    std::vector<std::vector<Lattice>> elements;
    const auto numNodes = static_cast<std::size_t>(nodesPerElement(body_.topology));
    for (const auto& corners : cornersInCell(shape_)) {
      std::vector<Lattice> offsets;
      for (const Lattice& c : corners) offsets.push_back({2 * c[0], 2 * c[1], 2 * c[2]});
      for (const auto& between : nodesBetweenCorners(shape_)) {
        if (offsets.size() == numNodes) break;
        Lattice sum{0, 0, 0};
        for (int corner : between)
          for (int d = 0; d < 3; ++d) sum[d] += offsets[corner][d];
        for (int d = 0; d < 3; ++d) sum[d] /= static_cast<int>(between.size());
        offsets.push_back(sum);
      }
      elements.push_back(offsets);
    }
    return elements;
  }

  std::size_t pointIndex(const Lattice& p) const {
    return (static_cast<std::size_t>(p[axes_[0]]) * size_[axes_[1]] + p[axes_[1]]) * size_[axes_[2]] +
           p[axes_[2]];
  }

  // Calls f for every cell's first lattice point, in the order of numbering.
  template <class F>
  void forEachCell(const F& f) const {
    Lattice p{};
    for (p[axes_[0]] = 0; p[axes_[0]] < size_[axes_[0]] - 1; p[axes_[0]] += 2)
      for (p[axes_[1]] = 0; p[axes_[1]] < size_[axes_[1]] - 1; p[axes_[1]] += 2)
        for (p[axes_[2]] = 0; p[axes_[2]] < size_[axes_[2]] - 1; p[axes_[2]] += 2) f(p);
  }

  void numberNodes() {
    nodeOfPoint_.assign(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2], -1);
    forEachCell([&](const Lattice& cell) {
      for (const auto& offsets : elements_)
        for (const Lattice& o : offsets)
          nodeOfPoint_[pointIndex({cell[0] + o[0], cell[1] + o[1], cell[2] + o[2]})] = 0;
    });
    Lattice p{};
    std::size_t index = 0;
    for (p[axes_[0]] = 0; p[axes_[0]] < size_[axes_[0]]; ++p[axes_[0]])
      for (p[axes_[1]] = 0; p[axes_[1]] < size_[axes_[1]]; ++p[axes_[1]])
        for (p[axes_[2]] = 0; p[axes_[2]] < size_[axes_[2]]; ++p[axes_[2]], ++index) {
          if (nodeOfPoint_[index] < 0) continue;
          nodeOfPoint_[index] = static_cast<int>(pointOfNode_.size());
          pointOfNode_.push_back(p);
          Point s{};
          for (int d = 0; d < 3; ++d) s[d] = static_cast<double>(p[d]) / (size_[d] - 1);
          const Point x = body_.position(s);
          mesh_.coordinates.insert(mesh_.coordinates.end(), x.begin(), x.end());
        }
  }

  void addBlock() {
    Block block;
    block.name = body_.blockName;
    block.id = 1;
    block.topology = body_.topology;
    forEachCell([&](const Lattice& cell) {
      for (const auto& offsets : elements_)
        for (const Lattice& o : offsets)
          block.nodes.push_back(nodeOfPoint_[pointIndex({cell[0] + o[0], cell[1] + o[1], cell[2] + o[2]})]);
    });
    mesh_.blocks.push_back(std::move(block));
  }

  // Faces, edges, corners and their mid-thickness counterparts: in each direction a set either
  // fixes the position or leaves it free.
  void addNodeSets() {
    enum { any = 0, min, max, mid };
    struct Choice {
      Lattice fixed;
      int numFixed;
    };
    std::vector<Choice> choices;
    for (int a = any; a <= max; ++a)
      for (int b = any; b <= max; ++b)
        for (int c = any; c <= mid; ++c) choices.push_back({{a, b, c}, (a != 0) + (b != 0) + (c != 0)});
    // Faces first, with the ids of the side sets: a_min a_max b_min b_max c_min c_max.
    const auto rank = [](const Choice& c) {
      return std::make_tuple(c.fixed[2] == mid, c.numFixed, c.numFixed == 1 ? firstFixed(c.fixed) : 0);
    };
    std::stable_sort(choices.begin(), choices.end(),
                     [&](const Choice& l, const Choice& r) { return rank(l) < rank(r); });
    for (const Choice& choice : choices) {
      if (choice.numFixed == 0) continue;
      NodeSet set;
      for (int d = 0; d < 3; ++d) {
        if (choice.fixed[d] == any) continue;
        if (!set.name.empty()) set.name += '_';
        set.name += choice.fixed[d] == mid ? "mid" : body_.faceNames[d][choice.fixed[d] - min];
      }
      for (std::size_t node = 0; node < pointOfNode_.size(); ++node) {
        bool inside = true;
        for (int d = 0; d < 3; ++d) {
          const int last = size_[d] - 1;
          const int at = choice.fixed[d] == max ? last : choice.fixed[d] == mid ? last / 2 : 0;
          inside = inside && (choice.fixed[d] == any || pointOfNode_[node][d] == at);
        }
        if (inside) set.nodes.push_back(static_cast<int>(node));
      }
      if (set.nodes.empty()) continue;  // no nodes halfway through the thickness
      set.id = static_cast<long long>(mesh_.nodeSets.size()) + 1;
      mesh_.nodeSets.push_back(std::move(set));
    }
  }

  static int firstFixed(const Lattice& fixed) { return fixed[0] ? 0 : fixed[1] ? 1 : 2; }

  void addSideSets() {
    const std::vector<int>& nodes = mesh_.blocks[0].nodes;
    const int perElement = nodesPerElement(body_.topology);
    const int numElements = mesh_.numElements();
    for (int d = 0; d < 3; ++d)
      for (int end = 0; end < 2; ++end) {
        const int at = end == 0 ? 0 : size_[d] - 1;
        SideSet set;
        set.name = body_.faceNames[d][end];
        set.id = 2 * d + end + 1;
        for (int e = 0; e < numElements; ++e) {
          const auto& sides = sideCorners(shape_);
          for (std::size_t s = 0; s < sides.size(); ++s)
            if (std::all_of(sides[s].begin(), sides[s].end(), [&](int corner) {
                  return pointOfNode_[nodes[static_cast<std::size_t>(e) * perElement + corner]][d] == at;
                }))
              set.sides.push_back({e, static_cast<int>(s)});
        }
        mesh_.sideSets.push_back(std::move(set));
      }
  }

  const Body& body_;
  Shape shape_;
  Lattice size_;  // number of lattice points in each direction
  std::array<int, 3> axes_;
  std::vector<std::vector<Lattice>>
      elements_;                  // [element of a cell][node]: offset from the cell's first point
  std::vector<int> nodeOfPoint_;  // -1 where no node is
  std::vector<Lattice> pointOfNode_;
  Mesh mesh_;
};

void require(bool condition, const std::string& body, const std::string& requirement) {
  if (!condition) throw std::invalid_argument(body + ": " + requirement);
}

void requirePositive(double value, const std::string& body, const std::string& name) {
  require(std::isfinite(value) && value > 0.0, body, name + " must be above 0, got " + std::to_string(value));
}

void requireFinite(double value, const std::string& body, const std::string& name) {
  require(std::isfinite(value), body, name + " must be a finite number");
}

void requireDivisions(const Lattice& divisions, const std::string& body) {
  double points = 1.0;
  for (int n : divisions) {
    require(n >= 1, body, "each of the divisions must be at least 1, got " + std::to_string(n));
    points *= 2.0 * n + 1.0;
  }
  require(points < std::numeric_limits<int>::max(), body, "too many divisions for one mesh");
}

void requireAngles(double min, double max, int divisions, const std::string& body, const std::string& name) {
  requireFinite(min, body, name + "Min");
  requireFinite(max, body, name + "Max");
  require(max > min, body, name + "Max must be above " + name + "Min");
  require(max - min < 360.0, body, name + " must span less than 360 degrees");
  require((max - min) / divisions <= 90.0, body, "more than 90 degrees of " + name + " per cell");
}

void requireShell(double midRadius, double thickness, const std::string& body) {
  requirePositive(midRadius, body, "midRadius");
  requirePositive(thickness, body, "thickness");
  require(thickness < 2.0 * midRadius, body, "thickness must be below twice the mid radius");
}

constexpr double radiansPerDegree = 3.14159265358979323846 / 180.0;

double between(double min, double max, double s) { return s == 1.0 ? max : min + s * (max - min); }

Mesh alignedBox(const BoxOptions& options, const std::string& kind,
                const std::array<std::string, 3>& lengthNames,
                const std::array<std::string, 2>& thicknessFaces) {
  for (int d = 0; d < 3; ++d) {
    requirePositive(options.lengths[d], kind, lengthNames[d]);
    requireFinite(options.origin[d], kind, "origin");
  }
  requireDivisions(options.divisions, kind);
  Body body;
  body.title = kind;
  body.blockName = options.blockName;
  body.topology = options.topology;
  body.divisions = options.divisions;
  body.faceNames = {{{"x_min", "x_max"}, {"y_min", "y_max"}, thicknessFaces}};
  std::vector<FineAxis> axes;
  for (int d = 0; d < 3; ++d) axes.emplace_back(options.fine[d], options.lengths[d], options.divisions[d]);
  body.position = [&](const Point& s) {
    Point x{};
    for (int d = 0; d < 3; ++d) x[d] = options.origin[d] + axes[d].at(s[d]) * options.lengths[d];
    return x;
  };
  return LatticeMesher(body).build();
}

}  // namespace

Mesh boxMesh(const BoxOptions& options) {
  return alignedBox(options, "box", {"lengths", "lengths", "lengths"}, {"z_min", "z_max"});
}

Mesh stripMesh(const StripOptions& options) {
  BoxOptions box;
  box.lengths = {options.length, options.width, options.thickness};
  box.origin = options.origin;
  box.divisions = options.divisions;
  box.topology = options.topology;
  box.blockName = options.blockName;
  return alignedBox(box, "strip", {"length", "width", "thickness"}, {"bottom", "top"});
}

Mesh cylinderPanelMesh(const CylinderPanelOptions& options) {
  const std::string kind = "cylinder panel";
  requireDivisions(options.divisions, kind);
  requireShell(options.midRadius, options.thickness, kind);
  requireAngles(options.thetaMin, options.thetaMax, options.divisions[0], kind, "theta");
  requirePositive(options.length, kind, "length");
  requireFinite(options.yMin, kind, "yMin");
  Body body;
  body.title = kind;
  body.blockName = options.blockName;
  body.topology = options.topology;
  body.divisions = options.divisions;
  body.faceNames = {{{"theta_min", "theta_max"}, {"y_min", "y_max"}, {"inner", "outer"}}};
  body.position = [&](const Point& s) {
    const double theta = radiansPerDegree * between(options.thetaMin, options.thetaMax, s[0]);
    const double r = options.midRadius + (s[2] - 0.5) * options.thickness;
    return Point{r * std::sin(theta), options.yMin + s[1] * options.length, r * std::cos(theta)};
  };
  return LatticeMesher(body).build();
}

Mesh spherePanelMesh(const SpherePanelOptions& options) {
  const std::string kind = "sphere panel";
  requireDivisions(options.divisions, kind);
  requireShell(options.midRadius, options.thickness, kind);
  requireAngles(options.longitudeMin, options.longitudeMax, options.divisions[0], kind, "longitude");
  requireAngles(options.latitudeMin, options.latitudeMax, options.divisions[1], kind, "latitude");
  require(options.latitudeMin > -90.0 && options.latitudeMax < 90.0, kind,
          "latitudes must stay strictly between -90 and 90 degrees");
  Body body;
  body.title = kind;
  body.blockName = options.blockName;
  body.topology = options.topology;
  body.divisions = options.divisions;
  body.faceNames = {
      {{"longitude_min", "longitude_max"}, {"latitude_min", "latitude_max"}, {"inner", "outer"}}};
  body.position = [&](const Point& s) {
    const double lon = radiansPerDegree * between(options.longitudeMin, options.longitudeMax, s[0]);
    const double lat = radiansPerDegree * between(options.latitudeMin, options.latitudeMax, s[1]);
    const double r = options.midRadius + (s[2] - 0.5) * options.thickness;
    return Point{r * std::cos(lat) * std::cos(lon), r * std::cos(lat) * std::sin(lon), r * std::sin(lat)};
  };
  return LatticeMesher(body).build();
}

}  // namespace atrapos::fem
