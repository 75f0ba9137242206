#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "atrapos/taylor/Law.hpp"

namespace atrapos::taylor {

/// The series of one law at many points, order by order: for programs with element loops of their own. Owns
/// the histories, runs L points at a time, knows neither threads nor what a point is.
///
///     PointSeries<Law> series(law, numPoints);
///     series.begin(maxOrder, gather);            // gather(point, double* in): the inputs' values
///     for k = 1, 2, ...:
///       series.order(k, gather, scatter);        // gather: their coefficient k - 1 (not called for k = 1);
///                                                // scatter(point, const double* out): nonlinear part of
///                                                order k
///
/// `data`, if the law has any: [point][datum].
template <class Law, int L = nativeLanes>
class PointSeries {
 public:
  PointSeries(const Law& law, int numPoints, std::vector<double> data = {})
      : law_(law), numPoints_(numPoints), data_(std::move(data)), shape_(historyShape(law)) {
    if (data_.size() != static_cast<std::size_t>(numPoints) * Law::numData)
      throw std::invalid_argument("PointSeries: " + std::to_string(data_.size()) + " data for " +
                                  std::to_string(numPoints) + " points of " + std::to_string(Law::numData));
  }
  PointSeries(const PointSeries&) = delete;
  PointSeries& operator=(const PointSeries&) = delete;

  /// Bytes of the histories for orders up to maxOrder.
  std::size_t historyBytes(int maxOrder) const {
    return groups() * shape_.template doubles<L>(maxOrder) * sizeof(double);
  }

  /// Order 0. Throws DomainError, with the point's number, where the law has no series.
  template <class Gather>
  void begin(int maxOrder, const Gather& gather) {
    if (maxOrder < 0) throw std::invalid_argument("PointSeries: a negative order");
    stride_ = shape_.template doubles<L>(maxOrder);
    maxOrder_ = maxOrder;
    next_ = 1;
    memory_.resize(groups() * stride_);  // kept from series to series
    Lanes<L> in[Law::numInputs], out[Law::numOutputs], data[Law::numData + 1] = {};
    for (int g = 0; g < groups(); ++g) {
      Failures<L> failures;
      Context<L> context = at(g, 0);
      context.failures = &failures;
      load(g, gather, in, data);
      start(law_, context, in, data, out);
      // A failure in a branch that if_then_else did not choose does no harm: only what reaches the outputs
      // counts.
      for (int lane = 0; lane < count(g); ++lane)
        for (int i = 0; i < Law::numOutputs; ++i)
          if (std::isnan(out[i][lane])) {
            failures.note(lane, Operation::Result, out[i][lane]);
            throw DomainError(failures.operation[lane], failures.value[lane],
                              "point " + std::to_string(g * L + lane));
          }
    }
  }

  /// Order k >= 1, one after the other.
  template <class Gather, class Scatter>
  void order(int k, const Gather& gather, const Scatter& scatter) {
    if (k != next_ || k > maxOrder_)
      throw std::invalid_argument("PointSeries: order " + std::to_string(k) + " asked for, order " +
                                  std::to_string(next_) + " of " + std::to_string(maxOrder_) + " is next");
    ++next_;
    Lanes<L> in[Law::numInputs], out[Law::numOutputs], data[Law::numData + 1] = {};
    for (int g = 0; g < groups(); ++g) {
      load(g, gather, in, data, k > 1);
      if (k > 1) {
        Context<L> previous = at(g, k - 1);
        complete(law_, previous, in, data);
      }
      Context<L> context = at(g, k);
      sweep(law_, context, data, out);
      for (int lane = 0; lane < count(g); ++lane) {
        double one[Law::numOutputs];
        for (int i = 0; i < Law::numOutputs; ++i) one[i] = out[i][lane];
        scatter(g * L + lane, static_cast<const double*>(one));
      }
    }
  }

 private:
  int groups() const { return (numPoints_ + L - 1) / L; }
  int count(int g) const { return g * L + L <= numPoints_ ? L : numPoints_ - g * L; }

  Context<L> at(int g, int k) {
    Context<L> context;
    context.memory = memory_.data() + g * stride_;
    context.shape = shape_;
    context.order = k;
    context.block = orderBlock(k > 0 ? k : 1, maxOrder_);
    context.waiting = HistoryShape::waiting(maxOrder_);
    return context;
  }

  /// Lanes beyond the last point repeat the group's first: any valid point will do.
  template <class Gather>
  void load(int g, const Gather& gather, Lanes<L>* in, Lanes<L>* data, bool inputs = true) const {
    for (int lane = 0; lane < L; ++lane) {
      const int point = g * L + (lane < count(g) ? lane : 0);
      double one[Law::numInputs];
      if (inputs) {
        gather(point, one);
        for (int j = 0; j < Law::numInputs; ++j) in[j][lane] = one[j];
      }
      for (int j = 0; j < Law::numData; ++j)
        data[j][lane] = data_[static_cast<std::size_t>(point) * Law::numData + j];
    }
  }

  Law law_;
  int numPoints_;
  std::vector<double> data_;
  HistoryShape shape_;
  std::size_t stride_ = 0;
  int maxOrder_ = -1, next_ = 1;
  std::vector<double> memory_;
};

}  // namespace atrapos::taylor
