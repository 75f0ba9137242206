#include "atrapos/fem/Tie.hpp"

#include <fmt/format.h>

#include <Teuchos_SerialDenseMatrix.hpp>
#include <Teuchos_SerialDenseSolver.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "InverseMap.hpp"
#include "Labels.hpp"
#include "TieCells.hpp"
#include "TieFaces.hpp"
#include "atrapos/fem/PointSet.hpp"

namespace atrapos::fem {
namespace {

using detail::TieFace;
using detail::TieSegment;

/// A cubature point of the pieces of faces.
struct TiePoint {
  int own = 0, other = 0;      ///< faces
  std::array<double, 2> at{};  ///< in the own face's plane
  double weight = 0;           ///< in that plane; behind `place` on the face itself
  std::vector<double> values;  ///< of the own face's shape functions
  Vec3 place{};
};

/// The corners beside midside node `node` of a shape, local; the second is -1 for corners and centres.
std::array<int, 2> cornersBeside(Face shape, int node) {
  const int corners = numCorners(shape);
  if (isLine(shape)) return node < 2 ? std::array{node, -1} : std::array{0, 1};
  if (node < corners || node >= 2 * corners) return {node, -1};
  return {node - corners, (node - corners + 1) % corners};
}

/// A place on a face, by shape functions that are tabulated in the face's own coordinates.
struct OnFace {
  Vec3 place{}, tangents[2]{};
  int dim = 2;

  OnFace(const TieFace& face, const Tabulation& t, int q) : dim(t.dim) {
    for (int a = 0; a < t.numNodes; ++a) {
      const std::size_t at = static_cast<std::size_t>(q) * t.numNodes + a;
      add(t.values[at], face.places[a], place);
      for (int d = 0; d < t.dim; ++d) add(t.gradients[at * t.dim + d], face.places[a], tangents[d]);
    }
  }
  /// Area by that of the reference face, or length, along the normal.
  Vec3 area() const { return dim == 1 ? cross(tangents[0], {0, 0, 1}) : cross(tangents[0], tangents[1]); }
};

/// A node of the following surface in the making.
struct Row {
  double mass = 0;
  std::map<int, double> masters;
};

class TieMaker {
 public:
  TieMaker(const Mesh& mesh, const SideSet& follows, const SideSet& leads, const TieOptions& options)
      : mesh_(mesh),
        options_(options),
        own_(detail::tieFaces(mesh, follows)),
        others_(detail::tieFaces(mesh, leads)),
        behind_(mesh, others_),
        near_(others_) {
    const std::vector<int> led = nodesOf(mesh, leads);
    for (const int n : nodesOf(mesh, follows))
      if (std::binary_search(led.begin(), led.end(), n))
        throw std::invalid_argument(fmt::format(
            "{} is on both surfaces: those that share nodes there are one already", nodeLabel(mesh, n)));
    for (const TieFace& face : own_)
      for (std::size_t a = 0; a < face.nodes.size(); ++a) {
        const auto [c, d] = cornersBeside(face.shape, static_cast<int>(a));
        Following& node = nodes_[face.nodes[a]];
        if (d < 0) continue;
        node.beside = {face.nodes[c], face.nodes[d]};
        node.share = std::max(node.share, givenShare(face));
      }
  }

  Tie operator()() {
    // Faces in groups: some thousand points at a time.
    constexpr int group = 64;
    const int count = static_cast<int>(own_.size());
    for (int first = 0; first < count; first += group) addFaces(first, std::min(first + group, count));
    place();
    Tie tie;
    tie.largestGap = largestGap_;
    for (auto& [node, f] : nodes_) {
      if (f.masters.empty())
        tie.open.push_back(node);
      else
        tie.nodes.push_back({node, std::move(f.masters)});
    }
    if (tie.nodes.empty())
      throw std::invalid_argument(fmt::format(
          "no node of the surface that follows has the other one opposite, within {:g} of the faces' size",
          options_.reach));
    return tie;
  }

