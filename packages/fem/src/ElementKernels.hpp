#pragma once

#include <cstddef>

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/taylor/Lanes.hpp"

namespace atrapos::fem {

/// Bounds of the element loops' stack arrays.
constexpr int kMaxNodes = 27;
constexpr int kMaxPoints = 64;

/// What the element loops of a term read of its entities, whatever the law (ElementArrays owns it).
///
/// Shape functions that all entities share are kept once, and gradients as those by reference coordinates,
/// which are shared, with a 3 x 3 map at each point: a loop reads 9 numbers at a point of a HEX20 then
/// instead of 60. Only where neither holds has each entity its own.
struct ElementView {
  int numEntities = 0, N = 0, Q = 0;  ///< nodes and points of an entity
  bool shared = false, mapped = false;
  const int* nodes = nullptr;      ///< [batch][lane][node]
  const int* positions = nullptr;  ///< [batch][lane][node a][node b]
  const double* shape = nullptr;   ///< shared: [q][node][component]; own: [batch][q][node][component][lane]
  const double* map = nullptr;     ///< mapped: [batch][q][d][i][lane] dxi_d/dX_i, shape has dN/dxi_d
  const double* weight = nullptr;  ///< [batch][q][lane]

  KOKKOS_FORCEINLINE_FUNCTION int lanesIn(int b) const {
    const int left = numEntities - b * kLanes;
    return left < kLanes ? left : kLanes;
  }
};

/// What a block of the tangent has beside B^T moduli B.
struct BlockCorrection {
  /// += sum_k left[3 na + i][k] right[3 nb + j][k], k < rank: [dof][k][lane].
  int rank = 0;
  const double* left = nullptr;
  const double* right = nullptr;
  /// += [node a][node b][i][j][lane]; null: nothing.
  const double* dense = nullptr;
};

/// Entries of the tangent as TangentSink has them.
struct BlockSink {
  const std::size_t* rowStart;
  double* values;
};

/// The steps of an element loop on one batch of entities, compiled for one instruction set and one number C
/// of shape components. B u has I = 3 C entries at a point.
struct ElementKernels {
  /// in[q][m][lane] = B u, m < I, of rows of `stride` entries a point.
  void (*inputs)(const ElementView&, int b, const double* u, int stride, double* in);
  /// force[3 node + i][lane] += B^T out; with `weighted` times the points' weights.
  void (*forces)(const ElementView&, int b, const double* out, int stride, bool weighted, double* force);
  /// f += force at the entities' nodes.
  void (*scatter)(const ElementView&, int b, const double* force, double* f);
  /// moduli[q][m][n][lane] = weight times d out_m/d in_n, m, n < I, of a law's jacobian [q][out][in][lane]
  /// with these numbers of outputs and inputs; may be the same array.
  void (*moduli)(const ElementView&, int b, const double* jacobian, int outputs, int inputs, double* moduli);
  /// K += B^T moduli B + correction; the moduli are lost. Of a symmetric K one triangle is worked out.
  void (*blocks)(const ElementView&, int b, double* moduli, bool symmetric, const BlockCorrection&,
                 const BlockSink&);
};

/// For the instruction set in use (Processor.hpp). Throws std::logic_error where no loops were compiled for
/// so many components.
ElementKernels elementKernels(int components);

namespace detail {

/// Those of C components for L lanes: defined where they are compiled.
template <int C, int L>
struct ElementKernelsOf {
  static ElementKernels table();
};

#ifndef ATRAPOS_KERNEL_LEVELS
/// Nothing but arithmetic on the caller's arrays: what is compiled for another instruction set than the rest
/// of the program must share no function with it.
template <int C, int L>
struct ElementSteps {
  using Pack = taylor::Lanes<L>;
  static constexpr int I = 3 * C;

  static KOKKOS_FORCEINLINE_FUNCTION std::size_t number(const ElementView& e, int b, int q) {
    return static_cast<std::size_t>(b) * e.Q + q;
  }
  static KOKKOS_FORCEINLINE_FUNCTION const int* nodesOf(const ElementView& e, int b, int lane) {
    return e.nodes + (static_cast<std::size_t>(b) * kLanes + lane) * e.N;
  }

