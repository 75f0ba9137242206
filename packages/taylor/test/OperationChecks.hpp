#pragma once

#include <Sacado.hpp>

#include "SeriesRun.hpp"

using atrapos::taylor::Passive;
using Tay = Sacado::Tay::Taylor<double>;

constexpr int maxOrder = 40;

template <class F>
struct Binary {
  static constexpr int numInputs = 2, numOutputs = 1, numData = 0;
  F f;
  template <class T>
  void operator()(const T* in, const Passive<T>*, T* out) const {
    out[0] = f(in[0], in[1]);
  }
};

/// Values of order 0 of the two operands.
struct Range {
  double a0 = 0.3, a1 = 0.9;  // order 0 of the operands over the lanes
  double b0 = 1.1, b1 = 1.9;
};

// Up to 40 terms in each sum and at most 3 nested recurrences, each rounded by half a unit in the last place;
// seen: 10 to 20 eps, 45 in a sum of integer powers whose tail cancels.
constexpr double rounding = 100 * 2.2e-16;
// Where a_0 passes 0 or b < 0, coefficients are small differences of larger terms than the scale knows; seen:
// 40 to 400 eps.
constexpr double roundingWithCancellation = 1000 * 2.2e-16;

/// f(a, b), one source for all scalars: orders 0..40 with the inputs known at once and as a solver does it,
/// and all histories.
template <class F>
void checkAgainstLongSeries(F f, const char* name, Range range = {}, double tolerance = rounding) {
  const Coefficients in = {testSeries(maxOrder, range.a0, range.a1, 1),
                           testSeries(maxOrder, range.b0, range.b1, 2)};
  const Binary<F> law{f};
  const auto expected = [&](int l) {
    const LongSeries c = f(lane(in[0], l), lane(in[1], l));
    return [c](int k) { return c.at(k); };
  };
  const auto direct = runSeries(law, in, Mode::Direct);
  expectSeries(direct.out[0], expected, tolerance, std::string(name) + " direct");
  const auto completed = runSeries(law, in, Mode::AsASolver);
  expectSeries(completed.out[0], expected, tolerance, std::string(name) + " completed");
  // The histories too are those of the true series: a later order depends on nothing else. Both carry
  // rounding, hence twice the tolerance.
  ASSERT_EQ(completed.memory.size(), direct.memory.size());
  for (int s = 0; s < direct.shape.slots; ++s) {
    const auto at = [&](const SeriesResult& r) {
      std::vector<Values> c(maxOrder + 1);
      for (int k = 0; k <= maxOrder; ++k)
        c[k] = Values::load(
            &r.memory[(r.shape.constants + r.shape.sums * atrapos::taylor::HistoryShape::waiting(maxOrder) +
                       k * r.shape.slots + s) *
                      L]);
      return c;
    };
    const auto slot = at(direct);
    const auto true_ = [&](int l) { return [&, l](int k) -> long double { return slot[k][l]; }; };
    expectSeries(at(completed), true_, 2 * tolerance, std::string(name) + " slot " + std::to_string(s));
  }
}

template <class F>
void checkAgainstSacado(F f, const char* name, Range range = {}) {
  const Coefficients in = {testSeries(maxOrder, range.a0, range.a1, 1),
                           testSeries(maxOrder, range.b0, range.b1, 2)};
  const auto expected = [&](int l) {
    Tay a(maxOrder, in[0][0][l]), b(maxOrder, in[1][0][l]);
    for (int k = 0; k <= maxOrder; ++k) {
      a.fastAccessCoeff(k) = in[0][k][l];
      b.fastAccessCoeff(k) = in[1][k][l];
    }
    const Tay c = f(a, b);
    return [c](int k) -> long double { return c.coeff(k); };
  };
  expectSeries(runSeries(Binary<F>{f}, in, Mode::Direct).out[0], expected, rounding, name);
}

template <class F>
void check(F f, const char* name, Range range = {}) {
  checkAgainstLongSeries(f, name, range);
  checkAgainstSacado(f, name, range);
}
