#pragma once

#include <adolc/adolc.h>

#include <cstddef>
#include <stdexcept>

#include "Inputs.hpp"

namespace atrapos::bench {

/// The law with ADOL-C: taped once, then interpreted by hos_forward at every point; otherwise as SacadoPeer.
/// `tag` numbers the tape.
template <class Law>
class AdolcPeer {
  static constexpr int I = Law::numInputs, O = Law::numOutputs;

 public:
  AdolcPeer(const Law& law, int maxOrder, short tag, const Inputs& inputs) : maxOrder_(maxOrder), tag_(tag) {
    trace_on(tag);
    adouble x[I], y[O];
    for (int j = 0; j < I; ++j) x[j] <<= inputs.point(0)[j * (maxOrder + 1)];
    law(x, &inputs.datum(), y);
    double ignored;
    for (int i = 0; i < O; ++i) y[i] >>= ignored;
    trace_off();
  }

  std::size_t seriesDoubles(std::size_t points) const { return points * I * (maxOrder_ + 1); }

  /// sink(k, point, output, coefficient)
  template <class Sink>
  void reevaluate(double* series, std::size_t points, const Inputs& inputs, const Sink& sink) const {
    const int stride = maxOrder_ + 1;
    double y[O], storage[O * kMaxOrder], *Y[O];
    for (int i = 0; i < O; ++i) Y[i] = storage + i * kMaxOrder;
    for (int k = 0; k <= maxOrder_; ++k)
      for (std::size_t p = 0; p < points; ++p) {
        double* s = series + p * I * stride;
        for (int j = 0; j < I; ++j) {
          const int known = k == 0 ? 0 : k - 1;
          s[j * stride + known] = inputs.point(p)[j * stride + known];
          if (k > 0) s[j * stride + k] = 0;
        }
        evaluate(s, k, y, Y);
        for (int i = 0; i < O; ++i) sink(k, p, i, k == 0 ? y[i] : Y[i][k - 1]);
      }
  }

  /// All orders at once, where all inputs are known: not what path following can use.
  template <class Sink>
  void oneShot(double* series, std::size_t points, const Inputs& inputs, const Sink& sink) const {
    const int stride = maxOrder_ + 1;
    double y[O], storage[O * kMaxOrder], *Y[O];
    for (int i = 0; i < O; ++i) Y[i] = storage + i * kMaxOrder;
    for (std::size_t p = 0; p < points; ++p) {
      double* s = series + p * I * stride;
      for (int j = 0; j < I * stride; ++j) s[j] = inputs.point(p)[j];
      evaluate(s, maxOrder_, y, Y);
      for (int i = 0; i < O; ++i)
        for (int k = 0; k <= maxOrder_; ++k) sink(k, p, i, k == 0 ? y[i] : Y[i][k - 1]);
    }
  }

  static constexpr int kMaxOrder = 200;

 private:
  void evaluate(double* series, int degree, double* y, double** Y) const {
    double x[I], *X[I];
    for (int j = 0; j < I; ++j) {
      x[j] = series[j * (maxOrder_ + 1)];
      X[j] = series + j * (maxOrder_ + 1) + 1;
    }
    const int rc =
        degree == 0 ? zos_forward(tag_, O, I, 0, x, y) : hos_forward(tag_, O, I, degree, 0, x, X, y, Y);
    if (rc < 0) throw std::runtime_error("AdolcPeer: the tape does not fit the point (a branch was taken?)");
  }

  int maxOrder_;
  short tag_;
};

}  // namespace atrapos::bench
