#include "EnhancedParameters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "atrapos/fem/EnhancedTerm.hpp"

namespace atrapos::fem {
namespace {

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

/// A lower triangular factor of a symmetric positive definite matrix.
struct Cholesky {
  double a[kMaxParameters][kMaxParameters];

  /// In place; only the lower triangle counts. False where the matrix is not positive definite.
  bool factor(int M) {
    for (int j = 0; j < M; ++j)
      for (int k = 0; k <= j; ++k) {
        double sum = a[j][k];
        for (int i = 0; i < k; ++i) sum -= a[j][i] * a[k][i];
        if (j == k && !(sum > 0)) return false;
        a[j][k] = j == k ? std::sqrt(sum) : sum / a[k][k];
      }
    return true;
  }
  void solve(int M, double* x) const {
    for (int j = 0; j < M; ++j) {
      for (int k = 0; k < j; ++k) x[j] -= a[j][k] * x[k];
      x[j] /= a[j][j];
    }
    for (int j = M - 1; j >= 0; --j) {
      for (int k = j + 1; k < M; ++k) x[j] -= a[k][j] * x[k];
      x[j] /= a[j][j];
    }
  }
};

/// Newton's method in one element; the law is evaluated for all of a batch at once.
struct Newton {
  double beta[kMaxParameters] = {}, trial[kMaxParameters] = {}, step[kMaxParameters] = {};
  double g[kMaxParameters], scale = 1, last = -1;
  Cholesky K;
  int iteration = 0, halving = 0;
  bool first = true, running = true;
  EnhancedFailure failure = EnhancedFailure::none;
};

class Solver {
 public:
  Solver(const PointLaw& law, const PointBatch& points, const EnhancedModes& modes, double* in, double* out,
         double* derivative)
      : law_(law),
        points_(points),
        modes_(modes),
        J_(law.shape().inputs),
        O_(law.shape().outputs),
        in_(in),
        out_(out),
        ds_(derivative) {}

  void solve(EnhancedFailure (&failure)[kLanes]) {
    Newton lanes[kLanes];
    for (int l = points_.lanes; l < kLanes; ++l) lanes[l].running = false;
    for (bool running = true; running;) {
      for (int l = 0; l < points_.lanes; ++l)
        if (lanes[l].running) place(lanes[l].trial, l);
      law_.derivative(points_, J_ - 1, in_, out_, ds_);
      running = false;
      for (int l = 0; l < points_.lanes; ++l) {
        if (lanes[l].running) advance(lanes[l], l);
        running = running || lanes[l].running;
      }
    }
    for (int l = 0; l < kLanes; ++l) {
      failure[l] = lanes[l].failure;
      if (failure[l] != EnhancedFailure::none)
        for (int q = 0; q < points_.numPoints; ++q) e(q, l) = notANumber;
      else
        place(lanes[l].beta, l);
    }
  }

 private:
  double& e(int q, int lane) { return in_[((q + 1) * J_ - 1) * kLanes + lane]; }
  double mode(int q, int j) const { return modes_.modes[q * modes_.count + j]; }
  double strainOf(int q, const double* beta) const {
    double sum = 0;
    for (int j = 0; j < modes_.count; ++j) sum += mode(q, j) * beta[j];
    return sum;
  }
  void place(const double* beta, int lane) {
    for (int q = 0; q < points_.numPoints; ++q) e(q, lane) = strainOf(q, beta);
  }

  /// g and K_bb of a lane at the strains in `in`; false where they are not finite.
  bool evaluate(Newton& n, int lane) const {
    const int M = modes_.count;
    for (int j = 0; j < M; ++j) {
      n.g[j] = 0;
      std::fill_n(n.K.a[j], M, 0.0);
    }
    bool finite = true;
    for (int q = 0; q < points_.numPoints; ++q) {
      const std::size_t at = ((static_cast<std::size_t>(q) + 1) * O_ - 1) * kLanes + lane;
      const double s = out_[at], ds = ds_[at], w = modes_.weight[q * kLanes + lane];
      finite = finite && std::isfinite(s) && std::isfinite(ds);
      for (int j = 0; j < M; ++j) {
        n.g[j] += w * mode(q, j) * s;
        for (int k = 0; k <= j; ++k) n.K.a[j][k] += w * mode(q, j) * mode(q, k) * ds;
      }
    }
    return finite;
  }

  /// After the law was evaluated at n.trial: whether that is the solution, and what to try next.
  void advance(Newton& n, int lane) {
    constexpr int maxIterations = 40, maxHalvings = 20;
    const auto stop = [&](EnhancedFailure why) {
      n.failure = why;
      n.running = false;
    };
    if (!evaluate(n, lane)) {
      if (n.first || ++n.halving > maxHalvings) return stop(EnhancedFailure::notFinite);
      n.scale *= 0.5;
      return tryNext(n);
    }
    if (!n.first && accept(n, lane)) return stop(EnhancedFailure::none);
    if (n.iteration++ == maxIterations) return stop(EnhancedFailure::notConverged);
    // Positive definite wherever the material is stable.
    if (!n.K.factor(modes_.count)) return stop(EnhancedFailure::notPositiveDefinite);
    for (int j = 0; j < modes_.count; ++j) n.step[j] = -n.g[j];
    n.K.solve(modes_.count, n.step);
    n.first = false;
    n.scale = 1;
    n.halving = 0;
    tryNext(n);
  }

  void tryNext(Newton& n) const {
    for (int j = 0; j < modes_.count; ++j) n.trial[j] = n.beta[j] + n.scale * n.step[j];
  }

  /// beta becomes n.trial; true where it is known well enough.
  bool accept(Newton& n, int lane) const {
    double change = 0, size = 0;  // of the strain
    for (int q = 0; q < points_.numPoints; ++q) {
      const double now = strainOf(q, n.trial), unit = modes_.strain[q * kLanes + lane];
      change = std::fmax(change, std::fabs(now - strainOf(q, n.beta)) * unit);
      size = std::fmax(size, std::fabs(now) * unit);
    }
    std::copy_n(n.trial, modes_.count, n.beta);
    // Convergence is quadratic: what is left after a change of 1e-8 is below rounding. 1e-16 is the rounding
    // of strains that finite rotations leave; changes that no longer fall, far down, are rounding too.
    if (change <= 1e-8 * size || change <= 1e-16) return true;
    if (n.last >= 0 && n.last < 1e-10 && change > 0.5 * n.last) return true;
    n.last = change;
    return false;
  }

  const PointLaw& law_;
  const PointBatch& points_;
  const EnhancedModes& modes_;
  int J_, O_;
  double *in_, *out_, *ds_;
};

}  // namespace

const char* describe(EnhancedFailure failure) {
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

void solveEnhanced(const PointLaw& law, const PointBatch& points, const EnhancedModes& modes, double* in,
                   double* out, double* derivative, EnhancedFailure (&failure)[kLanes]) {
  Solver(law, points, modes, in, out, derivative).solve(failure);
}

void invertInLanes(int M, const double* K, double* inverse) {
  for (int l = 0; l < kLanes; ++l) {
    Cholesky factor;
    for (int i = 0; i < M; ++i)
      for (int j = 0; j < M; ++j) factor.a[i][j] = K[(i * M + j) * kLanes + l];
    const bool good = factor.factor(M);
    for (int j = 0; j < M; ++j) {
      double column[kMaxParameters] = {};
      column[j] = 1;
      if (good) factor.solve(M, column);
      for (int i = 0; i < M; ++i) inverse[(i * M + j) * kLanes + l] = good ? column[i] : notANumber;
    }
  }
}

}  // namespace atrapos::fem
