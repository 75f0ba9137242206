#pragma once

#include <cstddef>

#include "Inputs.hpp"
#include "atrapos/taylor/Law.hpp"

namespace atrapos::bench {

/// All orders of a law over many points with the project's own sweeps, as the element loop does it: order 0,
/// then for every k one pass over the points that completes order k-1 and sweeps order k. The only file of
/// the benchmark that knows how histories are kept.
template <class Law>
class AtraposSweep {
  using Pack = taylor::Lanes<kLanes>;

 public:
  AtraposSweep(const Law& law, int maxOrder)
      : law_(law),
        maxOrder_(maxOrder),
        waiting_(taylor::HistoryShape::waiting(maxOrder)),
        shape_(taylor::historyShape(law)),
        perBatch_(shape_.doubles<kLanes>(maxOrder)) {}

  std::size_t historyDoubles(std::size_t batches) const { return batches * perBatch_; }

  /// Bytes a point of all passes, each number counted once a pass: what is read (order 0, the orders that the
  /// sweep's block asks for, sums that wait, constants) and written (orders k-1 and k, sums).
  double bytesPerPoint() const {
    const bool blocked = shape_.sums > 0;
    double numbers = shape_.slots + shape_.constants;
    for (int k = 1; k <= maxOrder_; ++k) {
      const taylor::OrderBlock block = taylor::orderBlock(k, maxOrder_);
      const int within = k - block.begin;
      const double orders = !blocked || within == 0 ? k : 1 + 2 * within;
      const int begun = within == 0 ? block.end - k - 1 : 1;
      numbers += shape_.slots * (orders + 1 + (k > 1)) + shape_.constants;
      numbers += static_cast<double>(shape_.sums) * begun;
    }
    return 8.0 * numbers;
  }

  /// sink(k, batch) is where the batch's outputs of order k >= 0 go, those of inputs x_k = 0.
  template <class Sink>
  void run(double* history, std::size_t batches, const Inputs& inputs, const Sink& sink) const {
    const Pack datum(inputs.datum());
    taylor::Context<kLanes> context;
    context.shape = shape_;
    context.waiting = waiting_;
    context.ahead = static_cast<std::ptrdiff_t>(perBatch_);
    for (std::size_t b = 0; b < batches; ++b) {
      context.memory = history + b * perBatch_;
      taylor::start(law_, context, inputs.batch(b, 0), &datum, sink(0, b));
    }
    for (int k = 1; k <= maxOrder_; ++k) {
      context.block = taylor::orderBlock(k, maxOrder_);
      for (std::size_t b = 0; b < batches; ++b) {
        context.memory = history + b * perBatch_;
        if (k > 1) {
          context.order = k - 1;
          taylor::complete(law_, context, inputs.batch(b, k - 1), &datum);
        }
        context.order = k;
        taylor::sweep(law_, context, &datum, sink(k, b));
      }
    }
  }

 private:
  Law law_;
  int maxOrder_;
  int waiting_;
  taylor::HistoryShape shape_;
  std::size_t perBatch_;
};

}  // namespace atrapos::bench
