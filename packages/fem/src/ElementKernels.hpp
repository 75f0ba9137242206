#pragma once

#include <cstddef>

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/taylor/Lanes.hpp"

namespace atrapos::fem {

/// Bounds of the element loops' stack arrays.
constexpr int kMaxNodes = 27;
constexpr int kMaxPoints = 64;

/// What the element loops read of one field of a term's entities, whatever the law (ElementArrays owns it).
///
/// Shape functions that all entities share are kept once, and gradients as those by reference coordinates,
/// which are shared, with a square map at each point: a loop reads 9 numbers at a point of a HEX20 then
/// instead of 60. Only where neither holds has each entity its own.
struct ElementView {
  int numEntities = 0, N = 0, Q = 0;  ///< nodes with the field, and points, of an entity
  bool shared = false, mapped = false;
  const int* dofs = nullptr;  ///< [batch][lane][node] the field's first component
  /// Where the blocks are in the rows of the tangent, [batch][lane][row node][column node] with P nodes a row
  /// and column: all that the term's entities have.
  const int* positions = nullptr;
  int P = 0;
  const double* shape = nullptr;   ///< shared: [q][node][component]; own: [batch][q][node][component][lane]
  const double* map = nullptr;     ///< mapped: [batch][q][d][i][lane] dxi_d/dX_i, shape has dN/dxi_d
  const double* weight = nullptr;  ///< [batch][q][lane]

  ATRAPOS_FORCEINLINE int lanesIn(int b) const {
    const int left = numEntities - b * kLanes;
    return left < kLanes ? left : kLanes;
  }
};

/// What a block of the tangent has beside B^T moduli B: sum_k left[D na + i][k] right[D nb + j][k], k < rank,
/// [dof][k][lane].
struct BlockCorrection {
  int rank = 0;
  const double* left = nullptr;
  const double* right = nullptr;
};

/// Entries of the tangent as TangentSink has them.
struct BlockSink {
  const std::size_t* rowStart;
  double* values;
};

/// The steps of an element loop on one batch of entities, compiled for one instruction set, D components of a
/// field and C of its shape functions. B u has I = D C entries at a point.
struct ElementKernels {
  /// in[q][m][lane] = B u, m < I, of rows of `stride` entries a point.
  void (*inputs)(const ElementView&, int b, const double* u, int stride, double* in);
  /// force[D node + i][lane] += B^T out; with `weighted` times the points' weights.
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
ElementKernels elementKernels(int components, int shapeComponents);

namespace detail {

/// Those for L lanes: defined where they are compiled.
template <int D, int C, int L>
struct ElementKernelsOf {
  static ElementKernels table();
};

#ifndef ATRAPOS_KERNEL_LEVELS
/// Nothing but arithmetic on the caller's arrays: what is compiled for another instruction set than the rest
/// of the program must share no function with it.
template <int D, int C, int L>
struct ElementSteps {
  using Pack = taylor::Lanes<L>;
  static constexpr int I = D * C;
  static constexpr bool mappable = C == 2 || C == 3;

  static ATRAPOS_FORCEINLINE std::size_t number(const ElementView& e, int b, int q) {
    return static_cast<std::size_t>(b) * e.Q + q;
  }
  static ATRAPOS_FORCEINLINE const int* dofsOf(const ElementView& e, int b, int lane) {
    return e.dofs + (static_cast<std::size_t>(b) * kLanes + lane) * e.N;
  }

  /// Entry i = node C + component of the shape functions of a point, as kept.
  struct Shared {
    const double* s;
    ATRAPOS_FORCEINLINE Pack operator()(int i) const { return Pack(s[i]); }
  };
  struct Own {
    const double* s;
    ATRAPOS_FORCEINLINE Pack operator()(int i) const { return Pack::load(s + i * kLanes); }
  };
  static ATRAPOS_FORCEINLINE Shared sharedAt(const ElementView& e, int q) {
    return {e.shape + static_cast<std::size_t>(q) * e.N * C};
  }
  static ATRAPOS_FORCEINLINE Own ownAt(const ElementView& e, int b, int q, int s) {
    return {e.shape + number(e, b, q) * e.N * C * kLanes + s};
  }
  static ATRAPOS_FORCEINLINE Own mapAt(const ElementView& e, int b, int q, int s) {
    return {e.map + number(e, b, q) * C * C * kLanes + s};
  }

