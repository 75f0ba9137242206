#pragma once

#include <cstddef>

#include "atrapos/taylor/Lanes.hpp"

/// Saint Venant-Kirchhoff's order-k sweep written by hand: the yardstick of the generic one.
///
///     S = lambda tr(E) I + 2 mu E,   2 E = H + H^T + H^T H,   P = (I + H) S
///
/// A batch is a point for each lane of the widest SIMD register; its history is [order][slot][lane] with the
/// slots H (9, row-major) and S (xx, yy, zz, xy, yz, zx). Every loop over orders loads each coefficient once
/// and feeds all sums with it. Orders come one after the other: start, then for k = 1, 2, ...: sweep (or
/// sweepBlock, sweepWithin) of order k, complete of order k.
namespace atrapos::bench::hand {

constexpr int kLanes = taylor::nativeLanes;
constexpr int kSlots = 15;

typedef double Vector __attribute__((vector_size(8 * kLanes), may_alias));

struct Material {
  double lambda, mu;
};

/// Named entries, not arrays: the compiler keeps them in registers across loops.
struct Tensor {
  Vector xx, xy, xz, yx, yy, yz, zx, zy, zz;
};
struct Symmetric {
  Vector xx, yy, zz, xy, yz, zx;
};
struct Order {
  Tensor H;
  Symmetric S;
};
static_assert(sizeof(Order) == kSlots * kLanes * sizeof(double));

#define ATRAPOS_HAND inline __attribute__((always_inline))

ATRAPOS_HAND Order* orders(double* history) { return reinterpret_cast<Order*>(history); }
ATRAPOS_HAND const Order* orders(const double* history) { return reinterpret_cast<const Order*>(history); }

/// Keeps a loaded value in its register; GCC 12 would load it again for several of its uses.
ATRAPOS_HAND void hold([[maybe_unused]] Vector& a) {
#ifdef __AVX512F__
  asm("" : "+v"(a));
#endif
}
ATRAPOS_HAND void hold(Vector& a, Vector& b, Vector& c) {
  hold(a);
  hold(b);
  hold(c);
}

/// S of twice the strain, E2.
ATRAPOS_HAND Symmetric stress(const Material& m, const Symmetric& E2) {
  const Vector trace = (0.5 * m.lambda) * (E2.xx + E2.yy + E2.zz);
  return {trace + m.mu * E2.xx, trace + m.mu * E2.yy, trace + m.mu * E2.zz,
          m.mu * E2.xy,         m.mu * E2.yz,         m.mu * E2.zx};
}

ATRAPOS_HAND Symmetric sum(const Symmetric& a, const Symmetric& b) {
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.yz + b.yz, a.zx + b.zx};
}

/// A^T B: its diagonal, and the two halves of its other entries, each a chain of sums of its own.
struct Strain {
  Vector xx, yy, zz, xy, yz, zx, yx, zy, xz;

  ATRAPOS_HAND void addRow(const Vector& a0, const Vector& a1, const Vector& a2, const Vector& b0,
                           const Vector& b1, const Vector& b2) {
    Vector ax = a0, ay = a1, az = a2, bx = b0, by = b1, bz = b2;
    hold(ax, ay, az);
    hold(bx, by, bz);
    xx += ax * bx;
    yy += ay * by;
    zz += az * bz;
    xy += ax * by;
    yz += ay * bz;
    zx += az * bx;
    yx += ay * bx;
    zy += az * by;
    xz += ax * bz;
  }
  ATRAPOS_HAND void add(const Tensor& a, const Tensor& b) {
    addRow(a.xx, a.xy, a.xz, b.xx, b.xy, b.xz);
    addRow(a.yx, a.yy, a.yz, b.yx, b.yy, b.yz);
    addRow(a.zx, a.zy, a.zz, b.zx, b.zy, b.zz);
  }
  /// A^T B + B^T A
  ATRAPOS_HAND Symmetric both() const { return {2.0 * xx, 2.0 * yy, 2.0 * zz, xy + yx, yz + zy, zx + xz}; }
  /// A^T A, where B = A
  ATRAPOS_HAND Symmetric one() const { return {xx, yy, zz, xy, yz, zx}; }
};

/// p += a s for one row.
ATRAPOS_HAND void addRow(const Vector& a0, const Vector& a1, const Vector& a2, const Symmetric& s, Vector& px,
                         Vector& py, Vector& pz) {
  Vector ax = a0, ay = a1, az = a2;
  hold(ax, ay, az);
  px += ax * s.xx;
  py += ax * s.xy;
  pz += ax * s.zx;
  px += ay * s.xy;
  py += ay * s.yy;
  pz += ay * s.yz;
  px += az * s.zx;
  py += az * s.yz;
  pz += az * s.zz;
}
ATRAPOS_HAND void addProduct(const Tensor& a, const Symmetric& b, Tensor& P) {
  Symmetric s = b;
  hold(s.xx, s.yy, s.zz);
  hold(s.xy, s.yz, s.zx);
  addRow(a.xx, a.xy, a.xz, s, P.xx, P.xy, P.xz);
  addRow(a.yx, a.yy, a.yz, s, P.yx, P.yy, P.yz);
  addRow(a.zx, a.zy, a.zz, s, P.zx, P.zy, P.zz);
}
ATRAPOS_HAND void addSymmetric(const Symmetric& s, Tensor& P) {
  P.xx += s.xx;
  P.xy += s.xy;
  P.xz += s.zx;
  P.yx += s.xy;
  P.yy += s.yy;
  P.yz += s.yz;
  P.zx += s.zx;
  P.zy += s.yz;
  P.zz += s.zz;
}

