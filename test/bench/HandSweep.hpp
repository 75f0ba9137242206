#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "HandWritten.hpp"
#include "Inputs.hpp"

namespace atrapos::bench {

/// All orders of Saint Venant-Kirchhoff over many points with the hand-written kernels, as AtraposSweep does
/// it with the generic ones.
class HandSweep {
 public:
  /// blocked: convolutions of several orders in one pass over the history (hand::sweepBlock).
  HandSweep(const hand::Material& material, int maxOrder, bool blocked)
      : material_(material), maxOrder_(maxOrder), blocked_(blocked) {}

  /// Where the block that begins at order k ends (one past its last order). Orders k..k+m-1 read k + m (m+1)
  /// orders instead of m k: best for m near sqrt(k).
  static int blockEnd(int k) {
    return k + std::min(k, std::max(1, static_cast<int>(std::lround(std::sqrt(k)))));
  }

  std::size_t historyDoubles(std::size_t batches) const { return batches * perBatch(); }

  /// As in AtraposSweep: every coefficient read or written counts once a pass.
  double bytesPerPoint() const {
    const double order = 8.0 * hand::kSlots, S = 8.0 * 6;
    double bytes = order;
    int begin = 1, end = 2;
    for (int k = 1; k <= maxOrder_; ++k) {
      bytes += (k > 1 ? order : 0) + S;  // written: order k-1, S_k
      if (!blocked_ || k == end || k == 1) {
        begin = k;
        end = blocked_ ? std::min(maxOrder_ + 1, blockEnd(k)) : k + 1;
        bytes += order * (k - 1) + (k > 1 ? S : order) + order * (end - k - 1);
      } else {
        bytes += order * (2 + (k - begin) + (k - 1 - begin)) + S;
      }
    }
    return bytes;
  }

  template <class Sink>
  void run(double* history, std::size_t batches, const Inputs& inputs, const Sink& sink) const {
    if (historyDoubles(batches) * sizeof(double) > 256 * 1024)
      runAll<true>(history, batches, inputs, sink);
    else
      runAll<false>(history, batches, inputs, sink);
  }

 private:
  std::size_t perBatch() const {
    return static_cast<std::size_t>(hand::kSlots) * (maxOrder_ + 1) * hand::kLanes;
  }

  static const hand::Tensor& tensor(const taylor::Lanes<kLanes>* in) {
    return *reinterpret_cast<const hand::Tensor*>(in);
  }

  template <bool kPrefetch, class Sink>
  void runAll(double* history, std::size_t batches, const Inputs& inputs, const Sink& sink) const {
    const auto out = [&](int k, std::size_t b) -> hand::Tensor& {
      return *reinterpret_cast<hand::Tensor*>(sink(k, b));
    };
    for (std::size_t b = 0; b < batches; ++b)
      hand::start(material_, history + b * perBatch(), tensor(inputs.batch(b, 0)), out(0, b));
    // One loop over the points for each kind of pass, so that each is compiled for itself.
    int begin = 1, end = 2;
    for (int k = 1; k <= maxOrder_; ++k) {
      if (blocked_ && (k == end || k == 1)) {
        begin = k;
        end = std::min(maxOrder_ + 1, blockEnd(k));
      }
      for (std::size_t b = 0; b < batches; ++b) {
        double* h = history + b * perBatch();
        const double* next = h + perBatch();  // prefetched: may lie past the end
        if (k > 1) hand::complete(material_, h, k - 1, tensor(inputs.batch(b, k - 1)));
        if (!blocked_)
          hand::sweep<kPrefetch>(material_, h, k, out(k, b), next);
        else if (k == begin)
          hand::sweepBlock<kPrefetch>(material_, h, k, end, out(k, b), next);
        else
          hand::sweepWithin<kPrefetch>(material_, h, k, begin, out(k, b), next);
      }
    }
  }

  hand::Material material_;
  int maxOrder_;
  bool blocked_;
};

}  // namespace atrapos::bench