  /// Entry i = node C + component of the shape functions of a point, as kept.
  struct Shared {
    const double* s;
    KOKKOS_FORCEINLINE_FUNCTION Pack operator()(int i) const { return Pack(s[i]); }
  };
  struct Own {
    const double* s;
    KOKKOS_FORCEINLINE_FUNCTION Pack operator()(int i) const { return Pack::load(s + i * kLanes); }
  };
  static KOKKOS_FORCEINLINE_FUNCTION Shared sharedAt(const ElementView& e, int q) {
    return {e.shape + static_cast<std::size_t>(q) * e.N * C};
  }
  static KOKKOS_FORCEINLINE_FUNCTION Own ownAt(const ElementView& e, int b, int q, int s) {
    return {e.shape + number(e, b, q) * e.N * C * kLanes + s};
  }
  static KOKKOS_FORCEINLINE_FUNCTION Own mapAt(const ElementView& e, int b, int q, int s) {
    return {e.map + number(e, b, q) * 9 * kLanes + s};
  }

  static void inputs(const ElementView& e, int b, const double* u, int stride, double* in) {
    const int lanes = e.lanesIn(b);
    for (int s = 0; s < lanes; s += L) {
      Pack local[3 * kMaxNodes];
      for (int lane = 0; lane < L; ++lane) {
        const int* node = nodesOf(e, b, s + lane);
        for (int n = 0; n < e.N; ++n)
          for (int i = 0; i < 3; ++i) local[3 * n + i][lane] = u[3 * node[n] + i];
      }
      for (int q = 0; q < e.Q; ++q) {
        Pack h[I];
        if (e.shared)
          interpolate(e, sharedAt(e, q), local, h);
        else
          interpolate(e, ownAt(e, b, q, s), local, h);
        if constexpr (C == 3)
          if (e.mapped) {
            const Own J = mapAt(e, b, q, s);
            for (int i = 0; i < 3; ++i) {
              const Pack along[3] = {h[3 * i], h[3 * i + 1], h[3 * i + 2]};
              for (int c = 0; c < 3; ++c)
                h[3 * i + c] = along[0] * J(c) + along[1] * J(3 + c) + along[2] * J(6 + c);
            }
          }
        double* to = in + static_cast<std::size_t>(q) * stride * kLanes + s;
        ATRAPOS_UNROLL
        for (int m = 0; m < I; ++m) h[m].store(to + m * kLanes);
      }
    }
  }

  template <class Shape>
  static KOKKOS_FORCEINLINE_FUNCTION void interpolate(const ElementView& e, const Shape& shape,
                                                      const Pack* local, Pack* in) {
    ATRAPOS_UNROLL
    for (int m = 0; m < I; ++m) in[m] = Pack(0.0);
    for (int n = 0; n < e.N; ++n) {
      ATRAPOS_UNROLL
      for (int i = 0; i < 3; ++i) {
        ATRAPOS_UNROLL
        for (int c = 0; c < C; ++c) in[i * C + c] += local[3 * n + i] * shape(n * C + c);
      }
    }
  }

  static void forces(const ElementView& e, int b, const double* out, int stride, bool weighted,
                     double* force) {
    const int lanes = e.lanesIn(b);
    for (int s = 0; s < lanes; s += L) {
      Pack sums[3 * kMaxNodes];
      for (int n = 0; n < 3 * e.N; ++n) sums[n] = Pack::load(force + n * kLanes + s);
      for (int q = 0; q < e.Q; ++q) {
        const double* from = out + static_cast<std::size_t>(q) * stride * kLanes + s;
        Pack f[I];
        ATRAPOS_UNROLL
        for (int m = 0; m < I; ++m) f[m] = Pack::load(from + m * kLanes);
        if (weighted) {
          const Pack w = Pack::load(e.weight + number(e, b, q) * kLanes + s);
          ATRAPOS_UNROLL
          for (int m = 0; m < I; ++m) f[m] = w * f[m];
        }
        if constexpr (C == 3)
          if (e.mapped) {
            const Own J = mapAt(e, b, q, s);
            Pack along[I];
            for (int i = 0; i < 3; ++i)
              for (int d = 0; d < 3; ++d)
                along[3 * i + d] =
                    J(3 * d) * f[3 * i] + J(3 * d + 1) * f[3 * i + 1] + J(3 * d + 2) * f[3 * i + 2];
            accumulate(e, sharedAt(e, q), along, sums);
            continue;
          }
        if (e.shared)
          accumulate(e, sharedAt(e, q), f, sums);
        else
          accumulate(e, ownAt(e, b, q, s), f, sums);
      }
      for (int n = 0; n < 3 * e.N; ++n) sums[n].store(force + n * kLanes + s);
    }
  }

