#include "atrapos/fem/ReferenceCell.hpp"

#include <Intrepid2_DefaultCubatureFactory.hpp>
#include <Intrepid2_HGRAD_HEX_C1_FEM.hpp>
#include <Intrepid2_HGRAD_HEX_C2_FEM.hpp>
#include <Intrepid2_HGRAD_LINE_C1_FEM.hpp>
#include <Intrepid2_HGRAD_QUAD_C1_FEM.hpp>
#include <Intrepid2_HGRAD_QUAD_C2_FEM.hpp>
#include <Intrepid2_HGRAD_TET_C1_FEM.hpp>
#include <Intrepid2_HGRAD_TET_C2_FEM.hpp>
#include <Intrepid2_HGRAD_TRI_C1_FEM.hpp>
#include <Intrepid2_HGRAD_TRI_C2_FEM.hpp>
#include <Intrepid2_HGRAD_WEDGE_C1_FEM.hpp>
#include <Kokkos_Core.hpp>
#include <Kokkos_DynRankView.hpp>
#include <Shards_CellTopology.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace atrapos::fem {
namespace {

// Set-up data live on the host, whatever device the element loops use.
using Host = Kokkos::Device<Kokkos::DefaultHostExecutionSpace, Kokkos::HostSpace>;
using HostView = Kokkos::DynRankView<double, Host>;

constexpr int maxDegree = 20;  // the largest that Intrepid2 has on lines, triangles and tetrahedra

[[noreturn]] void unknownShape() {
  throw std::invalid_argument("reference cell: unknown cell or face shape");
}

void requireKokkos() {
  if (!Kokkos::is_initialized())
    throw std::logic_error("reference cell: Kokkos must be initialised before shape functions are tabulated");
}

template <class Traits>
shards::CellTopology shardsCell() {
  return shards::CellTopology(shards::getCellTopologyData<Traits>());
}

shards::CellTopology cellOf(Topology topology) {
  switch (topology) {
    case Topology::Hex8:
      return shardsCell<shards::Hexahedron<8>>();
    case Topology::Hex20:
      return shardsCell<shards::Hexahedron<20>>();
    case Topology::Hex27:
      return shardsCell<shards::Hexahedron<27>>();
    case Topology::Tet4:
      return shardsCell<shards::Tetrahedron<4>>();
    case Topology::Tet10:
      return shardsCell<shards::Tetrahedron<10>>();
    case Topology::Wedge6:
      return shardsCell<shards::Wedge<6>>();
    case Topology::Wedge15:
      return shardsCell<shards::Wedge<15>>();
    case Topology::Shell4:
    case Topology::Quad4:
      return shardsCell<shards::Quadrilateral<4>>();
    case Topology::Shell8:
    case Topology::Quad8:
      return shardsCell<shards::Quadrilateral<8>>();
    case Topology::Shell9:
    case Topology::Quad9:
      return shardsCell<shards::Quadrilateral<9>>();
    case Topology::Shell3:
    case Topology::Tri3:
      return shardsCell<shards::Triangle<3>>();
    case Topology::Shell6:
    case Topology::Tri6:
      return shardsCell<shards::Triangle<6>>();
    case Topology::Bar2:
      return shardsCell<shards::Line<2>>();
    case Topology::Bar3:
      return shardsCell<shards::Line<3>>();
  }
  unknownShape();
}

/// The cell whose sides are meant: a shell has two faces and its edges, its middle surface the edges.
shards::CellTopology cellWithSides(Topology topology) {
  switch (topology) {
    case Topology::Shell3:
      return shardsCell<shards::ShellTriangle<3>>();
    case Topology::Shell4:
      return shardsCell<shards::ShellQuadrilateral<4>>();
    case Topology::Shell6:
      return shardsCell<shards::ShellTriangle<6>>();
    case Topology::Shell8:
      return shardsCell<shards::ShellQuadrilateral<8>>();
    case Topology::Shell9:
      return shardsCell<shards::ShellQuadrilateral<9>>();
    default:
      return cellOf(topology);
  }
}

shards::CellTopology cellOf(Face face) {
  switch (face) {
    case Face::Tri3:
      return shardsCell<shards::Triangle<3>>();
    case Face::Tri6:
      return shardsCell<shards::Triangle<6>>();
    case Face::Quad4:
      return shardsCell<shards::Quadrilateral<4>>();
    case Face::Quad8:
      return shardsCell<shards::Quadrilateral<8>>();
    case Face::Quad9:
      return shardsCell<shards::Quadrilateral<9>>();
    case Face::Line2:
      return shardsCell<shards::Line<2>>();
    case Face::Line3:
      return shardsCell<shards::Line<3>>();
  }
  unknownShape();
}

std::vector<double> vertices(const shards::CellTopology& cell) {
  switch (cell.getBaseKey()) {
    case shards::Hexahedron<8>::key:
      return {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1};
    case shards::Tetrahedron<4>::key:
      return {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    case shards::Wedge<6>::key:
      return {0, 0, -1, 1, 0, -1, 0, 1, -1, 0, 0, 1, 1, 0, 1, 0, 1, 1};
    case shards::Quadrilateral<4>::key:
      return {-1, -1, 1, -1, 1, 1, -1, 1};
    case shards::Triangle<3>::key:
      return {0, 0, 1, 0, 0, 1};
    case shards::Line<2>::key:
      return {-1, 1};
  }
  unknownShape();
}

// Vertices, then the node at the middle of each edge and quadrilateral face where Shards says there is one.
// The one node that is on neither (Hex27's, Quad9's and Line3's own centre) lies at the origin.
std::vector<double> nodes(const shards::CellTopology& cell) {
  const int dim = cell.getDimension(), numVertices = cell.getVertexCount();
  std::vector<double> x = vertices(cell);
  x.resize(static_cast<size_t>(cell.getNodeCount()) * dim, 0.0);
  for (int d = 1; d < dim; ++d) {
    for (unsigned s = 0; s < cell.getSubcellCount(d); ++s) {
      const int corners = cell.getVertexCount(d, s), count = cell.getNodeCount(d, s);
      if (d == 2 && count != 9) continue;  // no node inside this face
      if (count == corners) continue;
      const int middle = cell.getNodeMap(d, s, count - 1);
      if (middle < numVertices) unknownShape();
      for (int i = 0; i < dim; ++i) {
        double sum = 0;
        for (int c = 0; c < corners; ++c) sum += x[cell.getNodeMap(d, s, c) * dim + i];
        x[middle * dim + i] = sum / corners;
      }
    }
  }
  return x;
}

// ---- shape functions

template <class Basis>
void fillFromIntrepid(Tabulation& t) {
  Basis basis;
  if (basis.getCardinality() != t.numNodes) unknownShape();
  HostView points("points", t.numPoints, t.dim), values("values", t.numNodes, t.numPoints),
      gradients("gradients", t.numNodes, t.numPoints, t.dim);
  for (int q = 0; q < t.numPoints; ++q)
    for (int i = 0; i < t.dim; ++i) points(q, i) = t.points[q * t.dim + i];
  basis.getValues(values, points, Intrepid2::OPERATOR_VALUE);
  basis.getValues(gradients, points, Intrepid2::OPERATOR_GRAD);
  Kokkos::fence();
  for (int q = 0; q < t.numPoints; ++q) {
    for (int n = 0; n < t.numNodes; ++n) {
      t.values[q * t.numNodes + n] = values(n, q);
      for (int i = 0; i < t.dim; ++i) t.gradients[(q * t.numNodes + n) * t.dim + i] = gradients(n, q, i);
    }
  }
}

// Serendipity function of the node at a in {-1,0,1}^dim (Zienkiewicz & Taylor, vol. 1): with f_i = 1 + a_i
// x_i, and f_m = 1 - x_m^2 along the edge of a mid-edge node,
//     corner  2^-dim (f_1 ... f_dim) (a.x - (dim-1)),     mid-edge  2^-(dim-1) f_1 ... f_dim.
double boxSerendipity(int dim, const double* a, const double* x, double* gradient) {
  std::array<double, 3> f{1, 1, 1}, df{0, 0, 0};
  double scale = 1, sum = -(dim - 1.0);
  bool corner = true;
  for (int i = 0; i < dim; ++i) {
    const bool alongEdge = a[i] == 0;
    f[i] = alongEdge ? 1 - x[i] * x[i] : 1 + a[i] * x[i];
    df[i] = alongEdge ? -2 * x[i] : a[i];
    scale *= alongEdge ? 1.0 : 0.5;
    sum += a[i] * x[i];
    corner = corner && !alongEdge;
  }
  const double product = scale * f[0] * f[1] * f[2];
  for (int i = 0; i < dim; ++i) {
    const double dProduct = scale * df[i] * f[(i + 1) % 3] * f[(i + 2) % 3];
    gradient[i] = corner ? dProduct * sum + product * a[i] : dProduct;
  }
  return corner ? product * sum : product;
}

// With the triangle's barycentric coordinates L (L_0 = 1 - xi - eta) and the sign s of the node's zeta:
//     corner    L_i [(2 L_i - 1)(1 + s zeta) - (1 - zeta^2)] / 2
//     mid-edge  2 L_i L_j (1 + s zeta) on a triangle,   L_i (1 - zeta^2) between the triangles.
double wedgeSerendipity(const double* a, const double* x, double* gradient) {
  const std::array<double, 3> L{1 - x[0] - x[1], x[0], x[1]};
  constexpr double dL[3][2] = {{-1, -1}, {1, 0}, {0, 1}};
  const std::array<double, 3> nodeL{1 - a[0] - a[1], a[0], a[1]};
  const int i = static_cast<int>(std::max_element(nodeL.begin(), nodeL.end()) - nodeL.begin());
  const double s = a[2], z = x[2], bubble = 1 - z * z;
  if (s == 0) {
    for (int d = 0; d < 2; ++d) gradient[d] = dL[i][d] * bubble;
    gradient[2] = -2 * z * L[i];
    return L[i] * bubble;
  }
  if (nodeL[i] == 1) {
    for (int d = 0; d < 2; ++d) gradient[d] = dL[i][d] * ((4 * L[i] - 1) * (1 + s * z) - bubble) / 2;
    gradient[2] = L[i] * ((2 * L[i] - 1) * s + 2 * z) / 2;
    return L[i] * ((2 * L[i] - 1) * (1 + s * z) - bubble) / 2;
  }
  const int j = nodeL[(i + 1) % 3] > 0 ? (i + 1) % 3 : (i + 2) % 3;
  for (int d = 0; d < 2; ++d) gradient[d] = 2 * (dL[i][d] * L[j] + L[i] * dL[j][d]) * (1 + s * z);
  gradient[2] = 2 * L[i] * L[j] * s;
  return 2 * L[i] * L[j] * (1 + s * z);
}

template <class Function>
void fillSerendipity(const shards::CellTopology& cell, Tabulation& t, Function function) {
  const std::vector<double> a = nodes(cell);
  for (int q = 0; q < t.numPoints; ++q)
    for (int n = 0; n < t.numNodes; ++n)
      t.values[q * t.numNodes + n] =
          function(&a[n * t.dim], &t.points[q * t.dim], &t.gradients[(q * t.numNodes + n) * t.dim]);
}

void fill(const shards::CellTopology& cell, Tabulation& t) {
  namespace i2 = Intrepid2;
  const auto box = [&t](const double* a, const double* x, double* g) {
    return boxSerendipity(t.dim, a, x, g);
  };
  switch (cell.getKey()) {
    case shards::Hexahedron<8>::key:
      return fillFromIntrepid<i2::Basis_HGRAD_HEX_C1_FEM<Host>>(t);
    case shards::Hexahedron<20>::key:
      return fillSerendipity(cell, t, box);
    case shards::Hexahedron<27>::key:
      return fillFromIntrepid<i2::Basis_HGRAD_HEX_C2_FEM<Host>>(t);
    case shards::Tetrahedron<4>::key:
      return fillFromIntrepid<i2::Basis_HGRAD_TET_C1_FEM<Host>>(t);
    case shards::Tetrahedron<10>::key:
      return fillFromIntrepid<i2::Basis_HGRAD_TET_C2_FEM<Host>>(t);
    case shards::Wedge<6>::key:
      return fillFromIntrepid<i2::Basis_HGRAD_WEDGE_C1_FEM<Host>>(t);
    case shards::Wedge<15>::key:
      return fillSerendipity(cell, t, wedgeSerendipity);
    case shards::Triangle<3>::key:
      return fillFromIntrepid<i2::Basis_HGRAD_TRI_C1_FEM<Host>>(t);
    case shards::Triangle<6>::key:
      return fillFromIntrepid<i2::Basis_HGRAD_TRI_C2_FEM<Host>>(t);
    case shards::Quadrilateral<4>::key:
      return fillFromIntrepid<i2::Basis_HGRAD_QUAD_C1_FEM<Host>>(t);
    case shards::Quadrilateral<8>::key:
      return fillSerendipity(cell, t, box);
    case shards::Quadrilateral<9>::key:
      return fillFromIntrepid<i2::Basis_HGRAD_QUAD_C2_FEM<Host>>(t);
    case shards::Line<2>::key:
      return fillFromIntrepid<i2::Basis_HGRAD_LINE_C1_FEM<Host>>(t);
    case shards::Line<3>::key:
      return fillSerendipity(cell, t, box);
  }
  unknownShape();
}

// ---- points

Tabulation atPoints(const shards::CellTopology& cell, const std::vector<double>& points) {
  requireKokkos();
  Tabulation t;
  t.dim = static_cast<int>(cell.getDimension());
  t.numNodes = static_cast<int>(cell.getNodeCount());
  if (points.size() % t.dim != 0)
    throw std::invalid_argument("reference cell: " + std::to_string(points.size()) +
                                " coordinates are no whole number of points of dimension " +
                                std::to_string(t.dim));
  t.numPoints = static_cast<int>(points.size()) / t.dim;
  t.points = points;
  t.values.resize(static_cast<size_t>(t.numPoints) * t.numNodes);
  t.gradients.resize(t.values.size() * t.dim);
  if (t.numPoints > 0) fill(cell, t);
  return t;
}

// degrees: of the simplex (or first line), then of the lines; what Intrepid2's factory takes.
Tabulation withCubature(const shards::CellTopology& cell, std::vector<int> degrees) {
  requireKokkos();
  const int degree = degrees[0];
  for (; degrees[0] <= maxDegree; ++degrees[0]) {
    const auto cubature = Intrepid2::DefaultCubatureFactory::create<Host>(cell, degrees);
    const int numPoints = cubature->getNumPoints(), dim = cubature->getDimension();
    HostView points("points", numPoints, dim), weights("weights", numPoints);
    cubature->getCubature(points, weights);
    Kokkos::fence();
    std::vector<double> x(static_cast<size_t>(numPoints) * dim), w(numPoints);
    for (int q = 0; q < numPoints; ++q) {
      w[q] = weights(q);
      for (int i = 0; i < dim; ++i) x[q * dim + i] = points(q, i);
    }
    // Some simplex rules have a negative weight, which makes mass matrices and fits indefinite: take the
    // next.
    if (*std::min_element(w.begin(), w.end()) <= 0) continue;
    Tabulation t = atPoints(cell, x);
    t.weights = w;
    return t;
  }
  throw std::invalid_argument("reference cell: no cubature of degree " + std::to_string(degree) +
                              " with positive weights on a " + cell.getName());
}

Tabulation withCubature(const shards::CellTopology& cell, int degree) {
  if (degree < 0 || degree > maxDegree)
    throw std::invalid_argument("reference cell: cubature degree " + std::to_string(degree) +
                                " is not within 0 to " + std::to_string(maxDegree));
  return withCubature(cell, std::vector<int>(3, degree));
}

std::vector<int> defaultDegrees(Topology topology) {
  switch (topology) {
    case Topology::Hex8:
      return {3, 3, 3};
    case Topology::Hex20:
      return {3, 3, 3};
    case Topology::Hex27:
      return {5, 5, 5};
    case Topology::Tet4:
      return {1};
    case Topology::Tet10:
      return {2};
    case Topology::Wedge6:
      return {2, 3};
    case Topology::Wedge15:
      return {2, 5};
    case Topology::Shell4:
    case Topology::Shell8:
    case Topology::Quad4:
    case Topology::Quad8:
      return {3, 3};
    case Topology::Shell9:
    case Topology::Quad9:
      return {5, 5};
    case Topology::Tri3:
      return {1};
    case Topology::Shell3:
    case Topology::Shell6:
    case Topology::Tri6:
      return {2};
    case Topology::Bar2:
      return {1};
    case Topology::Bar3:
      return {3};
  }
  unknownShape();
}

// ---- extrapolation

Topology vertexCell(Topology topology) {
  switch (cellOf(topology).getBaseKey()) {
    case shards::Hexahedron<8>::key:
      return Topology::Hex8;
    case shards::Tetrahedron<4>::key:
      return Topology::Tet4;
    case shards::Wedge<6>::key:
      return Topology::Wedge6;
    case shards::Quadrilateral<4>::key:
      return Topology::Quad4;
    case shards::Triangle<3>::key:
      return Topology::Tri3;
    case shards::Line<2>::key:
      return Topology::Bar2;
  }
  unknownShape();
}

// Lower Cholesky factor of the symmetric n x n matrix a, in place; false where it is not safely definite.
bool factorize(int n, std::vector<double>& a) {
  double largest = 0;
  for (int i = 0; i < n; ++i) largest = std::max(largest, a[i * n + i]);
  for (int j = 0; j < n; ++j) {
    for (int i = j; i < n; ++i) {
      for (int k = 0; k < j; ++k) a[i * n + j] -= a[i * n + k] * a[j * n + k];
      // Pivots of a determined fit are within about 1e-3 of each other; those of an undetermined one round to
      // 1e-16.
      if (i == j && !(a[j * n + j] > 1e-10 * largest)) return false;
      a[i * n + j] = i == j ? std::sqrt(a[j * n + j]) : a[i * n + j] / a[j * n + j];
    }
  }
  return true;
}

void solveFactorized(int n, const std::vector<double>& l, double* x) {
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < i; ++k) x[i] -= l[i * n + k] * x[k];
    x[i] /= l[i * n + i];
  }
  for (int i = n - 1; i >= 0; --i) {
    for (int k = i + 1; k < n; ++k) x[i] -= l[k * n + i] * x[k];
    x[i] /= l[i * n + i];
  }
}

