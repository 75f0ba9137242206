#pragma once

#include <limits>

#include "atrapos/taylor/Law.hpp"
#include "atrapos/taylor/RateForm.hpp"
#include "atrapos/taylor/SmallLu.hpp"

/// Laws with internal variables that follow rates, A(v, z) z' = B(v, z) v' (docs/theory/taylor.md, Rate
/// laws).
namespace atrapos::taylor {

namespace detail {

// g(v, z, dv, dz, out) or g(v, z, data, dv, dz, out), as its author wrote it.
template <int ND, class G, class T, class P, class R>
ATRAPOS_FORCEINLINE void callRate(const G& g, const T* v, const T* z, [[maybe_unused]] const P* data,
                                  const R* dv, const R* dz, R* out) {
  if constexpr (ND > 0)
    g(v, z, data, dv, dz, out);
  else
    g(v, z, dv, dz, out);
}

/// A and B at one point, the coefficients of g = A z' - B v' by the rates.
template <int NV, int NZ, int ND>
struct RateMatrices {
  double a[NZ * NZ];  ///< by rows
  double b[NZ][NV];
  SmallLu<NZ> lu;    ///< of a
  double pivot = 0;  ///< SmallLu::leastPivot; 0 or NaN where there is no factor

  /// False where A is singular to rounding or not finite.
  template <class G>
  KOKKOS_INLINE_FUNCTION bool evaluate(const G& g, const double* v, const double* z, const double* data) {
    RateCoefficients<NV + NZ> dv[NV], dz[NZ], out[NZ];
    for (int j = 0; j < NV; ++j) dv[j].by[j] = 1;
    for (int j = 0; j < NZ; ++j) dz[j].by[NV + j] = 1;
    callRate<ND>(g, v, z, data, dv, dz, out);
    for (int i = 0; i < NZ; ++i) {
      for (int j = 0; j < NV; ++j) b[i][j] = -out[i].by[j];
      for (int j = 0; j < NZ; ++j) a[i * NZ + j] = out[i].by[NV + j];
    }
    return factor();
  }

