#include "atrapos/fem/RigidBody.hpp"

#include <cmath>
#include <stdexcept>

#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/taylor/Tensor.hpp"

namespace atrapos::fem {

namespace {

/// M : E(H) with the Green-Lagrange strain E = (H + H^T + H^T H)/2 of the arms and the multipliers M: the
/// stationary value over M is E = 0.
///
/// in, out: [Cartesian component i][H_i1, H_i2, H_i3, M_ii, M_i,i+1], dimensionless.
struct RigidArms {
  static constexpr int numInputs = 15, numOutputs = 15, numData = 0;
  static constexpr bool symmetric = true;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    T h[9], m[6];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) h[3 * i + j] = in[5 * i + j];
      m[i] = in[5 * i + 3];
      m[3 + i] = in[5 * i + 4];
    }
    const taylor::Matrix3<T> H(h);
    const taylor::Symmetric3<T> M(m);
    const taylor::Symmetric3<T> E = symmetricPart(H) + 0.5 * gramian(H);
    const taylor::Matrix3<T> P = full(M) + H * M;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) out[5 * i + j] = P(i, j);
      out[5 * i + 3] = E(i, i);
      const T shear = E(i, (i + 1) % 3);
      out[5 * i + 4] = 2.0 * shear;
    }
  }

  static constexpr int numObserved = 0;
  static std::vector<std::string> observedNames() { return {}; }
  KOKKOS_INLINE_FUNCTION void observe(const double*, const double*, double*) const {}
};

/// Five combinations of the nodes' displacements.
struct FiveVectors {
  static constexpr int components = 5;
  static constexpr int numInputs = 15;
};

}  // namespace

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
  PointSet p;
  p.numEntities = 1;
  p.nodesPerEntity = numNodes;
  p.pointsPerEntity = 1;
  p.shapeComponents = FiveVectors::components;
  for (int n = 0; n < numNodes; ++n) p.nodes.push_back(firstNode_ + n);
  const double one = 1 / length_;
  p.shape.assign(numNodes * FiveVectors::components, 0.0);
  const auto shape = [&](int node, int component) -> double& {
    return p.shape[node * FiveVectors::components + component];
  };
  for (int c = 0; c < 3; ++c) {
    shape(0, c) = -one;
    shape(1 + c, c) = one;
  }
  shape(4, 3) = shape(5, 4) = one;
  p.weights = {stiffness * length_ * length_};
  p.positions = {origin_[0], origin_[1], origin_[2]};
  model.terms.push_back(std::make_unique<LawTerm<RigidArms, FiveVectors>>(RigidArms{}, p));
  model.numMultipliers += 6;
}

}  // namespace atrapos::fem
