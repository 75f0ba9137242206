#pragma once

#include <array>
#include <vector>

#include "atrapos/solid/Material.hpp"
#include "atrapos/solid/Rubber.hpp"

namespace atrapos::solid {

namespace detail {

/// Second divided differences [z^power], [z^(power + 1)] on the eigenvalues of a matrix with determinant 1,
/// as functions of its invariants (docs/theory/rubber.md, Ogden): power = whole + fraction, that of the
/// fraction by a rule of Gauss and Jacobi.
struct StretchPower {
  static constexpr int numPoles = 28;
  int whole = 0;
  bool fractional = false;
  std::array<double, numPoles> pole{}, weight{};

  static StretchPower of(double power);  ///< finite, of at most 20

  /// [z^power] and [z^(power + 1)] from I_1 - 3 and I_2 - 3.
  template <class T>
  KOKKOS_INLINE_FUNCTION void differences(const T& x1, const T& x2, T& at, T& above) const {
    T below;  // [z^(fraction - 1)], [z^fraction], [z^(fraction + 1)]: of a whole power 1, 0, 0
    if (fractional) {
      below = at = above = T(0.0);
      for (int n = 0; n < numPoles; ++n) {
        const double t = pole[n];
        const T polynomial = (1 + t) * (1 + t) * (1 + t) + (t * t) * x1 + t * x2;
        const T share = weight[n] / polynomial;
        below = below + share;
        at = at - t * share;
        above = above + (t * t) * share;
      }
    } else {
      below = T(1.0);
      at = above = T(0.0);
    }
    // Cayley and Hamilton: z^3 = I_1 z^2 - I_2 z + 1
    for (int n = 0; n < whole; ++n) {
      const T next = 3.0 * (above - at) + (x1 * above - x2 * at) + below;
      below = at;
      at = above;
      above = next;
    }
    for (int n = 0; n > whole; --n) {
      const T next = 3.0 * (below - at) + (x2 * below - x1 * at) + above;
      above = at;
      at = below;
      below = next;
    }
  }
};

}  // namespace detail

/// Ogden's rubber (docs/theory/rubber.md): with principal stretches l_i, m_i = J^(-1/3) l_i,
///
///     W = sum of mu_p/alpha_p (m_1^alpha_p + m_2^alpha_p + m_3^alpha_p - 3) + (bulk/4) (J^2 - 1 - 2 ln J),
///     J = det F > 0
///
/// as a function of the invariants: equal stretches are nothing special, at any order.
///
/// in:  H_ij = du_i/dX_j, row-major, 9 entries, dimensionless.
/// out: first Piola-Kirchhoff stress P_ij, row-major, force per reference area.
struct Ogden : SecondInvariantLaw<Ogden> {
  static constexpr int maxTerms = 6;
  struct Term {
    double mu = 0;     ///< stress units, mu alpha > 0 where the term is stable by itself
    double alpha = 0;  ///< not 0
    detail::StretchPower power;
  };
  int numTerms = 0;
  std::array<Term, maxTerms> terms{};

  /// One to six mu and as many alpha, none of them 0 and |alpha| <= 40, sum of mu alpha > 0, bulk > 0;
  /// throws std::invalid_argument otherwise.
  static Ogden fromModuli(const std::vector<double>& mu, const std::vector<double>& alpha, double bulk);

  double shearModulus() const;  ///< at rest, sum of mu alpha / 2

  template <class T>
  ATRAPOS_FORCEINLINE void factors(const detail::Dilated<T>& x, const T& pressure, T& ofI, T& ofK,
                                   T& ofA) const {
    const T m2 = x.m * x.m;
    const T x1 = 3.0 * (x.m - 1.0) + x.m * x.i1;
    const T x2 = 3.0 * (m2 - 1.0) + m2 * x.i2;
    T first, second;
    slopes(x1, x2, first, second);
    const T n = x.m / x.J2;
    const T p = x.m * n;
    const T q1 = first * n;
    const T q2 = second * p;
    const T deviator1 = x.d - (1.0 / 3) * x.i1;
    const T deviator2 = x.i1 + 2.0 * x.d + x.d * x.i1 - (2.0 / 3) * x.i2;
    ofI = pressure + 2.0 * (q1 * deviator1) + 2.0 * (q2 * deviator2);
    ofK = pressure - 2.0 * q1 - (2.0 / 3) * (q1 * x.i1) - 4.0 * q2 - (4.0 / 3) * (q2 * x.i2);
    ofA = -2.0 * q2 - 2.0 * (q2 * x.d);
  }

 private:
  /// dW by the isochoric invariants.
  template <class T>
  KOKKOS_INLINE_FUNCTION void slopes(const T& x1, const T& x2, T& first, T& second) const {
    first = second = T(0.0);
    for (int i = 0; i < numTerms; ++i) {
      const Term& term = terms[i];
      T at, above;
      term.power.differences(x1, x2, at, above);
      first = first + (0.5 * term.mu) * above;
      second = second - (0.5 * term.mu) * at;
    }
  }
};

}  // namespace atrapos::solid

ATRAPOS_DECLARE_MATERIAL(atrapos::solid::Ogden)