  template <class Shape>
  static KOKKOS_FORCEINLINE_FUNCTION void accumulate(const ElementView& e, const Shape& shape,
                                                     const Pack* out, Pack* force) {
    for (int n = 0; n < e.N; ++n) {
      ATRAPOS_UNROLL
      for (int i = 0; i < 3; ++i) {
        Pack sum = force[3 * n + i];
        ATRAPOS_UNROLL
        for (int c = 0; c < C; ++c) sum += out[i * C + c] * shape(n * C + c);
        force[3 * n + i] = sum;
      }
    }
  }

  static void scatter(const ElementView& e, int b, const double* force, double* f) {
    const int lanes = e.lanesIn(b);
    for (int lane = 0; lane < lanes; ++lane) {
      const int* node = nodesOf(e, b, lane);
      for (int n = 0; n < e.N; ++n)
        for (int i = 0; i < 3; ++i) f[3 * node[n] + i] += force[(3 * n + i) * kLanes + lane];
    }
  }

  static void moduli(const ElementView& e, int b, const double* jacobian, int outputs, int inputs,
                     double* moduli) {
    const int lanes = e.lanesIn(b);
    for (int s = 0; s < lanes; s += L)
      for (int q = 0; q < e.Q; ++q) {
        const Pack w = Pack::load(e.weight + number(e, b, q) * kLanes + s);
        for (int m = 0; m < I; ++m)
          for (int n = 0; n < I; ++n)
            (w * Pack::load(jacobian + ((q * outputs + m) * inputs + n) * kLanes + s))
                .store(moduli + ((q * I + m) * I + n) * kLanes + s);
      }
  }

  static void blocks(const ElementView& e, int b, double* moduli, bool symmetric,
                     const BlockCorrection& correction, const BlockSink& sink) {
    const int lanes = e.lanesIn(b);
    for (int s = 0; s < lanes; s += L) {
      const int count = lanes - s < L ? lanes - s : L;
      if (e.mapped)
        for (int q = 0; q < e.Q; ++q) toReference(mapAt(e, b, q, s), moduli + q * I * I * kLanes + s);
      Pack column[kMaxPoints * I * 3];  // moduli times the shape of node nb: [q][input][j]
      for (int nb = 0; nb < e.N; ++nb) {
        for (int q = 0; q < e.Q; ++q)
          if (e.shared)
            columnOf(sharedAt(e, q), nb, moduli + q * I * I * kLanes + s, column + q * I * 3);
          else
            columnOf(ownAt(e, b, q, s), nb, moduli + q * I * I * kLanes + s, column + q * I * 3);
        const int end = symmetric ? nb + 1 : e.N;
        for (int na = 0; na < end; na += 2) {
          const int both = na + 1 < end ? 2 : 1;
          Pack block[2 * 9];
          for (int k = 0; k < both; ++k) begin(e, correction, na + k, nb, s, block + 9 * k);
          if (both == 2)
            multiply<2>(e, b, s, na, column, block);
          else
            multiply<1>(e, b, s, na, column, block);
          for (int k = 0; k < both; ++k)
            for (int lane = 0; lane < count; ++lane)
              addBlock(e, b, s + lane, na + k, nb, block + 9 * k, lane, symmetric, sink);
        }
      }
    }
  }

  /// Moduli by gradients with respect to the reference coordinates.
  static void toReference(const Own& J, double* moduli) {
    if constexpr (C == 3) {
      for (int m = 0; m < I; ++m)
        for (int j = 0; j < 3; ++j) turn(J, moduli + (m * I + 3 * j) * kLanes, 1);
      for (int i = 0; i < 3; ++i)
        for (int n = 0; n < I; ++n) turn(J, moduli + (3 * i * I + n) * kLanes, I);
    }
  }
  /// a_d = sum_c J_dc a_c of three entries `stride` apart.
  static KOKKOS_FORCEINLINE_FUNCTION void turn(const Own& J, double* a, int stride) {
    const Pack x = Pack::load(a), y = Pack::load(a + stride * kLanes),
               z = Pack::load(a + 2 * stride * kLanes);
    ATRAPOS_UNROLL
    for (int d = 0; d < 3; ++d)
      (J(3 * d) * x + J(3 * d + 1) * y + J(3 * d + 2) * z).store(a + d * stride * kLanes);
  }

