#pragma once

#include <vector>

#include "atrapos/fem/Coupling.hpp"
#include "atrapos/fem/Term.hpp"

namespace atrapos::fem::detail {

/// Couplings u_s = c.u + value + lambda rate on vectors and matrices over all dofs
/// (docs/theory/couplings.md): with u = T u + ..., forces become T^T f and the tangent T^T K T + s sum (e_s -
/// c)(e_s - c)^T, whose rows s are the couplings themselves.
class CoupledSystem {
 public:
  CoupledSystem() = default;
  explicit CoupledSystem(std::vector<Coupling> resolved);

  bool empty() const { return couplings_.empty(); }
  const std::vector<Coupling>& couplings() const { return couplings_; }

  /// f = T^T f: a slave's force goes to its masters, its own entry becomes 0.
  void gatherForces(const DofView& f) const;

  /// Adds the rows of the couplings at a state whose forces are gathered: g_s = s (u_s - c.u - value - lambda
  /// rate) at the slave, -c g_s at its masters; s of every dof.
  void addGaps(const ConstDofView& u, double lambda, const ConstDofView& s, const DofView& f) const;

  /// Turns the assembled tangent and load direction F into those of the coupled system. Rows have ascending
  /// columns; throws std::logic_error where the graph lacks an entry.
  void transform(const View<std::size_t*>& rowStart, const View<int*>& columns, const View<double*>& values,
                 const ConstDofView& s, const DofView& F) const;

 private:
  /// The couplings as the kernels read them.
  struct Rows {
    int count = 0;
    View<int*> slave, start, master;  // start: [coupling + 1] into master
    View<double*> factor, value, rate;
  };

  /// The same by masters.
  struct Columns {
    int count = 0;
    View<int*> master, start, coupling;  // start: [master + 1] into coupling
    View<double*> factor;
  };

  std::vector<Coupling> couplings_;
  Rows rows_;
  Columns columns_;
};

}  // namespace atrapos::fem::detail
