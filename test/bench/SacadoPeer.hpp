#pragma once

#include <Sacado.hpp>
#include <cstddef>

#include "Inputs.hpp"

namespace atrapos::bench {

/// The law with Sacado::Tay::Taylor. `series` is [point][input][order], all of it kept from order to order as
/// the method needs it; order k is a pass over all points that stores x_{k-1}, found since, and evaluates the
/// law again with all orders 0..k, x_k = 0.
template <class Law>
class SacadoPeer {
  using Taylor = Sacado::Tay::Taylor<double>;
  static constexpr int I = Law::numInputs, O = Law::numOutputs;

 public:
  SacadoPeer(const Law& law, int maxOrder) : law_(law), maxOrder_(maxOrder) {}

  std::size_t seriesDoubles(std::size_t points) const { return points * I * (maxOrder_ + 1); }

  /// sink(k, point, output, coefficient)
  template <class Sink>
  void reevaluate(double* series, std::size_t points, const Inputs& inputs, const Sink& sink) const {
    const int stride = maxOrder_ + 1;
    for (int k = 0; k <= maxOrder_; ++k) {
      Taylor x[I], y[O];
      for (int j = 0; j < I; ++j) x[j].resize(k, false);
      for (std::size_t p = 0; p < points; ++p) {
        double* s = series + p * I * stride;
        for (int j = 0; j < I; ++j) {
          const int known = k == 0 ? 0 : k - 1;
          s[j * stride + known] = inputs.point(p)[j * stride + known];
          if (k > 0) s[j * stride + k] = 0;
        }
        evaluate(s, k, inputs.datum(), x, y);
        for (int i = 0; i < O; ++i) sink(k, p, i, y[i].coeff(k));
      }
    }
  }

  /// All orders at once, where all inputs are known: not what path following can use.
  template <class Sink>
  void oneShot(double* series, std::size_t points, const Inputs& inputs, const Sink& sink) const {
    const int stride = maxOrder_ + 1;
    Taylor x[I], y[O];
    for (int j = 0; j < I; ++j) x[j].resize(maxOrder_, false);
    for (std::size_t p = 0; p < points; ++p) {
      double* s = series + p * I * stride;
      for (int j = 0; j < I * stride; ++j) s[j] = inputs.point(p)[j];
      evaluate(s, maxOrder_, inputs.datum(), x, y);
      for (int i = 0; i < O; ++i)
        for (int k = 0; k <= maxOrder_; ++k) sink(k, p, i, y[i].coeff(k));
    }
  }

 private:
  void evaluate(const double* series, int degree, const double& datum, Taylor* x, Taylor* y) const {
    for (int j = 0; j < I; ++j) {
      x[j].copyForWrite();
      for (int k = 0; k <= degree; ++k) x[j].fastAccessCoeff(k) = series[j * (maxOrder_ + 1) + k];
    }
    law_(x, &datum, y);
  }

  Law law_;
  int maxOrder_;
};

}  // namespace atrapos::bench
