#include "atrapos/fem/ShellJoints.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "JointLaws.hpp"
#include "Labels.hpp"
#include "NewMultipliers.hpp"
#include "Vec3.hpp"
#include "atrapos/fem/LawTerm.hpp"

namespace atrapos::fem {
namespace {

/// A condition g = 0 between directors of a node, with a multiplier.
struct Condition {
  std::vector<int> directors;  ///< positions among the node's
  std::vector<double> data;    ///< of the law
  std::vector<Vec3> gradient;  ///< [its director] by x at rest
};

/// The directors at a node in units of their lengths, and what they keep to.
struct Joint {
  std::vector<int> nodes;  ///< of the model
  std::vector<Vec3> E;
  std::vector<double> length;

  int count() const { return static_cast<int>(nodes.size()); }
};

Joint jointAt(const ShellGeometry& shells, int node) {
  Joint joint;
  joint.nodes = shells.directorNodes(node);
  for (const int n : joint.nodes) {
    const Vec3 D = vectorAt(shells.directors, n - shells.numMeshNodes);
    joint.length.push_back(norm(D));
    joint.E.push_back(scaled(1 / norm(D), D));
  }
  return joint;
}

double sine(const Vec3& a, const Vec3& b) { return norm(cross(a, b)); }

/// The two directors with the largest angle between them and their opposites.
std::pair<int, int> leaders(const Joint& joint, const std::string& where) {
  std::pair<int, int> best{0, 1};
  for (int i = 0; i < joint.count(); ++i)
    for (int j = 0; j < i; ++j)
      // Right angles differ by rounding: the first of them.
      if (sine(joint.E[j], joint.E[i]) > sine(joint.E[best.first], joint.E[best.second]) + 1e-6)
        best = {j, i};
  // Half a degree: less comes of shells that lie on each other.
  if (sine(joint.E[best.first], joint.E[best.second]) < 0.01)
    throw std::invalid_argument(
        where + ": the shells there are folded onto each other, which is no rigid joint; accepted is a hinge");
  return best;
}

Condition keptAngle(const Joint& joint, int i, int j) {
  const Vec3 &a = joint.E[i], &b = joint.E[j];
  const double cosine = dot(a, b), perSine = 1 / sine(a, b);
  Condition c{{i, j}, {}, {scaled(perSine, b), scaled(perSine, a)}};
  add(-perSine * cosine, a, c.gradient[0]);
  add(-perSine * cosine, b, c.gradient[1]);
  for (const Vec3& v : {a, b}) c.data.insert(c.data.end(), v.begin(), v.end());
  c.data.insert(c.data.end(), {cosine, perSine});
  return c;
}

/// Director k stays normal to p, which turns with i and j.
Condition keptNormal(const Joint& joint, int i, int j, int k, const Vec3& p) {
  const Vec3 &a = joint.E[i], &b = joint.E[j], &d = joint.E[k], n = cross(a, b);
  // p in the base a, b, a x b.
  const double area = dot(n, n), p1 = dot(p, cross(b, n)) / area, p2 = dot(p, cross(n, a)) / area,
               p3 = dot(p, n) / area;
  Condition c{{i, j, k}, {}, {scaled(p1, d), scaled(p2, d), p}};
  add(p3, cross(b, d), c.gradient[0]);
  add(p3, cross(d, a), c.gradient[1]);
  add(-(p1 * dot(a, d) + p3 * dot(d, n)), a, c.gradient[0]);
  add(-(p2 * dot(b, d) + p3 * dot(d, n)), b, c.gradient[1]);
  for (const Vec3& v : {a, b, d}) c.data.insert(c.data.end(), v.begin(), v.end());
  c.data.insert(c.data.end(), {p1, p2, p3, dot(d, a), dot(d, b), dot(d, n)});
  return c;
}

/// Two unit vectors normal to d and to each other.
std::pair<Vec3, Vec3> normalsTo(const Vec3& d) {
  int least = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(d[i]) < std::abs(d[least])) least = i;
  Vec3 axis{};
  axis[least] = 1;
  const Vec3 p = cross(d, axis);
  return {scaled(1 / norm(p), p), scaled(1 / norm(p), cross(d, p))};
}

std::vector<Condition> conditionsOf(const Joint& joint, const std::string& where) {
  const auto [i, j] = leaders(joint, where);
  std::vector<Condition> conditions{keptAngle(joint, i, j)};
  for (int k = 0; k < joint.count(); ++k) {
    if (k == i || k == j) continue;
    const auto [p, q] = normalsTo(joint.E[k]);
    conditions.push_back(keptNormal(joint, i, j, k, p));
    conditions.push_back(keptNormal(joint, i, j, k, q));
  }
  return conditions;
}

/// Which conditions the supports and couplings of a model leave to be fulfilled.
class Independent {
 public:
  explicit Independent(const FeModel& model) : model_(model) {
    for (Coupling& c : model.couplings.resolved(model.dofs, model.supports)) {
      const int dof = c.dof;
      couplings_.emplace(dof, std::move(c));
    }
  }

