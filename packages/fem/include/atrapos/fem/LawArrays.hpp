#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "atrapos/fem/Batches.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/Term.hpp"
#include "atrapos/taylor/Law.hpp"

namespace atrapos::fem {

/// Lanes of a batch: one AVX-512 register of doubles, two of AVX2.
constexpr int kLanes = 8;
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

/// A point where a law has no Taylor series.
struct LawFailure {
  int entity = -1, point = 0;
  taylor::Operation operation = taylor::Operation::None;
  double value = 0;
};

/// What the element loops of a term read, and the steps that all of them share: gather, B, B^T, scatter,
/// eight entities at a time. Copied by value into the kernels.
///
/// C: components of a shape function at a point (3: gradient, 1: value). B u has I = 3 C entries at a point:
/// the first inputs of the law, and the work conjugates of its first outputs.
template <class Law, int C>
struct LawArrays {
  static constexpr int L = kLanes, I = 3 * C, D = Law::numData;
  using Pack = taylor::Lanes<L>;

  Law law;
  int numEntities, N, Q;
  taylor::HistoryShape histories;
  std::size_t pointDoubles = 0;  // of the histories of L points
  int maxOrder = 0, waiting = 0;
  taylor::OrderBlock block;  // of the order that is swept
  View<int*> nodes;          // [batch][lane][node]
  View<int*> positions;      // [batch][lane][node a][node b]
  View<double*> shape;       // [batch][q][node][component][lane]
  View<double*> weight;      // [batch][q][lane]
  View<double*> offset;      // [batch][q][input][lane], CurrentPosition only: X
  View<double*> data;        // [batch][q][datum][lane]
  View<double*> history;     // [batch][q], then as taylor::Context has it
  View<int*> order;

  KOKKOS_INLINE_FUNCTION int lanesIn(int b) const {
    const int left = numEntities - b * L;
    return left < L ? left : L;
  }
  KOKKOS_INLINE_FUNCTION const int* nodesOf(int b, int lane) const { return &nodes((b * L + lane) * N); }
  KOKKOS_INLINE_FUNCTION const double* shapeAt(int b, int q) const {
    return &shape((static_cast<std::size_t>(b) * Q + q) * N * C * L);
  }
  KOKKOS_INLINE_FUNCTION Pack weightAt(int b, int q) const {
    return Pack::load(&weight((static_cast<std::size_t>(b) * Q + q) * L));
  }
  KOKKOS_INLINE_FUNCTION const Pack* dataAt(int b, int q) const {
    return D == 0 ? nullptr
                  : reinterpret_cast<const Pack*>(&data((static_cast<std::size_t>(b) * Q + q) * D * L));
  }
  KOKKOS_INLINE_FUNCTION double* historyAt(int b, int q) const {
    return &history((static_cast<std::size_t>(b) * Q + q) * pointDoubles);
  }

  KOKKOS_INLINE_FUNCTION void gather(int b, const ConstField& u, Pack* local) const {
    for (int lane = 0; lane < L; ++lane) {
      const int* node = nodesOf(b, lane);
      for (int n = 0; n < N; ++n)
        for (int i = 0; i < 3; ++i) local[3 * n + i][lane] = u(3 * node[n] + i);
    }
  }

  /// in = B u at point q.
  KOKKOS_INLINE_FUNCTION void interpolate(int b, int q, const Pack* local, Pack* in) const {
    const double* s = shapeAt(b, q);
    for (int m = 0; m < I; ++m) in[m] = Pack(0.0);
    for (int n = 0; n < N; ++n)
      for (int i = 0; i < 3; ++i)
        for (int c = 0; c < C; ++c) in[i * C + c] += local[3 * n + i] * Pack::load(s + (n * C + c) * L);
  }

  /// Adds the constant part of the inputs (order 0 only).
  KOKKOS_INLINE_FUNCTION void addOffset(int b, int q, Pack* in) const {
    if (C != 1) return;
    const double* x = &offset((static_cast<std::size_t>(b) * Q + q) * I * L);
    for (int m = 0; m < I; ++m) in[m] += Pack::load(x + m * L);
  }

