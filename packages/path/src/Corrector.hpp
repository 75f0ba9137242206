#pragma once

#include <string>

#include "Augmented.hpp"
#include "atrapos/path/NewtonFollower.hpp"

namespace atrapos::path {

/// Newton iterations in the plane normal to a direction of the path.
///
/// Holds what the last factorization gave: K^-1 and Uhat = K^-1 F of the state factored, and how far the
/// iterations went from there.
class Corrector {
 public:
  Corrector(Calls& calls, const NewtonOptions& options) : calls_(calls), options_(options) {}

  struct Result {
    int iterations = 0;
    double first = 0;     ///< relative residual at the predictor
    double residual = 0;  ///< and at the state returned
    bool converged = false;
    std::string trouble;  ///< why it did not converge
  };

  /// Factors the tangent at a state, Uhat included. Throws PathError.
  void factor(const State& state);

  /// Iterates from `state`, normal to `direction`, until the residual bound is kept; `r` is R at the end.
  Result correct(State& state, Vector& r, const Augmented& direction, double weight);

  /// (dU, dlambda) with K dU - F dlambda = rhs, direction . (dU, dlambda) = 0, by the last factorization.
  Augmented solve(const Vector& rhs, const Augmented& direction, double weight);

  /// dX/da at a state, i.e. K T_u = F T_lambda and direction . T = 1, by the last factorization as it is.
  Augmented tangent(const Augmented& direction, double weight) const;

  /// The same exactly: refined with the tangent of the state, which is assembled but not factored unless the
  /// refinement fails.
  Augmented tangentAt(const State& state, const Augmented& direction, double weight);

  /// Uhat of the last factorization.
  const RCP<Vector>& uhat() const { return uhat_; }
  /// Distance of the state that `correct` returned from the one factored last.
  double distance() const { return distance_; }
  std::optional<linear::Inertia> inertia() const { return calls_.inertia(); }

  /// x . y with the Problem's inner product of the unknowns.
  double dot(const Augmented& x, const Augmented& y, double weight) const;

 private:
  Calls& calls_;
  const NewtonOptions& options_;
  RCP<Vector> F_, uhat_;
  double distance_ = 0;
};

}  // namespace atrapos::path
