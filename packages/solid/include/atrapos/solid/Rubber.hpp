#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "atrapos/solid/Strain.hpp"
#include "atrapos/taylor/FadFunctions.hpp"
#include "atrapos/taylor/FunctionMarks.hpp"
#include "atrapos/taylor/Law.hpp"

/// What the laws of rubber share (docs/theory/rubber.md). Stresses are written in what changes from the body
/// at rest, H = F - I, K = cof F - I, j = det F - 1: sums of terms that are small where strains are, so that
/// small stresses are not differences of moduli.
namespace atrapos::solid {

namespace detail {

/// sum of all A_ij^2
constexpr auto listSquareTerms() {
  taylor::detail::TermList<9> t;
  for (int n = 0; n < 9; ++n) t.add(0, n, n);
  return t.terms;
}
struct SquareTerms {
  static constexpr bool ofOneBlock = true;
  static constexpr int numLeft = 9, numRight = 9, numOut = 1;
  static constexpr bool onlySquares(int) { return true; }
  static constexpr auto list = listSquareTerms();
};

/// tr(F^T F) - 3
template <class T>
ATRAPOS_FORCEINLINE T firstInvariantChange(const taylor::Matrix3<T>& H) {
  taylor::detail::Scalar<T> squares;
  taylor::detail::bilinear<SquareTerms>(H, H, squares);
  return 2.0 * trace(H) + squares.entry(0);
}

/// cof(I + H) - I
template <class T>
ATRAPOS_FORCEINLINE taylor::Matrix3<T> cofactorChange(const taylor::Matrix3<T>& H) {
  return plusIdentity(cofactor(H) - transpose(H), trace(H));
}
template <class T>
ATRAPOS_FORCEINLINE taylor::Symmetric3<T> cofactorChange(const taylor::Symmetric3<T>& A) {
  return plusIdentity(cofactor(A) - A, trace(A));
}

/// det(I + H) - 1 from H and K = cofactorChange(H), by the first row.
template <class T>
ATRAPOS_FORCEINLINE T determinantChange(const taylor::Matrix3<T>& H, const taylor::Matrix3<T>& K) {
  return H(0, 0) + K(0, 0) + determinant(H, K);
}
template <class T>
ATRAPOS_FORCEINLINE T determinantChange(const taylor::Symmetric3<T>& A, const taylor::Symmetric3<T>& K) {
  return A(0, 0) + K(0, 0) + determinant(A, K);
}

inline void requirePositive(double x, const char* what) {
  if (!(x > 0) || !std::isfinite(x)) throw std::invalid_argument(std::string(what) + " must be positive");
}

/// U'(J)/J of the common volumetric energy, by its bulk modulus: (J^2 - 1)/J^2.
struct BulkPressure {
  template <class T>
  ATRAPOS_FORCEINLINE T operator()(const T&, const T& d, const T& J2) const {
    return d / J2;
  }
};
/// The same where the pressure U'(J) is an unknown of its own, by the scale of this unknown.
template <class T>
struct GivenPressure {
  const T& pressure;
  ATRAPOS_FORCEINLINE T operator()(const T& J, const T&, const T&) const { return pressure / J; }
};

/// J - 1 where U'(J) = bulk/2 (J - 1/J) = bulk sinh(ln J) is q bulk.
template <class T>
ATRAPOS_FORCEINLINE T volumeChangeAt(const T& q) {
  using std::asinh;
  using std::expm1, atrapos::taylor::expm1;
  const T logarithm = asinh(q);
  return expm1(logarithm);
}

/// What laws of both invariants of the isochoric part are functions of.
template <class T>
struct Dilated {
  const T& i1;  ///< I_1 - 3
  const T& i2;  ///< I_2 - 3
  const T& d;   ///< J^2 - 1
  const T& J2;  ///< J^2
  const T& m;   ///< J^(-2/3)
};

}  // namespace detail

/// Base of a law of rubber: its shape, and the Cauchy stress that is shown.
template <class Law>
struct RubberLaw {
  static constexpr int numInputs = 9, numOutputs = 9, numData = 0;
  static constexpr bool symmetric = true;

