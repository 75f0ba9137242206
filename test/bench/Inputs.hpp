#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "atrapos/taylor/Lanes.hpp"

namespace atrapos::bench {

constexpr int kLanes = taylor::nativeLanes;
/// Points with inputs of their own; further points repeat them, so that inputs stay in cache as what an
/// element loop gathers from the nodes mostly does, and memory traffic is that of the histories.
constexpr int kDistinct = 64;
constexpr int kDistinctBatches = kDistinct / kLanes;

/// Box of a law's order-0 inputs, the size of its order-1 input, and the law's passive datum.
struct Domain {
  std::vector<double> center, halfWidth, rate;
  double datum = 0;
};

/// Input series x_k = rate random / 2^k of 64 points, in the two shapes that the methods read. Seeded: the
/// same at every run.
class Inputs {
 public:
  Inputs(const Domain& domain, int maxOrder)
      : size_(static_cast<int>(domain.center.size())),
        maxOrder_(maxOrder),
        flat_(static_cast<std::size_t>(kDistinct) * size_ * (maxOrder + 1)),
        lanes_(static_cast<std::size_t>(maxOrder + 1) * kDistinctBatches * size_),
        datum_(domain.datum) {
    std::mt19937 generator(2013);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int p = 0; p < kDistinct; ++p)
      for (int j = 0; j < size_; ++j)
        for (int k = 0; k <= maxOrder; ++k) {
          const double x = k == 0 ? domain.center[j] + domain.halfWidth[j] * uniform(generator)
                                  : domain.rate[j] * std::ldexp(uniform(generator), -k);
          flat_[(static_cast<std::size_t>(p) * size_ + j) * (maxOrder + 1) + k] = x;
          lanes_[(static_cast<std::size_t>(k) * kDistinctBatches + p / kLanes) * size_ + j][p % kLanes] = x;
        }
  }

  int size() const { return size_; }
  int maxOrder() const { return maxOrder_; }
  /// [input][order] of a point.
  const double* point(std::size_t p) const { return &flat_[(p % kDistinct) * size_ * (maxOrder_ + 1)]; }
  /// [input] of a batch.
  const taylor::Lanes<kLanes>* batch(std::size_t b, int k) const {
    return &lanes_[(static_cast<std::size_t>(k) * kDistinctBatches + b % kDistinctBatches) * size_];
  }
  const double& datum() const { return datum_; }

 private:
  int size_, maxOrder_;
  std::vector<double> flat_;
  std::vector<taylor::Lanes<kLanes>> lanes_;
  double datum_;
};

}  // namespace atrapos::bench
