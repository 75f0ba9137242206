#include "LawArrays.hpp"

#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "atrapos/taylor/Domain.hpp"

namespace atrapos::fem {

SeriesOrder seriesOrder(int k, int maxOrder) {
  SeriesOrder order{k, maxOrder, {}, taylor::HistoryShape::waiting(maxOrder)};
  if (k > 0) order.block = taylor::orderBlock(k, maxOrder);
  return order;
}

LawArrays::LawArrays(std::unique_ptr<PointLaw> theLaw, const PointSet& points,
                     const std::vector<double>& pointData)
    : elements(points),
      law(std::move(theLaw)),
      shape(law->shape()),
      // Whole cache lines, so that what follows begins with one.
      lawDoubles_((law->historyDoubles(0) + kLanes - 1) / kLanes * kLanes) {
  if (pointData.size() != static_cast<std::size_t>(points.numPoints()) * shape.data)
    throw std::logic_error("a term's law has " + std::to_string(shape.data) + " data a point, " +
                           std::to_string(pointData.size()) + " are given for " +
                           std::to_string(points.numPoints()) + " points");
  data_ = elements.packed(pointData, static_cast<std::size_t>(points.pointsPerEntity) * shape.data);
}

void LawArrays::keep(const TermPart& part) {
  data_ =
      ElementArrays::packedOf(part, data_.data(), static_cast<std::size_t>(elements.view().Q) * shape.data);
  elements.keep(part);
}

PointBatch LawArrays::batch(int b, const double* data, double* memory) const {
  return {elements.view().Q, elements.view().lanesIn(b), data + b * perBatch(shape.data), memory};
}

PointBatch LawArrays::seriesBatch(int b, const double* data) const {
  return batch(b, data, history_.data() + static_cast<std::size_t>(b) * elements.view().Q * pointDoubles_);
}

std::size_t LawArrays::historyBytes(int maxOrder) const {
  return static_cast<std::size_t>(elements.batches().count) * elements.view().Q *
         law->historyDoubles(maxOrder) * sizeof(double);
}

void LawArrays::reserveHistory(int maxOrder) {
  const std::size_t size = law->historyDoubles(maxOrder);
  maxOrder_ = maxOrder;
  if (history_.size() != 0 && pointDoubles_ == size) return;
  pointDoubles_ = size;
  history_ = View<double*>();  // free before the new one is made
  history_ = View<double*>(Kokkos::view_alloc("history", Kokkos::WithoutInitializing),
                           historyBytes(maxOrder) / sizeof(double));
}

void LawArrays::throwFirst(const std::vector<PointFailure>& perBatch) const {
  for (std::size_t b = 0; b < perBatch.size(); ++b)
    if (perBatch[b].lane >= 0)
      throw taylor::DomainError(
          perBatch[b].operation, perBatch[b].value,
          "entity " +
              std::to_string(elements.numberInTerm(static_cast<int>(b) * kLanes + perBatch[b].lane) + 1) +
              ", point " + std::to_string(perBatch[b].point + 1));
}

PointValues LawArrays::observe(const std::vector<double>& inputs, const double* data) const {
  const ElementView& e = elements.view();
  PointValues result{law->observedNames(), {}};
  const std::size_t Q = e.Q, J = shape.inputs, V = shape.observed;
  result.values.resize(e.numEntities * Q * V);
  forEachBatch("observe", elements.batches(), [&](int b) {
    const ThreadMemory::Held held(memory_);
    std::vector<double> in(Q * J * kLanes, 0.0), values(Q * V * kLanes);
    const int lanes = e.lanesIn(b);
    for (int lane = 0; lane < lanes; ++lane)
      for (std::size_t i = 0; i < Q * J; ++i)
        in[i * kLanes + lane] = inputs[(static_cast<std::size_t>(b) * kLanes + lane) * Q * J + i];
    law->observeAll(batch(b, data, held.data()), in.data(), values.data());
    for (int lane = 0; lane < lanes; ++lane)
      for (std::size_t i = 0; i < Q * V; ++i)
        result.values[(static_cast<std::size_t>(b) * kLanes + lane) * Q * V + i] = values[i * kLanes + lane];
  });
  return result;
}

void PointLaw::observeAll(const PointBatch& points, const double* in, double* values) const {
  const LawShape s = shape();
  std::vector<double> x(s.inputs), data(s.data + 1), shown(s.observed + 1);
  for (int q = 0; q < points.numPoints; ++q)
    for (int lane = 0; lane < points.lanes; ++lane) {
      for (int m = 0; m < s.inputs; ++m) x[m] = in[(q * s.inputs + m) * kLanes + lane];
      for (int d = 0; d < s.data; ++d) data[d] = points.data[(q * s.data + d) * kLanes + lane];
      observe(x.data(), data.data(), shown.data());
      for (int v = 0; v < s.observed; ++v) values[(q * s.observed + v) * kLanes + lane] = shown[v];
    }
}

double sumOf(const std::vector<double>& perBatch) {
  return std::accumulate(perBatch.begin(), perBatch.end(), 0.0);
}

}  // namespace atrapos::fem
