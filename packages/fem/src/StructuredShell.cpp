#include "atrapos/fem/StructuredShell.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "FineAxis.hpp"

namespace atrapos::fem {
namespace {

using Lattice = std::array<int, 2>;  // a point or an offset on the lattice, directions a, b
using Point = std::array<double, 3>;

/// Nodes of a cell of 2 x 2 lattice steps, in Exodus' order of SHELL9; SHELL4 and SHELL8 have the first of
/// them.
constexpr std::array<Lattice, 9> kNodesOfCell{
    {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {2, 1}, {1, 2}, {0, 1}, {1, 1}}};

struct Surface {
  std::string title, blockName;
  Topology topology = Topology::Shell8;
  std::array<int, 2> divisions{};
  std::array<bool, 2> closed{false, false};
  std::array<std::array<std::string, 3>, 2> names;  ///< [direction][min, max, mid]
  std::array<std::string, 2> faces;                 ///< top, bottom
  double thickness = 0;
  std::function<Point(double, double)> position;  ///< of lattice coordinates in [0, 1]^2
};

class SurfaceMesher {
 public:
  explicit SurfaceMesher(const Surface& surface) : surface_(surface) {
    for (int d = 0; d < 2; ++d) size_[d] = 2 * surface.divisions[d] + (surface.closed[d] ? 0 : 1);
    outer_ = size_[1] > size_[0] ? 1 : 0;
  }

  Mesh build() {
    mesh_.title = surface_.title;
    numberNodes();
    addBlock();
    addNodeSets();
    addLineSets();
    addSideSets();
    if (shellCorners(surface_.topology) == 3) splitCells();
    return std::move(mesh_);
  }

 private:
  int& nodeAt(const Lattice& p) {
    return nodeOfPoint_[static_cast<std::size_t>(p[outer_] % size_[outer_]) * size_[1 - outer_] +
                        p[1 - outer_] % size_[1 - outer_]];
  }

  template <class F>
  void forEachCell(const F& f) const {
    Lattice cell{};
    for (cell[outer_] = 0; cell[outer_] < surface_.divisions[outer_]; ++cell[outer_])
      for (cell[1 - outer_] = 0; cell[1 - outer_] < surface_.divisions[1 - outer_]; ++cell[1 - outer_])
        f(cell);
  }

  /// Of the cells that are made first: triangles come from quadrilaterals.
  Topology firstCell() const {
    if (surface_.topology == Topology::Shell3) return Topology::Shell4;
    return surface_.topology == Topology::Shell6 ? Topology::Shell9 : surface_.topology;
  }

  template <class F>
  void forEachNodeOf(const Lattice& cell, const F& f) {
    for (int n = 0; n < nodesPerElement(firstCell()); ++n)
      f(nodeAt({2 * cell[0] + kNodesOfCell[n][0], 2 * cell[1] + kNodesOfCell[n][1]}));
  }

  void numberNodes() {
    nodeOfPoint_.assign(static_cast<std::size_t>(size_[0]) * size_[1], -1);
    forEachCell([&](const Lattice& cell) { forEachNodeOf(cell, [](int& node) { node = 0; }); });
    Lattice p{};
    for (p[outer_] = 0; p[outer_] < size_[outer_]; ++p[outer_])
      for (p[1 - outer_] = 0; p[1 - outer_] < size_[1 - outer_]; ++p[1 - outer_]) {
        int& node = nodeAt(p);
        if (node < 0) continue;
        node = static_cast<int>(pointOfNode_.size());
        pointOfNode_.push_back(p);
        const Point x =
            surface_.position(p[0] / (2.0 * surface_.divisions[0]), p[1] / (2.0 * surface_.divisions[1]));
        mesh_.coordinates.insert(mesh_.coordinates.end(), x.begin(), x.end());
      }
  }

