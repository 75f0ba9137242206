#include "atrapos/fem/RigidBody.hpp"

#include <cmath>
#include <stdexcept>

#include "RigidArms.hpp"
#include "atrapos/fem/LawTerm.hpp"

namespace atrapos::fem {

RigidBody::RigidBody(FeModel& model, const std::array<double, 3>& origin, double armLength, double stiffness)
    : origin_(origin), length_(armLength) {
  if (!(armLength > 0) || !std::isfinite(armLength))
    throw std::invalid_argument("a rigid body needs arms of positive length");
  if (!(stiffness > 0) || !std::isfinite(stiffness))
    throw std::invalid_argument("a rigid body needs a positive stiffness to scale its multipliers");
  firstNode_ = model.dofs.addNodes(4, displacementField());
  // M_xx and M_xy, M_yy and M_yz, M_zz and M_zx.
  const int multipliers =
      model.dofs.addNodes(2, {"rigid body's multiplier", {"x", "y", "z"}, Role::multiplier});
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
  p.weights = {stiffness * length_ * length_};
  p.positions = {origin_[0], origin_[1], origin_[2]};
  Interpolation m;
  m.nodesPerEntity = m.shapeComponents = 2;
  m.nodes = {multipliers, multipliers + 1};
  m.shape = {1, 0, 0, 1};
  p.more.push_back(std::move(m));
  model.terms.push_back(lawTerm(pointLaw(RigidArms{}), p));
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
