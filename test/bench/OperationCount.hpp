#pragma once

#include <cstddef>
#include <vector>

#include "atrapos/taylor/Law.hpp"

namespace atrapos::bench {

/// A scalar that counts what a law costs as order-k recurrences (docs/theory/taylor.md): the multiplications
/// and additions of its convolutions, squares at half price. Linear operations are not counted, nor the
/// second execution of a Complete: this is the useful work, the same number for every method.
class Counted {
 public:
  struct Tally {
    int nextId = 1;
    double perOrder = 0;  ///< flops = perOrder k + constant at order k
    double constant = 0;
  };

  Counted() = default;
  Counted(double) {}
  explicit Counted(Tally* tally) : tally_(tally), id_(tally->nextId++) {}

  friend Counted operator+(const Counted& a, const Counted& b) { return linear(a, b); }
  friend Counted operator-(const Counted& a, const Counted& b) { return linear(a, b); }
  friend Counted operator-(const Counted& a) { return linear(a, a); }
  Counted& operator+=(const Counted& b) { return *this = linear(*this, b); }
  Counted& operator-=(const Counted& b) { return *this = linear(*this, b); }
  friend Counted operator*(const Counted& a, const Counted& b) {
    if (!a.tally_ || !b.tally_) return linear(a, b);
    return a.id_ == b.id_ ? a.result(1, 1) : a.result(2, 2);  // k+1 pairs, each twice in a square
  }
  friend Counted operator/(const Counted& a, const Counted& b) {
    return b.tally_ ? b.result(2, 1) : linear(a, b);
  }
  friend Counted sqrt(const Counted& a) { return a.result(1, 0); }
  friend Counted log(const Counted& a) { return a.result(2, 1); }
  friend Counted log1p(const Counted& a) { return a.result(2, 1); }
  friend Counted exp(const Counted& a) { return a.result(2, 1); }
  friend Counted pow(const Counted& a, double) { return a.result(4, 2); }  // a p' = r a' p
  friend Counted tanh(const Counted& a) { return a.result(2 + 1, 1); }     // t' = w a', and w = 1 - t^2

 private:
  static Counted linear(const Counted& a, const Counted& b) {
    Tally* tally = a.tally_ ? a.tally_ : b.tally_;
    return tally ? Counted(tally) : Counted();
  }
  Counted result(double perOrder, double constant) const {
    tally_->perOrder += perOrder;
    tally_->constant += constant;
    return Counted(tally_);
  }

  Tally* tally_ = nullptr;  ///< null: a constant
  int id_ = 0;
};

/// Useful flops a point of all orders 0..maxOrder.
template <class Law>
double usefulFlops(const Law& law, int maxOrder) {
  Counted::Tally tally;
  Counted x[Law::numInputs], y[Law::numOutputs];
  for (auto& xi : x) xi = Counted(&tally);
  const double datum = 1;
  law(static_cast<const Counted*>(x), &datum, y);
  double flops = 0;
  for (int k = 0; k <= maxOrder; ++k) flops += tally.perOrder * k + tally.constant;
  return flops;
}

}  // namespace atrapos::bench