  template <class Shape>
  static KOKKOS_FORCEINLINE_FUNCTION void columnOf(const Shape& shape, int nb, const double* moduli,
                                                   Pack* column) {
    for (int m = 0; m < I; ++m) {
      ATRAPOS_UNROLL
      for (int j = 0; j < 3; ++j) {
        Pack sum(0.0);
        ATRAPOS_UNROLL
        for (int c = 0; c < C; ++c)
          sum += Pack::load(moduli + (m * I + j * C + c) * kLanes) * shape(nb * C + c);
        column[m * 3 + j] = sum;
      }
    }
  }

  static KOKKOS_FORCEINLINE_FUNCTION void begin(const ElementView& e, const BlockCorrection& correction,
                                                int na, int nb, int s, Pack* block) {
    if (correction.dense != nullptr) {
      const double* from = correction.dense + (na * e.N + nb) * 9 * kLanes + s;
      for (int i = 0; i < 9; ++i) block[i] = Pack::load(from + i * kLanes);
      return;
    }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const double* left = correction.left + (3 * na + i) * correction.rank * kLanes + s;
        const double* right = correction.right + (3 * nb + j) * correction.rank * kLanes + s;
        Pack sum(0.0);
        for (int k = 0; k < correction.rank; ++k)
          sum += Pack::load(left + k * kLanes) * Pack::load(right + k * kLanes);
        block[3 * i + j] = sum;
      }
  }

  /// block += B_na^T column of `count` nodes from na on: with two of them each column is read once for both,
  /// and their sums stay in registers.
  template <int count>
  static KOKKOS_FORCEINLINE_FUNCTION void multiply(const ElementView& e, int b, int s, int na,
                                                   const Pack* column, Pack* block) {
    for (int i = 0; i < 3; ++i) {
      Pack sums[count * 3];
      ATRAPOS_UNROLL
      for (int k = 0; k < count * 3; ++k) sums[k] = Pack(0.0);
      for (int q = 0; q < e.Q; ++q) {
        const Pack* of = column + (q * I + i * C) * 3;
        if (e.shared)
          multiplyWith<count>(sharedAt(e, q), na, of, sums);
        else
          multiplyWith<count>(ownAt(e, b, q, s), na, of, sums);
      }
      ATRAPOS_UNROLL
      for (int k = 0; k < count; ++k) {
        ATRAPOS_UNROLL
        for (int j = 0; j < 3; ++j) block[9 * k + 3 * i + j] += sums[3 * k + j];
      }
    }
  }
  template <int count, class Shape>
  static KOKKOS_FORCEINLINE_FUNCTION void multiplyWith(const Shape& s, int na, const Pack* of, Pack* sums) {
    ATRAPOS_UNROLL
    for (int c = 0; c < C; ++c) {
      ATRAPOS_UNROLL
      for (int k = 0; k < count; ++k) {
        const Pack shape = s((na + k) * C + c);
        ATRAPOS_UNROLL
        for (int j = 0; j < 3; ++j) sums[3 * k + j] += shape * of[3 * c + j];
      }
    }
  }

  static KOKKOS_FORCEINLINE_FUNCTION void addBlock(const ElementView& e, int b, int lane, int na, int nb,
                                                   const Pack* block, int of, bool symmetric,
                                                   const BlockSink& sink) {
    const std::size_t entity = static_cast<std::size_t>(b) * kLanes + lane;
    const int* node = nodesOf(e, b, lane);
    const auto add = [&](int row, int column, int alongRow, int alongColumn) {
      const int position = e.positions[(entity * e.N + row) * e.N + column];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          sink.values[sink.rowStart[3 * node[row] + i] + position + j] +=
              block[alongRow * i + alongColumn * j][of];
    };
    add(na, nb, 3, 1);
    if (symmetric && na != nb) add(nb, na, 1, 3);
  }
};

template <int C, int L>
ElementKernels ElementKernelsOf<C, L>::table() {
  using Steps = ElementSteps<C, L>;
  return {Steps::inputs, Steps::forces, Steps::scatter, Steps::moduli, Steps::blocks};
}
#endif

}  // namespace detail
}  // namespace atrapos::fem
