#pragma once

#include <array>

#include "atrapos/path/Calls.hpp"

namespace atrapos::path {

/// A change of the unknowns and the load together, in R^(n+1). Internal variables do not take part: which
/// scalar product borders a system is free.
struct Augmented {
  RCP<Vector> u;
  double lambda = 0;
};

/// w u . v + lambda mu.
double dot(const Augmented& x, const Augmented& y, double weight);

/// w <u, v> + lambda mu with the Problem's inner product of the unknowns, in which fields of different units
/// are measured beside each other.
double dot(const Problem& problem, const Augmented& x, const Augmented& y, double weight);

RCP<Vector> copy(const Vector& v);
Augmented copy(const Augmented& x);
/// x + factor y.
void add(Augmented& x, double factor, const Augmented& y);
void scale(Augmented& x, double factor);

/// Values without symmetry, the same at every call with the same `which` >= 1: what must not be orthogonal to
/// any null vector.
void fillUnsymmetric(Vector& v, int which);

/// psi . D^2R(x, x) at a state, by order 2 of the residual's series: D^2R(x, x) = -2 F_2 with U_1 = x.
/// Nothing is differentiated numerically.
class SecondOrder {
 public:
  SecondOrder(Calls& calls, const State& state, RCP<const Vector> psi);
  double operator()(const Augmented& x);
  /// psi . D^2R(x, y) by polarisation.
  double operator()(const Augmented& x, const Augmented& y);

 private:
  Calls& calls_;
  const State& state_;
  RCP<const Vector> psi_;
  RCP<Vector> F_;
};

/// The system with two borders
///
///     K x + c_0 xi_0 + c_1 xi_1 = b,   r_i . x + d_i0 xi_0 + d_i1 xi_1 = beta_i,   i = 0, 1,
///
/// or the same with K^T, solved with a factorization of K or of a matrix near K: block elimination and
/// iterative refinement, which stays accurate where K alone is nearly singular (Govaerts and Pryce 1990).
struct Bordered {
  RCP<const CrsMatrix> K;
  bool transposed = false;
  std::array<RCP<const Vector>, 2> columns, rows;
  double d[2][2] = {{0, 0}, {0, 0}};
  /// Least size of K's entries that rounding is measured by: all of K may vanish at once.
  double stiffness = 0;

  struct Solution {
    RCP<Vector> x;
    std::array<double, 2> xi{};
    bool good = false;  ///< the residual fell to rounding size
  };
  Solution solve(Calls& calls, const RCP<const Vector>& b, std::array<double, 2> beta) const;
};

}  // namespace atrapos::path