  static constexpr int numObserved = 6;
  static std::vector<std::string> observedNames() {
    return {"stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_yz", "stress_zx"};
  }
  /// Cauchy stress P F^T / det F.
  KOKKOS_INLINE_FUNCTION void observe(const double* H, const double*, double* sigma) const {
    double P[9];
    static_cast<const Law&> (*this)(H, static_cast<const double*>(nullptr), P);
    cauchyStress(P, H, sigma);
  }
};

/// Laws of an isochoric part and the common volumetric one, (bulk/4) (J^2 - 1 - 2 ln J).
///
/// Law: `stress(A, K, d, J2, m, modulus, pressure)`, S from A = C - I, K = cof C - I, d = J^2 - 1, J2 = J^2,
/// m = J^(-2/3), U'(J)/J = modulus pressure; and `stressOfGradient(in, modulus, volumetric, out)`, P from H,
/// where U'(J)/J is modulus times what volumetric(J, J^2 - 1, J^2) says; returns J - 1.
template <class Law>
struct SplitLaw : RubberLaw<Law> {
  double bulk = 0;  ///< bulk modulus, stress units

  /// S from the Green-Lagrange strain.
  template <class T>
  ATRAPOS_FORCEINLINE taylor::Symmetric3<T> secondPiola(const taylor::Symmetric3<T>& E) const {
    using std::pow;
    const taylor::Symmetric3<T> A = 2.0 * E;
    const taylor::Symmetric3<T> K = detail::cofactorChange(A);
    const T d = detail::determinantChange(A, K);
    const T J2 = 1.0 + d;
    const T m = pow(J2, -1.0 / 3);
    const T pressure = d / J2;
    return law().stress(A, K, d, J2, m, 0.5 * bulk, pressure);
  }

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    law().stressOfGradient(in, 0.5 * bulk, detail::BulkPressure{}, out);
  }

  /// What MixedLaw is made of.
  template <class T>
  ATRAPOS_FORCEINLINE void mixed(const T* in, double scale, T* out) const {
    const T j = law().stressOfGradient(in, scale, detail::GivenPressure<T>{in[9]}, out);
    const T q = (scale / bulk) * in[9];
    out[9] = scale * (j - detail::volumeChangeAt(q));
  }

 private:
  ATRAPOS_FORCEINLINE const Law& law() const { return static_cast<const Law&>(*this); }
};

/// Laws whose energy is a function f of the first invariant of the isochoric part and the common volumetric
/// one,
///
///     W = f(x) + (bulk/4) (J^2 - 1 - 2 ln J),   x = J^(-2/3) I_1 - 3,   J = det F > 0
///
/// Law: `template <class T> T slope(const T& x) const`, f'(x).
template <class Law>
struct FirstInvariantLaw : SplitLaw<Law> {
  template <class T>
  ATRAPOS_FORCEINLINE taylor::Symmetric3<T> stress(const taylor::Symmetric3<T>& A,
                                                   const taylor::Symmetric3<T>& K, const T& d, const T& J2,
                                                   const T& m, double modulus, const T& pressure) const {
    const T i1 = trace(A);
    T s, t;
    factors(i1, d, J2, m, modulus, pressure, s, t);
    return plusIdentity(scaled(K, t), s);
  }