  /// force += weight B^T out.
  KOKKOS_INLINE_FUNCTION void accumulate(int b, int q, const Pack* out, Pack* force) const {
    const double* s = shapeAt(b, q);
    const Pack w = weightAt(b, q);
    Pack scaled[I];
    for (int m = 0; m < I; ++m) scaled[m] = w * out[m];
    for (int n = 0; n < N; ++n)
      for (int i = 0; i < 3; ++i)
        for (int c = 0; c < C; ++c) force[3 * n + i] += scaled[i * C + c] * Pack::load(s + (n * C + c) * L);
  }

  KOKKOS_INLINE_FUNCTION void scatter(int b, const Pack* force, const Field& f) const {
    const int count = lanesIn(b);
    for (int lane = 0; lane < count; ++lane) {
      const int* node = nodesOf(b, lane);
      for (int n = 0; n < N; ++n)
        for (int i = 0; i < 3; ++i) f(3 * node[n] + i) += force[3 * n + i][lane];
    }
  }

  KOKKOS_INLINE_FUNCTION void lanesOf(const Pack* in, int count, int lane, double* one) const {
    for (int m = 0; m < count; ++m) one[m] = in[m][lane];
  }

  /// The law's values at point q, lane by lane.
  KOKKOS_INLINE_FUNCTION void evaluate(int b, int q, const Pack* in, Pack* out) const {
    for (int lane = 0; lane < L; ++lane) {
      double one[Law::numInputs], datum[D + 1], result[Law::numOutputs];
      lanesOf(in, Law::numInputs, lane, one);
      lanesOf(dataAt(b, q), D, lane, datum);
      taylor::value(law, one, datum, result);
      for (int m = 0; m < Law::numOutputs; ++m) out[m][lane] = result[m];
    }
  }

  /// Sum of squares of a batch's nodal forces; padding lanes have weight, hence force, zero.
  KOKKOS_INLINE_FUNCTION double squares(const Pack* force) const {
    double sum = 0;
    for (int n = 0; n < 3 * N; ++n)
      for (int lane = 0; lane < L; ++lane) sum += force[n][lane] * force[n][lane];
    return sum;
  }

  /// K += B^T moduli B + correction. `moduli` are those of the law times the point's weight, [q][out][in];
  /// correction(na, nb, block) sets what else belongs to the 3 x 3 block of two nodes.
  template <class Correction>
  KOKKOS_INLINE_FUNCTION void addBlocks(int b, const Pack* moduli, const Correction& correction,
                                        const TangentSink& sink) const {
    const int count = lanesIn(b);
    Pack column[kMaxPoints * I * 3];  // moduli times the shape of node nb: [q][input][j]
    for (int nb = 0; nb < N; ++nb) {
      for (int q = 0; q < Q; ++q) {
        const double* s = shapeAt(b, q) + nb * C * L;
        for (int m = 0; m < I; ++m)
          for (int j = 0; j < 3; ++j) {
            Pack sum(0.0);
            for (int c = 0; c < C; ++c) sum += moduli[(q * I + m) * I + j * C + c] * Pack::load(s + c * L);
            column[(q * I + m) * 3 + j] = sum;
          }
      }
      for (int na = 0; na < N; ++na) {
        Pack block[9];
        correction(na, nb, block);
        for (int q = 0; q < Q; ++q) {
          const double* s = shapeAt(b, q) + na * C * L;
          for (int i = 0; i < 3; ++i)
            for (int c = 0; c < C; ++c)
              for (int j = 0; j < 3; ++j)
                block[3 * i + j] += Pack::load(s + c * L) * column[(q * I + i * C + c) * 3 + j];
        }
        for (int lane = 0; lane < count; ++lane) {
          const int node = nodesOf(b, lane)[na];
          const int position = positions((static_cast<std::size_t>(b * L + lane) * N + na) * N + nb);
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
              sink.values(sink.rowStart(3 * node + i) + position + j) += block[3 * i + j][lane];
        }
      }
    }
  }

  /// Where the series of point q is kept, and the order asked of it.
  KOKKOS_INLINE_FUNCTION taylor::Context<L> context(int b, int q, int k) const {
    taylor::Context<L> c;
    c.memory = historyAt(b, q);
    c.shape = histories;
    c.order = k;
    c.block = block;
    c.waiting = waiting;
    c.ahead = static_cast<std::ptrdiff_t>(pointDoubles);
    return c;
  }

