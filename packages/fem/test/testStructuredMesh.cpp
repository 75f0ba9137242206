// Structured meshes: volumes, orientation, conformity, numbering of nodes and sides. The shape
// functions used here are made from monomials on the spot and the side tables are Shards', so that
// neither shares a table with the code under test.
#include <gtest/gtest.h>

#include <Shards_BasicTopologies.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "atrapos/fem/StructuredMesh.hpp"

using namespace atrapos::fem;

namespace {

using Point = std::array<double, 3>;

const std::vector<Topology> topologies = {Topology::Hex8,  Topology::Hex20,  Topology::Hex27,  Topology::Tet4,
                                          Topology::Tet10, Topology::Wedge6, Topology::Wedge15};

const CellTopologyData& shardsCell(Topology topology) {
  switch (topology) {
    case Topology::Hex8:
      return *shards::getCellTopologyData<shards::Hexahedron<8>>();
    case Topology::Hex20:
      return *shards::getCellTopologyData<shards::Hexahedron<20>>();
    case Topology::Hex27:
      return *shards::getCellTopologyData<shards::Hexahedron<27>>();
    case Topology::Tet4:
      return *shards::getCellTopologyData<shards::Tetrahedron<4>>();
    case Topology::Tet10:
      return *shards::getCellTopologyData<shards::Tetrahedron<10>>();
    case Topology::Wedge6:
      return *shards::getCellTopologyData<shards::Wedge<6>>();
    case Topology::Wedge15:
      return *shards::getCellTopologyData<shards::Wedge<15>>();
    default:
      break;
  }
  throw std::logic_error("topology");
}

bool isHex(Topology t) { return t == Topology::Hex8 || t == Topology::Hex20 || t == Topology::Hex27; }
bool isTet(Topology t) { return t == Topology::Tet4 || t == Topology::Tet10; }
bool isQuadratic(Topology t) { return t != Topology::Hex8 && t != Topology::Tet4 && t != Topology::Wedge6; }
int elementsPerCell(Topology t) { return isHex(t) ? 1 : isTet(t) ? 6 : 2; }

// Reference cells here: [0,1]^3, the unit simplex, unit triangle times [0,1].
std::vector<Point> referenceNodes(Topology topology) {
  const CellTopologyData& cell = shardsCell(topology);
  std::vector<Point> nodes;
  if (isHex(topology))
    nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  else if (isTet(topology))
    nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  else
    nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  const auto corners = nodes;
  nodes.resize(cell.node_count, Point{0.5, 0.5, 0.5});  // HEX27's centroid is set by no edge or side
  if (isQuadratic(topology))
    for (unsigned e = 0; e < cell.edge_count; ++e) {
      const unsigned* n = cell.edge[e].node;
      for (int d = 0; d < 3; ++d) nodes[n[2]][d] = (corners[n[0]][d] + corners[n[1]][d]) / 2;
    }
  if (topology == Topology::Hex27)
    for (unsigned s = 0; s < cell.side_count; ++s) {
      const unsigned* n = cell.side[s].node;
      for (int d = 0; d < 3; ++d) {
        double sum = 0.0;
        for (int i = 0; i < 4; ++i) sum += corners[n[i]][d];
        nodes[n[8]][d] = sum / 4;
      }
    }
  return nodes;
}

// Exponents of the monomials that span the shape functions.
std::vector<std::array<int, 3>> monomials(Topology topology) {
  std::vector<std::array<int, 3>> result;
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; j <= 2; ++j)
      for (int k = 0; k <= 2; ++k) {
        const int squares = (i == 2) + (j == 2) + (k == 2);
        bool in = false;
        switch (topology) {
          case Topology::Hex8:
            in = squares == 0;
            break;
          case Topology::Hex20:
            in = squares <= 1;
            break;
          case Topology::Hex27:
            in = true;
            break;
          case Topology::Tet4:
            in = i + j + k <= 1;
            break;
          case Topology::Tet10:
            in = i + j + k <= 2;
            break;
          case Topology::Wedge6:
            in = i + j <= 1 && k <= 1;
            break;
          case Topology::Wedge15:
            in = i + j <= (k == 2 ? 1 : 2);
            break;
          default:
            break;
        }
        if (in) result.push_back({i, j, k});
      }
  return result;
}

double power(double x, int n) { return n < 0 ? 0.0 : n == 0 ? 1.0 : n == 1 ? x : x * x; }