  /// P of F and cof F, without C: fewer products than F S, and J itself, not J^2, must be positive.
  template <class T, class Volumetric>
  ATRAPOS_FORCEINLINE T stressOfGradient(const T* in, double modulus, const Volumetric& volumetric,
                                         T* out) const {
    using std::pow;
    const taylor::Matrix3<T> H(in);
    const taylor::Matrix3<T> K = detail::cofactorChange(H);
    const T j = detail::determinantChange(H, K);
    const T J = 1.0 + j;
    const T d = j + j * J;
    const T J2 = 1.0 + d;
    const T m = pow(J, -2.0 / 3);
    const T i1 = detail::firstInvariantChange(H);
    const T pressure = volumetric(J, d, J2);
    T s, t;
    factors(i1, d, J2, m, modulus, pressure, s, t);
    // F (s I + t (cof C - I)) = (s - t) F + t J cof F
    const T tj = t * j;
    const T ofH = s - t;
    const T ofK = t + tj;
    const T ofI = s + tj;
    const taylor::Matrix3<T> P = plusIdentity(scaled(H, ofH) + scaled(K, ofK), ofI);
    P.store(out);
    return j;
  }

 private:
  /// S = s I + t (cof C - I) from i1 = I_1 - 3, d = J^2 - 1, J2 = J^2, m = J^(-2/3), U'(J)/J = modulus
  /// pressure.
  template <class T>
  ATRAPOS_FORCEINLINE void factors(const T& i1, const T& d, const T& J2, const T& m, double modulus,
                                   const T& pressure, T& s, T& t) const {
    const T x = m * i1 + 3.0 * m - 3.0;
    const T slope = static_cast<const Law&>(*this).slope(x);
    const T n = m / J2;
    const T q = 2.0 * (slope * n);
    const T spherical = d - (1.0 / 3) * i1;
    s = modulus * pressure + q * spherical;
    t = modulus * pressure - q - (1.0 / 3) * (q * i1);
  }
};

/// Laws whose energy is one of both invariants of the isochoric part and the common volumetric one,
///
///     W = f(J^(-2/3) I_1, J^(-4/3) I_2) + (bulk/4) (J^2 - 1 - 2 ln J),   J = det F > 0
///
/// Law: `template <class T> void factors(const detail::Dilated<T>& x, const T& pressure, T& ofI, T& ofK, T&
/// ofA) const`, of S = ofI I + ofK (cof C - I) + ofA (C - I), where `pressure` is U'(J)/J.
template <class Law>
struct SecondInvariantLaw : SplitLaw<Law> {
  /// P = F S: the second invariant needs C anyway. J comes from F, for its sign.
  template <class T, class Volumetric>
  ATRAPOS_FORCEINLINE T stressOfGradient(const T* in, double modulus, const Volumetric& volumetric,
                                         T* out) const {
    using std::pow;
    const taylor::Matrix3<T> H(in);
    // The first row of cof F - I
    const T K0 = in[4] + in[8] + (in[4] * in[8] - in[5] * in[7]);
    const T K1 = in[5] * in[6] - in[3] * in[8] - in[3];
    const T K2 = in[3] * in[7] - in[4] * in[6] - in[6];
    const T j = in[0] + K0 + (in[0] * K0 + in[1] * K1 + in[2] * K2);
    const T J = 1.0 + j;
    const T m = pow(J, -2.0 / 3);
    const T d = j + j * J;
    const T J2 = 1.0 + d;
    const T pressure = volumetric(J, d, J2);
    const taylor::Symmetric3<T> A = 2.0 * greenLagrange(H);
    const taylor::Symmetric3<T> S = stress(A, detail::cofactorChange(A), d, J2, m, modulus, pressure);
    const taylor::Matrix3<T> P = full(S) + H * S;
    P.store(out);
    return j;
  }

  template <class T>
  ATRAPOS_FORCEINLINE taylor::Symmetric3<T> stress(const taylor::Symmetric3<T>& A,
                                                   const taylor::Symmetric3<T>& K, const T& d, const T& J2,
                                                   const T& m, double modulus, const T& pressure) const {
    const T i1 = trace(A);
    const T i2 = trace(K);
    const T spherical = modulus * pressure;
    T ofI, ofK, ofA;
    static_cast<const Law&>(*this).factors(detail::Dilated<T>{i1, i2, d, J2, m}, spherical, ofI, ofK, ofA);
    return plusIdentity(scaled(K, ofK) + scaled(A, ofA), ofI);
  }
};

}  // namespace atrapos::solid
