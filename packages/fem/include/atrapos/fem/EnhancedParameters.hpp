#pragma once

#include <Kokkos_Macros.hpp>
#include <Sacado.hpp>
#include <cmath>

#include "atrapos/taylor/SmallLu.hpp"

namespace atrapos::fem {

/// Why an element's enhanced parameters could not be found.
enum class EnhancedFailure {
  none = 0,
  notFinite,            ///< the law has no finite value there
  notPositiveDefinite,  ///< K_bb is not: the material is unstable in the enhanced strain
  notConverged          ///< Newton's method
};

/// One line's worth of words for a failure.
inline const char* describe(EnhancedFailure failure) {
  switch (failure) {
    case EnhancedFailure::none:
      return "none";
    case EnhancedFailure::notFinite:
      return "the material law has no finite stress there";
    case EnhancedFailure::notPositiveDefinite:
      return "the material is unstable in the enhanced strain";
    case EnhancedFailure::notConverged:
      return "Newton's method for the enhanced strain did not converge";
  }
  return "";
}

/// The M enhanced parameters beta of one element at given h = B u (docs/theory/shell.md):
///
///     g_j(beta) = sum_q w_q m_qj s(h_q, e_q) = 0,     e_q = sum_j m_qj beta_j
///
/// s is law.enhancedStress(in, data) with in = (h, e). Newton's method from beta = 0, whatever states came
/// before: beta is a function of the displacements alone and the same to the last bit at every call.
///
/// in: [q][numInputs], its e entries are work space and hold e_q afterwards; data: [q][numData]; w: [q]; m:
/// [q][M].
template <int M, class Law>
KOKKOS_INLINE_FUNCTION EnhancedFailure solveEnhanced(const Law& law, int numPoints, double* in,
                                                     const double* data, const double* w, const double* m,
                                                     double* beta) {
  constexpr int I = Law::numInputs, D = Law::numData, maxIterations = 40, maxHalvings = 20;
  using Fad = Sacado::Fad::SFad<double, 1>;
  const auto place = [&](const double* b) {
    for (int q = 0; q < numPoints; ++q) {
      double e = 0;
      for (int j = 0; j < M; ++j) e += m[q * M + j] * b[j];
      in[q * I + I - 1] = e;
    }
  };
  double g[M], K[M * M];
  // g, K_bb and whether all is finite, at the e in `in`.
  const auto evaluate = [&] {
    for (int j = 0; j < M; ++j) g[j] = 0;
    for (int j = 0; j < M * M; ++j) K[j] = 0;
    bool finite = true;
    for (int q = 0; q < numPoints; ++q) {
      Fad x[I];
      for (int i = 0; i < I; ++i) x[i] = in[q * I + i];
      x[I - 1] = Fad(1, 0, in[q * I + I - 1]);
      const Fad s = law.enhancedStress(x, data + q * D);
      const double ds = s.dx(0);
      finite = finite && std::isfinite(s.val()) && std::isfinite(ds);
      for (int j = 0; j < M; ++j) {
        g[j] += w[q] * m[q * M + j] * s.val();
        for (int k = 0; k <= j; ++k) K[j * M + k] += w[q] * m[q * M + j] * m[q * M + k] * ds;
      }
    }
    return finite;
  };

  for (int j = 0; j < M; ++j) beta[j] = 0;
  place(beta);
  if (!evaluate()) return EnhancedFailure::notFinite;
  double last = -1;
  for (int iteration = 0; iteration < maxIterations; ++iteration) {
    // Cholesky: positive definite wherever the material is stable.
    for (int j = 0; j < M; ++j) {
      for (int k = 0; k <= j; ++k) {
        double sum = K[j * M + k];
        for (int i = 0; i < k; ++i) sum -= K[j * M + i] * K[k * M + i];
        if (j == k && !(sum > 0)) return EnhancedFailure::notPositiveDefinite;
        K[j * M + k] = j == k ? std::sqrt(sum) : sum / K[k * M + k];
      }
    }
    double step[M];
    for (int j = 0; j < M; ++j) {
      step[j] = -g[j];
      for (int k = 0; k < j; ++k) step[j] -= K[j * M + k] * step[k];
      step[j] /= K[j * M + j];
    }
    for (int j = M - 1; j >= 0; --j) {
      for (int k = j + 1; k < M; ++k) step[j] -= K[k * M + j] * step[k];
      step[j] /= K[j * M + j];
    }
    double trial[M], scale = 1;
    bool finite = false;
    for (int h = 0; h <= maxHalvings && !finite; ++h, scale *= 0.5) {
      for (int j = 0; j < M; ++j) trial[j] = beta[j] + scale * step[j];
      place(trial);
      finite = evaluate();
    }
    if (!finite) return EnhancedFailure::notFinite;
    double change = 0, size = 0;  // of the strain
    for (int q = 0; q < numPoints; ++q) {
      double before = 0;
      for (int j = 0; j < M; ++j) before += m[q * M + j] * beta[j];
      const double e = in[q * I + I - 1], unit = law.enhancedStrainSize(data + q * D);
      change = std::fmax(change, std::fabs(e - before) * unit);
      size = std::fmax(size, std::fabs(e) * unit);
    }
    for (int j = 0; j < M; ++j) beta[j] = trial[j];
    // Convergence is quadratic: what is left after a change of 1e-8 is below rounding. 1e-16 is the rounding
    // of strains that finite rotations leave; changes that no longer fall, far down, are rounding too.
    if (change <= 1e-8 * size || change <= 1e-16) return EnhancedFailure::none;
    if (last >= 0 && last < 1e-10 && change > 0.5 * last) return EnhancedFailure::none;
    last = change;
  }
  return EnhancedFailure::notConverged;
}

/// Inverse of a symmetric positive definite M x M matrix in each lane; NaN in a lane where it is not.
template <int M, class Pack>
KOKKOS_INLINE_FUNCTION void invertInLanes(const Pack* K, Pack* inverse) {
  for (int lane = 0; lane < Pack::size; ++lane) {
    double a[M * M];
    for (int i = 0; i < M * M; ++i) a[i] = K[i][lane];
    taylor::detail::SmallLu<M> lu;
    const bool good = lu.factor(a);
    for (int j = 0; j < M; ++j) {
      double unit[M], column[M];
      for (int i = 0; i < M; ++i) unit[i] = i == j ? 1 : 0;
      if (good) lu.solve(unit, column);
      for (int i = 0; i < M; ++i) inverse[i * M + j][lane] = good ? column[i] : NAN;
    }
  }
}

}  // namespace atrapos::fem