 private:
  struct Following {
    std::array<int, 2> beside{-1, -1};  ///< corners, of a midside node
    double share = 0;                   ///< what it gives of itself to each of them
    bool whole = true;                  ///< all faces at it are opposite of others all over
    Row row;
    std::vector<CoupledNode> masters;
  };

  [[noreturn]] void distorted(const TieFace& face) const {
    throw std::runtime_error(fmt::format("no place on side {} of {}: the cell is too distorted",
                                         face.side.side + 1, elementLabel(mesh_, face.block, face.element)));
  }

  // ------------------------------------------------------------------------------- cubature points

  std::vector<TiePoint> pointsOf(int first, int last) {
    const Tabulation inTriangle = tabulateFace(Face::Tri3, 6), onLine = tabulateFace(Face::Line2, 7);
    std::vector<TiePoint> points;
    for (int f = first; f < last; ++f)
      for (const TieSegment& s : detail::tieSegments(own_, f, others_, near_, options_.reach)) {
        largestGap_ = std::max(largestGap_, s.gap);
        const bool line = own_[f].dim() == 1;
        const Tabulation& rule = line ? onLine : inTriangle;
        for (int q = 0; q < rule.numPoints; ++q) {
          TiePoint p;
          p.own = f;
          p.other = s.other;
          const double* xi = &rule.points[static_cast<std::size_t>(q) * rule.dim];
          const double share[3] = {line ? 0.5 * (1 - xi[0]) : 1 - xi[0] - xi[1],
                                   line ? 0.5 * (1 + xi[0]) : xi[0], line ? 0 : xi[1]};
          for (int c = 0; c < 3; ++c)
            for (int i = 0; i < 2; ++i) p.at[i] += share[c] * s.corners[c][i];
          p.weight = rule.weights[q] * s.size * (line ? 0.5 : 2);
          points.push_back(p);
        }
      }
    return points;
  }

  /// Values at the points' places on their own faces, and the weights there.
  void placeOnFaces(std::vector<TiePoint>& points) const {
    std::map<Face, std::vector<int>> byShape;
    for (std::size_t p = 0; p < points.size(); ++p)
      byShape[own_[points[p].own].shape].push_back(static_cast<int>(p));
    for (const auto& [shape, members] : byShape) {
      detail::PlacesInCells places;
      places.dim = isLine(shape) ? 1 : 2;
      for (const int p : members) {
        const TieFace& face = own_[points[p].own];
        for (const Vec3& X : face.places)
          for (int i = 0; i < places.dim; ++i) places.nodes.push_back(face.along(i, X));
        for (int i = 0; i < places.dim; ++i) places.targets.push_back(points[p].at[i]);
      }
      const std::vector<double> start(places.dim, numCorners(shape) == 3 ? 1.0 / 3 : 0.0);
      const auto tabulateHere = [shape = shape](const std::vector<double>& at) {
        return tabulateFaceAt(shape, at);
      };
      const auto xi = detail::inverseMap(places, start, tabulateHere);
      const Tabulation t = tabulateHere(xi);
      for (std::size_t m = 0; m < members.size(); ++m) finish(t, static_cast<int>(m), points[members[m]]);
    }
  }

  void finish(const Tabulation& t, int q, TiePoint& p) const {
    const TieFace& face = own_[p.own];
    if (std::isnan(t.values[static_cast<std::size_t>(q) * t.numNodes])) distorted(face);
    const double* const N = &t.values[static_cast<std::size_t>(q) * t.numNodes];
    p.values.assign(N, N + t.numNodes);
    const OnFace on(face, t, q);
    p.place = on.place;
    p.weight *= norm(on.area()) / std::abs(dot(face.normal, on.area()));
  }

  // ------------------------------------------------------------------------------- means over nodes

  /// What midside nodes give of themselves to the corners beside them, so that no corner's function has a
  /// vanishing or negative integral (docs/theory/couplings.md).
  double givenShare(const TieFace& face) const {
    const bool atAxis = options_.axisymmetric && face.low[0] < 1e-9 * face.size;
    return face.shape == Face::Tri6 || face.shape == Face::Quad8 || (face.shape == Face::Line3 && atAxis)
               ? 0.2
               : 0;
  }