/// A side as Shards counts it: faces (dimension 2) first, then edges (dimension 1) of shells and plane cells.
struct SideOfCell {
  shards::CellTopology cell;
  int dimension, number;
};

SideOfCell sideOf(Topology topology, int side) {
  const shards::CellTopology cell = cellWithSides(topology);
  const int faces = isPlane(topology) ? 0 : static_cast<int>(cell.getSubcellCount(2)),
            sides = numSides(topology);
  if (side < 0 || side >= sides)
    throw std::out_of_range("reference cell: side " + std::to_string(side) + " of a " + cell.getName() +
                            " is not within 0 to " + std::to_string(sides - 1));
  return side < faces ? SideOfCell{cell, 2, side} : SideOfCell{cell, 1, side - faces};
}

}  // namespace

Tabulation tabulate(Topology topology) { return withCubature(cellOf(topology), defaultDegrees(topology)); }

Tabulation tabulate(Topology topology, int degree) { return withCubature(cellOf(topology), degree); }

Tabulation tabulateAt(Topology topology, const std::vector<double>& points) {
  return atPoints(cellOf(topology), points);
}

Tabulation tabulateFace(Face face, int degree) { return withCubature(cellOf(face), degree); }

Tabulation tabulateFaceAt(Face face, const std::vector<double>& points) {
  return atPoints(cellOf(face), points);
}