  KOKKOS_INLINE_FUNCTION bool factor() {
    constexpr double rounding = 4 * NZ * std::numeric_limits<double>::epsilon();
    pivot = 0;
    if (lu.factor(a)) pivot = lu.leastPivot(a);
    return pivot > rounding;
  }
};

template <int NV, int NZ, int ND, class G>
KOKKOS_INLINE_FUNCTION bool solveRate(const G&, const double*, const double*, double*) {
  return true;
}

#if !defined(ATRAPOS_WITHOUT_TRILINOS)
// Fad types: dz = A^-1 B dv
template <int NV, int NZ, int ND, class G, class Fad>
KOKKOS_INLINE_FUNCTION bool solveRate(const G& g, const Fad* v, const double* data, Fad* z) {
  static_assert(Sacado::IsFad<Fad>::value && std::is_same_v<typename Sacado::ValueType<Fad>::type, double>,
                "solveRate: scalars are double, first-order Sacado Fad types over double, and Sweep");
  double v0[NV], z0[NZ];
  int n = 0;
  for (int j = 0; j < NV; ++j) {
    v0[j] = v[j].val();
    if (v[j].size() > n) n = v[j].size();
  }
  for (int j = 0; j < NZ; ++j) z0[j] = z[j].val();
  RateMatrices<NV, NZ, ND> matrices;
  const bool regular = matrices.evaluate(g, v0, z0, data);
  for (int j = 0; j < NZ; ++j) z[j] = Fad(n, z0[j]);
  for (int d = 0; d < n; ++d) {
    double right[NZ], dz[NZ];
    for (int i = 0; i < NZ; ++i) {
      right[i] = 0;
      dz[i] = notANumber;
      for (int j = 0; j < NV; ++j)
        if (v[j].size() > 0) right[i] += matrices.b[i][j] * v[j].fastAccessDx(d);
    }
    if (regular) matrices.lu.solve(right, dz);
    for (int i = 0; i < NZ; ++i) z[i].fastAccessDx(d) = dz[i];
  }
  return regular;
}
#endif

/// One execution of g in pass Y of the context that active v and z belong to, all with slots: vk and zk are
/// their coefficients in that pass.
template <class Y, int NV, int NZ, int ND, class G, class X>
KOKKOS_INLINE_FUNCTION void executeRate(const G& g, const Sweep<X>* v, const LanesOf<X>* vk,
                                        const LanesOf<X>* data, const Sweep<X>* z, const LanesOf<X>* zk,
                                        LanesOf<X>* out) {
  Sweep<Y> x[NV], y[NZ];
  RateForm<Y> dv[NV], dz[NZ], form[NZ];
  for (int j = 0; j < NV; ++j) {
    x[j] = v[j].isPassive() ? Sweep<Y>(v[j].value()) : v[j].template in<Y>().withValue(vk[j]);
    dv[j] = RateForm<Y>(x[j]);
  }
  for (int j = 0; j < NZ; ++j) {
    y[j] = z[j].template in<Y>().withValue(zk[j]);
    dz[j] = RateForm<Y>(y[j]);
  }
  callRate<ND>(g, static_cast<const Sweep<Y>*>(x), static_cast<const Sweep<Y>*>(y), data,
               static_cast<const RateForm<Y>*>(dv), static_cast<const RateForm<Y>*>(dz), form);
  for (int i = 0; i < NZ; ++i) out[i] = form[i].value();
}

/// The inverse of A after g's Start, a column of A in all lanes by an execution of the linear pass. False,
/// with a note and NaN, in lanes where A is singular.
template <int NV, int NZ, int ND, class G, class X>
KOKKOS_INLINE_FUNCTION bool invertRates(const G& g, Context<X::lanes>& context,
                                        const Context<X::lanes>& before, const Sweep<X>* v,
                                        const LanesOf<X>* data, const Sweep<X>* z, LanesOf<X>* inverse) {
  using Column = Execution<X::lanes, Pass::Linear, X::counting>;
  LanesOf<X> a[NZ * NZ], still[NV], unit[NZ], column[NZ];
  for (int j = 0; j < NV; ++j) still[j] = 0.0;
  for (int j = 0; j < NZ; ++j) unit[j] = 0.0;
  for (int j = 0; j < NZ; ++j) {
    context = before;
    unit[j] = 1.0;
    executeRate<Column, NV, NZ, ND>(g, v, still, data, z, unit, column);
    unit[j] = 0.0;
    for (int i = 0; i < NZ; ++i) a[i * NZ + j] = column[i];
  }
  bool regular = true;
  for (int l = 0; l < X::lanes; ++l) {
    RateMatrices<1, NZ, 0> lane;
    double inverse0[NZ * NZ];
    for (int j = 0; j < NZ * NZ; ++j) {
      lane.a[j] = a[j][l];
      inverse0[j] = notANumber;
    }
    const bool good = lane.factor();
    if (good)
      lane.lu.invert(inverse0);
    else if (!context.plain && context.failures != nullptr)
      context.failures->note(l, Operation::Rate, lane.pivot);
    for (int j = 0; j < NZ * NZ; ++j) inverse[j][l] = inverse0[j];
    regular = regular && good;
  }
  return regular;
}

template <int NV, int NZ, int ND, class G, class X>
KOKKOS_INLINE_FUNCTION bool solveRate(const G& g, const Sweep<X>* v, const LanesOf<X>* data, Sweep<X>* z) {
  Context<X::lanes>* context = nullptr;
  for (int j = 0; j < NZ; ++j)
    if (!z[j].isPassive()) context = z[j].context();
  for (int j = 0; j < NV; ++j)
    if (!v[j].isPassive()) context = v[j].context();
  if (context == nullptr) return true;  // constants have no rates

  // z and all arguments that move own slots before g is executed: each execution takes the same ones again.
  constexpr bool start = X::pass == Pass::Start;
  LanesOf<X> vk[NV], zk[NZ], form[NZ], inverse[NZ * NZ];
  double* slots = takeSlots<X>(*context, NZ);
  for (int j = 0; j < NZ; ++j) {
    zk[j] = start ? z[j].value() : LanesOf<X>(0.0);
    record<X::pass>(*context, slots + j * X::lanes, zk[j]);
    z[j] = Sweep<X>(zk[j], context, slots + j * X::lanes);
  }
  for (int j = 0; j < NV; ++j) {
    vk[j] = v[j].value();
    if (!v[j].isPassive()) v[j].slot();
  }
  const Context<X::lanes> before = *context;
  executeRate<X, NV, NZ, ND>(g, v, vk, data, z, zk, form);  // with z_k = 0: -(B_0 v_k + what is known)

  if constexpr (start) {
    bool regular = true;
    for (int j = 0; j < NZ * NZ; ++j) inverse[j] = 0.0;
    if constexpr (!X::counting) {
      const Context<X::lanes> after = *context;
      regular = invertRates<NV, NZ, ND>(g, *context, before, v, data, z, inverse);
      *context = after;
    }
    for (int j = 0; j < NZ * NZ; ++j) inverse[j] = keep<X>(*context, inverse[j]);
    // Without rates there is no series. (As doubles the state is what it is.)
    for (int i = 0; i < NZ && !context->plain; ++i)
      for (int j = 0; j < NZ; ++j)
        z[i] = z[i].withValue(z[i].value() + (0.0 * inverse[i * NZ + j] + 0.0 * form[j]));
    return regular;
  } else {
    for (int j = 0; j < NZ * NZ; ++j) inverse[j] = keep<X>(*context, inverse[j]);
    for (int i = 0; i < NZ; ++i) {
      LanesOf<X> sum(0.0);
      for (int j = 0; j < NZ; ++j) sum += inverse[i * NZ + j] * form[j];
      zk[i] = -sum;
      if constexpr (X::pass != Pass::Linear) record<Pass::Complete>(*context, z[i].slot(), zk[i]);
      z[i] = z[i].withValue(zk[i]);
    }
    // Second execution: the histories inside g become those of the true z_k.
    if constexpr (X::pass != Pass::Linear) {
      const Context<X::lanes> after = *context;
      *context = before;
      for (int j = 0; j < NV; ++j) vk[j] = 0.0;
      executeRate<Execution<X::lanes, Pass::Complete, X::counting>, NV, NZ, ND>(g, v, vk, data, z, zk, form);
      *context = after;
    }
    return true;
  }
}

}  // namespace detail

/// Internal variables z that follow v, by the rate law g = A(v, z) z' - B(v, z) v' = 0, inside a law or on
/// its own.
///
/// G has `template <class T, class R> void operator()(const T* v, const T* z, const R* dv, const R* dz, R* g)
/// const`, with shapes v[NV], z[NZ], dv[NV], dz[NZ], g[NZ], and no branch on values. dv and dz are the rates
/// of v and z; g is a sum of products of values (T, data, double) and rates, linear in the rates as RateForm
/// is. Intermediate rates are stored in an R, which begins as zero, never in an auto. Time and the load
/// factor are elements of v like others.
///
/// On entry z is the state of the point (only its value counts): passive data of the law that calls. On exit:
/// - double: unchanged, and g is not looked at;
/// - Sacado Fad over double: the same values, with dz = A^-1 B dv;
/// - Sweep: Start as double in every lane; then z_k = A^-1 B v_k + what is known from lower orders. z is then
///   an operand like any other. Arguments that are not inputs of the law get a history slot.
/// False, with NaN in the derivatives and, in a Start that is not `plain`, in z (in the lanes concerned),
/// where A is singular to rounding; passes after Start return true and carry the NaN on. Start also gives NaN
/// where a factor of a rate is not finite.
template <int NV, int NZ, class G, class T>
KOKKOS_INLINE_FUNCTION bool solveRate(const G& g, const T* v, T* z) {
  return detail::solveRate<NV, NZ, 0>(g, v, static_cast<const Passive<T>*>(nullptr), z);
}

/// The same with ND passive data: operator()(const T* v, const T* z, const Passive<T>* data, const R* dv,
/// const R* dz, R* g).
template <int NV, int NZ, int ND, class G, class T>
KOKKOS_INLINE_FUNCTION bool solveRate(const G& g, const T* v, const Passive<T>* data, T* z) {
  static_assert(ND > 0, "without data call solveRate<NV, NZ>(g, v, z)");
  return detail::solveRate<NV, NZ, ND>(g, v, data, z);
}

}  // namespace atrapos::taylor
