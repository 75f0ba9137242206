#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "Labels.hpp"
#include "SurfaceFaces.hpp"
#include "atrapos/fem/LineSet.hpp"

namespace atrapos::fem {
namespace {

/// An edge of the reference quadrilateral, from and to its corners in the sense of the coordinate that grows.
struct Edge {
  int from, to, middle;
};
constexpr Edge kEdges[4] = {{0, 1, 4}, {1, 2, 5}, {3, 2, 6}, {0, 3, 7}};
/// [direction of lines][start, end] the edges at which lines along xi, along eta begin and end.
constexpr int kEnds[2][2] = {{3, 1}, {0, 2}};

int directionThrough(int edge) { return edge % 2 == 1 ? 0 : 1; }

/// The coefficients of a polynomial of degree 1 or 2 from its values at -1, 0, 1.
void polynomial(int degree, const double* at, double* k) {
  k[0] = at[1];
  k[1] = 0.5 * (at[2] - at[0]);
  if (degree == 2) k[2] = 0.5 * (at[2] + at[0]) - at[1];
}

/// Lines of one direction across the reference cell, for all faces of a shape.
struct Pattern {
  Tabulation points;                 ///< [line, point]
  std::vector<double> shape, slope;  ///< [line][a][k]: N_a along the line, and its derivative across

  Pattern(Face face, int direction, int degree, const Tabulation& gauss) {
    const int n = gauss.numPoints;
    std::vector<double> at, along;
    for (int j = 0; j < n; ++j) {
      for (int s = 0; s < n; ++s) {
        const double xi = gauss.points[s], eta = gauss.points[j];
        at.insert(at.end(), {direction == 0 ? xi : eta, direction == 0 ? eta : xi});
      }
      for (const double xi : {-1.0, 0.0, 1.0}) {
        const double eta = gauss.points[j];
        along.insert(along.end(), {direction == 0 ? xi : eta, direction == 0 ? eta : xi});
      }
    }
    points = tabulateFaceAt(face, at);
    for (int j = 0; j < n; ++j)
      for (int s = 0; s < n; ++s) points.weights.push_back(gauss.weights[j] * gauss.weights[s]);
    const Tabulation t = tabulateFaceAt(face, along);
    const int N = t.numNodes, across = 1 - direction;
    for (int j = 0; j < n; ++j)
      for (int a = 0; a < N; ++a) {
        double value[3], rate[3], k[3];
        for (int i = 0; i < 3; ++i) {
          value[i] = t.values[(3 * j + i) * N + a];
          rate[i] = t.gradients[((3 * j + i) * N + a) * 2 + across];
        }
        polynomial(degree, value, k);
        shape.insert(shape.end(), k, k + degree + 1);
        polynomial(degree, rate, k);
        slope.insert(slope.end(), k, k + degree + 1);
      }
  }
};

/// Which corners of faces are the same: those with the same node and director.
class Corners {
 public:
  explicit Corners(const std::vector<SurfaceFace>& faces) {
    for (const SurfaceFace& face : faces) {
      const std::size_t N = face.places.size();
      for (std::size_t c = 0; c < 4; ++c) {
        const std::pair key(face.nodes[c], face.nodes.size() > N ? face.nodes[N + c] : -1);
        const int next = static_cast<int>(numbers_.size());
        of_.push_back(numbers_.try_emplace(key, next).first->second);
      }
    }
  }
  int of(int face, int corner) const { return of_[4 * face + corner]; }
  std::pair<int, int> ofEdge(int face, int edge) const {
    return std::minmax(of(face, kEdges[edge].from), of(face, kEdges[edge].to));
  }