/// Twice the symmetric part.
ATRAPOS_HAND Symmetric twiceSymmetric(const Tensor& H) {
  return {2.0 * H.xx, 2.0 * H.yy, 2.0 * H.zz, H.xy + H.yx, H.yz + H.zy, H.zx + H.xz};
}

/// Order 0: history's H and S from H, and P.
inline void start(const Material& m, double* history, const Tensor& H, Tensor& P) {
  Strain square{};
  square.add(H, H);
  const Symmetric S = stress(m, sum(twiceSymmetric(H), square.one()));
  orders(history)->H = H;
  orders(history)->S = S;
  Tensor p{};
  addProduct(H, S, p);
  addSymmetric(S, p);
  P = p;
}

/// The linear part of order k >= 1, once dH = H_k is known: history's H_k, and S_k made complete.
ATRAPOS_HAND void complete(const Material& m, double* history, int k, const Tensor& dH) {
  Order* h = orders(history);
  Strain mixed{};
  mixed.add(h[0].H, dH);
  const Symmetric dS = stress(m, sum(twiceSymmetric(dH), mixed.both()));
  h[k].H = dH;
  h[k].S = sum(h[k].S, dS);
}

/// Fetches order i of another batch while this one is computed.
ATRAPOS_HAND void prefetch(const double* history, int i) {
  const char* p = reinterpret_cast<const char*>(orders(history) + i);
#pragma GCC unroll 15
  for (int j = 0; j < kSlots; ++j) __builtin_prefetch(p + j * sizeof(Vector));
}

/// E2 = the sum of H_i^T H_{k-i} and P = that of H_i S_{k-i}, first <= i <= k-first. Where kPrefetch, these
/// orders of the batch `next` are fetched meanwhile.
template <bool kPrefetch>
ATRAPOS_HAND void addPairs(const Order* h, int k, int first, Symmetric& E2, Tensor& P,
                           [[maybe_unused]] const double* next) {
  Strain pairs{};
  int i = first;
  for (; 2 * i < k; ++i) pairs.add(h[i].H, h[k - i].H);
  E2 = pairs.both();
  if (2 * i == k) {
    Strain middle{};
    middle.add(h[i].H, h[i].H);
    E2 = sum(E2, middle.one());
  }
  Tensor p{};
  for (i = first; i <= k - first; ++i) {
    if constexpr (kPrefetch) prefetch(next, i);
    addProduct(h[i].H, h[k - i].S, p);
  }
  P = p;
}

/// S_k from E2 into the history, and P_k = P + H_0 S_k + S_k.
ATRAPOS_HAND void finish(const Material& m, Order* h, int k, const Symmetric& E2, Tensor& P) {
  const Symmetric S = stress(m, E2);
  h[k].S = S;
  addProduct(h[0].H, S, P);
  addSymmetric(S, P);
}

/// P_k, and history's S_k, without the part that is linear in H_k. `next` is the history of the batch that
/// comes after this one: it is fetched meanwhile, which takes a fifth off the time out of cache, a tenth
/// where the histories are in the second level.
ATRAPOS_HAND void sweep(const Material& m, double* history, int k, Tensor& P, const double* next) {
  Order* h = orders(history);
  Symmetric E2;
  Tensor p;
  addPairs<true>(h, k, 1, E2, p, next);
  finish(m, h, k, E2, p);
  P = p;
}

/// The same, and the convolutions of the orders k+1..end-1 begun, end <= 2 k, while the history is near:
/// pairs of orders below k are added for all of them. The partial sums wait where nothing else is yet: those
/// of E2 in the slots of S, those of P in the slots of H.
ATRAPOS_HAND void sweepBlock(const Material& m, double* history, int k, int end, Tensor& P,
                             const double* next) {
  sweep(m, history, k, P, next);
  Order* h = orders(history);
  for (int n = k + 1; n < end; ++n) addPairs<false>(h, n, n - k + 1, h[n].S, h[n].H, nullptr);
}

/// Order k of a block that sweepBlock began at order `begin` < k: adds the pairs that it could not know,
/// those with an order from begin to k-1.
ATRAPOS_HAND void sweepWithin(const Material& m, double* history, int k, int begin, Tensor& P,
                              const double* next) {
  Order* h = orders(history);
  prefetch(next, 0);
  prefetch(next, begin);
  Strain pairs{};
  for (int i = 1; i <= k - begin; ++i) {
    prefetch(next, i);
    pairs.add(h[i].H, h[k - i].H);
  }
  Tensor p = h[k].H;
  for (int i = 1; i <= k - begin; ++i) {
    prefetch(next, k - i + 1);
    addProduct(h[i].H, h[k - i].S, p);
    addProduct(h[k - i].H, h[i].S, p);
  }
  finish(m, h, k, sum(h[k].S, pairs.both()), p);
  P = p;
}

#undef ATRAPOS_HAND

}  // namespace atrapos::bench::hand
