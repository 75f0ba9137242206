#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "atrapos/fem/Batches.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/Term.hpp"
#include "atrapos/taylor/Lanes.hpp"

namespace atrapos::fem {

/// Entities of a batch, one to a SIMD lane.
constexpr int kLanes = taylor::nativeLanes;
/// Bounds of the element loops' stack arrays.
constexpr int kMaxNodes = 27;
constexpr int kMaxPoints = 64;

/// A view on the device with these numbers.
template <class T>
View<T*> upload(const std::string& name, const std::vector<T>& host) {
  View<T*> view(name, host.size());
  auto mirror = Kokkos::create_mirror_view(view);
  std::copy(host.begin(), host.end(), mirror.data());
  Kokkos::deep_copy(view, mirror);
  return view;
}

/// What the element loops of a term read of its entities, whatever the law: nodes, weights, shape functions,
/// and the steps made of them: gather, B, B^T, scatter, a batch of entities at a time. Copied by value into
/// the kernels.
///
/// C: components of a shape function at a point (3: gradient, 1: value). B u has I = 3 C entries at a point.
///
/// Shape functions that all entities share are kept once, and gradients as those by reference coordinates,
/// which are shared, with a 3 x 3 map at each point: a loop reads 9 numbers at a point of a HEX20 then
/// instead of 60. Only where neither holds has each entity its own.
/// Width is a parameter so that parts compiled for different instruction sets are different classes.
template <int C, int Width = kLanes>
struct ShapeArrays {
  static constexpr int L = Width, I = 3 * C;
  using Pack = taylor::Lanes<L>;

  int numEntities, N, Q;
  bool shared = false, mapped = false;
  View<int*> nodes;      // [batch][lane][node]
  View<int*> positions;  // [batch][lane][node a][node b]
  View<double*> shape;   // shared: [q][node][component]; own: [batch][q][node][component][lane]
  View<double*> map;     // mapped: [batch][q][d][i][lane] dxi_d/dX_i, shape has dN/dxi_d
  View<double*> weight;  // [batch][q][lane]

  KOKKOS_INLINE_FUNCTION int lanesIn(int b) const {
    const int left = numEntities - b * L;
    return left < L ? left : L;
  }
  /// Of point q of all lanes of a batch.
  KOKKOS_INLINE_FUNCTION std::size_t number(int b, int q) const {
    return static_cast<std::size_t>(b) * Q + q;
  }
  KOKKOS_INLINE_FUNCTION const int* nodesOf(int b, int lane) const { return &nodes((b * L + lane) * N); }
  KOKKOS_INLINE_FUNCTION Pack weightAt(int b, int q) const { return Pack::load(&weight(number(b, q) * L)); }

  /// Entry i = node C + component of the shape functions of a point, as kept.
  struct Shared {
    const double* s;
    KOKKOS_INLINE_FUNCTION Pack operator()(int i) const { return Pack(s[i]); }
  };
  struct Own {
    const double* s;
    KOKKOS_INLINE_FUNCTION Pack operator()(int i) const { return Pack::load(s + i * L); }
  };
  KOKKOS_INLINE_FUNCTION Shared sharedAt(int q) const { return {&shape(q * N * C)}; }
  KOKKOS_INLINE_FUNCTION Own ownAt(int b, int q) const { return {&shape(number(b, q) * N * C * L)}; }
  /// The value of node n's shape function at point q (C = 1).
  KOKKOS_INLINE_FUNCTION Pack valueAt(int b, int q, int n) const {
    static_assert(C == 1);
    return shared ? sharedAt(q)(n) : ownAt(b, q)(n);
  }

  KOKKOS_INLINE_FUNCTION void gather(int b, const ConstField& u, Pack* local) const {
    for (int lane = 0; lane < L; ++lane) {
      const int* node = nodesOf(b, lane);
      for (int n = 0; n < N; ++n)
        for (int i = 0; i < 3; ++i) local[3 * n + i][lane] = u(3 * node[n] + i);
    }
  }

  KOKKOS_INLINE_FUNCTION static void lanesOf(const Pack* in, int count, int lane, double* one) {
    for (int m = 0; m < count; ++m) one[m] = in[m][lane];
  }