  void addBlock() {
    Block block;
    block.name = surface_.blockName;
    block.id = 1;
    block.topology = firstCell();
    forEachCell(
        [&](const Lattice& cell) { forEachNodeOf(cell, [&](int node) { block.nodes.push_back(node); }); });
    if (surface_.thickness > 0) {
      block.attributeNames = {"thickness"};
      block.attributes.assign(block.nodes.size() / nodesPerElement(block.topology), surface_.thickness);
    }
    mesh_.blocks.push_back(std::move(block));
  }

  // In each direction a set fixes the position (at min, max, halfway) or leaves it free (-1).
  void addNodeSets() {
    enum { any = -1, min = 0, max = 1, mid = 2 };
    std::vector<Lattice> choices{{min, any}, {max, any}, {any, min}, {any, max}, {min, min},
                                 {max, min}, {min, max}, {max, max}, {mid, any}, {any, mid},
                                 {min, mid}, {max, mid}, {mid, min}, {mid, max}, {mid, mid}};
    for (const Lattice& choice : choices) {
      NodeSet set;
      bool exists = true;
      for (int d = 0; d < 2; ++d) {
        if (choice[d] == any) continue;
        exists = exists && !(surface_.closed[d] && choice[d] == max);
        set.name += (set.name.empty() ? "" : "_") + surface_.names[d][choice[d]];
      }
      for (std::size_t node = 0; exists && node < pointOfNode_.size(); ++node) {
        bool inside = true;
        for (int d = 0; d < 2; ++d) {
          const int last = 2 * surface_.divisions[d], at = choice[d] == max   ? last
                                                           : choice[d] == mid ? last / 2
                                                                              : 0;
          inside = inside && (choice[d] == any || pointOfNode_[node][d] == at);
        }
        if (inside) set.nodes.push_back(static_cast<int>(node));
      }
      if (set.nodes.empty()) continue;  // no nodes halfway, or no such edge
      set.id = static_cast<long long>(mesh_.nodeSets.size()) + 1;
      mesh_.nodeSets.push_back(std::move(set));
    }
  }

  /// For each direction the nodes on the lines along it: those that edges of elements form, and all. The
  /// factors are the integrals of a line's shape functions over its length: a force on each of them is a
  /// uniform force along the line.
  void addLineSets() {
    for (const bool edgesOnly : {false, true})
      for (int along = 0; along < 2; ++along) {
        NodeSet set;
        const std::string middle = surface_.names[along][2];  // "x_mid"
        set.name = middle.substr(0, middle.size() - 4) + (edgesOnly ? "_edges" : "_lines");
        Lattice p{};
        for (p[1 - along] = 0; p[1 - along] < size_[1 - along]; ++p[1 - along])
          if (!edgesOnly || p[1 - along] % 2 == 0) addLine(p, along, set);
        set.id = static_cast<long long>(mesh_.nodeSets.size()) + 1;
        mesh_.nodeSets.push_back(std::move(set));
      }
  }

  /// The line through the lattice point p, where it has nodes.
  void addLine(Lattice p, int along, NodeSet& set) {
    const int cells = surface_.divisions[along];
    const auto node = [&](int at) {
      p[along] = at;
      return nodeAt(p);
    };
    if (node(0) < 0) return;
    const bool threeNodes = node(1) >= 0;
    std::vector<double> lengths, shares(2 * static_cast<std::size_t>(cells) + 1, 0.0);
    double whole = 0;
    for (int c = 0; c < cells; ++c) {
      const double* x = &mesh_.coordinates[3 * static_cast<std::size_t>(node(2 * c))];
      const double* y = &mesh_.coordinates[3 * static_cast<std::size_t>(node(2 * c + 2))];
      lengths.push_back(std::hypot(y[0] - x[0], y[1] - x[1], y[2] - x[2]));
      whole += lengths.back();
    }
    for (int c = 0; c < cells; ++c) {
      const double length = lengths[c] / whole;
      shares[2 * c] += length * (threeNodes ? 1.0 / 6 : 0.5);
      shares[2 * c + 1] += length * (threeNodes ? 2.0 / 3 : 0.0);
      shares[2 * c + 2] += length * (threeNodes ? 1.0 / 6 : 0.5);
    }
    if (surface_.closed[along]) shares.front() += shares.back();
    for (int at = 0; at < size_[along]; ++at) {
      if (node(at) < 0) continue;
      set.nodes.push_back(node(at));
      set.factors.push_back(shares[at]);
    }
  }