 private:
  std::map<std::pair<int, int>, int> numbers_;
  std::vector<int> of_;  ///< [face][corner]
};

/// How much the gap changes along xi and along eta, over three lines each.
std::array<double, 2> changes(const SurfaceFace& face, const Tabulation& grid,
                              const std::function<double(const double*)>& gap) {
  double h[9];
  for (int q = 0; q < 9; ++q) {
    Vec3 x{};
    for (int a = 0; a < grid.numNodes; ++a) add(grid.values[q * grid.numNodes + a], face.places[a], x);
    h[q] = gap(x.data());
  }
  std::array<double, 2> sum{0, 0};
  for (int line = 0; line < 3; ++line)
    for (int d = 0; d < 2; ++d) {
      const auto at = [&](int i) { return d == 0 ? h[3 * line + i] : h[3 * i + line]; };
      sum[d] += std::max({at(0), at(1), at(2)}) - std::min({at(0), at(1), at(2)});
    }
  return sum;
}

double edgeLength(const SurfaceFace& face, int edge) {
  const Vec3 &a = face.places[kEdges[edge].from], &b = face.places[kEdges[edge].to];
  return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

/// What each of the two families of lines of faces that hang together would be.
struct Families {
  double change[2] = {0, 0};  ///< of the gap along the lines, in sum
  double border[2] = {0, 0};  ///< length of the surface's border that lines cross
  double size = 0;            ///< of the faces' edges, in sum

  /// Along the second one the gap changes more; where both are alike, its lines are longer.
  bool secondIsBetter() const {
    // Alike to rounding: over a ball relative to the changes, over a plane, along which nothing changes, to
    // the places.
    const double alike = 1e-6 * std::max(change[0], change[1]) + 1e-12 * size;
    if (std::abs(change[1] - change[0]) > alike) return change[1] > change[0];
    return border[1] < (1 - 1e-6) * border[0];
  }
};

/// [face] the direction of its lines. They cross an edge in both of its faces or in none, as far as that can
/// be: from face to face through each set of faces that hangs together.
std::vector<int> directions(const std::vector<SurfaceFace>& faces, const Corners& corners,
                            const std::function<double(const double*)>& gap) {
  std::map<std::pair<int, int>, std::vector<std::pair<int, int>>> byEdge;  // face, its edge
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    for (int edge = 0; edge < 4; ++edge) byEdge[corners.ofEdge(f, edge)].emplace_back(f, edge);
  std::vector<double> reference;
  for (const double eta : {-0.5, 0.0, 0.5})
    for (const double xi : {-0.5, 0.0, 0.5}) reference.insert(reference.end(), {xi, eta});
  const Tabulation grid = tabulateFaceAt(faces[0].face, reference);
  std::vector<int> result(faces.size(), -1);
  for (std::size_t seed = 0; seed < faces.size(); ++seed) {
    if (result[seed] >= 0) continue;
    result[seed] = 0;
    std::vector<int> part{static_cast<int>(seed)};
    Families families;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const int f = part[i];
      const auto own = changes(faces[f], grid, gap);
      for (int d = 0; d < 2; ++d) families.change[d] += own[d == 0 ? result[f] : 1 - result[f]];
      for (int edge = 0; edge < 4; ++edge) {
        const bool through = directionThrough(edge) == result[f];
        const auto& sharing = byEdge.at(corners.ofEdge(f, edge));
        const double length = edgeLength(faces[f], edge);
        families.size += length;
        if (sharing.size() == 1) families.border[through ? 0 : 1] += length;
        for (const auto& [other, otherEdge] : sharing) {
          if (result[other] >= 0) continue;
          result[other] = through ? directionThrough(otherEdge) : 1 - directionThrough(otherEdge);
          part.push_back(other);
        }
      }
    }
    if (families.secondIsBetter())
      for (const int f : part) result[f] = 1 - result[f];
  }
  return result;
}

FaceLines linesAcross(const Mesh& mesh, const SideSet& set, const std::vector<SurfaceFace>& faces, int degree,
                      const std::function<double(const double*)>& gap) {
  const Face shape = faces[0].face;
  const int P = shape == Face::Quad4 ? 1 : 2, K = P + 1;
  const Tabulation gauss = tabulateFace(Face::Line2, degree);
  const int n = gauss.numPoints;
  const Pattern patterns[2] = {{shape, 0, P, gauss}, {shape, 1, P, gauss}};
  const Corners corners(faces);
  const std::vector<int> direction = directions(faces, corners, gap);
  FaceLines result;
  LineSet& lines = result.lines;
  lines.degree = P;
  lines.nodesPerLine = static_cast<int>(faces[0].nodes.size());
  lines.shown = gauss.points;
  std::map<std::array<int, 3>, int> ends;  // both corners of an edge, which of its lines
  for (int f = 0; f < static_cast<int>(faces.size()); ++f) {
    const SurfaceFace& face = faces[f];
    const Pattern& pattern = patterns[direction[f]];
    const int N = static_cast<int>(face.places.size());
    appendFace(mesh, set, pattern.points, face, result.points);
    for (int j = 0; j < n; ++j) {
      lines.nodes.insert(lines.nodes.end(), face.nodes.begin(), face.nodes.end());
      for (std::size_t a = 0; a < face.nodes.size(); ++a)
        for (int k = 0; k < K; ++k)
          lines.shape.push_back(face.factors[a] * pattern.shape[(j * N + a % N) * K + k]);
      int nearest = 0;
      for (int k = 0; k < K; ++k) {
        Vec3 x{}, across{};
        for (int a = 0; a < N; ++a) {
          add(pattern.shape[(j * N + a) * K + k], face.places[a], x);
          add(gauss.weights[j] * pattern.slope[(j * N + a) * K + k], face.places[a], across);
          // Largest at the line's middle, by more than rounding.
          if (k == 0 && pattern.shape[(j * N + a) * K] > pattern.shape[(j * N + nearest) * K] + 1e-9)
            nearest = a;
        }
        lines.coefficients.insert(lines.coefficients.end(), x.begin(), x.end());
        lines.across.insert(lines.across.end(), across.begin(), across.end());
      }
      lines.middleNodes.push_back(face.nodes[nearest]);
      for (const int e : kEnds[direction[f]]) {
        const Edge& edge = kEdges[e];
        const auto [low, high] = corners.ofEdge(f, e);
        const int place = corners.of(f, edge.from) == low ? j : n - 1 - j;
        const auto [end, isNew] = ends.try_emplace({low, high, place}, lines.numEnds());
        lines.ends.push_back(end->second);
        if (!isNew) continue;
        const bool half = 2 * j + 1 == n && N > 4;
        lines.endNodes.push_back(face.nodes[half ? edge.middle : 2 * j + 1 < n ? edge.from : edge.to]);
      }
    }
  }
  lines.weights = result.points.weights;
  return result;
}

}  // namespace

std::vector<FaceLines> faceLines(const Mesh& mesh, const ShellGeometry& shells, const SideSet& set,
                                 double zeta, int degree, const std::function<double(const double*)>& gap) {
  std::map<Face, std::vector<SurfaceFace>> byShape;
  for (SurfaceFace& face : surfaceFaces(mesh, shells, set, zeta)) {
    if (face.face == Face::Tri3 || face.face == Face::Tri6) {
      const auto [b, e] = addressOf(mesh, face.side.element);
      throw std::runtime_error(fmt::format(
          "side set '{}': side {} of {} is a triangle; zones of contact are found on lines across "
          "quadrilaterals",
          set.name, face.side.side + 1, elementLabel(mesh, b, e)));
    }
    byShape[face.face].push_back(std::move(face));
  }
  std::vector<FaceLines> result;
  for (const auto& [shape, faces] : byShape) result.push_back(linesAcross(mesh, set, faces, degree, gap));
  return result;
}

}  // namespace atrapos::fem