  /// Remembers the first point of a batch where the law has no series: one with NaN in its results.
  KOKKOS_INLINE_FUNCTION void findFailure(int b, int q, const Pack* out, const taylor::Failures<L>& noted,
                                          LawFailure& first) const {
    for (int lane = 0; lane < lanesIn(b) && first.entity < 0; ++lane)
      for (int m = 0; m < Law::numOutputs; ++m)
        if (out[m][lane] != out[m][lane]) {
          const bool named = noted.operation[lane] != taylor::Operation::None;
          first = {b * L + lane, q, named ? noted.operation[lane] : taylor::Operation::Result,
                   noted.value[lane]};
          break;
        }
  }

  /// Host set-up from the points, `data` [entity][point][datum] and the batches of L entities.
  void fill(const Law& theLaw, const PointSet& p, const std::vector<double>& pointData,
            const Batches& grouped) {
    if (p.shapeComponents != C)
      throw std::logic_error("LawArrays: the points' shape components do not fit the operator");
    if (p.nodesPerEntity > kMaxNodes || p.pointsPerEntity > kMaxPoints)
      throw std::invalid_argument(
          "an element or face has more than 27 nodes or 64 points: lower the cubature degree");
    if (pointData.size() != static_cast<std::size_t>(p.numPoints()) * D)
      throw std::logic_error("LawArrays: wrong number of data");
    law = theLaw;
    numEntities = p.numEntities;
    N = p.nodesPerEntity;
    Q = p.pointsPerEntity;
    histories = taylor::historyShape(law);
    const std::size_t batches = grouped.count;
    std::vector<int> n(batches * L * N);
    std::vector<double> s(batches * Q * N * C * L), w(batches * Q * L), x(C == 1 ? batches * Q * I * L : 0),
        d(batches * Q * D * L);
    for (std::size_t b = 0; b < batches; ++b)
      for (int lane = 0; lane < L; ++lane) {
        // The last batch is filled up with copies of the last entity, of no weight and never scattered.
        const std::size_t e = std::min<std::size_t>(b * L + lane, p.numEntities - 1);
        const bool real = b * L + lane < static_cast<std::size_t>(p.numEntities);
        std::copy_n(&p.nodes[e * N], N, &n[(b * L + lane) * N]);
        for (int q = 0; q < Q; ++q) {
          const std::size_t source = e * Q + q, target = b * Q + q;
          w[target * L + lane] = real ? p.weights[source] : 0.0;
          for (int m = 0; m < N * C; ++m) s[(target * N * C + m) * L + lane] = p.shape[source * N * C + m];
          if (C == 1)
            for (int i = 0; i < 3; ++i) x[(target * I + i) * L + lane] = p.positions[source * 3 + i];
        }
      }
    pack(pointData, D, batches, d.data());
    nodes = upload("nodes", n);
    shape = upload("shape", s);
    weight = upload("weight", w);
    offset = upload("offset", x);
    data = upload("data", d);
    order = upload("order", grouped.order);
  }

