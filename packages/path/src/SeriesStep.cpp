#include "atrapos/path/SeriesStep.hpp"

#include <cmath>
#include <sstream>

#include <Tpetra_Vector.hpp>

namespace atrapos::path {

namespace {

/// Below this lambda_1 a tangent is singular to working accuracy: U_k = V_k + lambda_k Uhat loses the digits
/// that lambda_1 is short of 1, and half of them must stay.
constexpr double nearlySingular = 1e-8;

/// Squares of norms below this are no motion: forces that fall off exponentially are never quite zero, and
/// what is divided by these squares is to stay a number.
constexpr double nothing = 1e-60;

[[noreturn]] void notFinite(const char* what, int k, const State& start) {
  std::ostringstream text;
  text << what << " of order " << k << " is not finite (series at lambda = " << start.lambda << ")";
  throw PathError(EndReason::notFinite, text.str());
}

[[noreturn]] void withoutEffect(const State& start) {
  std::ostringstream text;
  text << "the load parameter does not move the unknowns (K_T^-1 F = 0 at lambda = " << start.lambda << ")";
  throw PathError(EndReason::loadWithoutEffect, text.str());
}

/// Coefficients grow like the inverse radius to the power of the order: beyond what floating-point numbers
/// hold where the radius is very small. Sums of their products overflow from about here on.
bool overflows(const Series& series, int k) {
  constexpr int fewest = 4;  // orders that a radius can be read off
  constexpr double large = 1e100;
  return k > fewest && series.norm(k - 1) > large;
}

/// x + mu y.
Increment combine(Increment x, double mu, const Increment& y) {
  x.u->update(mu, *y.u, 1);
  for (std::size_t i = 0; i < x.internal.size(); ++i) x.internal[i] += mu * y.internal[i];
  return x;
}

}  // namespace

Series buildSeries(Calls& calls, const State& start, const SeriesRequest& request) {
  const Problem& problem = calls.problem();
  auto F = calls.newVector();
  if (request.factored)
    calls.tangent(start, *F);
  else
    calls.factor(start, *F);
  if (!std::isfinite(F->norm2())) notFinite("the load F", 1, start);

  auto Uhat = calls.newVector();
  calls.solve(*F, *Uhat);
  calls.beginSeries(start, request.order);
  auto Fk = calls.newVector();
  calls.orderRhs(1, *Fk);  // zero at a solution; called for what it leaves behind for the later orders
  Increment Xhat = calls.internalOrder(1, Uhat, 1);
  // Nothing moves yet: lambda alone goes on, up to an event that its motion brings, or to where forces begin.
  const bool still = problem.inner(Xhat, Xhat) < nothing;
  if (still) {
    Uhat->putScalar(0);
    Xhat = calls.internalOrder(1, Uhat, 1);
  }
  const double w = still ? request.weight.value_or(1) : calls.weight(Xhat, request.weight);
  const double hat2 = problem.inner(Xhat, Xhat);  // which the weight may change
  if (!std::isfinite(hat2)) notFinite("the tangent direction", 1, start);

  // Internal variables may move as fast as they like: widths of zones behind their birth do.
  const Increment unknowns{Xhat.u, std::vector<double>(Xhat.internal.size(), 0.0)};
  const double response = std::sqrt(1 + w * problem.inner(unknowns, unknowns));
  if (1 / response < nearlySingular) {
    std::ostringstream text;
    text << "the tangent is singular to working accuracy at lambda = " << start.lambda
         << " (the response to the load is " << response
         << " times what path/weight makes one, the first step's where none is given)";
    throw PathError(EndReason::singularTangent, text.str());
  }
  double lambda1 = request.direction / std::sqrt(1 + w * hat2);
  if (const auto* previous = request.previous) {
    const double along = w * problem.inner(Xhat, previous->x) + previous->lambda;
    lambda1 = std::copysign(lambda1, along);
  }

  Series series(start, w);
  series.appendEvents(calls.eventOrder(0));
  for (const int i : problem.growingAt(start)) series.addGrowing(i, problem.negligibleFall(i));
  for (int k = 1; k <= request.order; ++k) {
    auto V = calls.newVector();
    // Order 1 of an exact solution has no right-hand side.
    const bool zero = k == 1 && !request.residual && !request.perturbation;
    if (k > 1) {
      calls.orderRhs(k, *Fk);
    } else {
      Fk->putScalar(0);
      if (request.residual) Fk->update(-1 / request.relaxOver, *request.residual, 1);
      if (request.perturbation) Fk->update(1, *request.perturbation, 1);
    }
    if (!zero && !still) calls.solve(*Fk, *V);
    const Increment Xv = calls.internalOrder(k, V, 0);
    // <X_k, D> w + lambda_k lambda_1 = [k = 1] with D = lambda_1 Xhat, (1 + w <Xhat, Xhat>) lambda_1^2 = 1.
    const double lambdaK = lambda1 * ((k == 1 ? 1.0 : 0.0) - w * lambda1 * problem.inner(Xv, Xhat));
    Increment Xk = combine(Xv, lambdaK, Xhat);
    const double norm = std::sqrt(problem.inner(Xk, Xk));
    if (!std::isfinite(norm) && request.mayOverflow && overflows(series, k)) break;
    if (!std::isfinite(lambdaK) || !std::isfinite(norm)) notFinite("the coefficient", k, start);
    calls.completeOrder(k, *Xk.u, lambdaK);
    series.append(std::move(Xk), lambdaK, norm);
    series.appendEvents(calls.eventOrder(k));
    if (k < request.order && request.enough && request.enough(series)) break;
  }
  if (still && problem.eventCount() > 0 && !series.eventsMove()) withoutEffect(start);
  series.setMemory(calls.memoryOrders());
  return series;
}

}  // namespace atrapos::path