  /// Empty: directors of the joint follow nodes elsewhere.
  std::vector<Condition> of(const Joint& joint, std::vector<Condition> all) const {
    std::vector<Condition> kept;
    std::vector<std::vector<double>> base;  // orthonormal rows of those that are kept
    for (Condition& c : all) {
      auto row = freePart(joint, c);
      if (!row) return {};
      for (const auto& b : base) {
        double part = 0;
        for (std::size_t i = 0; i < b.size(); ++i) part += b[i] * (*row)[i];
        for (std::size_t i = 0; i < b.size(); ++i) (*row)[i] -= part * b[i];
      }
      double size = 0;
      for (const double r : *row) size += r * r;
      // Rows are of size 1, and directors of meshes with single precision 1e-7 off.
      if (size < 1e-12) continue;
      for (double& r : *row) r /= std::sqrt(size);
      base.push_back(std::move(*row));
      kept.push_back(std::move(c));
    }
    return kept;
  }

 private:
  /// The gradient by the free unknowns of the joint's directors; none where one follows unknowns elsewhere.
  std::optional<std::vector<double>> freePart(const Joint& joint, const Condition& c) const {
    std::vector<double> row(3 * joint.nodes.size(), 0.0);
    for (std::size_t d = 0; d < c.directors.size(); ++d)
      for (int i = 0; i < 3; ++i) row[3 * static_cast<std::size_t>(c.directors[d]) + i] = c.gradient[d][i];
    std::vector<double> result(row.size(), 0.0);
    for (std::size_t r = 0; r < row.size(); ++r) {
      const int dof = model_.dofs.firstDof(joint.nodes[r / 3]) + static_cast<int>(r % 3);
      if (model_.supports.fixed(dof)) continue;
      const auto slave = couplings_.find(dof);
      if (slave == couplings_.end()) {
        result[r] += row[r];
        continue;
      }
      for (const CoupledDof& m : slave->second.masters) {
        const auto [position, found] = positionOf(joint, m.dof);
        if (!found) return std::nullopt;
        if (!model_.supports.fixed(m.dof))
          result[position] += row[r] * m.factor * joint.length[position / 3] / joint.length[r / 3];
      }
    }
    return result;
  }

  std::pair<std::size_t, bool> positionOf(const Joint& joint, int dof) const {
    for (std::size_t d = 0; d < joint.nodes.size(); ++d) {
      const int first = model_.dofs.firstDof(joint.nodes[d]);
      if (dof >= first && dof < first + 3) return {3 * d + static_cast<std::size_t>(dof - first), true};
    }
    return {0, false};
  }

  const FeModel& model_;
  std::map<int, Coupling> couplings_;  // by slave
};

/// Points with `directors` directors each and a multiplier.
struct Points {
  PointSet points;
  std::vector<double> data;

  explicit Points(int directors) {
    points.nodesPerEntity = points.shapeComponents = directors;
    points.pointsPerEntity = 1;
  }

  void add(const Joint& joint, const Condition& c, double stiffness) {
    ++points.numEntities;
    const int N = points.nodesPerEntity;
    for (int n = 0; n < N; ++n) {
      points.nodes.push_back(joint.nodes[c.directors[n]]);
      for (int m = 0; m < N; ++m) points.shape.push_back(m == n ? 1 / joint.length[c.directors[n]] : 0.0);
    }
    const double length = joint.length[c.directors[N - 1]];
    points.weights.push_back(stiffness * 2 * length * length * length);
    data.insert(data.end(), c.data.begin(), c.data.end());
  }

  template <class Law>
  void addTo(FeModel& model, const Law& law) {
    if (points.numEntities == 0) return;
    points.more.push_back(
        newMultipliers(model, {"moment of a joint", {""}, Role::multiplier}, points.numEntities));
    model.terms.push_back(lawTerm(pointLaw(law), points, data));
  }
};

}  // namespace

ShellJoints joinShells(FeModel& model, const Mesh& mesh, const ShellGeometry& shells, double youngsModulus,
                       const std::vector<int>& hinges) {
  if (!(youngsModulus > 0) || !std::isfinite(youngsModulus))
    throw std::invalid_argument("joints of shells need a positive modulus to scale their multipliers");
  std::vector<char> hinged(static_cast<std::size_t>(shells.numMeshNodes), 0);
  for (const int n : hinges) hinged.at(static_cast<std::size_t>(n)) = 1;
  const Independent independent(model);
  std::vector<char> follows(static_cast<std::size_t>(shells.numMeshNodes), 0);
  for (const EdgeFollower& f : shells.followers) follows[static_cast<std::size_t>(f.node)] = 1;
  Points angles(2), directions(3);
  ShellJoints joints;
  for (int node = 0; node < shells.numMeshNodes; ++node) {
    if (shells.firstDirector[node + 1] - shells.firstDirector[node] < 2) continue;
    if (follows[static_cast<std::size_t>(node)]) continue;  // the joints at the ends of its edge hold it
    (hinged[static_cast<std::size_t>(node)] ? joints.hinged : joints.rigid).push_back(node);
    if (hinged[static_cast<std::size_t>(node)]) continue;
    const Joint joint = jointAt(shells, node);
    for (const Condition& c : independent.of(joint, conditionsOf(joint, nodeLabel(mesh, node))))
      (c.directors.size() == 2 ? angles : directions).add(joint, c, youngsModulus);
  }
  angles.addTo(model, JointAngle{});
  directions.addTo(model, JointDirection{});
  return joints;
}

}  // namespace atrapos::fem
