#pragma once

#include <Kokkos_Macros.hpp>
#include <string>
#include <type_traits>

#include "atrapos/contact/ContactLaw.hpp"
#include "atrapos/contact/Requirements.hpp"

namespace atrapos::contact {

/// Rigid motion as a function of the load factor lambda: a turn by theta about an axis through `pivot`, then
/// a shift c,
///
///     x = pivot + c(lambda) + Q(theta(lambda)) (X - pivot),   c = sum_k shift[k] lambda^k,
///     theta = sum_k angle[k] lambda^k
///
/// X is a point of the tool at rest. Angles in radians, right-handed about the axis.
struct Motion {
  static constexpr int maxDegree = 3;
  double pivot[3] = {0, 0, 0};
  double axis[3] = {0, 0, 1};  ///< unit vector
  double shift[maxDegree + 1][3] = {};
  double angle[maxDegree + 1] = {};

  KOKKOS_INLINE_FUNCTION bool turns() const {
    for (const double a : angle)
      if (a != 0) return true;
    return false;
  }

  /// c(lambda), sin(theta), cos(theta).
  template <class T>
  KOKKOS_INLINE_FUNCTION void at(const T& lambda, T* c, T& sine, T& cosine) const {
    using taylor::sinCos;
    T theta(angle[maxDegree]);
    for (int i = 0; i < 3; ++i) c[i] = T(shift[maxDegree][i]);
    for (int k = maxDegree - 1; k >= 0; --k) {
      theta = theta * lambda + angle[k];
      for (int i = 0; i < 3; ++i) c[i] = c[i] * lambda + shift[k][i];
    }
    sine = T(0.0);
    cosine = T(1.0);
    if (turns()) sinCos(theta, sine, cosine);
  }

  /// out = v turned by the angle of that sine and cosine.
  template <class T>
  KOKKOS_INLINE_FUNCTION void turn(const T* v, const T& sine, const T& cosine, T* out) const {
    const T along = axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2];
    const T rest = along * (1.0 - cosine);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      out[i] = cosine * v[i] + axis[i] * rest + sine * (axis[j] * v[k] - axis[k] * v[j]);
    }
  }

  void validate() const {
    detail::requireFinite("motion", "pivot", pivot);
    detail::requireUnit("motion", "axis", axis);
    for (const auto& coefficient : shift) detail::requireFinite("motion", "shift", coefficient);
    for (const double a : angle) detail::requireFinite("motion", "angle", a);
  }
};

/// A tool that moves: its equation in the frame of the tool, with the point and the normal taken there.
///
///     proj(h, Q^T n, [s,] X) = 0,   X = pivot + Q^T (x - pivot - c)
///
/// Inputs: x and the load factor, in[0..3]. Where the tool has passive data so has this. The contact law then
/// has 4 inputs and 3 outputs; column 3 of its tangent is the share of dR/dlambda.
template <class Tool>
struct MovingTool {
  static constexpr int numUnknowns = Tool::numUnknowns, numPlaceInputs = 4;
  static constexpr int numToolData = detail::ToolData<Tool>::value;
  static constexpr bool symmetric = Tool::symmetric;  ///< of the part d(-R n)/dx
  Tool tool;
  Motion motion;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const T* y, T* g) const {
    T X[3], Y[numUnknowns];
    pullBack(x, y, X, Y);
    tool(X, Y, g);
  }
  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const T* y, const taylor::Passive<T>* data, T* g) const {
    T X[3], Y[numUnknowns];
    pullBack(x, y, X, Y);
    tool(X, Y, data, g);
  }

  KOKKOS_INLINE_FUNCTION void start(const double* x, double* y) const {
    double X[3];
    toToolFrame(x, X);
    tool.start(X, y);
    turnNormal(x[3], y);
  }
  KOKKOS_INLINE_FUNCTION void start(const double* x, const double* data, double* y) const {
    double X[3];
    toToolFrame(x, X);
    tool.start(X, data, y);
    turnNormal(x[3], y);
  }

  /// Where the point (x, lambda) is for somebody who moves with the tool: X. For PatchSet::locate and follow.
  KOKKOS_INLINE_FUNCTION void toToolFrame(const double* x, double* X) const {
    const double none[4] = {0, 0, 0, 0};
    double unused[4];
    pull<4>(x, none, X, unused);
  }

  template <class P>
  KOKKOS_INLINE_FUNCTION auto carries(const P* data) const {
    return tool.carries(data);
  }

  void validate() const {
    tool.validate();
    motion.validate();
  }
  std::string ambiguity(const double* x) const {
    double X[3];
    toToolFrame(x, X);
    return tool.ambiguity(X);
  }

 private:
  template <class T>
  KOKKOS_INLINE_FUNCTION void pullBack(const T* x, const T* y, T* X, T* Y) const {
    pull<numUnknowns>(x, y, X, Y);
  }

  // Not inlined: it stands in several laws and passes.
  template <int N, class T>
  ATRAPOS_NOINLINE KOKKOS_FUNCTION void pull(const T* x, const T* y, T* X, T* Y) const {
    T c[3], sine, cosine, v[3];
    motion.at(x[3], c, sine, cosine);
    for (int i = 0; i < N; ++i) Y[i] = y[i];
    if (!motion.turns()) {
      for (int i = 0; i < 3; ++i) X[i] = x[i] - c[i];
      return;
    }
    const T back = -sine;
    for (int i = 0; i < 3; ++i) v[i] = x[i] - motion.pivot[i] - c[i];
    motion.turn(v, back, cosine, X);
    for (int i = 0; i < 3; ++i) X[i] += motion.pivot[i];
    motion.turn(y + 1, back, cosine, Y + 1);
  }

  KOKKOS_INLINE_FUNCTION void turnNormal(double lambda, double* y) const {
    if (!motion.turns()) return;
    double c[3], sine, cosine;
    motion.at(lambda, c, sine, cosine);
    const double n[3] = {y[1], y[2], y[3]};
    motion.turn(n, sine, cosine, y + 1);
  }
};

}  // namespace atrapos::contact
