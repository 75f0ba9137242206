#include "LawArrays.hpp"

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

void PointLaw::carry(const PointBatch&, const double*, const double*, double*, PointFailure&) const {
  throw std::logic_error("a law without internal variables was asked for them");
}

void PointLaw::sizes(const PointBatch&, const double*, double*) const {
  throw std::logic_error("a law without sizes of its own was asked for them");
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
  data_ = packed(pointData);
}

std::vector<double> LawArrays::packed(const std::vector<double>& pointData) const {
  return elements.packed(pointData, static_cast<std::size_t>(elements.numPoints()) * shape.data);
}

void LawArrays::setDatum(int entity, int point, int d, double value) {
  const std::size_t at = indexOf(entity, point, d);
  data_[at] = value;
  if (entity + 1 < elements.numEntities()) return;
  for (int lane = entity % kLanes + 1; lane < kLanes; ++lane) data_[at + lane - entity % kLanes] = value;
}

void LawArrays::keep(const TermPart& part) {
  data_ = ElementArrays::packedOf(part, data_.data(),
                                  static_cast<std::size_t>(elements.numPoints()) * shape.data);
  elements.keep(part);
}

PointBatch LawArrays::batch(int b, const double* data, double* memory) const {
  return {elements.numPoints(), elements.lanesIn(b), data + b * perBatch(shape.data), memory};
}

PointBatch LawArrays::seriesBatch(int b, const double* data) const {
  return batch(b, data, history_.data() + static_cast<std::size_t>(b) * elements.numPoints() * pointDoubles_);
}

std::size_t LawArrays::historyBytes(int maxOrder) const {
  return static_cast<std::size_t>(elements.batches().count) * elements.numPoints() *
         law->historyDoubles(maxOrder) * sizeof(double);
}

void LawArrays::reserveHistory(int maxOrder) {
  start_ = seriesOrder(0, maxOrder);
  const std::size_t size = law->seriesDoubles(start_);
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

OwnForces sumOf(const std::vector<double>& perBatch, int numBalances) {
  OwnForces sums(numBalances, 0.0);
  for (std::size_t i = 0; i < perBatch.size(); ++i) sums[i % numBalances] += perBatch[i];
  return sums;
}

}  // namespace atrapos::fem
