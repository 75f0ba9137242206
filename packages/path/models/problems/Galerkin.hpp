#pragma once

#include <cmath>
#include <vector>

#include "Bifurcations.hpp"

/// Shallow pinned arch (EI = 1, span pi), rise e sin x, pressed down by lambda sin x, w = sum q_n sin(n x):
///
///     R_n = n^4 (q_n - e_n) + n^2 q_n S + lambda [n = 1],   S = sum n^2 (q_n^2 - e_n^2) / 2   (the thrust, <
///     0)
///
/// On the symmetric path (q_1 only) lambda has limit points at q_1 = -+sqrt((e^2 - 2) / 3) and mode 2 appears
/// at q_1 = -+sqrt(e^2 - 8), before the limit point where e^2 > 11. On the branch S = -4, so that
/// q_1 = (e - lambda) / (1 - 4), 4 q_2^2 = e^2 - 8 - q_1^2.
struct ShallowArch : NoInternal {
  int modes = 4;
  double rise = 4, imperfection = 0;  ///< imperfection: of mode 2, stress-free
  int size() const { return modes; }
  double scale() const { return 1; }
  std::vector<double> start() const {
    std::vector<double> e(modes, 0.0);
    e[0] = rise;
    e[1] = imperfection;
    return e;
  }
  template <class S>
  std::vector<S> residual(const std::vector<S>& q, const S& lambda) const {
    const auto e = start();
    S thrust = 0;
    for (int n = 1; n <= modes; ++n)
      thrust = thrust + 0.5 * n * n * (q[n - 1] * q[n - 1] - e[n - 1] * e[n - 1]);
    std::vector<S> r;
    for (int n = 1; n <= modes; ++n) {
      const S& x = q[n - 1];
      r.push_back(std::pow(n, 4) * (x - e[n - 1]) + n * n * x * thrust);
    }
    r[0] = r[0] + lambda;
    return r;
  }
};

/// Two modes x, y of a square plate: energy v^2/2 - lambda v + (crossing - v)(x^2 + y^2)/2 + a (x^4 + y^4)/4
/// + b x^2 y^2 / 2 + bend v^3/3, unknowns (v, x, y), with the symmetry of the square (x -> -x, x <-> y). Both
/// modes appear at v = crossing: two branches (x, 0), (0, y) with x^2 = (v - crossing)/a and two
/// (x, +-x) with x^2 = (v - crossing)/(a + b).
struct SquareModes : NoInternal {
  double crossing = 0.5, a = 1, b = 0.5, bend = 0.3, imperfection = 0;
  int size() const { return 3; }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    const S &v = u[0], &x = u[1], &y = u[2];
    return {v + bend * v * v - lambda - 0.5 * (x * x + y * y),
            (crossing - v) * x + a * x * x * x + b * x * y * y - S(imperfection),
            (crossing - v) * y + a * y * y * y + b * x * x * y};
  }
};

/// Pinned strut (EI = 1, length pi) on a foundation k w + k_2 w^2 + k_3 w^3, pressed by lambda,
/// w = sum_n q_n sin(n x); end shortening s, axial stiffness EA:
///
///     energy/(pi/2) = EA/2 (s - D)^2 - lambda s + sum (n^4 + k) q_n^2 / 2 + (2/pi) int k_2 w^3/3 + k_3
///     w^4/4, D = sum n^2 q_n^2 / 2.
///
/// Unknowns (s, q_1 .. q_N). The straight strut buckles at lambda = n^2 + k/n^2; k = n^2 (n+1)^2 makes the
/// loads of modes n and n+1 equal.
struct StrutOnFoundation : NoInternal {
  int modes = 4;
  double k = 4, k2 = 0, k3 = 1, EA = 50, imperfection = 0;
  int size() const { return 1 + modes; }
  double scale() const { return 1; }
  double buckling(int n) const { return n * n + k / (n * n); }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    S D = 0;
    for (int n = 1; n <= modes; ++n) D = D + 0.5 * n * n * u[n] * u[n];
    const S thrust = EA * (u[0] - D);
    std::vector<S> r{thrust - lambda};
    for (int n = 1; n <= modes; ++n) r.push_back((std::pow(n, 4) + k - n * n * thrust) * u[n]);
    r[1] = r[1] - S(imperfection);
    // The integrand of mode n is even in x; the midpoint rule is exact for trigonometric polynomials whose
    // degree 4 N stays below twice the number of points, except for the k_2 term (odd degree), where
    // it only has to be the gradient of some energy: it is that of this very rule.
    const int points = 2 * modes + 2;
    for (int j = 0; j < points; ++j) {
      const double x = M_PI * (j + 0.5) / points;
      S w = 0;
      for (int n = 1; n <= modes; ++n) w = w + std::sin(n * x) * u[n];
      const S force = 2.0 / points * (k2 * w * w + k3 * w * w * w);
      for (int n = 1; n <= modes; ++n) r[n] = r[n] + std::sin(n * x) * force;
    }
    return r;
  }
};