// Solves A X = I by Gauss-Jordan elimination with row pivoting.
std::vector<std::vector<double>> inverse(std::vector<std::vector<double>> a) {
  const std::size_t n = a.size();
  for (std::size_t i = 0; i < n; ++i) {
    a[i].resize(2 * n, 0.0);
    a[i][n + i] = 1.0;
  }
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c; r < n; ++r)
      if (std::abs(a[r][c]) > std::abs(a[pivot][c])) pivot = r;
    if (std::abs(a[pivot][c]) < 1e-10) throw std::logic_error("nodes and monomials do not match");
    std::swap(a[c], a[pivot]);
    for (std::size_t r = 0; r < n; ++r) {
      if (r == c) continue;
      const double f = a[r][c] / a[c][c];
      for (std::size_t k = c; k < 2 * n; ++k) a[r][k] -= f * a[c][k];
    }
  }
  for (std::size_t r = 0; r < n; ++r) {
    const double d = a[r][r];
    a[r].erase(a[r].begin(), a[r].begin() + static_cast<long>(n));
    for (double& x : a[r]) x /= d;
  }
  return a;
}

// Integrates and samples Jacobian determinants of the elements of one topology.
class JacobianCheck {
 public:
  explicit JacobianCheck(Topology topology) : exponents_(monomials(topology)) {
    std::vector<std::vector<double>> vandermonde;
    for (const Point& x : referenceNodes(topology)) {
      vandermonde.emplace_back();
      for (const auto& e : exponents_)
        vandermonde.back().push_back(power(x[0], e[0]) * power(x[1], e[1]) * power(x[2], e[2]));
    }
    coefficients_ = inverse(vandermonde);
    // Gauss points on [0,1]^3, collapsed to the simplex or the wedge (Duffy). Four in each
    // direction integrate the determinant of every element here exactly: its degree is at most 5 in
    // one coordinate, plus 2 from the collapse.
    const double gauss[4] = {0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
                             0.93056815579702629};
    const double weight[4] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                              0.17392742256872693};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        for (int k = 0; k < 4; ++k) {
          const double u = gauss[i], v = gauss[j], w = gauss[k];
          double wt = weight[i] * weight[j] * weight[k];
          Point x{u, v, w};
          if (isTet(topology)) {
            x = {u, v * (1 - u), w * (1 - u) * (1 - v)};
            wt *= (1 - u) * (1 - u) * (1 - v);
          } else if (!isHex(topology)) {
            x = {u, v * (1 - u), w};
            wt *= 1 - u;
          }
          points_.push_back(x);
          weights_.push_back(wt);
        }
    numQuadrature_ = points_.size();
    for (const Point& x : referenceNodes(topology)) points_.push_back(x);  // corners: the worst places
  }

  struct Result {
    double volume = 0.0;
    double minDeterminant = 1e300;
  };

  Result operator()(const Mesh& mesh) const {
    Result result;
    const auto& nodes = mesh.blocks[0].nodes;
    const std::size_t n = exponents_.size();
    for (std::size_t first = 0; first < nodes.size(); first += n)
      for (std::size_t p = 0; p < points_.size(); ++p) {
        double j[3][3] = {};
        for (std::size_t m = 0; m < n; ++m)
          for (int d = 0; d < 3; ++d) {
            double derivative = 1.0;
            for (int q = 0; q < 3; ++q)
              derivative *= q == d ? exponents_[m][q] * power(points_[p][q], exponents_[m][q] - 1)
                                   : power(points_[p][q], exponents_[m][q]);
            for (int x = 0; x < 3; ++x) {
              double c = 0.0;
              for (std::size_t a = 0; a < n; ++a)
                c += coefficients_[m][a] * mesh.coordinates[3 * nodes[first + a] + x];
              j[x][d] += c * derivative;
            }
          }
        const double det = j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
                           j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
                           j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
        result.minDeterminant = std::min(result.minDeterminant, det);
        if (p < numQuadrature_) result.volume += det * weights_[p];
      }
    return result;
  }

 private:
  std::vector<std::array<int, 3>> exponents_;
  std::vector<std::vector<double>> coefficients_;  // [monomial][node]
  std::vector<Point> points_;
  std::vector<double> weights_;
  std::size_t numQuadrature_ = 0;
};