  static void inputs(const ElementView& e, int b, const double* u, int stride, double* in) {
    const int lanes = e.lanesIn(b);
    for (int s = 0; s < lanes; s += L) {
      Pack local[D * kMaxNodes];
      for (int lane = 0; lane < L; ++lane) {
        const int* dof = dofsOf(e, b, s + lane);
        for (int n = 0; n < e.N; ++n)
          for (int i = 0; i < D; ++i) local[D * n + i][lane] = u[dof[n] + i];
      }
      for (int q = 0; q < e.Q; ++q) {
        Pack h[I];
        if (e.shared)
          interpolate(e, sharedAt(e, q), local, h);
        else
          interpolate(e, ownAt(e, b, q, s), local, h);
        if constexpr (mappable)
          if (e.mapped) {
            const Own J = mapAt(e, b, q, s);
            for (int i = 0; i < D; ++i) {
              Pack along[C];
              for (int d = 0; d < C; ++d) along[d] = h[C * i + d];
              for (int c = 0; c < C; ++c) {
                Pack sum = along[0] * J(c);
                ATRAPOS_UNROLL
                for (int d = 1; d < C; ++d) sum += along[d] * J(C * d + c);
                h[C * i + c] = sum;
              }
            }
          }
        double* to = in + static_cast<std::size_t>(q) * stride * kLanes + s;
        ATRAPOS_UNROLL
        for (int m = 0; m < I; ++m) h[m].store(to + m * kLanes);
      }
    }
  }

  template <class Shape>
  static ATRAPOS_FORCEINLINE void interpolate(const ElementView& e, const Shape& shape, const Pack* local,
                                              Pack* in) {
    ATRAPOS_UNROLL
    for (int m = 0; m < I; ++m) in[m] = Pack(0.0);
    for (int n = 0; n < e.N; ++n) {
      ATRAPOS_UNROLL
      for (int i = 0; i < D; ++i) {
        ATRAPOS_UNROLL
        for (int c = 0; c < C; ++c) in[i * C + c] += local[D * n + i] * shape(n * C + c);
      }
    }
  }

  static void forces(const ElementView& e, int b, const double* out, int stride, bool weighted,
                     double* force) {
    const int lanes = e.lanesIn(b);
    for (int s = 0; s < lanes; s += L) {
      Pack sums[D * kMaxNodes];
      for (int n = 0; n < D * e.N; ++n) sums[n] = Pack::load(force + n * kLanes + s);
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
        if constexpr (mappable)
          if (e.mapped) {
            const Own J = mapAt(e, b, q, s);
            Pack along[I];
            for (int i = 0; i < D; ++i)
              for (int d = 0; d < C; ++d) {
                Pack sum = J(C * d) * f[C * i];
                ATRAPOS_UNROLL
                for (int c = 1; c < C; ++c) sum += J(C * d + c) * f[C * i + c];
                along[C * i + d] = sum;
              }
            accumulate(e, sharedAt(e, q), along, sums);
            continue;
          }
        if (e.shared)
          accumulate(e, sharedAt(e, q), f, sums);
        else
          accumulate(e, ownAt(e, b, q, s), f, sums);
      }
      for (int n = 0; n < D * e.N; ++n) sums[n].store(force + n * kLanes + s);
    }
  }

  template <class Shape>
  static ATRAPOS_FORCEINLINE void accumulate(const ElementView& e, const Shape& shape, const Pack* out,
                                             Pack* force) {
    for (int n = 0; n < e.N; ++n) {
      ATRAPOS_UNROLL
      for (int i = 0; i < D; ++i) {
        Pack sum = force[D * n + i];
        ATRAPOS_UNROLL
        for (int c = 0; c < C; ++c) sum += out[i * C + c] * shape(n * C + c);
        force[D * n + i] = sum;
      }
    }
  }

  static void scatter(const ElementView& e, int b, const double* force, double* f) {
    const int lanes = e.lanesIn(b);
    for (int lane = 0; lane < lanes; ++lane) {
      const int* dof = dofsOf(e, b, lane);
      for (int n = 0; n < e.N; ++n)
        for (int i = 0; i < D; ++i) f[dof[n] + i] += force[(D * n + i) * kLanes + lane];
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
      if (mappable && e.mapped)
        for (int q = 0; q < e.Q; ++q) toReference(mapAt(e, b, q, s), moduli + q * I * I * kLanes + s);
      Pack column[kMaxPoints * I * D];  // moduli times the shape of node nb: [q][input][j]
      for (int nb = 0; nb < e.N; ++nb) {
        for (int q = 0; q < e.Q; ++q)
          if (e.shared)
            columnOf(sharedAt(e, q), nb, moduli + q * I * I * kLanes + s, column + q * I * D);
          else
            columnOf(ownAt(e, b, q, s), nb, moduli + q * I * I * kLanes + s, column + q * I * D);
        const int end = symmetric ? nb + 1 : e.N;
        for (int na = 0; na < end; na += 2) {
          const int both = na + 1 < end ? 2 : 1;
          Pack block[2 * D * D];
          for (int k = 0; k < both; ++k) begin(correction, na + k, nb, s, block + D * D * k);
          if (both == 2)
            multiply<2>(e, b, s, na, column, block);
          else
            multiply<1>(e, b, s, na, column, block);
          for (int k = 0; k < both; ++k)
            for (int lane = 0; lane < count; ++lane)
              addBlock(e, b, s + lane, na + k, nb, block + D * D * k, lane, symmetric, sink);
        }
      }
    }
  }

