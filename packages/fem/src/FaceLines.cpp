#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "SurfaceFaces.hpp"
#include "atrapos/fem/LineSet.hpp"

namespace atrapos::fem {
namespace {

/// An edge of the reference face, from and to its corners in the sense in which lines that begin or end at it
/// are counted.
struct Edge {
  int from, to, middle;
};

/// Lines across a reference face: from the place t on the first edge to the place t on the second one, t in
/// [0, 1]. On a quadrilateral these are opposite edges; on a triangle they meet in the corner to which both
/// run, and lines are parallel to the third.
struct Family {
  Edge ends[2];
};

/// A quadrilateral's lines along xi, along eta.
constexpr Family kAcrossQuadrilateral[] = {{{{0, 3, 7}, {1, 2, 5}}}, {{{0, 1, 4}, {3, 2, 6}}}};
/// A triangle's lines along its edges.
constexpr Family kAcrossTriangle[] = {
    {{{0, 2, 5}, {1, 2, 4}}}, {{{1, 0, 3}, {2, 0, 5}}}, {{{2, 1, 4}, {0, 1, 3}}}};

bool isTriangle(Face face) { return numCorners(face) == 3; }

const Family* familiesOf(Face face) { return isTriangle(face) ? kAcrossTriangle : kAcrossQuadrilateral; }
int numFamilies(Face face) { return isTriangle(face) ? 3 : 2; }

using Point2 = std::array<double, 2>;

/// A place on a line: xi in [-1, 1] along line t, and the derivative by t.
struct OnLine {
  Point2 at, across;
  double area;  ///< of the reference face by xi and t
};

/// `nodes`: referenceNodes of the face.
OnLine onLine(const std::vector<double>& nodes, const Family& family, double t, double xi) {
  Point2 end[2], rate[2];
  for (int e = 0; e < 2; ++e)
    for (int i = 0; i < 2; ++i) {
      const double from = nodes[2 * family.ends[e].from + i];
      rate[e][i] = nodes[2 * family.ends[e].to + i] - from;
      end[e][i] = from + t * rate[e][i];
    }
  OnLine p;
  Point2 along;
  for (int i = 0; i < 2; ++i) {
    p.at[i] = 0.5 * (end[0][i] + end[1][i]) + 0.5 * xi * (end[1][i] - end[0][i]);
    p.across[i] = 0.5 * (rate[0][i] + rate[1][i]) + 0.5 * xi * (rate[1][i] - rate[0][i]);
    along[i] = 0.5 * (end[1][i] - end[0][i]);
  }
  p.area = std::abs(along[0] * p.across[1] - along[1] * p.across[0]);
  return p;
}

/// The rule for t: lines of triangles are shorter the nearer they are to the corner, which is one degree
/// more.
Tabulation ruleAcross(Face face, int degree) {
  Tabulation rule = tabulateFace(Face::Line2, isTriangle(face) ? degree + 1 : degree);
  for (double& t : rule.points) t = 0.5 * (1 + t);
  for (double& w : rule.weights) w *= 0.5;
  return rule;
}

/// The coefficients of a polynomial of degree 1 or 2 from its values at -1, 0, 1.
void polynomial(int degree, const double* at, double* k) {
  k[0] = at[1];
  k[1] = 0.5 * (at[2] - at[0]);
  if (degree == 2) k[2] = 0.5 * (at[2] + at[0]) - at[1];
}

/// The lines of one family, for all faces of a shape.
struct Pattern {
  Tabulation points;                 ///< [line, point]
  std::vector<double> shape, slope;  ///< [line][a][k]: N_a along the line, and its derivative across

