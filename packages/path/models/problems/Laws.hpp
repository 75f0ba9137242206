#pragma once

#include <cmath>
#include <limits>
#include <vector>

/// Saint Venant-Kirchhoff bar, EA = 1: s (s^2 - 1) / 2 = lambda, unknown u = s - 1. Limit point at s =
/// 1/sqrt(3).
struct StvkBar {
  int size() const { return 1; }
  double scale() const { return 0.1; }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    const S s = u[0] + 1;
    return {0.5 * s * (s * s - 1) - lambda};
  }
  template <class S>
  std::vector<S> internal(const std::vector<S>&, const S&) const {
    return {};
  }
};

/// Von Mises truss in x = w/h and load / (EA (h/L0)^3): x (1 - x) (2 - x) = lambda, pulled by a spring of
/// stiffness k whose end z carries the load. k < 1: z folds too (snap-back).
struct TrussOnSpring {
  double k = 0.5;
  int size() const { return 2; }
  double scale() const { return 0.1; }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    const S x = u[0], spring = k * (u[1] - u[0]);
    return {x * (1 - x) * (2 - x) - spring, spring - lambda};
  }
  template <class S>
  std::vector<S> internal(const std::vector<S>&, const S&) const {
    return {};
  }
};

/// The truss alone.
struct Truss {
  int size() const { return 1; }
  double scale() const { return 0.1; }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    return {u[0] * (1 - u[0]) * (2 - u[0]) - lambda};
  }
  template <class S>
  std::vector<S> internal(const std::vector<S>&, const S&) const {
    return {};
  }
};

/// -u'' = lambda exp(u) on (0, 1), u = 0 at the ends, n interior points, central differences.
struct Bratu {
  int n = 1;
  int size() const { return n; }
  double scale() const { return std::sqrt(n); }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    const double h2 = 1.0 / ((n + 1.0) * (n + 1.0));
    std::vector<S> r;
    for (int i = 0; i < n; ++i) {
      S d = 2 * u[i];
      if (i > 0) d = d - u[i - 1];
      if (i + 1 < n) d = d - u[i + 1];
      r.push_back(1 / h2 * d - lambda * exp(u[i]));
    }
    return r;
  }
  template <class S>
  std::vector<S> internal(const std::vector<S>&, const S&) const {
    return {};
  }
};

/// Perturbed pitchfork u^3 - lambda u - eps = 0.
struct Pitchfork {
  double eps = 0.1;
  int size() const { return 1; }
  double scale() const { return eps; }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    return {u[0] * u[0] * u[0] - lambda * u[0] - eps};
  }
  template <class S>
  std::vector<S> internal(const std::vector<S>&, const S&) const {
    return {};
  }
};

/// Spring k = 1 pressed by lambda on a rigid plane at gap D = 1 with the regularised contact law (15),
/// R (R/alpha + h) = eta (D - h). Internal variable: the parameter t of the law's hyperbola, R = alpha A e^t
/// - eta.
struct Contact {
  double alpha = 1e3, eta = 0.1;
  int size() const { return 1; }
  double scale() const { return 1; }
  template <class S>
  S force(const S& u) const {
    const S h = 1 - u;
    return alpha / 2 * (sqrt(h * h + 4 * eta / alpha * u) - h);
  }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    return {u[0] + force(u[0]) - lambda};
  }
  template <class S>
  std::vector<S> internal(const std::vector<S>& u, const S&) const {
    const double A = std::sqrt(eta / alpha - eta * eta / (alpha * alpha));
    return {log((force(u[0]) + eta) / S(alpha * A))};
  }
};

/// Linear: u = lambda / 2.
struct Linear {
  int size() const { return 1; }
  double scale() const { return 1; }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    return {2 * u[0] - lambda};
  }
  template <class S>
  std::vector<S> internal(const std::vector<S>&, const S&) const {
    return {};
  }
};

/// lambda = u^2.
struct Fold : Linear {
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    return {u[0] * u[0] - lambda};
  }
};

/// n Saint Venant-Kirchhoff bars one after the other (EA = 1, total length 1), pulled by lambda at the end:
/// all stretches solve s_i (s_i^2 - 1)/2 = lambda. On the homogeneous path the limit point s = 1/sqrt(3) is
/// where all n eigenvalues vanish: from there on bars may unload one by one.
struct BarsInSeries {
  int n = 2;
  int size() const { return n; }
  double scale() const { return 0.1; }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    std::vector<S> force;
    for (int i = 0; i < n; ++i) {
      const S s = 1 + n * (i > 0 ? u[i] - u[i - 1] : u[i]);
      force.push_back(0.5 * s * (s * s - 1));
    }
    std::vector<S> r;
    for (int i = 0; i < n; ++i) r.push_back(force[i] - (i + 1 < n ? force[i + 1] : lambda));
    return r;
  }
  template <class S>
  std::vector<S> internal(const std::vector<S>&, const S&) const {
    return {};
  }
};
