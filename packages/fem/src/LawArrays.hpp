#pragma once

#include <memory>
#include <vector>

#include "ElementArrays.hpp"
#include "ThreadMemory.hpp"
#include "atrapos/fem/PointLaw.hpp"

namespace atrapos::fem {

/// What the loops of a term share: its entities, the law at their points, its data and histories.
class LawArrays {
 public:
  /// pointData: [entity][point][datum].
  LawArrays(std::unique_ptr<PointLaw> law, const PointSet& points, const std::vector<double>& pointData);

  /// What a thread needs in a loop beside the law's own scratch memory. Once, before any loop.
  void allocateScratch(std::size_t doubles) { memory_ = ThreadMemory(lawDoubles_ + doubles); }

  ElementArrays elements;
  std::unique_ptr<PointLaw> law;
  LawShape shape;

  const double* data() const { return data_.data(); }  ///< [batch][q][datum][lane]
  double datum(int entity, int point, int d) const { return data_[indexOf(entity, point, d)]; }
  void setDatum(int entity, int point, int d, double value);
  /// pointData in that order.
  std::vector<double> packed(const std::vector<double>& pointData) const;
  /// Numbers a batch of `count` entries a point.
  std::size_t perBatch(std::size_t count) const { return elements.numPoints() * count * kLanes; }

  /// Drops all entities but these.
  void keep(const TermPart& part);

  /// A batch for values and tangents; `memory` begins with historyDoubles(0) doubles that are the law's.
  PointBatch batch(int b, const double* data, double* memory) const;
  /// A batch of the series under way.
  PointBatch seriesBatch(int b, const double* data) const;
  /// What is left of a thread's memory when the law has taken its own.
  double* scratchOf(const ThreadMemory::Held& held) const { return held.data() + lawDoubles_; }
  const ThreadMemory& memory() const { return memory_; }

  std::size_t historyBytes(int maxOrder) const;
  /// Histories for series of orders up to `maxOrder`; kept where they are of that size already.
  void reserveHistory(int maxOrder);
  int maxOrder() const { return start_.maxOrder; }

  /// Starts the series at `in` and notes the first failure of each batch.
  void start(int b, const double* data, const double* in, double* out, PointFailure& failure) const {
    law->start(seriesBatch(b, data), start_, in, out, failure);
  }
  /// Throws taylor::DomainError for the first batch that noted a failure.
  void throwFirst(const std::vector<PointFailure>& perBatch) const;

  /// The law's named values, as Term::observe gives them; inputs(batch, thread's memory) are those of a
  /// batch, [q][input][lane], in the thread's own memory.
  template <class Inputs>
  PointValues observe(const double* data, const Inputs& inputs) const;

 private:
  std::size_t indexOf(int entity, int point, int d) const {
    const std::size_t q = static_cast<std::size_t>(entity / kLanes) * elements.numPoints() + point;
    return (q * shape.data + d) * kLanes + entity % kLanes;
  }

  std::vector<double> data_;
  std::size_t lawDoubles_;
  ThreadMemory memory_;
  std::size_t pointDoubles_ = 0;  // of the histories of kLanes points
  SeriesOrder start_;             // of the series under way
  View<double*> history_;         // [batch][q], then as the law has it
};

/// Runs kernel(batch) colour by colour; within a colour chunks of batches in parallel.
template <class Kernel>
void forEachBatch(const char* name, const Batches& batches, const Kernel& kernel) {
  const int perChunk = batches.perChunk, count = batches.count;
  const int* order = batches.order.data();
  for (std::size_t c = 0; c + 1 < batches.colourStart.size(); ++c)
    Kokkos::parallel_for(
        name, Kokkos::RangePolicy<Execution>(batches.colourStart[c], batches.colourStart[c + 1]),
        [=, &kernel](int i) {
          const int first = order[i] * perChunk, end = first + perChunk < count ? first + perChunk : count;
          for (int b = first; b < end; ++b) kernel(b);
        });
  Execution().fence();
}

template <class Inputs>
PointValues LawArrays::observe(const double* data, const Inputs& inputs) const {
  const std::size_t size = static_cast<std::size_t>(elements.numPoints()) * shape.observed;
  PointValues result{law->observedNames(), std::vector<double>(elements.numEntities() * size)};
  forEachBatch("observe", elements.batches(), [&](int b) {
    const ThreadMemory::Held held(memory_);
    std::vector<double> values(size * kLanes);
    law->observe(batch(b, data, held.data()), inputs(b, held), values.data());
    for (int lane = 0; lane < elements.lanesIn(b); ++lane)
      for (std::size_t i = 0; i < size; ++i)
        result.values[(static_cast<std::size_t>(b) * kLanes + lane) * size + i] = values[i * kLanes + lane];
  });
  return result;
}

/// The sums over all batches, [batch][balance], in one order for any number of threads.
OwnForces sumOf(const std::vector<double>& perBatch, int numBalances);

}  // namespace atrapos::fem
