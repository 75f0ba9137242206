#include "atrapos/fem/SharedEdges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

#include "Labels.hpp"
#include "NewMultipliers.hpp"
#include "SharedEdgeLaw.hpp"
#include "Vec3.hpp"
#include "atrapos/fem/LawTerm.hpp"

namespace atrapos::fem {
namespace {

/// f(block, element, corner, the two nodes) at every edge of the shells of a mesh.
template <class Function>
void forEachEdge(const Mesh& mesh, const Function& f) {
  for (int b = 0; b < static_cast<int>(mesh.blocks.size()); ++b) {
    const Block& block = mesh.blocks[b];
    if (!isShell(block)) continue;
    const int N = nodesPerElement(block.topology), count = shellCorners(block.topology);
    for (int e = 0; e < static_cast<int>(block.nodes.size()) / N; ++e) {
      const int* nodes = &block.nodes[static_cast<std::size_t>(e) * N];
      for (int c = 0; c < count; ++c) f(b, e, c, std::minmax(nodes[c], nodes[(c + 1) % count]));
    }
  }
}

/// Dofs that supports or couplings hold.
class Held {
 public:
  explicit Held(const FeModel& model) : model_(model) {
    for (const Coupling& c : model.couplings.all()) {
      slaves_.insert(c.dof);
      for (const CoupledDof& m : c.masters) masters_.insert(m.dof);
    }
  }

  /// Whether the middle is, or the ends follow it; what holds it must hold the ends, as masters maybe, or the
  /// edge would open there.
  bool middle(const Mesh& mesh, const EdgeFollower& f, int dof, const std::array<int, 2>& ends) const {
    const bool leads = masters_.count(dof) > 0 && slaves_.count(ends[0]) > 0 && slaves_.count(ends[1]) > 0;
    if (!model_.supports.fixed(dof) && slaves_.count(dof) == 0 && !leads) return false;
    for (const int end : ends)
      if (!model_.supports.fixed(end) && slaves_.count(end) == 0 && masters_.count(end) == 0)
        throw std::invalid_argument(
            fmt::format("{} is the middle of an edge that a shell without middle nodes shares: what holds it "
                        "must hold the ends of the edge too, nodes {} and {}",
                        nodeLabel(mesh, f.node), mesh.nodeNumber(f.ends[0]), mesh.nodeNumber(f.ends[1])));
    return true;
  }

 private:
  const FeModel& model_;
  std::set<int> slaves_, masters_;
};

/// The middles as points with a multiplier vector each: y and h, then the directors of the ends.
class Middles {
 public:
  Middles() {
    points_.nodesPerEntity = 3;
    directors_.nodesPerEntity = 2;
    points_.shapeComponents = directors_.shapeComponents = 2;
    points_.pointsPerEntity = 1;
  }

  void add(const Mesh& mesh, const ShellGeometry& shells, const EdgeFollower& f, double youngsModulus) {
    Vec3 H = vectorAt(mesh.coordinates, f.ends[1]), Y = vectorAt(mesh.coordinates, f.node), D[2];
    fem::add(-1, vectorAt(mesh.coordinates, f.ends[0]), H);
    for (const int end : f.ends) fem::add(-0.5, vectorAt(mesh.coordinates, end), Y);
    const double length = norm(H);
    H = scaled(1 / length, H);
    Y = scaled(1 / length, Y);
    double half[2];
    for (int end = 0; end < 2; ++end) {
      D[end] = vectorAt(shells.directors, f.endDirectors[end] - shells.numMeshNodes);
      half[end] = norm(D[end]);
      D[end] = scaled(1 / half[end], D[end]);
    }
    Vec3 M = scaled(0.5, D[0]);
    fem::add(0.5, D[1], M);
    // Y = q_h H + q_m M + q_c H x M; where the directors lean to one end, M has a part along H.
    const Vec3 C = cross(H, M);
    const double hm = dot(H, M), mm = dot(M, M), det = mm - hm * hm;
    for (const Vec3& v : {H, D[0], D[1]}) data_.insert(data_.end(), v.begin(), v.end());
    data_.insert(data_.end(), {(mm * dot(Y, H) - hm * dot(Y, M)) / det, (dot(Y, M) - hm * dot(Y, H)) / det,
                               dot(Y, C) / dot(C, C), mm});

    ++points_.numEntities;
    points_.nodes.insert(points_.nodes.end(), {f.node, f.ends[0], f.ends[1]});
    points_.shape.insert(points_.shape.end(),
                         {1 / length, 0, -0.5 / length, -1 / length, -0.5 / length, 1 / length});
    directors_.nodes.insert(directors_.nodes.end(), f.endDirectors.begin(), f.endDirectors.end());
    directors_.shape.insert(directors_.shape.end(), {1 / half[0], 0, 0, 1 / half[1]});
    // A force of a strain of 1 over the edge.
    points_.weights.push_back(youngsModulus * length * length * (half[0] + half[1]));
  }