  /// in = B u at point q.
  KOKKOS_INLINE_FUNCTION void interpolate(int b, int q, const Pack* local, Pack* in) const {
    if (shared)
      interpolateWith(sharedAt(q), local, in);
    else
      interpolateWith(ownAt(b, q), local, in);
    if constexpr (C == 3)
      if (mapped) {
        const Own J{&map(number(b, q) * 9 * L)};
        for (int i = 0; i < 3; ++i) {
          const Pack along[3] = {in[3 * i], in[3 * i + 1], in[3 * i + 2]};
          for (int c = 0; c < 3; ++c)
            in[3 * i + c] = along[0] * J(c) + along[1] * J(3 + c) + along[2] * J(6 + c);
        }
      }
  }

  /// force += weight B^T out.
  KOKKOS_INLINE_FUNCTION void accumulate(int b, int q, const Pack* out, Pack* force) const {
    const Pack w = weightAt(b, q);
    Pack scaled[I];
    for (int m = 0; m < I; ++m) scaled[m] = w * out[m];
    accumulateWeighted(b, q, scaled, force);
  }

  /// force += B^T out
  KOKKOS_INLINE_FUNCTION void accumulateWeighted(int b, int q, const Pack* out, Pack* force) const {
    if constexpr (C == 3)
      if (mapped) {
        const Own J{&map(number(b, q) * 9 * L)};
        Pack along[I];
        for (int i = 0; i < 3; ++i)
          for (int d = 0; d < 3; ++d)
            along[3 * i + d] =
                J(3 * d) * out[3 * i] + J(3 * d + 1) * out[3 * i + 1] + J(3 * d + 2) * out[3 * i + 2];
        return accumulateWith(sharedAt(q), along, force);
      }
    if (shared)
      accumulateWith(sharedAt(q), out, force);
    else
      accumulateWith(ownAt(b, q), out, force);
  }

  KOKKOS_INLINE_FUNCTION void scatter(int b, const Pack* force, const Field& f) const {
    const int count = lanesIn(b);
    for (int lane = 0; lane < count; ++lane) {
      const int* node = nodesOf(b, lane);
      for (int n = 0; n < N; ++n)
        for (int i = 0; i < 3; ++i) f(3 * node[n] + i) += force[3 * n + i][lane];
    }
  }

  /// Sum of squares of a batch's nodal forces; padding lanes have weight, hence force, zero.
  KOKKOS_INLINE_FUNCTION double squares(const Pack* force) const {
    double sum = 0;
    for (int n = 0; n < 3 * N; ++n)
      for (int lane = 0; lane < L; ++lane) sum += force[n][lane] * force[n][lane];
    return sum;
  }

  /// K += B^T moduli B + correction. `moduli` are those of the law times the point's weight, [q][out][in],
  /// and are lost; correction(na, nb, block) sets what else belongs to the 3 x 3 block of two nodes. Of a
  /// symmetric K one triangle is worked out.
  template <class Correction>
  KOKKOS_INLINE_FUNCTION void addBlocks(int b, Pack* moduli, bool symmetric, const Correction& correction,
                                        const TangentSink& sink) const {
    Pack column[kMaxPoints * I * 3];  // moduli times the shape of node nb: [q][input][j]
    if (mapped) toReference(b, moduli);
    for (int nb = 0; nb < N; ++nb) {
      columnOf(b, nb, moduli, column);
      const int end = symmetric ? nb + 1 : N;
      for (int na = 0; na < end; na += 2) {
        const int count = na + 1 < end ? 2 : 1;
        Pack blocks[2 * 9];
        for (int k = 0; k < count; ++k) correction(na + k, nb, blocks + 9 * k);
        if (count == 2)
          multiply<2>(b, na, column, blocks);
        else
          multiply<1>(b, na, column, blocks);
        for (int k = 0; k < count; ++k) scatterBlock(b, na + k, nb, blocks + 9 * k, symmetric, sink);
      }
    }
  }

