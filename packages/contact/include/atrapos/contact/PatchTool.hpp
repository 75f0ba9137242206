#pragma once

#include <Kokkos_Core.hpp>
#include <cmath>
#include <string>

#include "atrapos/contact/PatchPoint.hpp"
#include "atrapos/contact/Requirements.hpp"
#include "atrapos/taylor/Implicit.hpp"

namespace atrapos::contact {

/// A set of (rational) Bezier patches as a tool; paper (13) with S = A/w multiplied by the weight w:
///
///     w(t) (x - h n) - A(t) = 0,   <n, n> - 1 = 0,   <n, A_i - w_i x> + h w_i = 0,   i = 1, 2
///
/// Unknowns y = (h, n, t1, t2). A and w are polynomials in t1, t2, which are in [-1, 1] over the patch;
/// beyond the law goes on with them. Made by PatchSet::tool.
///
/// data: the patch that the point is over (-1: none, the point carries no force) and (t1, t2) to begin from.
/// It is fixed while series of a step are built and used, and brought up to date between steps by
/// PatchSet::follow (docs/theory/contact.md). Lanes read the coefficients of their own patch; the operations
/// are the same for all.
struct PatchTool {
  static constexpr int numUnknowns = 6, numToolData = 3;
  static constexpr bool symmetric = true;

  int numPatches = 0;
  int degree[2] = {1, 1};
  bool rational = false;   ///< some weight is not 1
  double orientation = 1;  ///< n = orientation S_1 x S_2/|S_1 x S_2|
  double scale = 1;        ///< size of a patch, a length
  /// [patch][i][j][4], of t1^i t2^j: coordinates times weight, weight. After the last patch follows a plane,
  /// on which points without a patch are projected so that all lanes have numbers.
  Kokkos::View<const double*> coefficients;

  // Not inlined: it is large, and stands in several laws and passes.
  template <class T>
  ATRAPOS_NOINLINE KOKKOS_FUNCTION void operator()(const T* x, const T* y, const taylor::Passive<T>* data,
                                                   T* g) const {
    const int p = degree[0], q = degree[1];
    T power1[maxPatchDegree + 1], power2[maxPatchDegree + 1];
    power1[1] = y[4];
    power2[1] = y[5];
    for (int i = 2; i <= p; ++i) power1[i] = power1[i - 1] * y[4];
    for (int j = 2; j <= q; ++j) power2[j] = power2[j - 1] * y[5];

    const auto patch = origin(data[0]);
    const int components = rational ? 4 : 3;
    T A[3][4];  // A, A_1, A_2: linear in the monomials
    for (int i = 0; i <= p; ++i)
      for (int j = 0; j <= q; ++j) {
        if (i == 0 && j == 0) {
          for (int c = 0; c < components; ++c) {
            A[0][c] = T(at(patch, 0, 0, c));
            A[1][c] = T(at(patch, 1, 0, c));
            A[2][c] = T(at(patch, 0, 1, c));
          }
          continue;
        }
        const T monomial = i == 0 ? power2[j] : j == 0 ? power1[i] : T(power1[i] * power2[j]);
        for (int c = 0; c < components; ++c) {
          A[0][c] += at(patch, i, j, c) * monomial;
          if (i < p) A[1][c] += (i + 1.0) * at(patch, i + 1, j, c) * monomial;
          if (j < q) A[2][c] += (j + 1.0) * at(patch, i, j + 1, c) * monomial;
        }
      }

    // Times a length it is added to the other equations: each is judged by the size of its terms, and all of
    // those of a coordinate vanish where a point lies in a plane of symmetry.
    g[3] = y[1] * y[1] + y[2] * y[2] + y[3] * y[3] - 1.0;
    const T unit = scale * g[3];
    for (int c = 0; c < 3; ++c) {
      const T foot = x[c] - y[0] * y[1 + c];
      g[c] = (rational ? T(A[0][3] * foot) : foot) - A[0][c] + unit;
    }
    for (int i = 1; i <= 2; ++i) {
      g[3 + i] = unit;
      for (int c = 0; c < 3; ++c) g[3 + i] += y[1 + c] * (rational ? T(A[i][c] - A[i][3] * x[c]) : A[i][c]);
      if (rational) g[3 + i] += y[0] * A[i][3];
    }
  }

