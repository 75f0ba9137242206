#pragma once

#include <array>
#include <vector>

#include "atrapos/fem/FeModel.hpp"
#include "atrapos/fem/PointSet.hpp"

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

  /// The body turns about this direction in space (any length, not 0) alone, by an angle that is an unknown:
  /// returns the node that has it, as the field rotationField(), in radians. Supports drive it, and what
  /// holds them is the moment about the direction; a load there is a moment, which has a potential. Once.
  /// Throws std::invalid_argument for a direction without a finite length.
  int hinge(FeModel& model, const std::array<double, 3>& direction) const;

  /// The node carries a vector's change that turns with the body: a shell's director D.
  void attachDirector(FeModel& model, int node, const std::array<double, 3>& D) const;

 private:
  /// The one point of laws whose inputs are the four points' H.
  PointSet points() const;

  int firstNode_;
  std::array<double, 3> origin_;
  double length_, stiffness_;
};

/// A scalar, the angle of hinged bodies.
Field rotationField();

}  // namespace atrapos::fem