  /// The arrays of some of the entities alone: [entity of the part] -> number so far, and their nodes.
  void keep(const TermPart& part, const Batches& grouped) {
    const std::size_t batches = grouped.count, count = part.entities.size();
    const auto kept = [&](const View<double*>& from, std::size_t size) {
      const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), from);
      std::vector<double> to(batches * size * L);
      for (std::size_t i = 0; i < batches * L; ++i) {
        const std::size_t e = part.entities[std::min(i, count - 1)];
        for (std::size_t m = 0; m < size; ++m)
          to[(i / L * size + m) * L + i % L] = host((e / L * size + m) * L + e % L);
      }
      return to;
    };
    std::vector<double> w = kept(weight, Q);
    for (std::size_t i = count; i < batches * L; ++i)  // copies that fill up the last batch weigh nothing
      for (int q = 0; q < Q; ++q) w[(i / L * Q + q) * L + i % L] = 0;
    std::vector<int> n(batches * L * N);
    for (std::size_t i = 0; i < batches * L; ++i)
      std::copy_n(&part.nodes[std::min(i, count - 1) * N], N, &n[i * N]);
    shape = upload("shape", kept(shape, static_cast<std::size_t>(Q) * N * C));
    weight = upload("weight", w);
    if (C == 1) offset = upload("offset", kept(offset, static_cast<std::size_t>(Q) * I));
    data = upload("data", kept(data, static_cast<std::size_t>(Q) * D));
    nodes = upload("nodes", n);
    order = upload("order", grouped.order);
    numEntities = static_cast<int>(count);
  }

  /// [entity][point][m] -> [batch][point][m][lane], m < count; lanes beyond the last entity copy it.
  void pack(const std::vector<double>& from, int count, std::size_t batches, double* to) const {
    for (std::size_t b = 0; b < batches; ++b)
      for (int lane = 0; lane < L; ++lane) {
        const std::size_t e = std::min<std::size_t>(b * L + lane, numEntities - 1);
        for (int q = 0; q < Q; ++q)
          for (int m = 0; m < count; ++m)
            to[((b * Q + q) * count + m) * L + lane] = from[(e * Q + q) * count + m];
      }
  }

  void setPositions(const std::vector<int>& of, int numBatches) {
    std::vector<int> padded(static_cast<std::size_t>(numBatches) * L * N * N, 0);
    std::copy_n(of.begin(), static_cast<std::size_t>(numEntities) * N * N, padded.begin());
    positions = upload("positions", padded);
  }

  std::size_t historyDoubles(int numBatches, int ordersTo) const {
    return static_cast<std::size_t>(numBatches) * Q * histories.template doubles<L>(ordersTo);
  }

  /// Histories for series of orders up to `ordersTo`; kept where they are of that size already.
  void reserveHistory(int numBatches, int ordersTo) {
    const std::size_t size = histories.template doubles<L>(ordersTo);
    if (history.size() != 0 && pointDoubles == size) return;
    pointDoubles = size;
    maxOrder = ordersTo;
    waiting = taylor::HistoryShape::waiting(ordersTo);
    history = View<double*>();  // free before the new one is made
    history = View<double*>(Kokkos::view_alloc("history", Kokkos::WithoutInitializing),
                            historyDoubles(numBatches, ordersTo));
  }
};

/// Runs kernel(batch) colour by colour; within a colour chunks of batches in parallel. `order` is that of the
/// chunks, where the kernel runs.
template <class Kernel>
void forEachBatch(const char* name, const Batches& batches, const View<int*>& order, const Kernel& kernel) {
  const int perChunk = batches.perChunk, count = batches.count;
  for (std::size_t c = 0; c + 1 < batches.colourStart.size(); ++c)
    Kokkos::parallel_for(
        name, Kokkos::RangePolicy<Execution>(batches.colourStart[c], batches.colourStart[c + 1]),
        KOKKOS_LAMBDA(int i) {
          const int first = order(i) * perChunk, end = first + perChunk < count ? first + perChunk : count;
          for (int b = first; b < end; ++b) kernel(b);
        });
  Execution().fence();
}

/// Number of an entity, from 0, in the whole term: `kept` are the entities of a part, empty where all are
/// there.
inline int numberInTerm(const std::vector<int>& kept, int entity) {
  return kept.empty() ? entity : kept[entity];
}

/// Throws taylor::DomainError for the first batch that noted a failure.
inline void throwFirst(const View<LawFailure*>& perBatch, const std::vector<int>& kept = {}) {
  auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), perBatch);
  for (std::size_t b = 0; b < host.size(); ++b)
    if (host(b).entity >= 0)
      throw taylor::DomainError(host(b).operation, host(b).value,
                                "entity " + std::to_string(numberInTerm(kept, host(b).entity) + 1) +
                                    ", point " + std::to_string(host(b).point + 1));
}

/// The sum over all batches, in one order for any number of threads.
inline double sumOf(const View<double*>& perBatch) {
  auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), perBatch);
  double sum = 0;
  for (std::size_t b = 0; b < host.size(); ++b) sum += host(b);
  return sum;
}

}  // namespace atrapos::fem
