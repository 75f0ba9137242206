#pragma once

#include "atrapos/contact/CurveContactLaw.hpp"
#include "atrapos/contact/ExponentialPressure.hpp"
#include "atrapos/contact/MovingTool.hpp"
#include "atrapos/contact/Overclosure.hpp"
#include "atrapos/contact/PatchTool.hpp"
#include "atrapos/contact/PowerBarrier.hpp"
#include "atrapos/contact/SharpenedContact.hpp"
#include "atrapos/contact/SmoothedPenalty.hpp"
#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/taylor/Implicit.hpp"

/// What contact laws are made of (ContactStages.hpp): each is compiled once, whatever it is put together
/// with.
namespace atrapos::contact {

/// x (3) -> h, n (4): the projection on a tool at rest.
template <class Tool>
struct ProjectionStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = 3, numOutputs = 4, numData = 0;
  Tool tool;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const taylor::Passive<T>*, T* out) const {
    T y[Tool::numUnknowns];
    for (int i = 0; i < Tool::numUnknowns; ++i) y[i] = T(0.0);  // Newton's start is the tool's own
    taylor::solveImplicit<3, Tool::numUnknowns>(tool, x, y);
    for (int i = 0; i < 4; ++i) out[i] = y[i];
  }
};

/// The same on patches, and the foot's t1, t2. data: Delta, patch, t1, t2 to begin from. A point that is over
/// no part of the tool has h = Delta and n = 0.
template <>
struct ProjectionStage<PatchTool> {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = 3, numOutputs = 6, numData = 1 + PatchTool::numToolData;
  PatchTool tool;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const taylor::Passive<T>* data, T* out) const {
    T y[PatchTool::numUnknowns];
    for (int i = 0; i < PatchTool::numUnknowns; ++i) y[i] = T(0.0);
    taylor::solveImplicit<3, PatchTool::numUnknowns, PatchTool::numToolData>(tool, x, data + 1, y);
    const taylor::Passive<T> on = tool.carries(data + 1);
    out[0] = y[0] * on + (1.0 - on) * data[0];
    for (int i = 1; i < 4; ++i) out[i] = y[i] * on;
    for (int i = 4; i < 6; ++i) out[i] = y[i];
  }
};

/// x, lambda (4) -> where x is for somebody who moves with the tool (3).
struct PullStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = 4, numOutputs = 3, numData = 0;
  Motion motion;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* X) const {
    T c[3], sine, cosine, v[3], turned[3];
    motion.at(in[3], c, sine, cosine);
    if (!motion.turns()) {
      for (int i = 0; i < 3; ++i) X[i] = in[i] - c[i];
      return;
    }
    for (int i = 0; i < 3; ++i) v[i] = in[i] - motion.pivot[i] - c[i];
    const T back = -sine;
    motion.turn(v, back, cosine, turned);
    for (int i = 0; i < 3; ++i) X[i] = turned[i] + motion.pivot[i];
  }
};

/// n of the tool at rest, lambda (4) -> n (3), of motions that turn.
struct TurnStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = 4, numOutputs = 3, numData = 0;
  Motion motion;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* n) const {
    T c[3], sine, cosine;
    motion.at(in[3], c, sine, cosine);
    motion.turn(in, sine, cosine, n);
  }
};

/// h, n (4) -> -R n, R (4). data: Delta.
template <class Pressure>
struct PressureStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = 4, numOutputs = 4, numData = 1;
  Pressure pressure;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    T R[1] = {T(0.0)};
    taylor::solveImplicit<1, 1, 1>(pressure, in, data, R);
    for (int i = 0; i < 3; ++i) out[i] = -(R[0] * in[1 + i]);
    out[3] = R[0];
  }
};

/// h, n, s (5) -> -R n, R (4) with the regularisation eta exp(-s). data: Delta.
struct SharpenedStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = 5, numOutputs = 4, numData = 1;
  SharpenedPressure pressure;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    const T hs[2] = {in[0], in[4]};
    T R[1] = {T(0.0)};
    taylor::solveImplicit<2, 1, 1>(pressure, static_cast<const T*>(hs), data, R);
    for (int i = 0; i < 3; ++i) out[i] = -(R[0] * in[1 + i]);
    out[3] = R[0];
  }
};

/// h (1) -> p (1) where h <= 0, and its analytic continuation beyond.
struct OverclosureStage {
  static constexpr bool stage = true, symmetric = true;
  static constexpr int numInputs = 1, numOutputs = 1, numData = 0;
  Overclosure law;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* h, const taylor::Passive<T>*, T* out) const {
    const T depth = -h[0];
    T power = depth;
    for (int m = 1; m < law.exponent; ++m) {
      const T next = power * depth;
      power = next;
    }
    out[0] = law.stiffness * power;
  }
};

/// q (1) -> 0, q (2): what flows through a contact does no work. data: as PatchTool, the patch; where the
/// point is over no part of the tool nothing flows.
struct PassageStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = 1, numOutputs = 2, numData = 1;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* q, const taylor::Passive<T>* data, T* out) const {
    out[0] = T(0.0);
    out[1] = q[0] * PatchTool::carries(data);
  }
};

/// n, r (4) -> -r n (3): the force of hard contact.
struct HardStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = 4, numOutputs = 3, numData = 0;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    for (int i = 0; i < 3; ++i) out[i] = -(in[3] * in[i]);
  }
};

/// h, n, t (5) -> -R n, -R'(t) (h - h(t)), R (5): CurveContactLaw. data: Delta.
struct CurveStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = 5, numOutputs = 5, numData = 1;
  RegularisedPressure pressure;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    using std::exp;
    const T up = exp(in[4]), down = exp(-in[4]);
    const T R = pressure.eta * (up - 1.0);
    for (int i = 0; i < 3; ++i) out[i] = -(R * in[1 + i]);
    const T mismatch = in[0] - data[0] * down + (pressure.compliance * pressure.eta) * (up + down - 2.0);
    out[3] = -(pressure.eta * (up * mismatch));
    out[4] = R;
  }
};

}  // namespace atrapos::contact
