#pragma once

#include <array>
#include <vector>

#include "atrapos/fem/FeModel.hpp"

namespace atrapos::fem {

/// A rigid body of finite rotations that nodes are attached to: a rigid end of a shell, a stiff plate
/// (docs/theory/couplings.md, "Rigid bodies").
///
/// Its motion is that of four points: an origin and the ends of three arms of one length along x, y, z. Every
/// attached point is linear in their displacements (Couplings), and six quadratic constraints, the
/// Green-Lagrange strains of the four points, keep the arms orthonormal. Their multipliers are unknowns.
///
/// Has nodes of its own: origin, three arms, two with three multipliers each. Supports and loads act at the
/// origin (a translation, a force through it) and at the arms (rotations: an arm's end that is held;
/// couples); the multipliers want neither.
class RigidBody {
 public:
  static constexpr int numNodes = 6;

  /// Gives the model its nodes and their constraints. origin: where it stands at rest. armLength > 0: about
  /// the body's size. stiffness (force per length, > 0) only scales the multipliers: take the size of the
  /// tangent's diagonal, Young's modulus times the thickness. Throws std::invalid_argument where they are not
  /// positive.
  RigidBody(FeModel& model, const std::array<double, 3>& origin, double armLength, double stiffness);

  int originNode() const { return firstNode_; }
  int armNode(int axis) const { return firstNode_ + 1 + axis; }

  /// The node moves with the point of the body at `position` (its place at rest).
  void attach(FeModel& model, int node, const std::array<double, 3>& position) const;

  /// The node carries a vector's change that turns with the body: a shell's director D.
  void attachDirector(FeModel& model, int node, const std::array<double, 3>& D) const;

 private:
  int firstNode_;
  std::array<double, 3> origin_;
  double length_;
};

}  // namespace atrapos::fem