std::vector<int> sideNodes(const Mesh& mesh, const Side& side) {
  const Topology topology = mesh.blocks[0].topology;
  const CellTopologyData& cell = shardsCell(topology);
  const auto& s = cell.side[side.side];
  std::vector<int> nodes;
  for (unsigned i = 0; i < s.topology->node_count; ++i)
    nodes.push_back(mesh.blocks[0].nodes[side.element * cell.node_count + s.node[i]]);
  return nodes;
}

// Sorted nodes of a side -> how many elements have it.
std::map<std::vector<int>, int> countSides(const Mesh& mesh) {
  std::map<std::vector<int>, int> count;
  const int numSides = static_cast<int>(shardsCell(mesh.blocks[0].topology).side_count);
  for (int e = 0; e < mesh.numElements(); ++e)
    for (int s = 0; s < numSides; ++s) {
      auto nodes = sideNodes(mesh, {e, s});
      std::sort(nodes.begin(), nodes.end());
      ++count[nodes];
    }
  return count;
}

Point coordinatesOf(const Mesh& mesh, int node) {
  return {mesh.coordinates[3 * node], mesh.coordinates[3 * node + 1], mesh.coordinates[3 * node + 2]};
}

Mesh anyBox(Topology topology, std::array<int, 3> divisions = {3, 2, 4}) {
  BoxOptions options;
  options.lengths = {3.0, 0.5, 2.0};
  options.origin = {-1.0, 2.0, 0.25};
  options.divisions = divisions;
  options.topology = topology;
  return boxMesh(options);
}

CylinderPanelOptions anyCylinder(Topology topology, std::array<int, 3> divisions = {4, 3, 2}) {
  CylinderPanelOptions options;
  options.midRadius = 10.0;
  options.thickness = 0.2;
  options.thetaMin = -20.0;
  options.thetaMax = 40.0;
  options.length = 7.0;
  options.yMin = -1.0;
  options.divisions = divisions;
  options.topology = topology;
  return options;
}

SpherePanelOptions anySphere(Topology topology, std::array<int, 3> divisions = {4, 3, 2}) {
  SpherePanelOptions options;
  options.midRadius = 10.0;
  options.thickness = 0.04;
  options.divisions = divisions;
  options.topology = topology;
  return options;
}

constexpr double degree = 3.14159265358979323846 / 180.0;

double cylinderVolume(const CylinderPanelOptions& o) {
  return (o.thetaMax - o.thetaMin) * degree * o.midRadius * o.thickness * o.length;
}

double sphereVolume(const SpherePanelOptions& o) {
  const double outer = o.midRadius + o.thickness / 2, inner = o.midRadius - o.thickness / 2;
  return (o.longitudeMax - o.longitudeMin) * degree *
         (std::sin(o.latitudeMax * degree) - std::sin(o.latitudeMin * degree)) *
         (outer * outer * outer - inner * inner * inner) / 3;
}

}  // namespace

TEST(StructuredMesh, boxVolumeIsExactAndJacobiansPositive) {
  for (Topology topology : topologies) {
    SCOPED_TRACE(topologyName(topology));
    const Mesh mesh = anyBox(topology);
    const auto result = JacobianCheck(topology)(mesh);
    EXPECT_NEAR(result.volume, 3.0, 1e-12);  // round-off of a sum of a few thousand terms of order 1e-3
    // Each element is an affine image of its reference cell and fills the same share of its lattice
    // cell as that does of the unit cube, so each determinant is the volume of a lattice cell.
    EXPECT_NEAR(result.minDeterminant, 3.0 / 24, 1e-12);  // round-off of the Vandermonde inverse
  }
}

TEST(StructuredMesh, panelJacobiansArePositive) {
  for (Topology topology : topologies) {
    SCOPED_TRACE(topologyName(topology));
    EXPECT_GT(JacobianCheck(topology)(cylinderPanelMesh(anyCylinder(topology))).minDeterminant, 0.0);
    EXPECT_GT(JacobianCheck(topology)(spherePanelMesh(anySphere(topology))).minDeterminant, 0.0);
  }
}

