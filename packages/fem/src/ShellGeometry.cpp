#include "atrapos/fem/ShellGeometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include "Labels.hpp"
#include "Vec3.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/fem/SharedEdges.hpp"

namespace atrapos::fem {
namespace {

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;

// At a branch the faces beyond 45 degrees are no smooth surface, however wide the fold angle is.
const double kCosBranch = std::sqrt(0.5);

/// Where a node stands in an element of one of the sections.
struct Corner {
  int section, element, local;
};

/// Tangent vectors g_1, g_2 of a nodal vector field (positions, directors) at a point of a tabulation.
template <class At>
std::array<Vec3, 2> surfaceGradient(const Tabulation& t, int q, const At& at) {
  std::array<Vec3, 2> g{};
  for (int n = 0; n < t.numNodes; ++n)
    for (int d = 0; d < 2; ++d) add(t.gradients[(q * t.numNodes + n) * 2 + d], at(n), g[d]);
  return g;
}

class Builder {
 public:
  Builder(const Mesh& mesh, const std::vector<ShellSection>& sections, const ShellGeometryOptions& options)
      : mesh_(mesh), sections_(sections), options_(options) {
    if (!(options.foldAngle > 0 && options.foldAngle < 180))
      throw std::invalid_argument(fmt::format(
          "shell geometry: the fold angle must be above 0 and below 180 degrees, got {}", options.foldAngle));
    cosFold_ = std::cos(options.foldAngle * kRadiansPerDegree);
  }

  ShellGeometry operator()() {
    checkSections();
    result_.numMeshNodes = mesh_.numNodes();
    corners_.resize(mesh_.numNodes());
    for (std::size_t s = 0; s < sections_.size(); ++s) {
      thickness_.push_back(shellThickness(mesh_, sections_[s]));
      addBlock(static_cast<int>(s));
    }
    checkOrientation();
    findSharedEdges();
    addDirectors();
    alignFollowers();
    for (std::size_t s = 0; s < sections_.size(); ++s) checkBodies(static_cast<int>(s));
    return std::move(result_);
  }

 private:
  [[noreturn]] static void fail(const std::string& message) { throw std::invalid_argument(message); }

  const Block& block(int section) const { return mesh_.blocks[sections_[section].block]; }
  int perElement(int section) const { return result_.blocks[section].nodesPerElement; }
  int corners(int section) const { return shellCorners(block(section).topology); }
  std::string label(int section, int element) const {
    return elementLabel(mesh_, sections_[section].block, element);
  }
  int node(int section, int element, int local) const {
    return block(section).nodes[static_cast<std::size_t>(element) * perElement(section) + local];
  }
  Vec3 position(int node) const { return vectorAt(mesh_.coordinates, node); }
  std::size_t at(const Corner& c) const {
    return static_cast<std::size_t>(c.element) * perElement(c.section) + c.local;
  }
  const Vec3& normal(const Corner& c) const { return normals_[c.section][at(c)]; }

  void checkSections() const {
    std::vector<int> count(mesh_.blocks.size(), 0);
    for (const ShellSection& section : sections_) {
      const Block& b = mesh_.blocks.at(section.block);
      if (!isShell(b))
        fail(fmt::format(
            "{}: has {}, no shells; a shell section is for SHELL3, SHELL4, SHELL6, SHELL8 or SHELL9",
            blockLabel(b), topologyName(b.topology)));
      if (++count[section.block] > 1) fail(fmt::format("{}: has two shell sections", blockLabel(b)));
    }
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b)
      if (isShell(mesh_.blocks[b]) && count[b] == 0)
        fail(fmt::format("{}: its {} need a shell section with a thickness", blockLabel(mesh_.blocks[b]),
                         topologyName(mesh_.blocks[b].topology)));
  }