  /// Downhill from the data's (t1, t2): the nearest foot that belongs to the same sheet.
  KOKKOS_INLINE_FUNCTION void start(const double* x, const double* data, double* y) const {
    const double* patch = origin(data[0]);
    double t[2] = {carries(data) != 0 ? data[1] : 0, carries(data) != 0 ? data[2] : 0};
    PatchPoint s = PatchPoint::of(patch, degree[0], degree[1], t[0], t[1]);
    const bool held[2] = {false, false};
    for (int iteration = 0; iteration < 50; ++iteration) {
      const SquaredDistance f(s, x);
      double dt[2];
      f.step(held, dt);
      double share = 1;
      for (; share > 1e-4; share /= 2) {
        const PatchPoint trial =
            PatchPoint::of(patch, degree[0], degree[1], t[0] + share * dt[0], t[1] + share * dt[1]);
        if (!(SquaredDistance(trial, x).value > f.value)) {
          s = trial;
          break;
        }
      }
      if (share <= 1e-4) break;
      t[0] += share * dt[0];
      t[1] += share * dt[1];
      if (std::fabs(dt[0]) + std::fabs(dt[1]) < 1e-10) break;  // Newton's method on (13) does the rest
    }
    double N[3];
    s.cross(N);
    const double length = std::sqrt(N[0] * N[0] + N[1] * N[1] + N[2] * N[2]);
    y[0] = 0;
    for (int c = 0; c < 3; ++c) {
      y[1 + c] = orientation * N[c] / length;
      y[0] += (x[c] - s.S[c]) * y[1 + c];
    }
    y[4] = t[0];
    y[5] = t[1];
  }

  /// 1 where the point is over a patch, 0 where it is over none.
  static KOKKOS_INLINE_FUNCTION double carries(const double* data) { return data[0] >= 0 ? 1 : 0; }
  template <int L>
  static KOKKOS_INLINE_FUNCTION taylor::Lanes<L> carries(const taylor::Lanes<L>* data) {
    taylor::Lanes<L> on;
    for (int l = 0; l < L; ++l) on[l] = data[0][l] >= 0 ? 1 : 0;
    return on;
  }

  void validate() const {
    if (numPatches < 1) detail::refuse("patch surface", "has no patches; make it with PatchSet::tool");
  }

 private:
  KOKKOS_INLINE_FUNCTION int slot(double patch) const {
    return patch >= 0 && patch < numPatches ? static_cast<int>(patch) : numPatches;
  }
  KOKKOS_INLINE_FUNCTION int stride() const { return (degree[0] + 1) * (degree[1] + 1) * 4; }

  /// First coefficients of the patches of L points.
  template <int L>
  struct Origins {
    const double* at[L];
  };
  KOKKOS_INLINE_FUNCTION const double* origin(double patch) const {
    return &coefficients(slot(patch) * stride());
  }
  template <int L>
  KOKKOS_INLINE_FUNCTION Origins<L> origin(const taylor::Lanes<L>& patch) const {
    Origins<L> origins;
    for (int l = 0; l < L; ++l) origins.at[l] = origin(patch[l]);
    return origins;
  }

  KOKKOS_INLINE_FUNCTION double at(const double* patch, int i, int j, int c) const {
    return patch[((degree[1] + 1) * i + j) * 4 + c];
  }
  template <int L>
  KOKKOS_INLINE_FUNCTION taylor::Lanes<L> at(const Origins<L>& patch, int i, int j, int c) const {
    const int place = ((degree[1] + 1) * i + j) * 4 + c;
    taylor::Lanes<L> a;
    for (int l = 0; l < L; ++l) a[l] = patch.at[l][place];
    return a;
  }
};

}  // namespace atrapos::contact