// Halving the cells divides the volume error by 4 for chords and by 16 for quadratic nodes on the
// true geometry; were those on chords, quadratic meshes would show 4 too.
TEST(StructuredMesh, panelVolumesConvergeAtTheRateOfTheirOrder) {
  for (Topology topology : topologies) {
    SCOPED_TRACE(topologyName(topology));
    const JacobianCheck check(topology);
    double cylinderError[2], sphereError[2];
    for (int level = 0; level < 2; ++level) {
      const int n = 4 << level;
      const auto cylinder = anyCylinder(topology, {n, n, 1});
      const auto sphere = anySphere(topology, {n, n, 1});
      cylinderError[level] =
          std::abs(check(cylinderPanelMesh(cylinder)).volume / cylinderVolume(cylinder) - 1);
      sphereError[level] = std::abs(check(spherePanelMesh(sphere)).volume / sphereVolume(sphere) - 1);
    }
    const double rate = isQuadratic(topology) ? 4.0 : 2.0;
    // 0.2: cells of 15 degrees (30 for the sphere) are not yet quite in the asymptotic range.
    EXPECT_NEAR(std::log2(cylinderError[0] / cylinderError[1]), rate, 0.2);
    EXPECT_NEAR(std::log2(sphereError[0] / sphereError[1]), rate, 0.2);
  }
}

TEST(StructuredMesh, quadraticNodesLieOnTheTrueGeometry) {
  for (Topology topology : {Topology::Hex20, Topology::Hex27, Topology::Tet10, Topology::Wedge15}) {
    SCOPED_TRACE(topologyName(topology));
    const auto options = anyCylinder(topology);
    const Mesh mesh = cylinderPanelMesh(options);
    const Mesh sphere = spherePanelMesh(anySphere(topology));
    for (const char* face : {"inner", "outer"}) {
      const double sign = face[0] == 'i' ? -0.5 : 0.5;
      for (int node : mesh.nodeSets[findNodeSet(mesh, face)].nodes) {
        const Point x = coordinatesOf(mesh, node);
        EXPECT_NEAR(std::hypot(x[0], x[2]), 10.0 + sign * 0.2, 1e-13);  // a few units in the last place of 10
      }
      for (int node : sphere.nodeSets[findNodeSet(sphere, face)].nodes) {
        const Point x = coordinatesOf(sphere, node);
        EXPECT_NEAR(std::hypot(x[0], x[1], x[2]), 10.0 + sign * 0.04, 1e-13);  // as above
      }
    }
  }
}

TEST(StructuredMesh, nodeAndElementCounts) {
  const int a = 3, b = 2, c = 4, cells = a * b * c;
  const int points = (a + 1) * (b + 1) * (c + 1);
  const int edges = a * (b + 1) * (c + 1) + (a + 1) * b * (c + 1) + (a + 1) * (b + 1) * c;
  const int allPoints = (2 * a + 1) * (2 * b + 1) * (2 * c + 1);
  const std::map<Topology, int> expected = {
      {Topology::Hex8, points},
      {Topology::Hex20, points + edges},
      {Topology::Hex27, allPoints},
      {Topology::Tet4, points},
      {Topology::Tet10, allPoints},  // Kuhn's edges halve every edge, face diagonal and body diagonal
      {Topology::Wedge6, points},
      {Topology::Wedge15, points + edges + a * b * (c + 1)}};  // one diagonal in each face across c
  for (Topology topology : topologies) {
    SCOPED_TRACE(topologyName(topology));
    const Mesh mesh = anyBox(topology, {a, b, c});
    EXPECT_EQ(mesh.numNodes(), expected.at(topology));
    EXPECT_EQ(mesh.numElements(), cells * elementsPerCell(topology));
    const std::set<int> used(mesh.blocks[0].nodes.begin(), mesh.blocks[0].nodes.end());
    EXPECT_EQ(static_cast<int>(used.size()), mesh.numNodes());
    EXPECT_EQ(mesh.blocks[0].name, "body");
  }
}

TEST(StructuredMesh, facesConformAndSideSetsAreTheBoundary) {
  for (Topology topology : topologies) {
    SCOPED_TRACE(topologyName(topology));
    for (const Mesh& mesh :
         {anyBox(topology), cylinderPanelMesh(anyCylinder(topology)), spherePanelMesh(anySphere(topology))}) {
      SCOPED_TRACE(mesh.title);
      std::set<std::vector<int>> boundary, fromSets;
      for (const auto& [nodes, count] : countSides(mesh)) {
        EXPECT_LE(count, 2);
        if (count == 1) boundary.insert(nodes);
      }
      ASSERT_EQ(mesh.sideSets.size(), 6u);
      std::size_t listed = 0;
      for (const SideSet& set : mesh.sideSets)
        for (const Side& side : set.sides) {
          auto nodes = sideNodes(mesh, side);
          std::sort(nodes.begin(), nodes.end());
          fromSets.insert(nodes);
          ++listed;
        }
      EXPECT_EQ(listed, fromSets.size());
      EXPECT_EQ(fromSets, boundary);
    }
  }
}