  Pattern(Face face, const Family& family, int degree, const Tabulation& lines, const Tabulation& shown) {
    const std::vector<double> nodes = referenceNodes(face);
    std::vector<double> at, along, weights;
    std::vector<Point2> across;
    for (int j = 0; j < lines.numPoints; ++j) {
      for (int s = 0; s < shown.numPoints; ++s) {
        const OnLine p = onLine(nodes, family, lines.points[j], shown.points[s]);
        at.insert(at.end(), p.at.begin(), p.at.end());
        weights.push_back(lines.weights[j] * shown.weights[s] * p.area);
      }
      for (const double xi : {-1.0, 0.0, 1.0}) {
        const OnLine p = onLine(nodes, family, lines.points[j], xi);
        along.insert(along.end(), p.at.begin(), p.at.end());
        across.push_back(p.across);
      }
    }
    points = tabulateFaceAt(face, at);
    points.weights = weights;
    const Tabulation t = tabulateFaceAt(face, along);
    const int N = t.numNodes;
    for (int j = 0; j < lines.numPoints; ++j)
      for (int a = 0; a < N; ++a) {
        double value[3], rate[3], k[3];
        for (int i = 0; i < 3; ++i) {
          const double* gradient = &t.gradients[((3 * j + i) * N + a) * 2];
          value[i] = t.values[(3 * j + i) * N + a];
          rate[i] = gradient[0] * across[3 * j + i][0] + gradient[1] * across[3 * j + i][1];
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
  explicit Corners(const std::vector<SurfaceFace>& faces) : ofFace_(numCorners(faces[0].face)) {
    for (const SurfaceFace& face : faces) {
      const std::size_t N = face.places.size();
      for (int c = 0; c < ofFace_; ++c) {
        const std::pair key(face.nodes[c], face.nodes.size() > N ? face.nodes[N + c] : -1);
        const int next = static_cast<int>(numbers_.size());
        of_.push_back(numbers_.try_emplace(key, next).first->second);
      }
    }
  }
  int of(int face, int corner) const { return of_[ofFace_ * face + corner]; }
  std::pair<int, int> ofEdge(int face, const Edge& edge) const {
    return std::minmax(of(face, edge.from), of(face, edge.to));
  }

 private:
  int ofFace_;
  std::map<std::pair<int, int>, int> numbers_;
  std::vector<int> of_;  ///< [face][corner]
};

/// Where the gap is looked at to choose between the families of lines: three places on three lines of each.
Tabulation placesToLook(Face face) {
  const std::vector<double> nodes = referenceNodes(face);
  std::vector<double> at;
  for (int d = 0; d < numFamilies(face); ++d)
    for (const double t : {0.25, 0.5, 0.75})
      for (const double xi : {-0.5, 0.0, 0.5}) {
        const OnLine p = onLine(nodes, familiesOf(face)[d], t, xi);
        at.insert(at.end(), p.at.begin(), p.at.end());
      }
  return tabulateFaceAt(face, at);
}

/// How much the gap changes along the lines of each family, in sum over three.
std::vector<double> changes(const SurfaceFace& face, const Tabulation& grid,
                            const std::function<double(const double*)>& gap) {
  std::vector<double> sums(numFamilies(face.face), 0.0), h(grid.numPoints);
  for (int q = 0; q < grid.numPoints; ++q) {
    Vec3 x{};
    for (int a = 0; a < grid.numNodes; ++a) add(grid.values[q * grid.numNodes + a], face.places[a], x);
    h[q] = gap(x.data());
  }
  for (std::size_t line = 0; 3 * line < h.size(); ++line) {
    const auto [least, most] = std::minmax_element(&h[3 * line], &h[3 * line] + 3);
    sums[line / 3] += *most - *least;
  }
  return sums;
}

double edgeLength(const SurfaceFace& face, int from, int to) {
  const Vec3 &a = face.places[from], &b = face.places[to];
  return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

/// Whether the gap's changes along two families are alike but for rounding: over a ball relative to the
/// changes, over a plane, along which nothing changes, to the size of what they are changes over.
bool areAlike(double a, double b, double size) {
  return !(std::abs(a - b) > 1e-6 * std::max(a, b) + 1e-12 * size);
}

/// What each of the two families of lines of quadrilaterals that hang together would be.
struct Families {
  double change[2] = {0, 0};  ///< of the gap along the lines, in sum
  double border[2] = {0, 0};  ///< length of the surface's border that lines cross
  double size = 0;            ///< of the faces' edges, in sum

  /// Along the second one the gap changes more; where both are alike, its lines are longer.
  bool secondIsBetter() const {
    if (!areAlike(change[0], change[1], size)) return change[1] > change[0];
    return border[1] < (1 - 1e-6) * border[0];
  }
};

/// [quadrilateral] the family of its lines. They cross an edge in both of its faces or in none, as far as
/// that can be: from face to face through each set of faces that hangs together.
std::vector<int> throughQuadrilaterals(const std::vector<SurfaceFace>& faces, const Corners& corners,
                                       const std::function<double(const double*)>& gap) {
  // Those that the first family's lines cross, then those of the second's: edge / 2 is the family.
  constexpr const Family* families = kAcrossQuadrilateral;
  const Edge edges[4] = {families[0].ends[0], families[0].ends[1], families[1].ends[0], families[1].ends[1]};
  std::map<std::pair<int, int>, std::vector<std::pair<int, int>>> byEdge;  // face, its edge
  for (int f = 0; f < static_cast<int>(faces.size()); ++f)
    for (int edge = 0; edge < 4; ++edge) byEdge[corners.ofEdge(f, edges[edge])].emplace_back(f, edge);
  const Tabulation grid = placesToLook(faces[0].face);
  std::vector<int> result(faces.size(), -1);
  for (std::size_t seed = 0; seed < faces.size(); ++seed) {
    if (result[seed] >= 0) continue;
    result[seed] = 0;
    std::vector<int> part{static_cast<int>(seed)};
    Families sums;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const int f = part[i];
      const auto own = changes(faces[f], grid, gap);
      for (int d = 0; d < 2; ++d) sums.change[d] += own[d == 0 ? result[f] : 1 - result[f]];
      for (int edge = 0; edge < 4; ++edge) {
        const bool crossed = edge / 2 == result[f];
        const auto& sharing = byEdge.at(corners.ofEdge(f, edges[edge]));
        const double length = edgeLength(faces[f], edges[edge].from, edges[edge].to);
        sums.size += length;
        if (sharing.size() == 1) sums.border[crossed ? 0 : 1] += length;
        for (const auto& [other, otherEdge] : sharing) {
          if (result[other] >= 0) continue;
          result[other] = crossed ? otherEdge / 2 : 1 - otherEdge / 2;
          part.push_back(other);
        }
      }
    }
    if (sums.secondIsBetter())
      for (const int f : part) result[f] = 1 - result[f];
  }
  return result;
}

/// [triangle] the family of its lines: that along which the gap changes most for its length, else the longest
/// lines. Of triangles that halve quadrilaterals lines cross an edge in both or in none; others need not
/// agree.
std::vector<int> throughTriangles(const std::vector<SurfaceFace>& faces,
                                  const std::function<double(const double*)>& gap) {
  const Tabulation grid = placesToLook(faces[0].face);
  std::vector<int> result;
  for (const SurfaceFace& face : faces) {
    auto slope = changes(face, grid, gap);
    double length[3];
    for (int d = 0; d < 3; ++d) {
      length[d] = edgeLength(face, kAcrossTriangle[d].ends[0].from, kAcrossTriangle[d].ends[1].from);
      slope[d] /= length[d];
    }
    int best = 0;
    for (int d = 1; d < 3; ++d)
      if (areAlike(slope[d], slope[best], 1) ? length[d] > (1 + 1e-6) * length[best] : slope[d] > slope[best])
        best = d;
    result.push_back(best);
  }
  return result;
}

FaceLines linesAcross(const Mesh& mesh, const SideSet& set, const std::vector<SurfaceFace>& faces, int degree,
                      const std::function<double(const double*)>& gap) {
  const Face shape = faces[0].face;
  const int P = shape == Face::Quad4 || shape == Face::Tri3 ? 1 : 2, K = P + 1;
  const Tabulation shown = tabulateFace(Face::Line2, degree), rule = ruleAcross(shape, degree);
  const int n = rule.numPoints;
  std::vector<Pattern> patterns;
  for (int d = 0; d < numFamilies(shape); ++d)
    patterns.emplace_back(shape, familiesOf(shape)[d], P, rule, shown);
  const Corners corners(faces);
  const std::vector<int> families =
      isTriangle(shape) ? throughTriangles(faces, gap) : throughQuadrilaterals(faces, corners, gap);
  FaceLines result;
  LineSet& lines = result.lines;
  lines.degree = P;
  lines.nodesPerLine = static_cast<int>(faces[0].nodes.size());
  lines.shown = shown.points;
  std::map<std::array<int, 3>, int> ends;  // both corners of an edge, which of its lines
  for (int f = 0; f < static_cast<int>(faces.size()); ++f) {
    const SurfaceFace& face = faces[f];
    const Pattern& pattern = patterns[families[f]];
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
          add(rule.weights[j] * pattern.slope[(j * N + a) * K + k], face.places[a], across);
          // Largest at the line's middle, by more than rounding.
          if (k == 0 && pattern.shape[(j * N + a) * K] > pattern.shape[(j * N + nearest) * K] + 1e-9)
            nearest = a;
        }
        lines.coefficients.insert(lines.coefficients.end(), x.begin(), x.end());
        lines.across.insert(lines.across.end(), across.begin(), across.end());
      }
      lines.middleNodes.push_back(face.nodes[nearest]);
      for (const Edge& edge : familiesOf(shape)[families[f]].ends) {
        const auto [low, high] = corners.ofEdge(f, edge);
        const int place = corners.of(f, edge.from) == low ? j : n - 1 - j;
        const auto [end, isNew] = ends.try_emplace({low, high, place}, lines.numEnds());
        lines.ends.push_back(end->second);
        if (!isNew) continue;
        const bool half = 2 * j + 1 == n && N > numCorners(shape);
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
  for (SurfaceFace& face : surfaceFaces(mesh, shells, set, zeta))
    byShape[face.face].push_back(std::move(face));
  std::vector<FaceLines> result;
  for (const auto& [shape, faces] : byShape) result.push_back(linesAcross(mesh, set, faces, degree, gap));
  return result;
}

}  // namespace atrapos::fem
