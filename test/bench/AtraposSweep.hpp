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
      : law_(law), maxOrder_(maxOrder), slots_(taylor::historySlots<kLanes>(law)) {}

  std::size_t historyDoubles(std::size_t batches) const { return batches * perBatch(); }

  /// Bytes a point of all passes, each coefficient counted once a pass: the histories read (orders 0..k-1 for
  /// order k) and written (order k, and order k-1 when it is completed).
  double bytesPerPoint() const {
    double bytes = 8.0 * slots_;
    for (int k = 1; k <= maxOrder_; ++k) bytes += 8.0 * slots_ * (k + 1 + (k > 1));
    return bytes;
  }

  /// sink(k, batch) is where the batch's outputs of order k >= 0 go, those of inputs x_k = 0.
  template <class Sink>
  void run(double* history, std::size_t batches, const Inputs& inputs, const Sink& sink) const {
    const Pack datum(inputs.datum());
    const Pack zero[Law::numInputs] = {};
    for (std::size_t b = 0; b < batches; ++b) {
      taylor::Context<kLanes> context{history + b * perBatch(), maxOrder_, 0, taylor::Pass::Start, 0};
      taylor::sweep(law_, context, inputs.batch(b, 0), &datum, sink(0, b));
    }
    for (int k = 1; k <= maxOrder_; ++k)
      for (std::size_t b = 0; b < batches; ++b) {
        taylor::Context<kLanes> context{history + b * perBatch(), maxOrder_, k, taylor::Pass::Sweep, 0};
        if (k > 1) {
          Pack ignored[Law::numOutputs];
          context.order = k - 1;
          context.pass = taylor::Pass::Complete;
          taylor::sweep(law_, context, inputs.batch(b, k - 1), &datum, ignored);
          context.order = k;
          context.pass = taylor::Pass::Sweep;
        }
        taylor::sweep(law_, context, zero, &datum, sink(k, b));
      }
  }

 private:
  std::size_t perBatch() const { return taylor::historyDoubles<kLanes>(slots_, maxOrder_); }

  Law law_;
  int maxOrder_;
  int slots_;
};

}  // namespace atrapos::bench
