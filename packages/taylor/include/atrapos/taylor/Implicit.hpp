#pragma once

#include <limits>

#include "atrapos/taylor/Law.hpp"
#include "atrapos/taylor/LocalNewton.hpp"

/// Laws given by an equation g(x, y) = 0 (paper 2.2.2, Algorithm 3).
namespace atrapos::taylor {

namespace detail {

template <int NX, int NY, int ND, class G>
KOKKOS_INLINE_FUNCTION bool solveImplicit(const G& g, const double* x, const double* data, double* y) {
  LocalNewton<NX, NY, ND> newton;
  if (newton.solve(g, x, data, y, true)) return true;
  for (int j = 0; j < NY; ++j) y[j] = std::numeric_limits<double>::quiet_NaN();
  return false;
}

// Fad types: dy = -(dg/dy)^-1 (dg/dx) dx
template <int NX, int NY, int ND, class G, class Fad>
KOKKOS_INLINE_FUNCTION bool solveImplicit(const G& g, const Fad* x, const double* data, Fad* y) {
  static_assert(Sacado::IsFad<Fad>::value && std::is_same_v<typename Sacado::ValueType<Fad>::type, double>,
                "solveImplicit: scalars are double, first-order Sacado Fad types over double, and Sweep");
  LocalNewton<NX, NY, ND> newton;
  double x0[NX], y0[NY];
  int n = 0;
  for (int j = 0; j < NX; ++j) {
    x0[j] = x[j].val();
    if (x[j].size() > n) n = x[j].size();
  }
  for (int j = 0; j < NY; ++j) y0[j] = y[j].val();
  const bool converged = newton.solve(g, x0, data, y0);
  for (int j = 0; j < NY; ++j) y[j] = Fad(n, converged ? y0[j] : std::numeric_limits<double>::quiet_NaN());
  for (int d = 0; d < n && converged; ++d) {
    double right[NY], dy[NY];
    for (int i = 0; i < NY; ++i) {
      right[i] = 0;
      for (int j = 0; j < NX; ++j)
        if (x[j].size() > 0) right[i] -= newton.gx[i][j] * x[j].fastAccessDx(d);
    }
    newton.lu.solve(right, dy);
    for (int i = 0; i < NY; ++i) y[i].fastAccessDx(d) = dy[i];
  }
  return converged;
}

// Order 0 in each lane: y, and with `inverted` the inverse of dg/dy, else zeros, at half the work. Lanes that
// fail become NaN.
template <int NX, int NY, int ND, class G, class X>
KOKKOS_INLINE_FUNCTION bool solveLanes(const G& g, const Sweep<X>* x, const LanesOf<X>* data, LanesOf<X>* y,
                                       bool inverted, LanesOf<X>* inverse, Failures<X::lanes>* failures) {
  bool converged = true;
  double start0[NY];
  for (int j = 0; j < NY; ++j) start0[j] = y[j][0];
  for (int j = 0; j < NY * NY; ++j) inverse[j] = LanesOf<X>(0.0);
  for (int l = 0; l < X::lanes; ++l) {
    double x0[NX], y0[NY], data0[ND + 1];
    // Lanes beyond the last point of a row repeat its first, and a single point is in all of them.
    bool repeats = l > 0 && converged;
    for (int j = 0; j < NX; ++j) {
      x0[j] = x[j].value()[l];
      repeats = repeats && x0[j] == x[j].value()[0];
    }
    for (int j = 0; j < ND; ++j) {
      data0[j] = data[j][l];
      repeats = repeats && data0[j] == data[j][0];
    }
    for (int j = 0; j < NY; ++j) {
      y0[j] = y[j][l];
      repeats = repeats && y0[j] == start0[j];
    }
    if (repeats) {
      for (int j = 0; j < NY; ++j) y[j][l] = y[j][0];
      for (int j = 0; j < NY * NY; ++j) inverse[j][l] = inverse[j][0];
    } else {
      LocalNewton<NX, NY, ND> newton;
      const bool good = newton.solve(g, x0, data0, y0, !inverted);
      converged = converged && good;
      if (!good && failures != nullptr) failures->note(l, Operation::Implicit, newton.size);
      for (int j = 0; j < NY; ++j) y[j][l] = good ? y0[j] : std::numeric_limits<double>::quiet_NaN();
      if (!inverted) continue;
      double inverse0[NY * NY];
      if (good) newton.lu.invert(inverse0);
      for (int j = 0; j < NY * NY; ++j)
        inverse[j][l] = good ? inverse0[j] : std::numeric_limits<double>::quiet_NaN();
    }
  }
  return converged;
}

template <int NX, int NY, int ND, class G, class X>
KOKKOS_INLINE_FUNCTION bool solveImplicit(const G& g, const Sweep<X>* x, const LanesOf<X>* data,
                                          Sweep<X>* y) {
  Context<X::lanes>* context = nullptr;
  for (int j = 0; j < NX; ++j)
    if (!x[j].isPassive()) context = x[j].context();
  for (int j = 0; j < NY; ++j)
    if (!y[j].isPassive()) context = y[j].context();

  LanesOf<X> yk[NY], inverse[NY * NY];
  bool converged = true;
  if (context == nullptr) {  // constants only: the solution is one too
    for (int j = 0; j < NY; ++j) yk[j] = y[j].value();
    converged =
        solveLanes<NX, NY, ND>(g, x, data, yk, false, inverse, static_cast<Failures<X::lanes>*>(nullptr));
    for (int j = 0; j < NY; ++j) y[j] = Sweep<X>(yk[j]);
    return converged;
  }

  const bool start = X::pass == Pass::Start;
  for (int j = 0; j < NY; ++j) yk[j] = start ? y[j].value() : LanesOf<X>(0.0);
  const bool valuesOnly = start && !X::counting && context->valuesOnly;
  if (start && !X::counting)
    converged = solveLanes<NX, NY, ND>(g, x, data, yk, !valuesOnly, inverse, context->failures);

  // y takes slots, the inverse of dg/dy is of order 0 only; then comes what g takes.
  double* slots = takeSlots<X>(*context, NY);
  for (int j = 0; j < NY; ++j) {
    record<X::pass>(*context, slots + j * X::lanes, yk[j]);
    y[j] = Sweep<X>(yk[j], context, slots + j * X::lanes);
  }
  if (valuesOnly) return converged;
  for (int j = 0; j < NY * NY; ++j) inverse[j] = keep<X>(*context, inverse[j]);

  // The arguments as they are before g gives slots to some of them: g's second execution must take the
  // same slots again.
  Sweep<X> still[NX];
  if (!start)
    for (int j = 0; j < NX; ++j) still[j] = x[j].isPassive() ? x[j] : x[j].withValue(LanesOf<X>(0.0));

  Sweep<X> residual[NY];
  const Context<X::lanes> before = *context;
  callImplicit<ND>(g, x, static_cast<const Sweep<X>*>(y), data,
                   residual);  // Sweep: gt_k; Complete: (dg/dx) dx
  if constexpr (X::pass == Pass::Start) return converged;

  for (int i = 0; i < NY; ++i) {
    LanesOf<X> sum(0.0);
    for (int j = 0; j < NY; ++j) sum += inverse[i * NY + j] * residual[j].coefficient();
    yk[i] = -sum;
  }

  // Nothing is recorded in Linear, and nobody asks for the histories inside g.
  if constexpr (X::pass == Pass::Linear) {
    for (int j = 0; j < NY; ++j) y[j] = y[j].withValue(yk[j]);
    return true;
  } else {
    // Second execution: the histories inside g become those of the true y_k (paper, Algorithm 3, leaves this
    // out).
    using Again = Execution<X::lanes, Pass::Complete, X::counting>;
    double* const nextSum = context->nextSum;  // the sums of this pass: the second execution takes none
    *context = before;
    context->nextSum = nextSum;
    Sweep<Again> xk[NX], dy[NY], unused[NY];
    for (int j = 0; j < NX; ++j) xk[j] = still[j].template in<Again>();
    for (int j = 0; j < NY; ++j) {
      double* slot = y[j].slot();
      record<Pass::Complete>(*context, slot, yk[j]);
      y[j] = Sweep<X>(yk[j], context, slot);
      dy[j] = y[j].template in<Again>();
    }
    callImplicit<ND>(g, static_cast<const Sweep<Again>*>(xk), static_cast<const Sweep<Again>*>(dy), data,
                     unused);
    return true;
  }
}

}  // namespace detail

/// Solves g(x, y) = 0 for y inside a law or on its own.
///
/// G has `template <class T> void operator()(const T* x, const T* y, T* g) const`, with shapes x[NX], y[NY],
/// g[NY], and no branch on values; quantities that are constant at a point may be elements of x. Newton
/// starts from g.start(x, y) where G has that member (`void start(const double* x, double* y) const`, with
/// data: start(x, data, y)), otherwise from y on entry (only its value counts). On exit y is the solution:
/// - double: Newton to rounding;
/// - Sacado Fad over double: also dy = -(dg/dy)^-1 (dg/dx) dx;
/// - Sweep: Start as double in every lane; then y_k = -(dg/dy)^-1 g_k|_{y_k=0} (paper (20)). y is then an
///   operand like any other.
/// False, with NaN in y (in the lanes concerned), where Newton fails or dg/dy is singular; passes after
/// Start return true and carry the NaN on.
template <int NX, int NY, class G, class T>
KOKKOS_INLINE_FUNCTION bool solveImplicit(const G& g, const T* x, T* y) {
  return detail::solveImplicit<NX, NY, 0>(g, x, static_cast<const Passive<T>*>(nullptr), y);
}

/// The same with ND passive data: operator()(const T* x, const T* y, const Passive<T>* data, T* g).
template <int NX, int NY, int ND, class G, class T>
KOKKOS_INLINE_FUNCTION bool solveImplicit(const G& g, const T* x, const Passive<T>* data, T* y) {
  static_assert(ND > 0, "without data call solveImplicit<NX, NY>(g, x, y)");
  return detail::solveImplicit<NX, NY, ND>(g, x, data, y);
}

}  // namespace atrapos::taylor
