#pragma once

#include <string>
#include <utility>
#include <vector>

#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/ShellGeometry.hpp"

namespace atrapos::fem {

/// Dirichlet conditions u_i = value + lambda * perLoadFactor, dof by dof (3 a node).
class Supports {
 public:
  explicit Supports(int numNodes);

  /// More nodes behind those there are, free.
  void addNodes(int count);

  /// Prescribes one component (0, 1, 2) at a node. Throws std::invalid_argument where the same dof was
  /// prescribed before with other numbers.
  void prescribe(int node, int component, double value, double perLoadFactor);

  int numNodes() const { return static_cast<int>(fixed_.size() / 3); }
  bool fixed(int dof) const { return fixed_[dof] != 0; }
  double value(int dof) const { return value_[dof]; }
  double perLoadFactor(int dof) const { return rate_[dof]; }
  double at(int dof, double lambda) const { return value_[dof] + lambda * rate_[dof]; }
  bool driven() const;  ///< any perLoadFactor != 0

 private:
  std::vector<char> fixed_;
  std::vector<double> value_, rate_;
};

/// A direction in which something other than a support holds a node (contact with a rigid tool).
struct HeldDirection {
  int node = 0;
  double direction[3] = {0, 0, 0};
};

/// A connected part of the mesh that can still move as a rigid body.
struct FreeBody {
  std::string block;  ///< name of the first block that belongs to it
  int motions = 0;    ///< number of independent rigid motions left, 1..6
};

/// Connected parts of the mesh whose rigid motions are not all held by the supports and held directions. With
/// shells the supports go on with the director nodes; what holds a director D holds omega x D of a rotation
/// omega. Parts that are joined by a hinge only (a fold with two directors, a shell's edge on a solid) count
/// as one: that they can turn about it is not seen here. `joined`: pairs of nodes that couplings join, as an
/// element would.
std::vector<FreeBody> freeBodies(const Mesh& mesh, const Supports& supports,
                                 const std::vector<HeldDirection>& held,
                                 const ShellGeometry* shells = nullptr,
                                 const std::vector<std::pair<int, int>>& joined = {});

}  // namespace atrapos::fem