  /// Values of the shape functions that stand for the changed unknowns of a face's nodes.
  std::vector<double> changed(const TieFace& face, const std::vector<double>& N) const {
    std::vector<double> result = N;
    for (std::size_t n = 0; n < N.size(); ++n) {
      const double share = nodes_.at(face.nodes[n]).share;
      if (share == 0) continue;
      for (const int corner : cornersBeside(face.shape, static_cast<int>(n))) result[corner] += share * N[n];
      result[n] -= 2 * share * N[n];
    }
    return result;
  }

  void addFaces(int first, int last) {
    std::vector<TiePoint> points = pointsOf(first, last);
    placeOnFaces(points);
    std::vector<std::pair<int, Vec3>> places;
    for (TiePoint& p : points) {
      if (options_.axisymmetric) p.weight *= p.place[0];
      places.push_back({p.other, p.place});
    }
    const std::vector<detail::InCell> behind = behind_.find(places);
    for (std::size_t p = 0; p < points.size(); ++p)
      if (std::isnan(behind[p].xi[0])) distorted(others_[points[p].other]);
    std::size_t from = 0;
    for (int f = first; f < last; ++f) {
      std::size_t to = from;
      while (to < points.size() && points[to].own == f) ++to;
      addFace(f, points, behind, from, to);
      from = to;
    }
  }

  /// Area or length of a face, weighed as the points are.
  double measure(const TieFace& face) const {
    const Tabulation t = tabulateFace(face.shape, 6);
    double sum = 0;
    for (int q = 0; q < t.numPoints; ++q) {
      const OnFace on(face, t, q);
      sum += t.weights[q] * norm(on.area()) * (options_.axisymmetric ? on.place[0] : 1);
    }
    return sum;
  }

  void addFace(int f, const std::vector<TiePoint>& points, const std::vector<detail::InCell>& behind,
               std::size_t from, std::size_t to) {
    const TieFace& face = own_[f];
    const int N = static_cast<int>(face.nodes.size());
    double covered = 0;
    for (std::size_t p = from; p < to; ++p) covered += points[p].weight;
    // Facets of curved borders miss up to some per cent; what is left out counts as the rest does.
    if (covered < 0.95 * measure(face)) {
      for (const int node : face.nodes) nodes_[node].whole = false;
      return;
    }
    Teuchos::SerialDenseMatrix<int, double> mass(N, N);
    std::vector<double> sums(N, 0.0);
    std::vector<std::vector<double>> functions;  // [point] those of the changed unknowns
    for (std::size_t p = from; p < to; ++p) {
      functions.push_back(changed(face, points[p].values));
      const std::vector<double>& values = functions.back();
      for (int a = 0; a < N; ++a) {
        sums[a] += points[p].weight * values[a];
        for (int b = 0; b < N; ++b) mass(a, b) += points[p].weight * values[a] * values[b];
      }
    }
    Teuchos::SerialDenseSolver<int, double> inverse;
    inverse.setMatrix(Teuchos::rcp(&mass, false));
    if (inverse.invert() != 0) distorted(face);
    for (int a = 0; a < N; ++a) nodes_[face.nodes[a]].row.mass += sums[a];
    for (std::size_t p = from; p < to; ++p) {
      const std::vector<double>& values = functions[p - from];
      const TieFace& other = others_[points[p].other];
      const std::vector<int>& cells = mesh_.blocks[other.block].nodes;
      const std::size_t M = behind[p].values.size(), cell = other.element * M;
      for (int a = 0; a < N; ++a) {
        double dual = 0;
        for (int b = 0; b < N; ++b) dual += mass(a, b) * values[b];
        dual *= sums[a] * points[p].weight;
        auto& masters = nodes_[face.nodes[a]].row.masters;
        for (std::size_t m = 0; m < M; ++m) masters[cells[cell + m]] += dual * behind[p].values[m];
      }
    }
  }