  /// Host set-up from the points and the batches of L entities.
  void fillShapes(const PointSet& p, const Batches& grouped) {
    if (p.shapeComponents != C)
      throw std::logic_error("ShapeArrays: the points' shape components do not fit the operator");
    if (p.nodesPerEntity > kMaxNodes || p.pointsPerEntity > kMaxPoints)
      throw std::invalid_argument(
          "an element or face has more than 27 nodes or 64 points: lower the cubature degree");
    numEntities = p.numEntities;
    N = p.nodesPerEntity;
    Q = p.pointsPerEntity;
    mapped = !p.maps.empty();
    const std::size_t batches = grouped.count, size = static_cast<std::size_t>(Q) * N * C;
    if (p.shape.size() != (mapped ? size : numEntities * size) ||
        p.maps.size() != (mapped ? static_cast<std::size_t>(p.numPoints()) * 9 : 0))
      throw std::logic_error("ShapeArrays: wrong number of shape functions or maps");
    shared = mapped || (numEntities > 0 && allEqual(p.shape, size));
    nodes = upload("nodes", padded(p.nodes, N, batches));
    weight = upload("weight", withoutPadding(packed(p.weights, Q, batches)));
    shape = upload("shape", shared ? std::vector<double>(p.shape.begin(), p.shape.begin() + size)
                                   : packed(p.shape, size, batches));
    if (mapped) map = upload("map", packed(p.maps, static_cast<std::size_t>(Q) * 9, batches));
  }

  /// The arrays of some of the entities alone: [entity of the part] -> number so far, and their nodes.
  void keepShapes(const TermPart& part, const Batches& grouped) {
    const std::size_t Q9 = static_cast<std::size_t>(Q) * 9;
    auto w = kept(weight, Q, part, grouped.count);
    if (!shared)
      shape = upload("shape", kept(shape, static_cast<std::size_t>(Q) * N * C, part, grouped.count));
    if (mapped) map = upload("map", kept(map, Q9, part, grouped.count));
    numEntities = static_cast<int>(part.entities.size());
    weight = upload("weight", withoutPadding(std::move(w)));
    nodes = upload("nodes", padded(part.nodes, N, grouped.count));
  }

  void setPositions(const std::vector<int>& of, int numBatches) {
    std::vector<int> all(static_cast<std::size_t>(numBatches) * L * N * N, 0);
    std::copy_n(of.begin(), static_cast<std::size_t>(numEntities) * N * N, all.begin());
    positions = upload("positions", all);
  }

  /// [entity][m] -> [batch][m][lane], m < count; lanes beyond the last entity copy it.
  std::vector<double> packed(const std::vector<double>& from, std::size_t count, std::size_t batches) const {
    std::vector<double> to(batches * count * L);
    pack(from, count, batches, to.data());
    return to;
  }
  void pack(const std::vector<double>& from, std::size_t count, std::size_t batches, double* to) const {
    for (std::size_t i = 0; i < batches * L; ++i) {
      const double* own = &from[std::min<std::size_t>(i, numEntities - 1) * count];
      for (std::size_t m = 0; m < count; ++m) to[(i / L * count + m) * L + i % L] = own[m];
    }
  }

