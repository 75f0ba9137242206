#pragma once

#include <cmath>
#include <type_traits>
#include <utility>

#include "atrapos/taylor/Fad.hpp"
#include "atrapos/taylor/SmallLu.hpp"

namespace atrapos::taylor::detail {

// g(x, y, out) or g(x, y, data, out), as its author wrote it.
template <int ND, class G, class T, class P>
ATRAPOS_FORCEINLINE void callImplicit(const G& g, const T* x, const T* y, [[maybe_unused]] const P* data,
                                      T* out) {
  if constexpr (ND > 0)
    g(x, y, data, out);
  else
    g(x, y, out);
}

// Whether the law brings its own guess: void start(const double* x, [const double* data,] double* y) const.
template <int ND, class G, class = void>
struct HasStart : std::false_type {};
template <class G>
struct HasStart<0, G, std::void_t<decltype(std::declval<const G&>().start((double*)0, (double*)0))>>
    : std::true_type {};
template <int ND, class G>
struct HasStart<ND, G,
                std::void_t<decltype(std::declval<const G&>().start((double*)0, (double*)0, (double*)0))>>
    : std::true_type {};

// A member of that name, whatever its arguments.
template <class G, class = void>
struct NamesStart : std::false_type {};
template <class G>
struct NamesStart<G, std::void_t<decltype(&G::start)>> : std::true_type {};

/// g(x, y) = 0 at one point and its derivatives there.
template <int NX, int NY, int ND>
struct LocalNewton {
  static constexpr int maxIterations = 60;
  static constexpr double eps = 2.220446049250313e-16;

  double g[NY];
  double gx[NY][NX];   ///< dg/dx
  double gy[NY * NY];  ///< dg/dy by rows
  SmallLu<NY> lu;      ///< of gy
  double size = 0;     ///< relative residual where `solve` ended

  /// Newton from the law's own start where it has one, otherwise from the guess in y. Each equation is judged
  /// by its own size, the sum of |dg/dz| |z| over its x and y, so neither units nor scalings matter. False
  /// where it does not converge or dg/dy is singular. The members hold what is at the solution; with
  /// `valueOnly` they do not, and the solution is the same.
  template <class G>
  KOKKOS_INLINE_FUNCTION bool solve(const G& law, const double* x, const double* data, double* y,
                                    bool valueOnly = false) {
    // Size of a residual that internal cancellation may leave: stagnating below it is convergence.
    constexpr double nearRounding = 1e-10;
    double last = -1;
    static_assert(
        HasStart<ND, G>::value || !NamesStart<G>::value,
        "start(x, y) without data, start(x, data, y) with data: this law's start has other arguments");
    if constexpr (HasStart<ND, G>::value) {
      if constexpr (ND > 0)
        law.start(x, data, y);
      else
        law.start(x, y);
    }
    for (int iteration = 0; iteration < maxIterations; ++iteration) {
      if (valueOnly && last >= 0 && last <= 4 * eps) return true;
      linearize(law, x, data, y);
      double weight[NY];
      for (int i = 0; i < NY; ++i) {
        weight[i] = 0;
        for (int j = 0; j < NX; ++j) weight[i] += std::fabs(gx[i][j] * x[j]);
        for (int j = 0; j < NY; ++j) weight[i] += std::fabs(gy[i * NY + j] * y[j]);
      }
      size = weighted(g, weight);
      if (std::isnan(size) || !lu.factor(gy)) return false;
      if (size == 0 || (last >= 0 && last <= 4 * eps)) return true;
      if (last >= 0 && last < nearRounding && size > 0.5 * last) return true;
      // Below 4 eps one more, undamped step: the weights can overestimate what rounding allows.
      if (!step(law, x, data, y, weight, size, size < 1e-8)) return false;
      last = size;
    }
    return false;
  }

 private:
  template <class G>
  KOKKOS_INLINE_FUNCTION void linearize(const G& law, const double* x, const double* data, const double* y) {
    using Fad = Sacado::Fad::SFad<double, NX + NY>;
    Fad xf[NX], yf[NY], out[NY];
    for (int j = 0; j < NX; ++j) xf[j] = Fad(NX + NY, j, x[j]);
    for (int j = 0; j < NY; ++j) yf[j] = Fad(NX + NY, NX + j, y[j]);
    callImplicit<ND>(law, xf, yf, data, out);
    for (int i = 0; i < NY; ++i) {
      g[i] = out[i].val();
      for (int j = 0; j < NX; ++j) gx[i][j] = out[i].dx(j);
      for (int j = 0; j < NY; ++j) gy[i * NY + j] = out[i].dx(NX + j);
    }
  }

  // max |r_i| / weight_i; NaN as soon as one residual is.
  static KOKKOS_INLINE_FUNCTION double weighted(const double* r, const double* weight) {
    double size = 0;
    for (int i = 0; i < NY; ++i) {
      // Denormal numbers, as of a force far off a tool, have no digits that an iteration could reduce.
      if (std::fabs(r[i]) < 2.3e-308) continue;
      const double q = std::fabs(r[i]) / weight[i];
      if (!(q <= size)) size = q;
      if (std::isnan(size)) return size;
    }
    return size;
  }

  // y += t dy with the first t = 1, 1/2, 1/4, ... that reduces the residual.
  template <class G>
  KOKKOS_INLINE_FUNCTION bool step(const G& law, const double* x, const double* data, double* y,
                                   const double* weight, double size, bool undamped) {
    double minusG[NY], dy[NY];
    for (int i = 0; i < NY; ++i) minusG[i] = -g[i];
    lu.solve(minusG, dy);
    for (double t = 1; t > 1e-6; t /= 2) {
      double trial[NY], r[NY];
      for (int i = 0; i < NY; ++i) trial[i] = y[i] + t * dy[i];
      if (!undamped) callImplicit<ND>(law, x, static_cast<const double*>(trial), data, r);
      if (undamped || weighted(r, weight) <= (1 - 0.1 * t) * size) {
        for (int i = 0; i < NY; ++i) y[i] = trial[i];
        return true;
      }
    }
    return false;
  }
};

}  // namespace atrapos::taylor::detail
