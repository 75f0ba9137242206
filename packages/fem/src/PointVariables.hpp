#pragma once

#include <functional>
#include <vector>

#include "LawArrays.hpp"

namespace atrapos::fem {

/// The internal variables of a term's points: as a state remembers them, carried to other states, and on the
/// series under way. With a law that has none nothing is kept.
class PointVariables {
 public:
  /// Inputs of a batch at a state, [q][input][lane].
  using Inputs = std::function<void(int batch, double* in)>;

  explicit PointVariables(const LawArrays& arrays) : a_(arrays), V_(arrays.shape.variables) {}

  bool none() const { return V_ == 0; }

  /// `variables`, [entity][point][variable], are those of a state.
  void remember(const double* variables, const Inputs& inputs);
  /// The term's packed data with the variables carried to a state. Throws taylor::DomainError, naming the
  /// point, where the law does not lead there.
  void carry(const Inputs& inputs, std::vector<double>& data) const;
  /// [entity][point][variable] out of packed data.
  std::vector<double> values(const double* data) const;

  /// A series begins with these packed data.
  void beginSeries(const double* data, int maxOrder);
  /// The part of order k that is known without that order of the unknowns, among the law's outputs
  /// [q][output][lane]; and what that order adds.
  void begin(int batch, int k, const double* out) { store(batch, k, out, false); }
  void complete(int batch, int k, const double* out) { store(batch, k, out, true); }
  void added(int k) { last_ = k; }
  /// The pass behind the last order.
  SeriesOrder afterLast() const;
  /// [order][entity][point][variable].
  std::vector<std::vector<double>> orders() const;

 private:
  void store(int batch, int k, const double* out, bool add);
  /// The packed variables, [batch][q][variable][lane], as [entity][point][variable].
  std::vector<double> unpacked(const double* packed, int stride, int first) const;

  const LawArrays& a_;
  int V_;
  std::vector<double> data_;                 ///< packed, with the variables remembered
  std::vector<double> in_;                   ///< the inputs there, [batch][q][input][lane]
  std::vector<std::vector<double>> orders_;  ///< [order][batch][q][variable][lane]
  int last_ = 0, maxOrder_ = 0;
};

}  // namespace atrapos::fem
