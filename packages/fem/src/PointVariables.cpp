#include "PointVariables.hpp"

#include <algorithm>

namespace atrapos::fem {

void PointVariables::remember(const double* variables, const Inputs& inputs) {
  const int Q = a_.elements.numPoints(), D = a_.shape.data, count = a_.elements.batches().count;
  data_.assign(a_.data(), a_.data() + count * a_.perBatch(D));
  in_.resize(count * a_.perBatch(a_.shape.inputs));
  const int entities = a_.elements.numEntities();
  for (int b = 0; b < count; ++b)
    for (int lane = 0; lane < kLanes; ++lane) {
      const std::size_t entity = std::min(b * kLanes + lane, entities - 1);  // lanes beyond the last copy it
      for (int q = 0; q < Q; ++q)
        for (int v = 0; v < V_; ++v)
          data_[((static_cast<std::size_t>(b) * Q + q) * D + D - V_ + v) * kLanes + lane] =
              variables[(entity * Q + q) * V_ + v];
    }
  forEachBatch("remember", a_.elements.batches(),
               [&](int b) { inputs(b, in_.data() + b * a_.perBatch(a_.shape.inputs)); });
}

void PointVariables::carry(const Inputs& inputs, std::vector<double>& data) const {
  const int Q = a_.elements.numPoints(), D = a_.shape.data, J = a_.shape.inputs;
  if (data_.empty()) {  // nothing is remembered yet
    data.assign(a_.data(), a_.data() + a_.elements.batches().count * a_.perBatch(D));
    return;
  }
  data = data_;
  std::vector<PointFailure> failures(a_.elements.batches().count);
  forEachBatch("carry", a_.elements.batches(), [&](int b) {
    const ThreadMemory::Held held(a_.memory());
    double* to = a_.scratchOf(held);
    double* variables = to + a_.perBatch(J);
    inputs(b, to);
    a_.law->carry(a_.batch(b, data_.data(), held.data()), in_.data() + b * a_.perBatch(J), to, variables,
                  failures[b]);
    for (int q = 0; q < Q; ++q)
      std::copy_n(variables + q * V_ * kLanes, V_ * kLanes,
                  data.data() + ((static_cast<std::size_t>(b) * Q + q) * D + D - V_) * kLanes);
  });
  a_.throwFirst(failures);
}

std::vector<double> PointVariables::values(const double* data) const {
  return none() ? std::vector<double>{} : unpacked(data, a_.shape.data, a_.shape.data - V_);
}

std::vector<double> PointVariables::unpacked(const double* packed, int stride, int first) const {
  const int Q = a_.elements.numPoints(), entities = a_.elements.numEntities();
  std::vector<double> all(static_cast<std::size_t>(entities) * Q * V_);
  for (std::size_t e = 0; e < static_cast<std::size_t>(entities); ++e)
    for (int q = 0; q < Q; ++q)
      for (int v = 0; v < V_; ++v)
        all[(e * Q + q) * V_ + v] = packed[((e / kLanes * Q + q) * stride + first + v) * kLanes + e % kLanes];
  return all;
}

void PointVariables::beginSeries(const double* data, int maxOrder) {
  const std::size_t size = a_.elements.batches().count * a_.perBatch(V_);
  orders_.assign(maxOrder + 1, std::vector<double>(size));
  maxOrder_ = maxOrder;
  last_ = 0;
  const int Q = a_.elements.numPoints(), D = a_.shape.data;
  for (std::size_t point = 0; point < static_cast<std::size_t>(a_.elements.batches().count) * Q; ++point)
    std::copy_n(data + (point * D + D - V_) * kLanes, V_ * kLanes, orders_[0].data() + point * V_ * kLanes);
}

void PointVariables::store(int batch, int k, const double* out, bool add) {
  const int Q = a_.elements.numPoints(), O = a_.shape.outputs;
  double* own = orders_[k].data() + batch * a_.perBatch(V_);
  for (int q = 0; q < Q; ++q)
    for (int m = 0; m < V_ * kLanes; ++m) {
      const double value = out[(q * O + O - V_) * kLanes + m];
      double& z = own[q * V_ * kLanes + m];
      z = add ? z + value : value;
    }
}

SeriesOrder PointVariables::afterLast() const {
  // The block of orders concerns the sweep alone, which there is none of behind the highest order.
  SeriesOrder order = seriesOrder(std::min(last_ + 1, maxOrder_), maxOrder_);
  order.k = last_ + 1;
  return order;
}

std::vector<std::vector<double>> PointVariables::orders() const {
  std::vector<std::vector<double>> all;
  for (int k = 0; k <= last_; ++k) all.push_back(unpacked(orders_[k].data(), V_, 0));
  return all;
}

}  // namespace atrapos::fem
