#pragma once

#include "Augmented.hpp"
#include "Critical.hpp"

namespace atrapos::path {

/// Newton on the extended system of a simple bifurcation point, R(x) + z p = 0, g(x) = 0
/// (docs/theory/path.md).
class ExtendedSystem {
 public:
  ExtendedSystem(Calls& calls, const CriticalSearch& search, const RCP<Vector>& nullGuess)
      : calls_(calls), w_(search.series.weight()), phi_(nullGuess), F_(calls.newVector()) {}

  /// Borders from the tangent at `state`, which is factored here or, where `held`, stands in the solver
  /// already, maybe for a state near; `exact`: the null vector's guess is better than inverse iteration makes
  /// it. False where the path does not lie in the plane of the two directions found.
  bool enter(const State& state, const Augmented& path, bool held, bool exact);
  /// One Newton step from `state` (moved); `moved` is its size in w <U, U> + lambda^2.
  bool iterate(State& state, double& moved);

  const Augmented& V(int i) const { return V_[i]; }
  double H(int i, int j) const { return H_[i][j]; }
  const RCP<Vector>& psi() const { return psi_; }
  const RCP<Vector>& phi() const { return phi_; }

 private:
  /// M [x; z] = [b; beta].
  bool solveM(const Bordered& M, const RCP<const Vector>& b, double beta0, double beta1, Augmented& x,
              double& z) const;

  Calls& calls_;
  double w_;
  RCP<Vector> phi_, F_, p_, psi_;
  Augmented Q_[2], V_[2];
  double H_[2][2] = {{0, 0}, {0, 0}};
  double z_ = 0;
};

}  // namespace atrapos::path
