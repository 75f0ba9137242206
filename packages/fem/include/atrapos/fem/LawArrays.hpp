#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "atrapos/fem/PointMemory.hpp"
#include "atrapos/fem/ShapeArrays.hpp"
#include "atrapos/taylor/Law.hpp"

namespace atrapos::fem {

/// A point where a law has no Taylor series.
struct LawFailure {
  int entity = -1, point = 0;
  taylor::Operation operation = taylor::Operation::None;
  double value = 0;
};

/// What the element loops of a term read: entities and shape functions, the law, its data and histories.
/// Copied by value into the kernels.
///
/// B u has I = 3 C entries at a point: the first inputs of the law, and the work conjugates of its first
/// outputs.
template <class Law, int C, int Width = kLanes>
struct LawArrays : ShapeArrays<C, Width> {
  using Shapes = ShapeArrays<C, Width>;
  using Shapes::I, Shapes::L, Shapes::lanesIn, Shapes::lanesOf, Shapes::N, Shapes::number,
      Shapes::numEntities, Shapes::Q;
  using typename Shapes::Pack;
  static constexpr int D = Law::numData;

  Law law;
  taylor::HistoryShape histories;
  std::size_t pointDoubles = 0;  // of the histories of L points
  int maxOrder = 0, waiting = 0;
  taylor::OrderBlock block;  // of the order that is swept
  View<double*> offset;      // [batch][q][input][lane], CurrentPosition only: X
  View<double*> data;        // [batch][q][datum][lane]
  View<double*> history;     // [batch][q], then as taylor::Context has it
  View<int*> order;

  KOKKOS_INLINE_FUNCTION const Pack* dataAt(int b, int q) const {
    return D == 0 ? nullptr : reinterpret_cast<const Pack*>(&data(number(b, q) * D * L));
  }
  KOKKOS_INLINE_FUNCTION double* historyAt(int b, int q) const {
    return &history(number(b, q) * pointDoubles);
  }

  /// Adds the constant part of the inputs (order 0 only).
  KOKKOS_INLINE_FUNCTION void addOffset(int b, int q, Pack* in) const {
    if (C != 1) return;
    const double* x = &offset(number(b, q) * I * L);
    for (int m = 0; m < I; ++m) in[m] += Pack::load(x + m * L);
  }

  /// For values and tangents.
  PointMemory pointMemory() const { return PointMemory(histories.template doubles<L>(0)); }

  /// The law's values at point q.
  KOKKOS_INLINE_FUNCTION void evaluate(int b, int q, double* memory, const Pack* in, Pack* out) const {
    auto order0 = ofOrder0(memory);
    taylor::start(law, order0, in, dataAt(b, q), out);
  }

  /// The same and its derivatives, jacobian[output * Law::numInputs + input].
  KOKKOS_INLINE_FUNCTION void tangent(int b, int q, double* memory, const Pack* in, Pack* out,
                                      Pack* jacobian) const {
    taylor::tangent(law, ofOrder0(memory), in, dataAt(b, q), out, jacobian);
  }

  KOKKOS_INLINE_FUNCTION taylor::Context<L> ofOrder0(double* memory) const {
    taylor::Context<L> c;
    c.memory = memory;
    c.shape = histories;
    c.plain = true;
    return c;
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

  /// Host set-up from the points, `pointData` [entity][point][datum] and the batches of L entities.
  void fill(const Law& theLaw, const PointSet& p, const std::vector<double>& pointData,
            const Batches& grouped) {
    if (pointData.size() != static_cast<std::size_t>(p.numPoints()) * D)
      throw std::logic_error("LawArrays: wrong number of data");
    this->fillShapes(p, grouped);
    law = theLaw;
    histories = taylor::historyShape(law);
    if constexpr (C == 1) offset = upload("offset", this->packed(p.positions, Q * I, grouped.count));
    data = upload("data", this->packed(pointData, Q * D, grouped.count));
    order = upload("order", grouped.order);
  }

  /// The arrays of some of the entities alone: [entity of the part] -> number so far, and their nodes.
  void keep(const TermPart& part, const Batches& grouped) {
    if constexpr (C == 1) offset = upload("offset", this->kept(offset, Q * I, part, grouped.count));
    data = upload("data", this->kept(data, Q * D, part, grouped.count));
    this->keepShapes(part, grouped);
    order = upload("order", grouped.order);
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