  // Normals of the middle surface at the nodes, all on one side of the element.
  void addBlock(int section) {
    const Topology topology = block(section).topology;
    const Tabulation nodal = tabulateAt(topology, referenceNodes(topology)),
                     centre = tabulateAt(topology, shellCorners(topology) == 3
                                                       ? std::vector<double>{1.0 / 3, 1.0 / 3}
                                                       : std::vector<double>{0, 0});
    ShellBlock shells;
    shells.block = sections_[section].block;
    shells.nodesPerElement = nodal.numNodes;
    const int N = nodal.numNodes, numElements = static_cast<int>(block(section).nodes.size()) / N;
    shells.nodes.resize(2 * static_cast<std::size_t>(N) * numElements);
    shells.directors.resize(3 * static_cast<std::size_t>(N) * numElements);
    shells.directorScale.resize(static_cast<std::size_t>(N) * numElements);
    for (int n : block(section).nodes) {
      const Vec3 R = position(n);
      shells.midsurface.insert(shells.midsurface.end(), R.begin(), R.end());
    }
    result_.blocks.push_back(std::move(shells));
    normals_.emplace_back(static_cast<std::size_t>(N) * numElements);
    for (int e = 0; e < numElements; ++e) {
      const auto x = [&](int n) { return position(node(section, e, n)); };
      const auto atCentre = surfaceGradient(centre, 0, x);
      const Vec3 middle = cross(atCentre[0], atCentre[1]);
      const double scale = dot(atCentre[0], atCentre[0]) + dot(atCentre[1], atCentre[1]);
      for (int n = 0; n < N; ++n) {
        const auto g = surfaceGradient(nodal, n, x);
        const Vec3 area = cross(g[0], g[1]);
        // Rounding of the coordinates leaves about 1e-16 of the sides' squares; no usable element is near.
        if (!(dot(area, middle) > 0) || !(norm(area) > 1e-12 * scale))
          fail(
              fmt::format("{}: the Jacobian of the middle surface is zero or changes sign at {}; check node "
                          "order and shape",
                          label(section, e), nodeLabel(mesh_, node(section, e, n))));
        const Corner corner{section, e, n};
        normals_[section][at(corner)] = scaled(1 / norm(area), area);
        corners_[node(section, e, n)].push_back(corner);
      }
    }
  }

  // Neighbours on one surface run through their common edge in opposite directions. Where more than two
  // elements meet at an edge no order of all is consistent, and only pairs that continue each other count.
  // Notes the nodes of such branches.
  void checkOrientation() {
    struct Use {
      Corner from, to;
    };
    std::map<std::pair<int, int>, std::vector<Use>> edges;
    for (std::size_t s = 0; s < sections_.size(); ++s)
      for (int e = 0; e < result_.blocks[s].numElements(); ++e)
        for (int c = 0, count = corners(static_cast<int>(s)); c < count; ++c) {
          const Corner from{static_cast<int>(s), e, c}, to{static_cast<int>(s), e, (c + 1) % count};
          const int a = node(from.section, e, from.local), b = node(to.section, e, to.local);
          edges[std::minmax(a, b)].push_back({from, to});
        }
    const auto first = [this](const Use& use) {
      return node(use.from.section, use.from.element, use.from.local);
    };
    atBranch_.assign(mesh_.numNodes(), 0);
    for (const auto& edge : edges) {
      const std::vector<Use>& uses = edge.second;
      if (uses.size() > 2)
        for (const Corner& c : {uses[0].from, uses[0].to}) atBranch_[node(c.section, c.element, c.local)] = 1;
      if (uses.size() > 2 && hasMiddles(block(uses[0].from.section).topology))
        atBranch_[node(uses[0].from.section, uses[0].from.element,
                       corners(uses[0].from.section) + uses[0].from.local)] = 1;
      for (std::size_t i = 0; i < uses.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
          if (first(uses[i]) != first(uses[j])) continue;
          if (uses.size() > 2 &&
              dot(normal(uses[i].from), normal(uses[j].from)) > -std::max(cosFold_, kCosBranch))
            continue;
          fail(fmt::format(
              "{} and {} have opposite normals: both run from {} to {} along their common edge; "
              "reverse the node order of one (a surface with one side only, a Moebius strip, has no order "
              "that fits)",
              label(uses[j].from.section, uses[j].from.element),
              label(uses[i].from.section, uses[i].from.element), nodeLabel(mesh_, first(uses[i])),
              nodeLabel(mesh_, node(uses[i].to.section, uses[i].to.element, uses[i].to.local))));
        }
    }
  }

  void findSharedEdges() {
    followers_.resize(mesh_.numNodes());
    for (const SharedEdge& edge : sharedEdges(mesh_)) {
      const auto section = std::find_if(sections_.begin(), sections_.end(),
                                        [&](const ShellSection& s) { return s.block == edge.block; });
      const int s = static_cast<int>(section - sections_.begin());
      const int local = corners(s) + edge.edge;
      followers_[node(s, edge.element, local)].push_back({s, edge.element, local});
    }
  }

