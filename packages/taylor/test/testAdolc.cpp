// Another tool as a judge: coefficients 0..40 by ADOL-C's univariate Taylor propagation on a tape, lane by
// lane.

#include <adolc/adolc.h>

#include "OperationChecks.hpp"

namespace {

/// Coefficients 0..maxOrder of f(a, b).
template <class F>
std::vector<double> byAdolc(F f, const std::vector<double>& a, const std::vector<double>& b) {
  constexpr short tape = 1;
  double out = 0;
  trace_on(tape);
  {
    adouble x, y, z;
    x <<= a[0];
    y <<= b[0];
    z = f(x, y);
    z >>= out;
  }
  trace_off();
  double base[] = {a[0], b[0]};
  std::vector<double> higher[] = {{a.begin() + 1, a.end()}, {b.begin() + 1, b.end()}};
  double* in[] = {higher[0].data(), higher[1].data()};
  std::vector<double> result(maxOrder);
  double* outs[] = {result.data()};
  EXPECT_GE(hos_forward(tape, 1, 2, maxOrder, 0, base, in, &out, outs), 0);
  result.insert(result.begin(), out);
  return result;
}

template <class F>
void checkAgainstAdolc(F f, const char* name, Range range = {}, double tolerance = rounding) {
  const Coefficients in = {testSeries(maxOrder, range.a0, range.a1, 1),
                           testSeries(maxOrder, range.b0, range.b1, 2)};
  const auto expected = [&](int l) {
    std::vector<double> x[2];
    for (int j = 0; j < 2; ++j)
      for (const auto& c : in[j]) x[j].push_back(c[l]);
    return [c = byAdolc(f, x[0], x[1])](int k) -> long double { return c[k]; };
  };
  for (const Mode mode : {Mode::Direct, Mode::AsASolver})
    expectSeries(runSeries(Binary<F>{f}, in, mode).out[0], expected, tolerance, name);
}

TEST(AgainstAdolc, arithmetic) {
  checkAgainstAdolc(
      [](auto a, auto b) -> decltype(a) { return a * b - 2.0 * a / b + (1.0 - a) * (3.0 + a * a); },
      "arithmetic");
  checkAgainstAdolc([](auto a, auto b) -> decltype(a) { return 1.0 / (a * a + b * b) - b / 3.0; },
                    "quotients");
}

TEST(AgainstAdolc, rootsAndPowers) {
  checkAgainstAdolc([](auto a, auto b) -> decltype(a) { return sqrt(a + b) * b; }, "sqrt");
  checkAgainstAdolc([](auto a, auto b) -> decltype(a) { return pow(b, -2.5) * a; }, "b^-2.5");
  checkAgainstAdolc([](auto a, auto b) -> decltype(a) { return pow(b, a); }, "b^a");
}

TEST(AgainstAdolc, exponentials) {
  checkAgainstAdolc([](auto a, auto b) -> decltype(a) { return exp(a) * b; }, "exp");
  checkAgainstAdolc([](auto a, auto b) -> decltype(a) { return log(b) * a; }, "log");
  checkAgainstAdolc([](auto a, auto b) -> decltype(a) { return log10(b) * a; }, "log10");
  checkAgainstAdolc([](auto a, auto b) -> decltype(a) { return erf(a) * b; }, "erf");
}

TEST(AgainstAdolc, circularAndHyperbolic) {
  checkAgainstAdolc([](auto a, auto b) -> decltype(a) { return sin(a) * cos(b) + tan(a); }, "circular");
  checkAgainstAdolc([](auto a, auto b) -> decltype(a) { return sinh(a) * cosh(b) + tanh(a); }, "hyperbolic");
}

TEST(AgainstAdolc, inverses) {
  checkAgainstAdolc([](auto a, auto b) -> decltype(a) { return asin(0.5 * a) * acos(0.5 * a) + atan(b); },
                    "circular");
  checkAgainstAdolc([](auto a, auto b) -> decltype(a) { return asinh(a) * acosh(1.0 + b) + atanh(0.5 * a); },
                    "hyperbolic");
  checkAgainstAdolc([](auto a, auto b) -> decltype(a) { return atan2(a, b); }, "atan2");
}

TEST(AgainstAdolc, choices) {
  checkAgainstAdolc([](auto a, auto b) -> decltype(a) { return fabs(a - 0.7) * b; }, "fabs");
  // The names differ, the meaning does not.
  checkAgainstAdolc(
      [](auto a, auto b) -> decltype(a) {
        if constexpr (std::is_same_v<decltype(a), adouble>)
          return fmin(a, 0.5 * b) * fmax(a, 0.6 * b);
        else
          return min(a, 0.5 * b) * max(a, 0.6 * b);
      },
      "min and max");
}

}  // namespace
