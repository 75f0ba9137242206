#pragma once

#include <functional>
#include <optional>

#include "atrapos/path/Calls.hpp"

namespace atrapos::path {

/// What one series is asked to be.
struct SeriesRequest {
  int order = 20;  ///< K, the highest order
  /// Asked after every order below K: whether those computed so far are enough. Empty: all are computed.
  std::function<bool(const Series&)> enough;
  std::optional<double> weight;  ///< w; empty: 1 / <Xhat, Xhat>
  double direction = 1;          ///< sign of lambda_1 where `previous` is null
  /// The tangent at the end of the previous step, whose sense is kept; null at the start of a path.
  const PathTangent* previous = nullptr;
  /// A residual R0 of the start that the series takes to zero over the length `relaxOver`; null: none.
  const Vector* residual = nullptr;
  double relaxOver = 1;
  /// A force that grows with a: the series is that of R(U(a), lambda(a)) = a * perturbation; null: none.
  const Vector* perturbation = nullptr;
  /// Where coefficients grow beyond floating-point numbers the series ends with those before; false:
  /// notFinite.
  bool mayOverflow = false;
  bool factored = false;  ///< the tangent solver holds K_T of the start already
};

/// The Taylor series of the path at a state, to the highest order or as far as is enough: one factorization,
/// one solve per order.
///
/// With K_T Uhat = F, K_T V_k = F_k and hats for the pair (unknowns, internal variables), which the Problem's
/// inner product takes:
///
///     lambda_1 = +-1/sqrt(1 + w <Xhat, Xhat>)     X_k = Xv_k + lambda_k Xhat
///     lambda_k = -w <Xv_k, lambda_1 Xhat> lambda_1
///
/// which is a = w <X - X0, X_1> + (lambda - lambda0) lambda_1 at every order, with no division by lambda_1.
/// Throws PathError: singularTangent, loadWithoutEffect, notFinite.
Series buildSeries(Calls& calls, const State& start, const SeriesRequest& request);

}  // namespace atrapos::path
