#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "atrapos/fem/DofMap.hpp"
#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/ShellGeometry.hpp"

namespace atrapos::fem {

/// Dirichlet conditions u = value + lambda * perLoadFactor, dof by dof.
class Supports {
 public:
  /// Throws std::invalid_argument where the same dof was prescribed before with other numbers, and for dofs
  /// below 0.
  void prescribe(int dof, double value, double perLoadFactor);

  /// What held the dof before is no longer there; what is out of balance there still counts as a support's
  /// force (FeProblem::reactions).
  void release(int dof) { released_.insert(dof); }

  bool fixed(int dof) const { return prescribed_.count(dof) > 0; }
  bool fixedOrReleased(int dof) const { return fixed(dof) || released_.count(dof) > 0; }
  double value(int dof) const { return of(dof).value; }
  double perLoadFactor(int dof) const { return of(dof).rate; }
  double at(int dof, double lambda) const { return of(dof).value + lambda * of(dof).rate; }
  bool driven() const;  ///< any perLoadFactor != 0
  /// The largest dof that is prescribed; -1: none is.
  int last() const { return prescribed_.empty() ? -1 : prescribed_.rbegin()->first; }

 private:
  struct Prescribed {
    double value = 0, rate = 0;
  };
  Prescribed of(int dof) const {
    const auto found = prescribed_.find(dof);
    return found == prescribed_.end() ? Prescribed{} : found->second;
  }
  std::map<int, Prescribed> prescribed_;
  std::set<int> released_;
};

/// A direction in which something other than a support holds a node (contact with a rigid tool), or an axis
/// about which it keeps the body at the node from turning.
struct HeldDirection {
  int node = 0;
  double direction[3] = {0, 0, 0};
  bool turn = false;
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
std::vector<FreeBody> freeBodies(const Mesh& mesh, const DofMap& dofs, const Supports& supports,
                                 const std::vector<HeldDirection>& held,
                                 const ShellGeometry* shells = nullptr,
                                 const std::vector<std::pair<int, int>>& joined = {});

}  // namespace atrapos::fem