  /// Moduli by gradients with respect to the reference coordinates.
  static void toReference(const Own& J, double* moduli) {
    if constexpr (mappable) {
      for (int m = 0; m < I; ++m)
        for (int j = 0; j < D; ++j) turn(J, moduli + (m * I + C * j) * kLanes, 1);
      for (int i = 0; i < D; ++i)
        for (int n = 0; n < I; ++n) turn(J, moduli + (C * i * I + n) * kLanes, I);
    }
  }
  /// a_d = sum_c J_dc a_c of C entries `stride` apart.
  static ATRAPOS_FORCEINLINE void turn(const Own& J, double* a, int stride) {
    Pack x[C];
    ATRAPOS_UNROLL
    for (int c = 0; c < C; ++c) x[c] = Pack::load(a + c * stride * kLanes);
    ATRAPOS_UNROLL
    for (int d = 0; d < C; ++d) {
      Pack sum = J(C * d) * x[0];
      ATRAPOS_UNROLL
      for (int c = 1; c < C; ++c) sum += J(C * d + c) * x[c];
      sum.store(a + d * stride * kLanes);
    }
  }

  template <class Shape>
  static ATRAPOS_FORCEINLINE void columnOf(const Shape& shape, int nb, const double* moduli, Pack* column) {
    for (int m = 0; m < I; ++m) {
      ATRAPOS_UNROLL
      for (int j = 0; j < D; ++j) {
        Pack sum(0.0);
        ATRAPOS_UNROLL
        for (int c = 0; c < C; ++c)
          sum += Pack::load(moduli + (m * I + j * C + c) * kLanes) * shape(nb * C + c);
        column[m * D + j] = sum;
      }
    }
  }

  static ATRAPOS_FORCEINLINE void begin(const BlockCorrection& correction, int na, int nb, int s,
                                        Pack* block) {
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) {
        const double* left = correction.left + (D * na + i) * correction.rank * kLanes + s;
        const double* right = correction.right + (D * nb + j) * correction.rank * kLanes + s;
        Pack sum(0.0);
        for (int k = 0; k < correction.rank; ++k)
          sum += Pack::load(left + k * kLanes) * Pack::load(right + k * kLanes);
        block[D * i + j] = sum;
      }
  }

  /// block += B_na^T column of `count` nodes from na on: with two of them each column is read once for both,
  /// and their sums stay in registers.
  template <int count>
  static ATRAPOS_FORCEINLINE void multiply(const ElementView& e, int b, int s, int na, const Pack* column,
                                           Pack* block) {
    for (int i = 0; i < D; ++i) {
      Pack sums[count * D];
      ATRAPOS_UNROLL
      for (int k = 0; k < count * D; ++k) sums[k] = Pack(0.0);
      for (int q = 0; q < e.Q; ++q) {
        const Pack* of = column + (q * I + i * C) * D;
        if (e.shared)
          multiplyWith<count>(sharedAt(e, q), na, of, sums);
        else
          multiplyWith<count>(ownAt(e, b, q, s), na, of, sums);
      }
      ATRAPOS_UNROLL
      for (int k = 0; k < count; ++k) {
        ATRAPOS_UNROLL
        for (int j = 0; j < D; ++j) block[D * D * k + D * i + j] += sums[D * k + j];
      }
    }
  }
  template <int count, class Shape>
  static ATRAPOS_FORCEINLINE void multiplyWith(const Shape& s, int na, const Pack* of, Pack* sums) {
    ATRAPOS_UNROLL
    for (int c = 0; c < C; ++c) {
      ATRAPOS_UNROLL
      for (int k = 0; k < count; ++k) {
        const Pack shape = s((na + k) * C + c);
        ATRAPOS_UNROLL
        for (int j = 0; j < D; ++j) sums[D * k + j] += shape * of[D * c + j];
      }
    }
  }

  static ATRAPOS_FORCEINLINE void addBlock(const ElementView& e, int b, int lane, int na, int nb,
                                           const Pack* block, int of, bool symmetric, const BlockSink& sink) {
    const std::size_t entity = static_cast<std::size_t>(b) * kLanes + lane;
    const int* dof = dofsOf(e, b, lane);
    const auto add = [&](int row, int column, int alongRow, int alongColumn) {
      const int position = e.positions[(entity * e.P + row) * e.P + column];
      for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j)
          sink.values[sink.rowStart[dof[row] + i] + position + j] +=
              block[alongRow * i + alongColumn * j][of];
    };
    add(na, nb, D, 1);
    if (symmetric && na != nb) add(nb, na, 1, D);
  }
};

template <int D, int C, int L>
ElementKernels ElementKernelsOf<D, C, L>::table() {
  using Steps = ElementSteps<D, C, L>;
  return {Steps::inputs, Steps::forces, Steps::scatter, Steps::moduli, Steps::blocks};
}
#endif

}  // namespace detail
}  // namespace atrapos::fem