std::vector<double> referenceNodes(Topology topology) { return nodes(cellOf(topology)); }

std::vector<double> referenceNodes(Face face) { return nodes(cellOf(face)); }

bool isLine(Face face) { return face == Face::Line2 || face == Face::Line3; }

int numCorners(Face face) {
  if (isLine(face)) return 2;
  return face == Face::Tri3 || face == Face::Tri6 ? 3 : 4;
}

int numSides(Topology topology) {
  if (isBar(topology)) return 0;
  const shards::CellTopology cell = cellWithSides(topology);
  if (isPlane(topology)) return static_cast<int>(cell.getSubcellCount(1));
  return static_cast<int>(cell.getSubcellCount(2) + (isShell(topology) ? cell.getSubcellCount(1) : 0));
}

Face sideFace(Topology topology, int side) {
  const auto [cell, dimension, number] = sideOf(topology, side);
  switch (cell.getKey(dimension, number)) {
    case shards::Triangle<3>::key:
      return Face::Tri3;
    case shards::Triangle<6>::key:
      return Face::Tri6;
    case shards::Quadrilateral<4>::key:
      return Face::Quad4;
    case shards::Quadrilateral<8>::key:
      return Face::Quad8;
    case shards::Quadrilateral<9>::key:
      return Face::Quad9;
    case shards::Line<2>::key:
      return Face::Line2;
    case shards::Line<3>::key:
      return Face::Line3;
  }
  unknownShape();
}

