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

  /// One past the last order of the block that begins at order k. Its m orders read about k + m (m+1) orders
  /// of the history together, instead of m k one by one: best for m near sqrt(k), and measured so.
  static int blockEnd(int k) {
    return k + std::min(k, std::max(1, static_cast<int>(std::lround(std::sqrt(k)))));
  }

  std::size_t historyDoubles(std::size_t batches) const { return batches * perBatch(); }

  /// As in AtraposSweep: every coefficient read or written counts once a pass.
  double bytesPerPoint() const {
    const double order = 8.0 * hand::kSlots, S = 8.0 * 6;
    double bytes = order;
    int begin = 1, end = 1;
    for (int k = 1; k <= maxOrder_; ++k) {
      bytes += (k > 1 ? order : 0) + S;  // written: order k-1, S_k
      if (k == end) {
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
    const auto out = [&](int k, std::size_t b) -> hand::Tensor& {
      return *reinterpret_cast<hand::Tensor*>(sink(k, b));
    };
    for (std::size_t b = 0; b < batches; ++b)
      hand::start(material_, history + b * perBatch(), tensor(inputs.batch(b, 0)), out(0, b));
    int begin = 1, end = 1;
    for (int k = 1; k <= maxOrder_; ++k) {
      if (k == end) {
        begin = k;
        end = blocked_ ? std::min(maxOrder_ + 1, blockEnd(k)) : k + 1;
      }
      for (std::size_t b = 0; b < batches; ++b) {
        double* h = history + b * perBatch();
        const double* next = b + 1 < batches ? h + perBatch() : h;
        if (k > 1) hand::complete(material_, h, k - 1, tensor(inputs.batch(b, k - 1)));
        if (k == begin)
          hand::sweepBlock(material_, h, k, end, out(k, b), next);
        else
          hand::sweepWithin(material_, h, k, begin, out(k, b), next);
      }
    }
  }

 private:
  std::size_t perBatch() const {
    return static_cast<std::size_t>(hand::kSlots) * (maxOrder_ + 1) * hand::kLanes;
  }

  static const hand::Tensor& tensor(const taylor::Lanes<kLanes>* in) {
    return *reinterpret_cast<const hand::Tensor*>(in);
  }

  hand::Material material_;
  int maxOrder_;
  bool blocked_;
};

}  // namespace atrapos::bench