  /// Directors halfway between those that their element has at the ends of a shared edge.
  void alignFollowers() {
    for (int n = 0; n < mesh_.numNodes(); ++n)
      for (const Corner& middle : followers_[n]) {
        ShellBlock& shells = result_.blocks[middle.section];
        const int N = shells.nodesPerElement, count = corners(middle.section), a = middle.local - count;
        const int* nodes = &shells.nodes[2 * static_cast<std::size_t>(N) * middle.element];
        EdgeFollower f;
        f.node = n;
        f.director = nodes[N + middle.local];
        Vec3 D{};
        for (int end = 0; end < 2; ++end) {
          const Corner c{middle.section, middle.element, (a + end) % count};
          f.ends[end] = nodes[c.local];
          f.endDirectors[end] = nodes[N + c.local];
          f.endScales[end] = shells.directorScale[at(c)];
          for (int i = 0; i < 3; ++i) D[i] += 0.5 * shells.directors[3 * at(c) + i];
        }
        std::copy(D.begin(), D.end(), &shells.directors[3 * at(middle)]);
        std::copy(D.begin(), D.end(),
                  &result_.directors[3 * static_cast<std::size_t>(f.director - result_.numMeshNodes)]);
        result_.followers.push_back(f);
      }
  }

  void addDirectors() {
    std::map<int, Vec3> prescribed;
    for (const PrescribedDirector& p : options_.directors) {
      const double length = norm(p.direction);
      if (p.node < 0 || p.node >= mesh_.numNodes() || corners_[p.node].empty())
        fail(fmt::format("prescribed director: no shell has node {}", mesh_.nodeNumber(p.node)));
      if (!(length > 0) || !std::isfinite(length))
        fail(fmt::format("{}: the prescribed director has no direction", nodeLabel(mesh_, p.node)));
      prescribed[p.node] = scaled(1 / length, p.direction);
    }
    for (int n = 0; n < mesh_.numNodes(); ++n) {
      result_.firstDirector.push_back(result_.numDirectors());
      const auto given = prescribed.find(n);
      if (!followers_[n].empty())
        for (const Corner& c : corners_[n]) addDirector(n, {c}, std::nullopt);
      else if (given != prescribed.end())
        addDirector(n, corners_[n], given->second);
      else
        for (const auto& group :
             smoothGroups(corners_[n], atBranch_[n] ? std::max(cosFold_, kCosBranch) : cosFold_))
          addDirector(n, group, std::nullopt);
    }
    result_.firstDirector.push_back(result_.numDirectors());
  }

  // Classes of the relation "normals within an angle", continued transitively, in order of appearance.
  std::vector<std::vector<Corner>> smoothGroups(const std::vector<Corner>& corners, double cosine) const {
    const int count = static_cast<int>(corners.size());
    std::vector<int> group(count);
    std::iota(group.begin(), group.end(), 0);
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < i; ++j)
        if (group[i] != group[j] && dot(normal(corners[i]), normal(corners[j])) >= cosine) {
          const int low = std::min(group[i], group[j]), high = std::max(group[i], group[j]);
          std::replace(group.begin(), group.end(), high, low);
        }
    std::map<int, std::vector<Corner>> groups;
    for (int i = 0; i < count; ++i) groups[group[i]].push_back(corners[i]);
    std::vector<std::vector<Corner>> result;
    for (auto& entry : groups) result.push_back(std::move(entry.second));
    return result;
  }

  void addDirector(int meshNode, const std::vector<Corner>& faces, const std::optional<Vec3>& prescribed) {
    Vec3 direction{};
    double mitre = 1;
    if (prescribed) {
      direction = *prescribed;
      for (const Corner& c : faces)
        if (!(dot(direction, normal(c)) > 0))
          fail(fmt::format("{}: the prescribed director points to the bottom face of {}",
                           nodeLabel(mesh_, meshNode), label(c.section, c.element)));
    } else {
      Vec3 sum{};
      const std::vector<double> weights = weightsOf(faces);
      for (std::size_t f = 0; f < faces.size(); ++f) add(weights[f], normal(faces[f]), sum);
      const double length = norm(sum), all = std::accumulate(weights.begin(), weights.end(), 0.0);
      double mean = 0, least = 1;
      for (std::size_t f = 0; f < faces.size(); ++f) {
        const double cosine = length > 0 ? dot(sum, normal(faces[f])) / length : 0;
        mean += weights[f] * cosine / all;
        least = std::min(least, cosine);
      }
      // Steeper than 84 degrees a common director would be ten times as long as the half thickness.
      if (!(least > 0.1))
        fail(fmt::format("{}: the faces there have no common director; a smaller fold angle separates them",
                         nodeLabel(mesh_, meshNode)));
      direction = scaled(1 / length, sum);
      mitre = 1 / mean;
    }
    double least = thicknessAt(faces[0]), most = least, total = 0;
    for (const Corner& c : faces) {
      least = std::min(least, thicknessAt(c));
      most = std::max(most, thicknessAt(c));
      total += thicknessAt(c);
    }
    const double common = least == most ? least : total / static_cast<double>(faces.size());
    const int director = result_.numDirectors();
    result_.meshNode.push_back(meshNode);
    const Vec3 D = scaled(0.5 * common * mitre, direction);
    result_.directors.insert(result_.directors.end(), D.begin(), D.end());
    for (const Corner& c : faces) {
      ShellBlock& shells = result_.blocks[c.section];
      const int N = shells.nodesPerElement;
      const double scale = thicknessAt(c) / common;
      int* nodes = &shells.nodes[2 * static_cast<std::size_t>(N) * c.element];
      nodes[c.local] = meshNode;
      nodes[N + c.local] = result_.numMeshNodes + director;
      shells.directorScale[at(c)] = scale;
      for (int i = 0; i < 3; ++i) shells.directors[3 * at(c) + i] = scale * D[i];
    }
  }

