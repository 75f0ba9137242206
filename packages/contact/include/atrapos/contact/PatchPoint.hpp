#pragma once

#include <Kokkos_Macros.hpp>
#include <cmath>

namespace atrapos::contact {

constexpr int maxPatchDegree = 20;

/// A point S(t1, t2) of a patch with first and second derivatives.
struct PatchPoint {
  double S[3], S1[3], S2[3], S11[3], S12[3], S22[3];

  /// From the patch's coefficients of t1^i t2^j, [i][j][4] with i <= p, j <= q: three coordinates times the
  /// weight, and the weight.
  static KOKKOS_INLINE_FUNCTION PatchPoint of(const double* coefficients, int p, int q, double t1,
                                              double t2) {
    double a[3][maxPatchDegree + 1], b[3][maxPatchDegree + 1];  // t^i and its derivatives
    powers(p, t1, a);
    powers(q, t2, b);
    double A[6][4] = {};  // A, A_1, A_2, A_11, A_12, A_22
    for (int i = 0; i <= p; ++i)
      for (int j = 0; j <= q; ++j)
        for (int c = 0; c < 4; ++c) {
          const double C = coefficients[((q + 1) * i + j) * 4 + c];
          A[0][c] += C * a[0][i] * b[0][j];
          A[1][c] += C * a[1][i] * b[0][j];
          A[2][c] += C * a[0][i] * b[1][j];
          A[3][c] += C * a[2][i] * b[0][j];
          A[4][c] += C * a[1][i] * b[1][j];
          A[5][c] += C * a[0][i] * b[2][j];
        }
    PatchPoint s;
    const double w = A[0][3], w1 = A[1][3], w2 = A[2][3];
    for (int c = 0; c < 3; ++c) {  // from A = w S, differentiated
      s.S[c] = A[0][c] / w;
      s.S1[c] = (A[1][c] - w1 * s.S[c]) / w;
      s.S2[c] = (A[2][c] - w2 * s.S[c]) / w;
      s.S11[c] = (A[3][c] - 2 * w1 * s.S1[c] - A[3][3] * s.S[c]) / w;
      s.S12[c] = (A[4][c] - w1 * s.S2[c] - w2 * s.S1[c] - A[4][3] * s.S[c]) / w;
      s.S22[c] = (A[5][c] - 2 * w2 * s.S2[c] - A[5][3] * s.S[c]) / w;
    }
    return s;
  }

  /// S_1 x S_2, not normalised.
  KOKKOS_INLINE_FUNCTION void cross(double* N) const {
    for (int c = 0; c < 3; ++c) N[c] = S1[(c + 1) % 3] * S2[(c + 2) % 3] - S1[(c + 2) % 3] * S2[(c + 1) % 3];
  }

 private:
  static KOKKOS_INLINE_FUNCTION void powers(int degree, double t, double (*a)[maxPatchDegree + 1]) {
    for (int i = 0; i <= degree; ++i) {
      a[0][i] = i == 0 ? 1 : a[0][i - 1] * t;
      a[1][i] = i == 0 ? 0 : i * a[0][i - 1];
      a[2][i] = i == 0 ? 0 : i * a[1][i - 1];
    }
  }
};

/// |x - S|^2/2 as a function of (t1, t2): value, gradient, Hessian.
struct SquaredDistance {
  double value = 0, g[2] = {0, 0}, H[3] = {0, 0, 0};  ///< H_11, H_12, H_22
  double metric[3] = {0, 0, 0};                       ///< S_i.S_j: H without curvature

  KOKKOS_INLINE_FUNCTION SquaredDistance(const PatchPoint& s, const double* x) {
    for (int c = 0; c < 3; ++c) {
      const double d = x[c] - s.S[c];
      value += d * d / 2;
      g[0] -= d * s.S1[c];
      g[1] -= d * s.S2[c];
      metric[0] += s.S1[c] * s.S1[c];
      metric[1] += s.S1[c] * s.S2[c];
      metric[2] += s.S2[c] * s.S2[c];
      H[0] -= d * s.S11[c];
      H[1] -= d * s.S12[c];
      H[2] -= d * s.S22[c];
    }
    for (int i = 0; i < 3; ++i) H[i] += metric[i];
  }

  KOKKOS_INLINE_FUNCTION bool convex() const {
    // Well inside: near a centre of curvature the step would be no better than the one without curvature.
    return H[0] > 0 && H[0] * H[2] - H[1] * H[1] > 1e-6 * (metric[0] * metric[2] - metric[1] * metric[1]);
  }

  /// Newton's step downhill; held[i]: t_i stays.
  KOKKOS_INLINE_FUNCTION void step(const bool* held, double* dt) const {
    const double* M = convex() ? H : metric;
    dt[0] = dt[1] = 0;
    if (held[0] && held[1]) return;
    if (held[0] || held[1]) {
      const int i = held[0] ? 1 : 0;
      dt[i] = -g[i] / (M[2 * i] > 0 ? M[2 * i] : metric[2 * i]);
      return;
    }
    const double det = M[0] * M[2] - M[1] * M[1];
    dt[0] = -(M[2] * g[0] - M[1] * g[1]) / det;
    dt[1] = -(M[0] * g[1] - M[1] * g[0]) / det;
  }
};

}  // namespace atrapos::contact