  void addSideSets() {
    // Edge of a cell at the min and max of each direction, 0-based: 1-2 at b min, 2-3 at a max, 3-4 at b max.
    constexpr int edges[2][2] = {{5, 3}, {2, 4}};
    for (int d = 0; d < 2; ++d)
      for (int end = 0; end < 2; ++end) {
        SideSet set{surface_.names[d][end], 2 * d + end + 1, {}};
        int element = 0;
        forEachCell([&](const Lattice& cell) {
          if (cell[d] == (end == 0 ? 0 : surface_.divisions[d] - 1))
            set.sides.push_back({element, edges[d][end]});
          ++element;
        });
        if (!surface_.closed[d]) mesh_.sideSets.push_back(std::move(set));
      }
    for (int face = 0; face < 2; ++face) {
      SideSet set{surface_.faces[face], 5 + face, {}};
      for (int e = 0; e < mesh_.numElements(); ++e) set.sides.push_back({e, face});
      mesh_.sideSets.push_back(std::move(set));
    }
  }

  /// Two triangles in place of each quadrilateral, with diagonals in turn; of SHELL9 with its centre on them.
  void splitCells() {
    constexpr int triangles[2][2][6] = {{{0, 1, 2, 4, 5, 8}, {0, 2, 3, 8, 6, 7}},
                                        {{0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 6, 8}}};
    // Triangle of the cell and side of it, by diagonal and edge of the cell.
    constexpr int edges[2][4][2] = {{{0, 2}, {0, 3}, {1, 3}, {1, 4}}, {{0, 2}, {1, 2}, {1, 3}, {0, 4}}};
    Block& block = mesh_.blocks[0];
    const int N = nodesPerElement(block.topology), own = nodesPerElement(surface_.topology);
    std::vector<int> nodes, diagonal;
    forEachCell([&](const Lattice& at) {
      const int* quad = &block.nodes[N * diagonal.size()];
      diagonal.push_back((at[0] + at[1]) % 2);
      for (const auto& triangle : triangles[diagonal.back()])
        for (int n = 0; n < own; ++n) nodes.push_back(quad[triangle[n]]);
    });
    block.topology = surface_.topology;
    block.nodes = std::move(nodes);
    block.attributes.resize(2 * block.attributes.size(), surface_.thickness);
    for (SideSet& set : mesh_.sideSets) {
      std::vector<Side> sides;
      for (const Side& side : set.sides) {
        const int first = 2 * side.element;
        if (side.side < 2) {
          sides.push_back({first, side.side});
          sides.push_back({first + 1, side.side});
        } else {
          const auto& [triangle, edge] = edges[diagonal[side.element]][side.side - 2];
          sides.push_back({first + triangle, edge});
        }
      }
      set.sides = std::move(sides);
    }
  }