  /// What the normals at a node count: with triangles there the angles of their corners, since how many share
  /// a side of the node is chance; else the same.
  std::vector<double> weightsOf(const std::vector<Corner>& faces) const {
    std::vector<double> weights(faces.size(), 1.0);
    if (std::none_of(faces.begin(), faces.end(), [this](const Corner& c) { return corners(c.section) == 3; }))
      return weights;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const auto& [section, element, local] = faces[f];
      const int count = corners(section);
      const Vec3 at = position(node(section, element, local));
      Vec3 next = position(node(section, element, (local + 1) % count)),
           last = position(node(section, element, (local + count - 1) % count));
      add(-1, at, next);
      add(-1, at, last);
      weights[f] = std::atan2(norm(cross(next, last)), dot(next, last));
    }
    return weights;
  }

  double thicknessAt(const Corner& c) const { return thickness_[c.section][at(c)]; }

  // det(g_1 + zeta D_,1, g_2 + zeta D_,2, D) is quadratic in zeta: the faces show a thickness that exceeds
  // twice the radius of curvature, the middle surface what no director can repair.
  void checkBodies(int section) const {
    const ShellBlock& shells = result_.blocks[section];
    const Tabulation t = tabulate(block(section).topology);
    for (int e = 0; e < shells.numElements(); ++e) {
      const auto x = [&](int n) { return position(node(section, e, n)); };
      const auto D = [&](int n) {
        const double* d = &shells.directors[3 * (static_cast<std::size_t>(e) * shells.nodesPerElement + n)];
        return Vec3{d[0], d[1], d[2]};
      };
      for (int q = 0; q < t.numPoints; ++q) {
        const auto g = surfaceGradient(t, q, x), dD = surfaceGradient(t, q, D);
        Vec3 director{};
        for (int n = 0; n < t.numNodes; ++n) add(t.values[q * t.numNodes + n], D(n), director);
        for (const double zeta : {0.0, 1.0, -1.0}) {
          Vec3 a = g[0], b = g[1];
          add(zeta, dD[0], a);
          add(zeta, dD[1], b);
          const double det = dot(cross(a, b), director);
          if (det > 0) continue;
          fail(fmt::format(
              "{}: the Jacobian is {:.3g} on the {} surface, must be positive; {}", label(section, e), det,
              zeta == 0  ? "middle"
              : zeta > 0 ? "top"
                         : "bottom",
              zeta == 0 ? "check node order and shape"
                        : "the shell is too thick for its curvature (t/2 must stay below the radius)"));
        }
      }
    }
  }

  const Mesh& mesh_;
  const std::vector<ShellSection>& sections_;
  const ShellGeometryOptions& options_;
  double cosFold_ = 0;
  std::vector<char> atBranch_;                  // [mesh node]
  std::vector<std::vector<double>> thickness_;  // [section][element][node]
  std::vector<std::vector<Vec3>> normals_;      // [section][element][node]
  std::vector<std::vector<Corner>> corners_;    // [mesh node]
  std::vector<std::vector<Corner>> followers_;  // [mesh node] of shared edges, which it is the middle of
  ShellGeometry result_;
};

}  // namespace

std::vector<int> ShellGeometry::directorNodes(int node) const {
  std::vector<int> result;
  for (int d = firstDirector[node]; d < firstDirector[node + 1]; ++d) result.push_back(numMeshNodes + d);
  return result;
}

const ShellBlock* ShellGeometry::find(int block) const {
  for (const ShellBlock& shells : blocks)
    if (shells.block == block) return &shells;
  return nullptr;
}

ShellGeometry shellGeometry(const Mesh& mesh, const std::vector<ShellSection>& sections,
                            const ShellGeometryOptions& options) {
  return Builder(mesh, sections, options)();
}

}  // namespace atrapos::fem