std::vector<int> sideNodes(Topology topology, int side) {
  const auto [cell, dimension, number] = sideOf(topology, side);
  std::vector<int> result(cell.getNodeCount(dimension, number));
  for (size_t i = 0; i < result.size(); ++i) result[i] = cell.getNodeMap(dimension, number, i);
  return result;
}

std::vector<double> extrapolation(Topology topology, const Tabulation& tabulation) {
  const shards::CellTopology cell = cellOf(topology);
  const int numNodes = static_cast<int>(cell.getNodeCount()), numPoints = tabulation.numPoints;
  if (tabulation.dim != static_cast<int>(cell.getDimension()) || tabulation.numNodes != numNodes ||
      numPoints < 1 || static_cast<int>(tabulation.weights.size()) != numPoints)
    throw std::invalid_argument("reference cell: extrapolation needs a cubature of the same cell");
  std::vector<double> result(static_cast<size_t>(numNodes) * numPoints, 1.0);
  if (numPoints == 1) return result;

  // Fit: minimise sum_q w_q (sum_v c_v phi_v(x_q) - f_q)^2; normal matrix M_uv = sum_q w_q phi_u phi_v.
  const Topology parent = vertexCell(topology);
  const Tabulation atPoints = tabulateAt(parent, tabulation.points);
  const Tabulation atNodes = tabulateAt(parent, referenceNodes(topology));
  const int n = atPoints.numNodes;
  std::vector<double> normal(static_cast<size_t>(n) * n, 0.0), coefficients(n);
  for (int q = 0; q < numPoints; ++q)
    for (int u = 0; u < n; ++u)
      for (int v = 0; v < n; ++v)
        normal[u * n + v] += tabulation.weights[q] * atPoints.values[q * n + u] * atPoints.values[q * n + v];
  if (!factorize(n, normal))
    throw std::invalid_argument("reference cell: " + std::to_string(numPoints) +
                                " cubature points determine no fit in " + std::to_string(n) +
                                " shape functions");
  for (int q = 0; q < numPoints; ++q) {
    for (int v = 0; v < n; ++v) coefficients[v] = tabulation.weights[q] * atPoints.values[q * n + v];
    solveFactorized(n, normal, coefficients.data());
    for (int node = 0; node < numNodes; ++node) {
      double sum = 0;
      for (int v = 0; v < n; ++v) sum += atNodes.values[node * n + v] * coefficients[v];
      result[node * numPoints + q] = sum;
    }
  }
  return result;
}

}  // namespace atrapos::fem
