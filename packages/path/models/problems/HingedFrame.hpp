#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "Bifurcations.hpp"

/// Lee's frame: two legs of length 120 (column from the origin up, beam from its top to the right), both ends
/// hinged, vertical load lambda downwards on the beam 24 from the corner; E = 720, A = 6, I = 2.
/// Geometrically exact planar beam, extensible, no shear.
///
/// With the section's force f = (f_x, f_y) constant on each of the two parts that end at the load point P
/// (nothing acts between), the stretch is 1 + N/EA, N = f . d, d = (cos phi, sin phi), phi = phi_0 + theta:
///
///     L = int EI theta'^2 / 2 ds - lambda v_P
///         + sum over parts [ f . (P_end - P_start) - int (f . d + (f . d)^2 / (2 EA)) ds ],
///
/// stationary in theta(s), P = (24 + u_P, 120 - v_P) and both forces, which are multipliers of closure.
/// theta is piecewise cubic (nodes of Lagrange elements, Gauss rule of four points), the corner is rigid:
/// theta goes through it. Unknowns: u_P, v_P, f of the column's part, f of the other part, theta at the
/// nodes.
struct HingedFrame : NoInternal {
  int elements = 12;  ///< of equal length within column, beam left and right of the load: about 5 : 1 : 4
  double leg = 120, offset = 24, EI = 1440, EA = 4320;

  int columnElements() const { return elements / 2; }
  int leftElements() const { return std::max(1, elements / 10); }
  int count() const { return columnElements() + leftElements() + rightElements(); }
  int rightElements() const { return std::max(1, elements - columnElements() - leftElements()); }
  int size() const { return 6 + 3 * count() + 1; }
  double scale() const { return 1; }  // the loads are of order 1
  int multipliers() const { return 4; }

  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    using std::cos;
    using std::sin;
    std::vector<S> r(u.size(), S(0));
    // Ends of the parts: the column's foot is the origin, the beam's hinge (leg, leg).
    const S Px = offset + u[0], Py = leg - u[1];
    r[2] = Px;
    r[3] = Py;
    r[4] = leg - Px;
    r[5] = leg - Py;
    r[0] = u[2] - u[4];
    r[1] = u[5] - u[3] - lambda;
    static const std::array<double, 4> point{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                             0.8611363115940526};
    static const std::array<double, 4> weight{0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                              0.3478548451374538};
    for (int e = 0; e < count(); ++e) {
      const bool column = e < columnElements(), left = !column && e < columnElements() + leftElements();
      const double h = column ? leg / columnElements()
                       : left ? offset / leftElements()
                              : (leg - offset) / rightElements();
      const double phi0 = column ? M_PI / 2 : 0;
      const int part = column || left ? 2 : 4, first = 6 + 3 * e;
      for (int g = 0; g < 4; ++g) {
        const auto [N, dN] = cubic(point[g]);
        S theta = 0, slope = 0;
        for (int i = 0; i < 4; ++i) {
          theta = theta + N[i] * u[first + i];
          slope = slope + 2 / h * dN[i] * u[first + i];
        }
        const double ds = 0.5 * h * weight[g];
        const S dx = cos(phi0 + theta), dy = sin(phi0 + theta);
        const S force = u[part] * dx + u[part + 1] * dy;
        const S stretch = 1 + 1 / EA * force;
        r[part] = r[part] - ds * stretch * dx;
        r[part + 1] = r[part + 1] - ds * stretch * dy;
        const S moment = -stretch * (u[part + 1] * dx - u[part] * dy);
        for (int i = 0; i < 4; ++i)
          r[first + i] = r[first + i] + ds * (N[i] * moment + 2 / h * dN[i] * EI * slope);
      }
    }
    return r;
  }

 private:
  /// Lagrange's cubics on nodes -1, -1/3, 1/3, 1, and their derivatives.
  static std::pair<std::array<double, 4>, std::array<double, 4>> cubic(double x) {
    return {{-0.0625 * (x - 1) * (9 * x * x - 1), 0.5625 * (x * x - 1) * (3 * x - 1),
             -0.5625 * (x * x - 1) * (3 * x + 1), 0.0625 * (x + 1) * (9 * x * x - 1)},
            {-0.0625 * (27 * x * x - 18 * x - 1), 0.5625 * (9 * x * x - 2 * x - 3),
             -0.5625 * (9 * x * x + 2 * x - 3), 0.0625 * (27 * x * x + 18 * x - 1)}};
  }
};
