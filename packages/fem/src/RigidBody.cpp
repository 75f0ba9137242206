#include "atrapos/fem/RigidBody.hpp"

#include <cmath>
#include <stdexcept>

#include "RigidArms.hpp"
#include "atrapos/fem/LawTerm.hpp"

namespace atrapos::fem {

RigidBody::RigidBody(int firstNode, const std::array<double, 3>& origin, double armLength)
    : firstNode_(firstNode), origin_(origin), length_(armLength) {
  if (!(armLength > 0) || !std::isfinite(armLength))
    throw std::invalid_argument("a rigid body needs arms of positive length");
}

void RigidBody::attachDirector(Couplings& couplings, int node, const std::array<double, 3>& D) const {
  std::vector<CoupledNode> masters;
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    if (D[i] == 0) continue;
    masters.push_back({armNode(i), D[i] / length_});
    sum += D[i] / length_;
  }
  masters.push_back({originNode(), -sum});
  coupleNode(couplings, node, masters);
}

void RigidBody::attach(Couplings& couplings, int node, const std::array<double, 3>& position) const {
  std::vector<CoupledNode> masters;
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double arm = (position[i] - origin_[i]) / length_;
    if (arm == 0) continue;
    masters.push_back({armNode(i), arm});
    sum += arm;
  }
  masters.push_back({originNode(), 1 - sum});
  coupleNode(couplings, node, masters);
}

void RigidBody::addTo(FeModel& model, double stiffness) const {
  if (firstNode_ < 0 || firstNode_ + numNodes > model.numNodes)
    throw std::invalid_argument("the model has no nodes for this rigid body");
  if (!(stiffness > 0) || !std::isfinite(stiffness))
    throw std::invalid_argument("a rigid body needs a positive stiffness to scale its multipliers");
  constexpr int numVectors = 5;  // combinations of the nodes' displacements: law inputs [i][vector]
  PointSet p;
  p.numEntities = 1;
  p.nodesPerEntity = numNodes;
  p.pointsPerEntity = 1;
  p.shapeComponents = numVectors;
  for (int n = 0; n < numNodes; ++n) p.nodes.push_back(firstNode_ + n);
  const double one = 1 / length_;
  p.shape.assign(numNodes * numVectors, 0.0);
  const auto shape = [&](int node, int component) -> double& {
    return p.shape[node * numVectors + component];
  };
  for (int c = 0; c < 3; ++c) {
    shape(0, c) = -one;
    shape(1 + c, c) = one;
  }
  shape(4, 3) = shape(5, 4) = one;
  p.weights = {stiffness * length_ * length_};
  p.positions = {origin_[0], origin_[1], origin_[2]};
  model.terms.push_back(lawTerm(pointLaw(RigidArms{}), p));
  model.numMultipliers += 6;
}

}  // namespace atrapos::fem