TEST(StructuredMesh, boxSetsLieOnTheirFaces) {
  const double low[3] = {-1.0, 2.0, 0.25}, high[3] = {2.0, 2.5, 2.25};
  const char* names[3][2] = {{"x_min", "x_max"}, {"y_min", "y_max"}, {"z_min", "z_max"}};
  for (Topology topology : topologies) {
    SCOPED_TRACE(topologyName(topology));
    const Mesh mesh = anyBox(topology);
    for (int d = 0; d < 3; ++d)
      for (int end = 0; end < 2; ++end) {
        SCOPED_TRACE(names[d][end]);
        const double plane = end == 0 ? low[d] : high[d];
        const int sides = findSideSet(mesh, names[d][end]), nodes = findNodeSet(mesh, names[d][end]);
        ASSERT_GE(sides, 0);
        ASSERT_GE(nodes, 0);
        EXPECT_EQ(mesh.sideSets[sides].id, 2 * d + end + 1);
        EXPECT_EQ(mesh.nodeSets[nodes].id, 2 * d + end + 1);
        std::set<int> fromSides;
        for (const Side& side : mesh.sideSets[sides].sides)
          for (int node : sideNodes(mesh, side)) fromSides.insert(node);
        const auto& set = mesh.nodeSets[nodes].nodes;
        EXPECT_EQ(fromSides, std::set<int>(set.begin(), set.end()));
        std::size_t inPlane = 0;
        for (int node = 0; node < mesh.numNodes(); ++node)
          inPlane += std::abs(coordinatesOf(mesh, node)[d] - plane) < 1e-12;  // cells are 0.25 or more wide
        EXPECT_EQ(inPlane, set.size());
      }
  }
}

TEST(StructuredMesh, sidesPointOutwards) {
  for (Topology topology : topologies) {
    SCOPED_TRACE(topologyName(topology));
    const Mesh mesh = anyBox(topology);
    for (int set = 0; set < 6; ++set)
      for (const Side& side : mesh.sideSets[set].sides) {
        const auto nodes = sideNodes(mesh, side);
        const Point p = coordinatesOf(mesh, nodes[0]), q = coordinatesOf(mesh, nodes[1]),
                    r = coordinatesOf(mesh, nodes[2]);
        const int d = set / 2, u = (d + 1) % 3, v = (d + 2) % 3;
        const double normal = (q[u] - p[u]) * (r[v] - p[v]) - (q[v] - p[v]) * (r[u] - p[u]);
        EXPECT_GT(set % 2 == 0 ? -normal : normal, 0.0);
      }
  }
}

TEST(StructuredMesh, edgesCornersAndMidSets) {
  StripOptions options;
  options.length = 10.0;
  options.thickness = 0.1;
  options.divisions = {5, 2, 1};
  const Mesh mesh = stripMesh(options);
  const auto size = [&](const char* name) {
    const int set = findNodeSet(mesh, name);
    return set < 0 ? 0 : static_cast<int>(mesh.nodeSets[set].nodes.size());
  };
  EXPECT_EQ(size("top"), 6 * 3 + 5 * 3 + 6 * 2);  // corners and mid-edge nodes of 5 x 2 QUAD8
  EXPECT_EQ(size("x_max_top"), 5);
  EXPECT_EQ(size("y_min_bottom"), 11);
  EXPECT_EQ(size("x_min_y_max"), 3);
  EXPECT_EQ(size("x_max_y_max_top"), 1);
  EXPECT_EQ(size("mid"), 18);
  EXPECT_EQ(size("x_max_mid"), 3);
  EXPECT_EQ(size("x_max_y_min_mid"), 1);
  EXPECT_EQ(mesh.nodeSets.size(), 6u + 12 + 8 + 1 + 4 + 4);
  const Point x = coordinatesOf(mesh, mesh.nodeSets[findNodeSet(mesh, "x_max_y_min_mid")].nodes[0]);
  EXPECT_EQ(x, (Point{10.0, 0.0, 0.05}));
  std::set<std::string> names;
  for (const NodeSet& set : mesh.nodeSets) names.insert(set.name);
  EXPECT_EQ(names.size(), mesh.nodeSets.size());

  options.topology = Topology::Hex8;  // one linear layer has no nodes at mid-thickness
  EXPECT_EQ(findNodeSet(stripMesh(options), "mid"), -1);
  options.divisions[2] = 2;
  EXPECT_GE(findNodeSet(stripMesh(options), "x_max_mid"), 0);
}

