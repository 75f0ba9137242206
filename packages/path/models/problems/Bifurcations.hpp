#pragma once

#include <cmath>
#include <vector>

/// What every law here has in common.
struct NoInternal {
  double scale() const { return 0.1; }
  template <class S>
  std::vector<S> internal(const std::vector<S>&, const S&) const {
    return {};
  }
};

/// Von Mises truss whose top may sway: two Saint Venant-Kirchhoff bars (EA = 1) from (-b, 0) and (b, 0) to
/// (0, h). Unknowns x = sinking / h and y = sway / h; load in units of EA (h/L)^3. The symmetric path is
/// lambda = x (1 - x) (2 - x); it bifurcates at x = 1 -+ sqrt(1 - 2 b^2/h^2).
struct SwayTruss : NoInternal {
  double b = 0.5;  ///< h = 1
  double imperfection = 0;
  int size() const { return 2; }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    const S top = 1 - u[0];
    const S left = (u[1] + b) * (u[1] + b) + top * top - (1 + b * b);
    const S right = (u[1] - b) * (u[1] - b) + top * top - (1 + b * b);
    return {-0.5 * (left + right) * top - lambda,
            0.5 * (left * (u[1] + b) + right * (u[1] - b)) - S(imperfection)};
  }
};

/// v^2/2 - lambda v + sum_i [(crossing_i - v) x_i^2/2 + cubic x_i^3/3 + quartic x_i^4/4], unknowns (v, x_0,
/// ..). The trivial path is v = lambda, x = 0; x_i appears at lambda = crossing_i, transcritically where
/// cubic /= 0, with lambda = crossing + (quartic - 1/2) x^2 else.
struct Modes : NoInternal {
  std::vector<double> crossing{0.5};
  double cubic = 0, quartic = 1, imperfection = 0;
  /// Makes the trivial path curved: v + bend v^2 instead of v.
  double bend = 0;
  int size() const { return 1 + static_cast<int>(crossing.size()); }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    std::vector<S> r{u[0] + bend * u[0] * u[0] - lambda};
    for (std::size_t i = 0; i < crossing.size(); ++i) {
      const S x = u[i + 1];
      r[0] = r[0] - 0.5 * x * x;
      r.push_back((crossing[i] - u[0]) * x + cubic * x * x + quartic * x * x * x - S(imperfection));
    }
    return r;
  }
};

/// Column clamped at one end, pressed by lambda at the other: n rigid links of length h = 1/n with angles
/// theta_i at their middles, rotational springs 1/h between them (EI = 1, L = 1), 2/h at the clamp, and one
/// shortening s of stiffness EA for all. Unknowns (s, theta_1 .. theta_n). The straight column buckles where
/// lambda (1 - lambda/EA) = 2 n^2 (1 - cos(pi (2m - 1)/2n)), m = 1, 2, ..
///
/// The load may follow the top in part: it turns by `follow` theta_n, which makes the tangent unsymmetric.
/// With phi_i = theta_i - follow theta_n the straight column's neighbour obeys phi_(i+1) - 2 phi_i +
/// phi_(i-1) = -P phi_i / n^2, phi_i = A cos(omega (i - n - 1/2)), and the clamp theta_0 = -theta_1 asks for
/// cos(omega n) = -follow / (1 - follow): no buckling beyond follow = 1/2.
struct Column : NoInternal {
  int n = 10;
  double EA = 100, sideLoad = 0, follow = 0;
  int size() const { return n + 1; }
  double scale() const { return 1; }
  bool symmetric() const { return follow == 0; }
  double buckling(int m) const {
    // omega n, of which the cosine is given: the m-th positive one.
    const double first = std::acos(-follow / (1 - follow));
    const double angle = m % 2 == 1 ? (m - 1) * M_PI + first : m * M_PI - first;
    const double P = 2 * n * n * (1 - std::cos(angle / n));
    return 0.5 * EA * (1 - std::sqrt(1 - 4 * P / EA));
  }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    using std::cos;
    using std::sin;
    const double h = 1.0 / n;
    std::vector<S> r{EA * u[0]};
    for (int i = 1; i <= n; ++i) {
      S moment = i > 1 ? u[i] - u[i - 1] : 2 * u[i];
      if (i < n) moment = moment - (u[i + 1] - u[i]);
      const S angle = follow == 0 ? u[i] : u[i] - follow * u[n];  // to the load
      r[0] = r[0] + h * lambda * cos(angle);
      r.push_back(1 / h * moment - h * (lambda * (1 + u[0]) * sin(angle) + sideLoad * cos(u[i])));
    }
    return r;
  }
};