  const Surface& surface_;
  Lattice size_{};                // number of different lattice points in each direction
  int outer_ = 0;                 // the direction that changes last in the numbering
  std::vector<int> nodeOfPoint_;  // -1 where no node is
  std::vector<Lattice> pointOfNode_;
  Mesh mesh_;
};

void require(bool condition, const std::string& surface, const std::string& requirement) {
  if (!condition) throw std::invalid_argument(surface + ": " + requirement);
}

void requirePositive(double value, const std::string& surface, const std::string& name) {
  require(std::isfinite(value) && value > 0, surface,
          name + " must be above 0, got " + std::to_string(value));
}

void requireFinite(double value, const std::string& surface, const std::string& name) {
  require(std::isfinite(value), surface, name + " must be a finite number");
}

void requireAngles(double min, double max, int divisions, const std::string& surface,
                   const std::string& name) {
  requireFinite(min, surface, name + "Min");
  requireFinite(max, surface, name + "Max");
  require(max > min, surface, name + "Max must be above " + name + "Min");
  require(max - min <= 360, surface, name + " must span at most 360 degrees");
  require((max - min) / divisions <= 90, surface, "more than 90 degrees of " + name + " per cell");
}

constexpr double radiansPerDegree = 3.14159265358979323846 / 180.0;

double between(double min, double max, double s) { return s == 1.0 ? max : min + s * (max - min); }

/// A lattice coordinate in [0, 1] of corners of cells moved towards the nearer end, symmetric about the
/// middle; nodes between corners stay halfway.
double graded(double s, int divisions, double power) {
  if (power == 1) return s;
  const auto corner = [&](double c) {
    const double x = c / divisions;
    return x < 0.5 ? 0.5 * std::pow(2 * x, power) : 1 - 0.5 * std::pow(2 - 2 * x, power);
  };
  const double half = 0.5 * std::round(2 * s * divisions);
  return 0.5 * (corner(std::floor(half)) + corner(std::ceil(half)));
}

/// What all options have in common.
template <class Options>
Surface common(const Options& options, const std::string& title) {
  double points = 1.0;
  for (int n : options.divisions) {
    require(n >= 1, title, "each of the divisions must be at least 1, got " + std::to_string(n));
    points *= 2.0 * n + 1.0;
  }
  require(points < std::numeric_limits<int>::max(), title, "too many divisions for one mesh");
  require(isShell(options.topology), title,
          std::string("cells must be SHELL3, SHELL4, SHELL6, SHELL8 or SHELL9, got ") +
              topologyName(options.topology));
  require(std::isfinite(options.thickness) && options.thickness >= 0, title,
          "thickness must not be below 0, got " + std::to_string(options.thickness));
  Surface surface;
  surface.title = title;
  surface.blockName = options.blockName;
  surface.topology = options.topology;
  surface.divisions = options.divisions;
  surface.thickness = options.thickness;
  return surface;
}

}  // namespace

Mesh shellPlateMesh(const ShellPlateOptions& options) {
  const std::string kind = "shell plate";
  Surface surface = common(options, kind);
  requirePositive(options.length, kind, "length");
  requirePositive(options.width, kind, "width");
  require(options.angle > 0 && options.angle < 180, kind, "angle must be above 0 and below 180 degrees");
  for (double x : options.origin) requireFinite(x, kind, "origin");
  require(std::isfinite(options.grading) && options.grading >= 1, kind,
          "grading must be at least 1, got " + std::to_string(options.grading));
  surface.names = {{{"x_min", "x_max", "x_mid"}, {"y_min", "y_max", "y_mid"}}};
  surface.faces = {"top", "bottom"};
  // A right angle gives exact coordinates.
  const double c = options.angle == 90 ? 0 : std::cos(radiansPerDegree * options.angle),
               s = options.angle == 90 ? 1 : std::sin(radiansPerDegree * options.angle);
  require(options.grading == 1 || options.fine[0].divisions + options.fine[1].divisions == 0, kind,
          "fine ends are not for a graded one");
  const FineAxis alongLength(options.fine[0], options.length, options.divisions[0]),
      alongWidth(options.fine[1], options.width, options.divisions[1]);
  surface.position = [&](double a, double b) {
    const Point& o = options.origin;
    a = alongLength.at(graded(a, options.divisions[0], options.grading));
    b = alongWidth.at(graded(b, options.divisions[1], options.grading));
    return Point{o[0] + a * options.length + b * options.width * c, o[1] + b * options.width * s, o[2]};
  };
  return SurfaceMesher(surface).build();
}

Mesh shellCylinderMesh(const ShellCylinderOptions& options) {
  const std::string kind = "shell cylinder";
  Surface surface = common(options, kind);
  requirePositive(options.radius, kind, "radius");
  requireAngles(options.thetaMin, options.thetaMax, options.divisions[0], kind, "theta");
  requirePositive(options.length, kind, "length");
  requireFinite(options.yMin, kind, "yMin");
  require(std::isfinite(options.tangent) && options.tangent >= 0, kind,
          "tangent must not be below 0, got " + std::to_string(options.tangent));
  require(options.tangent > 0 ? options.tangentDivisions >= 1 : options.tangentDivisions == 0, kind,
          "tangent and tangentDivisions come together, got " + std::to_string(options.tangent) + " and " +
              std::to_string(options.tangentDivisions));
  surface.closed[0] = options.thetaMax - options.thetaMin == 360 && !options.slit;
  require(!surface.closed[0] || options.tangent == 0, kind, "a closed cylinder has no tangent plane");
  surface.divisions[0] += options.tangentDivisions;
  surface.names = {{{"theta_min", "theta_max", "theta_mid"}, {"y_min", "y_max", "y_mid"}}};
  surface.faces = {"outer", "inner"};
  surface.position = [&](double a, double b) {
    // Half elements along both parts, counted: the border between them is exact.
    const double at = std::round(2 * a * surface.divisions[0]), arc = 2 * options.divisions[0],
                 beyond = at > arc ? options.tangent * ((at - arc) / (2 * options.tangentDivisions)) : 0,
                 theta =
                     radiansPerDegree * between(options.thetaMin, options.thetaMax, std::min(at / arc, 1.0));
    return Point{options.radius * std::sin(theta) + beyond * std::cos(theta),
                 options.yMin + b * options.length,
                 options.radius * std::cos(theta) - beyond * std::sin(theta)};
  };
  return SurfaceMesher(surface).build();
}

Mesh shellAnnulusMesh(const ShellAnnulusOptions& options) {
  const std::string kind = "shell annulus";
  Surface surface = common(options, kind);
  requirePositive(options.innerRadius, kind, "innerRadius");
  requirePositive(options.outerRadius, kind, "outerRadius");
  require(options.outerRadius > options.innerRadius, kind, "outerRadius must be above innerRadius");
  requireAngles(options.angleMin, options.angleMax, options.divisions[1], kind, "angle");
  surface.closed[1] = options.angleMax - options.angleMin == 360 && !options.slit;
  surface.names = {{{"inner", "outer", "radius_mid"}, {"angle_min", "angle_max", "angle_mid"}}};
  surface.faces = {"top", "bottom"};
  surface.position = [&](double a, double b) {
    const double r = between(options.innerRadius, options.outerRadius, a),
                 angle = radiansPerDegree * between(options.angleMin, options.angleMax, b);
    return Point{r * std::cos(angle), r * std::sin(angle), 0.0};
  };
  return SurfaceMesher(surface).build();
}

Mesh shellSphereMesh(const ShellSphereOptions& options) {
  const std::string kind = "shell sphere";
  Surface surface = common(options, kind);
  requirePositive(options.radius, kind, "radius");
  requireAngles(options.longitudeMin, options.longitudeMax, options.divisions[0], kind, "longitude");
  requireAngles(options.latitudeMin, options.latitudeMax, options.divisions[1], kind, "latitude");
  require(options.latitudeMin > -90 && options.latitudeMax < 90, kind,
          "latitudes must stay strictly between -90 and 90 degrees");
  surface.closed[0] = options.longitudeMax - options.longitudeMin == 360 && !options.slit;
  surface.names = {{{"longitude_min", "longitude_max", "longitude_mid"},
                    {"latitude_min", "latitude_max", "latitude_mid"}}};
  surface.faces = {"outer", "inner"};
  surface.position = [&](double a, double b) {
    const double lon = radiansPerDegree * between(options.longitudeMin, options.longitudeMax, a);
    const double lat = radiansPerDegree * between(options.latitudeMin, options.latitudeMax, b);
    return Point{options.radius * std::cos(lat) * std::cos(lon),
                 options.radius * std::cos(lat) * std::sin(lon), options.radius * std::sin(lat)};
  };
  return SurfaceMesher(surface).build();
}

}  // namespace atrapos::fem