  /// [edge, as added][component]: whether supports or couplings hold the middle.
  void addTo(FeModel& model, const std::vector<std::array<bool, 3>>& held) {
    const Field force{"force at the middle of an edge", {"x", "y", "z"}, Role::multiplier};
    Interpolation mu = newMultipliers(model, force, points_.numEntities);
    const int field = model.dofs.find(force.name);
    for (std::size_t e = 0; e < held.size(); ++e)
      for (int i = 0; i < 3; ++i)
        if (held[e][static_cast<std::size_t>(i)])
          model.supports.prescribe(model.dofs.dof(field, mu.nodes[e], i), 0, 0);
    points_.more = {std::move(directors_), std::move(mu)};
    model.terms.push_back(lawTerm(pointLaw(SharedEdgeLaw{}), points_, data_));
  }

 private:
  PointSet points_;
  Interpolation directors_;
  std::vector<double> data_;
};

}  // namespace

bool hasMiddles(Topology topology) { return nodesPerElement(topology) > shellCorners(topology); }

std::vector<SharedEdge> sharedEdges(const Mesh& mesh) {
  std::set<std::pair<int, int>> straight;
  forEachEdge(mesh, [&](int b, int, int, const std::pair<int, int>& ends) {
    if (!hasMiddles(mesh.blocks[b].topology)) straight.insert(ends);
  });
  std::vector<SharedEdge> shared;
  forEachEdge(mesh, [&](int b, int e, int c, const std::pair<int, int>& ends) {
    if (hasMiddles(mesh.blocks[b].topology) && straight.count(ends) > 0) shared.push_back({b, e, c});
  });
  return shared;
}

std::vector<int> middlesAtCorners(const Mesh& mesh) {
  std::set<int> corners, middles;
  for (const Block& block : mesh.blocks) {
    if (!isShell(block)) continue;
    const int N = nodesPerElement(block.topology), count = shellCorners(block.topology);
    for (std::size_t i = 0; i < block.nodes.size(); ++i) {
      const int local = static_cast<int>(i % static_cast<std::size_t>(N));
      if (local < 2 * count) (local < count ? corners : middles).insert(block.nodes[i]);
    }
  }
  std::vector<int> both;
  std::set_intersection(corners.begin(), corners.end(), middles.begin(), middles.end(),
                        std::back_inserter(both));
  return both;
}

void coupleSharedEdges(FeModel& model, const Mesh& mesh, const ShellGeometry& shells, double youngsModulus) {
  if (shells.followers.empty()) return;
  if (!(youngsModulus > 0) || !std::isfinite(youngsModulus))
    throw std::invalid_argument("shared edges of shells need a positive modulus to scale their multipliers");
  const Held held(model);
  const auto dofOf = [&](int node, int i) { return model.dofs.firstDof(node) + i; };
  Middles middles;
  std::vector<std::array<bool, 3>> middleHeld;
  std::set<int> seen;  // two shells with middle nodes may have one
  for (const EdgeFollower& f : shells.followers) {
    std::array<bool, 3> here{};
    for (int i = 0; i < 3; ++i) {
      here[static_cast<std::size_t>(i)] =
          held.middle(mesh, f, dofOf(f.node, i), {dofOf(f.ends[0], i), dofOf(f.ends[1], i)});
      const std::array<int, 2> masters{dofOf(f.endDirectors[0], i), dofOf(f.endDirectors[1], i)};
      if (held.middle(mesh, f, dofOf(f.director, i), masters)) continue;
      model.couplings.add(
          {dofOf(f.director, i), {{masters[0], 0.5 * f.endScales[0]}, {masters[1], 0.5 * f.endScales[1]}}});
    }
    if (!seen.insert(f.node).second) continue;
    middles.add(mesh, shells, f, youngsModulus);
    middleHeld.push_back(here);
  }
  middles.addTo(model, middleHeld);
}

}  // namespace atrapos::fem
