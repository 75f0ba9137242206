#pragma once

#include <algorithm>

#include "atrapos/solid/Mitc3Base.hpp"
#include "atrapos/solid/Mitc4Base.hpp"
#include "atrapos/solid/Mitc6Base.hpp"
#include "atrapos/solid/ShellBase.hpp"
#include "atrapos/solid/Strain.hpp"

/// From what moves at a point of a shell to strains, and back from stresses to forces: what the laws of
/// shells have in common, and each element its own of. A Kinematics says
///
///     numInputs    of what moves (x)
///     numData      passive numbers of a point
///     strain       the Green-Lagrange strain of x, in the axes of the data
///     forces       the work conjugates of x for the second Piola-Kirchhoff stress in these axes
///     gradient     at a point as doubles: F by rows, [component][axis], from the axes to space
///     doubled      the x of a body whose lengths are all twice as large, without a turn
namespace atrapos::solid {

/// Strains of the displacements (ShellLaw). x: H_ij = du_i/dX_j by rows; data: the axes at rest,
/// [component][axis].
struct PlainShell {
  static constexpr int numInputs = 9, numData = 9;

  template <class T>
  static ATRAPOS_FORCEINLINE taylor::Symmetric3<T> strain(const T* x, const taylor::Passive<T>* axes) {
    taylor::Symmetric3<T> E;
    taylor::detail::linear(detail::ToCartesian<taylor::Passive<T>>{turned(axes).entries},
                           greenLagrange(taylor::Matrix3<T>(x)), E);
    return E;
  }
  template <class T>
  static ATRAPOS_FORCEINLINE void forces(const T* x, const taylor::Symmetric3<T>& S,
                                         const taylor::Passive<T>* axes, T* out) {
    const taylor::Matrix3<T> H(x);
    taylor::Symmetric3<T> inSpace;
    taylor::detail::linear(detail::ToCartesian<taylor::Passive<T>>{axes}, S, inSpace);
    const taylor::Matrix3<T> P = full(inSpace) + H * inSpace;
    P.store(out);
  }
  static KOKKOS_INLINE_FUNCTION void gradient(const double* x, const double* axes, double* F) {
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        F[3 * i + k] =
            axes[3 * i + k] + x[3 * i] * axes[k] + x[3 * i + 1] * axes[3 + k] + x[3 * i + 2] * axes[6 + k];
  }

  static void doubled(const double*, double* x) {
    for (int i = 0; i < 9; ++i) x[i] = i % 4 == 0 ? 1 : 0;
  }

 private:
  /// The transpose.
  template <class P>
  struct Turned {
    P entries[9];
  };
  template <class P>
  static ATRAPOS_FORCEINLINE Turned<P> turned(const P* axes) {
    return {{axes[0], axes[3], axes[6], axes[1], axes[4], axes[7], axes[2], axes[5], axes[8]}};
  }
};

/// Assumed transverse shear (AssumedShearLaw). x: changes of the four vectors, [component][vector]; data:
/// these at rest, the contravariant base in the axes, [axis][i].
struct AssumedShearShell {
  static constexpr int numInputs = 12, numData = 21;

  template <class T>
  static ATRAPOS_FORCEINLINE taylor::Symmetric3<T> strain(const T* x, const taylor::Passive<T>* data) {
    return shellStrain(ShellBase<T>(x), data, data + 12);
  }
  template <class T>
  static ATRAPOS_FORCEINLINE void forces(const T* x, const taylor::Symmetric3<T>& S,
                                         const taylor::Passive<T>* data, T* out) {
    const ShellBase<T> f = shellForces(ShellBase<T>(x), S, data, data + 12);
    f.store(out);
  }
  /// With g_3 the mean of the two directors.
  static KOKKOS_INLINE_FUNCTION void gradient(const double* x, const double* data, double* F) {
    const double* base = data + 12;
    for (int i = 0; i < 3; ++i) {
      double g[4];
      for (int v = 0; v < 4; ++v) g[v] = data[4 * i + v] + x[4 * i + v];
      for (int k = 0; k < 3; ++k)
        F[3 * i + k] = g[0] * base[3 * k] + g[1] * base[3 * k + 1] + 0.5 * (g[2] + g[3]) * base[3 * k + 2];
    }
  }
  static void doubled(const double* data, double* x) { std::copy_n(data, numInputs, x); }
};

/// Strains tied between points of an Element (TiedPoint.hpp). x: changes of its vectors, [component][vector];
/// data: these at rest, the Element's Place, the contravariant base in the axes, [axis][i].
template <class Element>
struct TiedShell {
  static constexpr int numInputs = 3 * Element::vectors,
                       firstBase = numInputs + Element::template Place<double>::numData,
                       numData = firstBase + 9;

  template <class T>
  static ATRAPOS_FORCEINLINE taylor::Symmetric3<T> strain(const T* x, const taylor::Passive<T>* data) {
    return TiedPoint<Element, T>(x, data, data + numInputs).strain(data + firstBase);
  }
  template <class T>
  static ATRAPOS_FORCEINLINE void forces(const T* x, const taylor::Symmetric3<T>& S,
                                         const taylor::Passive<T>* data, T* out) {
    TiedPoint<Element, T>(x, data, data + numInputs).forces(S, data + firstBase, out);
  }
  static KOKKOS_INLINE_FUNCTION void gradient(const double* x, const double* data, double* F) {
    double now[numInputs];
    for (int i = 0; i < numInputs; ++i) now[i] = data[i] + x[i];
    detail::tiedGradient<Element>(now, data + numInputs, data + firstBase, F);
  }
  static void doubled(const double* data, double* x) { std::copy_n(data, numInputs, x); }
};

}  // namespace atrapos::solid