  // ------------------------------------------------------------------------------- the couplings

  void place() {
    std::vector<int> alone;
    for (auto& [node, f] : nodes_) {
      if (!f.whole) {
        alone.push_back(node);
        continue;
      }
      f.masters = terms(f.row.masters, (1 - 2 * f.share) / f.row.mass);
      for (const int corner : f.beside)
        if (f.share > 0) f.masters.push_back({corner, f.share});
    }
    placeAlone(alone);
  }

  /// What is not rounding of a factor of one.
  static std::vector<CoupledNode> terms(const std::map<int, double>& masters, double factor) {
    std::vector<CoupledNode> all;
    for (const auto& [node, value] : masters)
      if (std::abs(factor * value) > 1e-12) all.push_back({node, factor * value});
    return all;
  }

  /// Nodes at the border of what is opposite: each by its own place.
  void placeAlone(const std::vector<int>& nodes) {
    std::vector<std::pair<int, Vec3>> places;
    std::vector<int> of;
    for (const int node : nodes) {
      const Vec3 X = vectorAt(mesh_.coordinates, node);
      for (const int o : near_.of(X, X, 0, options_.reach)) {
        places.push_back({o, X});
        of.push_back(node);
      }
    }
    const std::vector<detail::InCell> behind = behind_.find(places);
    std::map<int, double> gaps;  // of the nearest face so far
    for (std::size_t p = 0; p < places.size(); ++p) {
      const TieFace& other = others_[places[p].first];
      const auto gap = behind_.gapTo(other, places[p].second, behind[p].xi);
      if (!gap || *gap > options_.reach * other.size) continue;
      const auto [nearest, first] = gaps.emplace(of[p], *gap);
      if (!first && nearest->second <= *gap) continue;
      nearest->second = *gap;
      std::map<int, double> masters;
      const std::size_t M = behind[p].values.size();
      for (std::size_t m = 0; m < M; ++m)
        masters[mesh_.blocks[other.block].nodes[other.element * M + m]] += behind[p].values[m];
      nodes_[of[p]].masters = terms(masters, 1);
    }
    for (const auto& [node, gap] : gaps) largestGap_ = std::max(largestGap_, gap);
  }

  const Mesh& mesh_;
  const TieOptions& options_;
  const std::vector<TieFace> own_, others_;
  const detail::CellsBehind behind_;
  const detail::NearFaces near_;
  std::map<int, Following> nodes_;
  double largestGap_ = 0;
};

}  // namespace

Tie tieSurfaces(const Mesh& mesh, const SideSet& follows, const SideSet& leads, const TieOptions& options) {
  return TieMaker(mesh, follows, leads, options)();
}

int couple(FeModel& model, const Tie& tie, const std::vector<std::string>& fields) {
  std::set<int> coupled;
  for (const Coupling& c : model.couplings.all()) coupled.insert(c.dof);
  int kept = 0;
  for (const std::string& name : fields) {
    const int field = model.dofs.find(name);
    if (field < 0) throw std::invalid_argument(fmt::format("the model has no field '{}'", name));
    const int components = model.dofs.fields()[field].numComponents();
    for (const TiedNode& node : tie.nodes)
      for (int i = 0; i < components; ++i) {
        Coupling c;
        c.dof = model.dofs.dof(field, node.node, i);
        if (c.dof < 0) break;
        if (model.supports.fixed(c.dof) || coupled.count(c.dof) > 0) {
          ++kept;
          continue;
        }
        for (const CoupledNode& m : node.masters) {
          const int dof = model.dofs.dof(field, m.node, i);
          if (dof < 0)
            throw std::invalid_argument(
                fmt::format("{} follows node {}, which has none", model.dofs.nameOf(c.dof), m.node + 1));
          c.masters.push_back({dof, m.factor});
        }
        model.couplings.add(std::move(c));
      }
  }
  return kept;
}

}  // namespace atrapos::fem
