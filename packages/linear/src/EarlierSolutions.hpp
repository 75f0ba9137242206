#pragma once

#include <deque>

#include "atrapos/linear/Types.hpp"

namespace atrapos::linear {

/// The latest solutions of one K, with the products K z orthonormal, so that the combination of them whose
/// residual is least costs no product with K (Fischer, Comput. Methods Appl. Mech. Engrg. 163 (1998) 193).
class EarlierSolutions {
 public:
  explicit EarlierSolutions(int most) : most_(most) {}

  /// That combination for K x = b; zero where there are none.
  void combine(const Vector& b, Vector& x) const;

  /// Takes a solution x and its product K x.
  void add(const Vector& x, const Vector& product);

 private:
  struct Pair {
    RCP<Vector> solution, product;
  };
  int most_;
  std::deque<Pair> pairs_;
};

}  // namespace atrapos::linear
