#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "atrapos/path/Calls.hpp"

namespace atrapos::path {

struct Unstable {
  int all = 0;   ///< eigenvalues with negative real part
  int real = 0;  ///< the real ones among them
  /// All that were computed, nearest to zero first.
  std::vector<std::complex<double>> nearest{};
};

/// Whose eigenvalues are counted.
enum class EigenProblem {
  ofTangent,  ///< K x = mu m x, m of Problem::eigenvalueWeights (docs/theory/path.md, "Unsymmetric tangents")
  ofRates     ///< K x = mu M x, M of Problem::mass where there is one (docs/theory/stability.md)
};

/// N of K x = mu N x at a state: what eigenvalues of a tangent that is not symmetric are measured by.
class EigenMeasure {
 public:
  EigenMeasure(Calls& calls, const State& at, EigenProblem of);
  bool isOne() const { return mass_.is_null() && weights_.is_null(); }
  bool isRegular() const { return mass_.is_null(); }
  /// y = N x
  void apply(const linear::MultiVector& x, linear::MultiVector& y) const;

 private:
  linear::RCP<const CrsMatrix> mass_;
  linear::RCP<const Vector> weights_;
};

/// Eigenvalues with negative real part, K the factored tangent at a state, which need not be symmetric.
/// `count` is how many of those next to zero are computed at first. Empty where they leave the numbers open,
/// or where multipliers of constraints are among the unknowns.
std::optional<Unstable> countUnstable(Calls& calls, const State& at, int count, EigenProblem of);

}  // namespace atrapos::path