  /// [batch][m][lane] of some of the entities.
  static std::vector<double> kept(const View<double*>& from, std::size_t count, const TermPart& part,
                                  std::size_t batches) {
    const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), from);
    std::vector<double> to(batches * count * L);
    for (std::size_t i = 0; i < batches * L; ++i) {
      const std::size_t e = part.entities[std::min(i, part.entities.size() - 1)];
      for (std::size_t m = 0; m < count; ++m)
        to[(i / L * count + m) * L + i % L] = host((e / L * count + m) * L + e % L);
    }
    return to;
  }

 private:
  template <class Shape>
  KOKKOS_INLINE_FUNCTION void interpolateWith(const Shape& s, const Pack* local, Pack* in) const {
    for (int m = 0; m < I; ++m) in[m] = Pack(0.0);
    for (int n = 0; n < N; ++n)
      for (int i = 0; i < 3; ++i)
        for (int c = 0; c < C; ++c) in[i * C + c] += local[3 * n + i] * s(n * C + c);
  }

  template <class Shape>
  KOKKOS_INLINE_FUNCTION void accumulateWith(const Shape& s, const Pack* out, Pack* force) const {
    for (int n = 0; n < N; ++n)
      for (int i = 0; i < 3; ++i)
        for (int c = 0; c < C; ++c) force[3 * n + i] += out[i * C + c] * s(n * C + c);
  }

  /// Moduli by gradients with respect to the reference coordinates.
  KOKKOS_FUNCTION void toReference(int b, Pack* moduli) const {
    if constexpr (C == 3)
      for (int q = 0; q < Q; ++q) {
        const Own J{&map(number(b, q) * 9 * L)};
        Pack* A = moduli + q * I * I;
        for (int m = 0; m < I; ++m)
          for (int j = 0; j < 3; ++j) turn(J, A + m * I + 3 * j, 1);
        for (int i = 0; i < 3; ++i)
          for (int n = 0; n < I; ++n) turn(J, A + 3 * i * I + n, I);
      }
  }
  /// a_d = sum_c J_dc a_c of three entries `stride` apart.
  KOKKOS_INLINE_FUNCTION static void turn(const Own& J, Pack* a, int stride) {
    const Pack x = a[0], y = a[stride], z = a[2 * stride];
    for (int d = 0; d < 3; ++d) a[d * stride] = J(3 * d) * x + J(3 * d + 1) * y + J(3 * d + 2) * z;
  }

  KOKKOS_FUNCTION void columnOf(int b, int nb, const Pack* moduli, Pack* column) const {
    for (int q = 0; q < Q; ++q)
      if (shared)
        columnWith(sharedAt(q), nb, moduli + q * I * I, column + q * I * 3);
      else
        columnWith(ownAt(b, q), nb, moduli + q * I * I, column + q * I * 3);
  }
  template <class Shape>
  KOKKOS_INLINE_FUNCTION static void columnWith(const Shape& s, int nb, const Pack* moduli, Pack* column) {
    for (int m = 0; m < I; ++m)
      for (int j = 0; j < 3; ++j) {
        Pack sum(0.0);
        for (int c = 0; c < C; ++c) sum += moduli[m * I + j * C + c] * s(nb * C + c);
        column[m * 3 + j] = sum;
      }
  }

  /// blocks += B_na^T column of `count` nodes from na on: with two of them each column is read once for both,
  /// and their sums stay in registers.
  template <int count>
  KOKKOS_FUNCTION void multiply(int b, int na, const Pack* column, Pack* blocks) const {
    for (int i = 0; i < 3; ++i) {
      Pack sums[count * 3];
      ATRAPOS_UNROLL
      for (int k = 0; k < count * 3; ++k) sums[k] = Pack(0.0);
      for (int q = 0; q < Q; ++q) {
        const Pack* of = column + (q * I + i * C) * 3;
        if (shared)
          multiplyWith<count>(sharedAt(q), na, of, sums);
        else
          multiplyWith<count>(ownAt(b, q), na, of, sums);
      }
      for (int k = 0; k < count; ++k)
        for (int j = 0; j < 3; ++j) blocks[9 * k + 3 * i + j] += sums[3 * k + j];
    }
  }
  template <int count, class Shape>
  KOKKOS_FORCEINLINE_FUNCTION static void multiplyWith(const Shape& s, int na, const Pack* of, Pack* sums) {
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

  KOKKOS_FUNCTION void scatterBlock(int b, int na, int nb, const Pack* block, bool symmetric,
                                    const TangentSink& sink) const {
    const int count = lanesIn(b);
    for (int lane = 0; lane < count; ++lane) {
      const std::size_t entity = static_cast<std::size_t>(b) * L + lane;
      const int* node = nodesOf(b, lane);
      const auto add = [&](int row, int column, int alongRow, int alongColumn) {
        const int position = positions((entity * N + row) * N + column);
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            sink.values(sink.rowStart(3 * node[row] + i) + position + j) +=
                block[alongRow * i + alongColumn * j][lane];
      };
      add(na, nb, 3, 1);
      if (symmetric && na != nb) add(nb, na, 1, 3);
    }
  }

  static bool allEqual(const std::vector<double>& items, std::size_t size) {
    for (std::size_t i = size; i < items.size(); i += size)
      if (!std::equal(items.begin(), items.begin() + size, items.begin() + i)) return false;
    return true;
  }
  /// [entity][node]; entities that fill up the last batch copy the last one.
  std::vector<int> padded(const std::vector<int>& of, int count, std::size_t batches) const {
    std::vector<int> to(batches * L * count);
    for (std::size_t i = 0; i < batches * L; ++i)
      std::copy_n(&of[std::min<std::size_t>(i, numEntities - 1) * count], count, &to[i * count]);
    return to;
  }
  /// Copies that fill up the last batch weigh nothing.
  std::vector<double> withoutPadding(std::vector<double> weights) const {
    for (std::size_t i = numEntities; i * Q < weights.size(); ++i)
      for (int q = 0; q < Q; ++q) weights[(i / L * Q + q) * L + i % L] = 0;
    return weights;
  }
};

}  // namespace atrapos::fem
