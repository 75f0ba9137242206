#include "atrapos/fem/RigidBody.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "HingeAngle.hpp"
#include "RigidArms.hpp"
#include "Vec3.hpp"
#include "atrapos/fem/LawTerm.hpp"

namespace atrapos::fem {

RigidBody::RigidBody(FeModel& model, const std::array<double, 3>& origin, double armLength, double stiffness)
    : origin_(origin), length_(armLength), stiffness_(stiffness) {
  if (!(armLength > 0) || !std::isfinite(armLength))
    throw std::invalid_argument("a rigid body needs arms of positive length");
  if (!(stiffness > 0) || !std::isfinite(stiffness))
    throw std::invalid_argument("a rigid body needs a positive stiffness to scale its multipliers");
  firstNode_ = model.dofs.addNodes(4, displacementField());
  // M_xx and M_xy, M_yy and M_yz, M_zz and M_zx.
  const int multipliers =
      model.dofs.addNodes(2, {"rigid body's multiplier", {"x", "y", "z"}, Role::multiplier});
  PointSet p = points();
  Interpolation m;
  m.nodesPerEntity = m.shapeComponents = 2;
  m.nodes = {multipliers, multipliers + 1};
  m.shape = {1, 0, 0, 1};
  p.more.push_back(std::move(m));
  model.terms.push_back(lawTerm(pointLaw(RigidArms{}), p));
}

PointSet RigidBody::points() const {
  PointSet p;
  p.numEntities = p.pointsPerEntity = 1;
  p.nodesPerEntity = 4;
  p.shapeComponents = 3;
  const double one = 1 / length_;
  p.shape.assign(4 * 3, 0.0);
  for (int c = 0; c < 3; ++c) {
    p.shape[c] = -one;
    p.shape[(1 + c) * 3 + c] = one;
  }
  for (int n = 0; n < 4; ++n) p.nodes.push_back(firstNode_ + n);
  p.weights = {stiffness_ * length_ * length_};
  p.positions = {origin_[0], origin_[1], origin_[2]};
  return p;
}

Field rotationField() { return {"rotation", {""}, Role::primal}; }

namespace {

/// Rows over the entries H_ij, [3 i + j], whose sums vanish: none of the two has the other's largest entry.
struct Vanishing {
  std::array<double, 9> row[2];
  int pivot[2];
};

Vanishing reduced(const std::array<double, 9>& first, const std::array<double, 9>& second) {
  const auto largest = [](const std::array<double, 9>& row) {
    return static_cast<int>(std::max_element(row.begin(), row.end(),
                                             [](double a, double b) { return std::abs(a) < std::abs(b); }) -
                            row.begin());
  };
  const auto eliminate = [](int pivot, const std::array<double, 9>& from, std::array<double, 9>& in) {
    const double factor = in[pivot] / from[pivot];
    for (int k = 0; k < 9; ++k) in[k] -= factor * from[k];
    in[pivot] = 0;
  };
  Vanishing v{{first, second}, {largest(first), 0}};
  eliminate(v.pivot[0], v.row[0], v.row[1]);
  v.pivot[1] = largest(v.row[1]);
  eliminate(v.pivot[1], v.row[1], v.row[0]);
  return v;
}

}  // namespace

int RigidBody::hinge(FeModel& model, const std::array<double, 3>& direction) const {
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  if (!(length > 0) || !std::isfinite(length))
    throw std::invalid_argument("a rigid body's axis needs a direction of finite length");
  const Vec3 axis = scaled(1 / length, direction);
  // e along the coordinate axis that is most across, made exactly so.
  int across = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(axis[i]) < std::abs(axis[across])) across = i;
  Vec3 e{};
  e[across] = 1;
  add(-axis[across], axis, e);
  e = scaled(1 / norm(e), e);
  const Vec3 f = cross(axis, e);

  // H axis has no part along e and f; that its length stays is one of the arms' conditions.
  std::array<double, 9> rows[2];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      rows[0][3 * i + j] = e[i] * axis[j];
      rows[1][3 * i + j] = f[i] * axis[j];
    }
  const Vanishing v = reduced(rows[0], rows[1]);
  for (int r = 0; r < 2; ++r) {
    Coupling c;
    const auto dof = [&](int node, int component) { return model.dofs.firstDof(node) + component; };
    const int pivot = v.pivot[r];
    c.dof = dof(armNode(pivot % 3), pivot / 3);
    c.masters.push_back({dof(originNode(), pivot / 3), 1});
    for (int k = 0; k < 9; ++k) {
      const double factor = v.row[r][k] / v.row[r][pivot];
      if (k == pivot || factor == 0) continue;
      c.masters.push_back({dof(armNode(k % 3), k / 3), -factor});
      c.masters.push_back({dof(originNode(), k / 3), factor});
    }
    model.couplings.add(std::move(c));
  }

  const int moment = model.dofs.addNodes(1, {"moment of a rigid body", {""}, Role::multiplier}),
            angle = model.dofs.addNodes(1, rotationField());
  PointSet p = points();
  for (const int node : {moment, angle}) {
    Interpolation own;
    own.components = own.nodesPerEntity = own.shapeComponents = 1;
    own.nodes = {node};
    own.shape = {1};
    p.more.push_back(std::move(own));
  }
  HingeAngle law;
  std::copy(e.begin(), e.end(), law.e);
  std::copy(f.begin(), f.end(), law.f);
  model.terms.push_back(lawTerm(pointLaw(law), p));
  return angle;
}

void RigidBody::attachDirector(FeModel& model, int node, const std::array<double, 3>& D) const {
  std::vector<CoupledNode> masters;
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    if (D[i] == 0) continue;
    masters.push_back({armNode(i), D[i] / length_});
    sum += D[i] / length_;
  }
  masters.push_back({originNode(), -sum});
  coupleNode(model.couplings, model.dofs, node, masters);
}

void RigidBody::attach(FeModel& model, int node, const std::array<double, 3>& position) const {
  std::vector<CoupledNode> masters;
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double arm = (position[i] - origin_[i]) / length_;
    if (arm == 0) continue;
    masters.push_back({armNode(i), arm});
    sum += arm;
  }
  masters.push_back({originNode(), 1 - sum});
  coupleNode(model.couplings, model.dofs, node, masters);
}

}  // namespace atrapos::fem
