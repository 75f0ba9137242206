#pragma once

#include <cmath>

#include "atrapos/taylor/FunctionMarks.hpp"

namespace atrapos::taylor::detail {

/// P A = L U of a small dense matrix, rows compared relative to their largest entry (implicit equilibration).
template <int N>
class SmallLu {
 public:
  /// a[N][N] by rows. False where a is singular to the last digit or not finite.
  KOKKOS_INLINE_FUNCTION bool factor(const double* a) {
    double scale[N];
    for (int i = 0; i < N; ++i) {
      row_[i] = i;
      scale[i] = 0;
      for (int j = 0; j < N; ++j) {
        lu_[i][j] = a[i * N + j];
        if (!std::isfinite(lu_[i][j])) return false;
        if (std::fabs(lu_[i][j]) > scale[i]) scale[i] = std::fabs(lu_[i][j]);
      }
      if (scale[i] == 0) return false;
    }
    for (int k = 0; k < N; ++k) {
      int pivot = k;
      for (int i = k + 1; i < N; ++i)
        if (std::fabs(lu_[i][k]) * scale[pivot] > std::fabs(lu_[pivot][k]) * scale[i]) pivot = i;
      if (lu_[pivot][k] == 0) return false;
      if (pivot != k) {
        for (int j = 0; j < N; ++j) swap(lu_[k][j], lu_[pivot][j]);
        swap(scale[k], scale[pivot]);
        swap(row_[k], row_[pivot]);
      }
      for (int i = k + 1; i < N; ++i) {
        lu_[i][k] /= lu_[k][k];
        for (int j = k + 1; j < N; ++j) lu_[i][j] -= lu_[i][k] * lu_[k][j];
      }
    }
    return true;
  }

  /// x = A^-1 b; x and b must not overlap.
  KOKKOS_INLINE_FUNCTION void solve(const double* b, double* x) const {
    for (int i = 0; i < N; ++i) {
      x[i] = b[row_[i]];
      for (int j = 0; j < i; ++j) x[i] -= lu_[i][j] * x[j];
    }
    for (int i = N - 1; i >= 0; --i) {
      for (int j = i + 1; j < N; ++j) x[i] -= lu_[i][j] * x[j];
      x[i] /= lu_[i][i];
    }
  }

  /// After factor(a): the least |pivot| over the size of the terms that it is the sum of. In the order of
  /// rounding where a is singular, whatever the units of rows and columns.
  KOKKOS_INLINE_FUNCTION double leastPivot(const double* a) const {
    double least = 1;
    for (int k = 0; k < N; ++k) {
      double size = std::fabs(a[row_[k] * N + k]);
      for (int i = 0; i < k; ++i) size += std::fabs(lu_[k][i] * lu_[i][k]);
      if (std::fabs(lu_[k][k]) < least * size) least = std::fabs(lu_[k][k]) / size;
    }
    return least;
  }

  /// inverse[N][N] = A^-1 by rows.
  KOKKOS_INLINE_FUNCTION void invert(double* inverse) const {
    for (int j = 0; j < N; ++j) {
      double unit[N], column[N];
      for (int i = 0; i < N; ++i) unit[i] = i == j ? 1 : 0;
      solve(unit, column);
      for (int i = 0; i < N; ++i) inverse[i * N + j] = column[i];
    }
  }

 private:
  template <class S>
  static ATRAPOS_FORCEINLINE void swap(S& a, S& b) {
    const S c = a;
    a = b;
    b = c;
  }

  double lu_[N][N];
  int row_[N];
};

}  // namespace atrapos::taylor::detail
