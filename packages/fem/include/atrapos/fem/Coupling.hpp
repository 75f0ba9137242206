#pragma once

#include <array>
#include <utility>
#include <vector>

#include "atrapos/fem/Support.hpp"

/// Linear couplings between dofs (multi-point constraints), eliminated exactly (docs/theory/couplings.md).
namespace atrapos::fem {

/// One term of a coupling: factor times an unknown.
struct CoupledDof {
  int dof = 0;
  double factor = 1;
};

/// u_dof = sum of the masters' terms + value + lambda perLoadFactor.
struct Coupling {
  int dof = 0;  ///< the slave
  std::vector<CoupledDof> masters;
  double value = 0, perLoadFactor = 0;
};

/// Couplings of a model. A slave has one coupling and no support; a master may be supported, and may be the
/// slave of another coupling.
class Couplings {
 public:
  void add(Coupling coupling) { couplings_.push_back(std::move(coupling)); }

  bool empty() const { return couplings_.empty(); }
  int count() const { return static_cast<int>(couplings_.size()); }
  bool driven() const;  ///< any perLoadFactor != 0
  const std::vector<Coupling>& all() const { return couplings_; }

  /// The same with masters that are no slaves, each once. Throws std::invalid_argument naming a slave that
  /// has two couplings, depends on itself, or is supported, and for unknowns that are not there.
  std::vector<Coupling> resolved(const DofMap& dofs, const Supports& supports) const;

 private:
  std::vector<Coupling> couplings_;
};

// What follows couples the vectors of nodes: their first fields, displacements or changes of directors.

/// Every component of these nodes moves as that of the first one.
void coupleEqual(Couplings& couplings, const DofMap& dofs, const std::vector<int>& nodes);

/// These nodes keep a common displacement along `normal` (any length): an edge or face stays in a plane that
/// shifts but does not turn. The first node leads. Throws std::invalid_argument for a zero normal.
void couplePlane(Couplings& couplings, const DofMap& dofs, const std::vector<int>& nodes,
                 const std::array<double, 3>& normal);

/// u = sum of factor_i u_i, all components; `masters` are (node, factor).
struct CoupledNode {
  int node = 0;
  double factor = 1;
};
void coupleNode(Couplings& couplings, const DofMap& dofs, int node, const std::vector<CoupledNode>& masters);

/// Joins a node of a shell's edge to a solid: v = (u_top + u_bottom)/2 and w = (u_top - u_bottom)/2, so that
/// the director follows the solid's side. `top` and `bottom` are the solid's nodes at X + D and X - D of the
/// shell's node. Nodes of the solid between them are to be coupled to both in the same way (coupleNode), or
/// constant stress does not pass. joinMidsurface = false leaves v free.
void coupleShellToSolid(Couplings& couplings, const DofMap& dofs, int shellNode, int directorNode, int top,
                        int bottom, bool joinMidsurface = true);

}  // namespace atrapos::fem