TEST(StructuredMesh, hex20MidEdgeNodesRunBottomVerticalTop) {
  BoxOptions options;
  options.topology = Topology::Hex20;
  options.lengths = {2.0, 2.0, 2.0};
  const Mesh mesh = boxMesh(options);
  const std::vector<Point> exodus = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2},
                                     {2, 0, 2}, {2, 2, 2}, {0, 2, 2}, {1, 0, 0}, {2, 1, 0},
                                     {1, 2, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1},
                                     {0, 2, 1}, {1, 0, 2}, {2, 1, 2}, {1, 2, 2}, {0, 1, 2}};
  for (int i = 0; i < 20; ++i) EXPECT_EQ(coordinatesOf(mesh, mesh.blocks[0].nodes[i]), exodus[i]) << i;
}

TEST(StructuredMesh, bandwidthIsThatOfTheSmallestCrossSection) {
  for (std::array<int, 3> divisions :
       {std::array<int, 3>{40, 2, 1}, std::array<int, 3>{2, 40, 1}, std::array<int, 3>{1, 2, 40}}) {
    const Mesh mesh = anyBox(Topology::Hex8, divisions);
    int bandwidth = 0;
    const auto& nodes = mesh.blocks[0].nodes;
    for (std::size_t e = 0; e < nodes.size(); e += 8) {
      const auto [low, high] = std::minmax_element(nodes.begin() + e, nodes.begin() + e + 8);
      bandwidth = std::max(bandwidth, *high - *low);
    }
    EXPECT_EQ(bandwidth, 3 * 2 + 2 + 2 - 1);  // one section of 3 x 2 nodes, one row of 2, one node
  }
}

TEST(StructuredMesh, findsByNameThenById) {
  Mesh mesh = anyBox(Topology::Hex8);
  mesh.blocks.push_back(mesh.blocks[0]);
  mesh.blocks[1].name = "1";
  mesh.blocks[1].id = 7;
  EXPECT_EQ(findBlock(mesh, "body"), 0);
  EXPECT_EQ(findBlock(mesh, "7"), 1);
  EXPECT_EQ(findBlock(mesh, "1"), 1);  // the name wins over block 0's id
  EXPECT_EQ(findBlock(mesh, "no"), -1);
  EXPECT_EQ(findBlock(mesh, ""), -1);
  EXPECT_EQ(findSideSet(mesh, "4"), 3);
  EXPECT_EQ(findNodeSet(mesh, "y_max"), 3);
  EXPECT_EQ(mesh.numElements(), 2 * 24);
}

TEST(StructuredMesh, badNumbersThrow) {
  BoxOptions box;
  box.divisions = {1, 0, 1};
  EXPECT_THROW(boxMesh(box), std::invalid_argument);
  box.divisions = {30000, 30000, 30000};
  EXPECT_THROW(boxMesh(box), std::invalid_argument);
  box = {};
  box.lengths[2] = -1.0;
  EXPECT_THROW(boxMesh(box), std::invalid_argument);
  box.lengths[2] = std::nan("");
  EXPECT_THROW(boxMesh(box), std::invalid_argument);
  StripOptions strip;
  strip.thickness = 0.0;
  EXPECT_THROW(stripMesh(strip), std::invalid_argument);
  auto cylinder = anyCylinder(Topology::Hex20);
  cylinder.thetaMax = cylinder.thetaMin;
  EXPECT_THROW(cylinderPanelMesh(cylinder), std::invalid_argument);
  cylinder.thetaMax = cylinder.thetaMin + 360.0;
  EXPECT_THROW(cylinderPanelMesh(cylinder), std::invalid_argument);
  cylinder = anyCylinder(Topology::Hex20);
  cylinder.thickness = 2.0 * cylinder.midRadius;
  EXPECT_THROW(cylinderPanelMesh(cylinder), std::invalid_argument);
  auto sphere = anySphere(Topology::Hex20);
  sphere.latitudeMax = 90.0;
  EXPECT_THROW(spherePanelMesh(sphere), std::invalid_argument);
  try {
    box = {};
    box.divisions[1] = -3;
    boxMesh(box);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "box: each of the divisions must be at least 1, got -3");
  }
}
