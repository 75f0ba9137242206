// The functions that Sacado's Taylor type has not, or not everywhere, orders 0..40, all lanes different:
// against series in long double.

#include "OperationChecks.hpp"
#include "atrapos/taylor/Functions.hpp"

using atrapos::taylor::if_then_else;

namespace {

TEST(Functions, cubeRoot) {
  checkAgainstLongSeries([](auto a, auto b) -> decltype(a) { return cbrt(b) * a; }, "cbrt");
  checkAgainstLongSeries([](auto, auto b) { return cbrt(b); }, "of negative values", {0.3, 0.9, -1.9, -1.1});
}

TEST(Functions, hypot) {
  checkAgainstLongSeries([](auto a, auto b) -> decltype(a) { return hypot(a, b); }, "hypot");
  checkAgainstLongSeries([](auto a, auto) -> decltype(a) { return hypot(a, 2.0) * hypot(1.0, a); },
                         "one passive");
}

TEST(Functions, exponentialsAndLogarithms) {
  checkAgainstLongSeries([](auto a, auto b) -> decltype(a) { return expm1(a) * b; }, "expm1");
  checkAgainstLongSeries([](auto a, auto b) -> decltype(a) { return log1p(a) * b; }, "log1p", {-0.8, -0.2});
  checkAgainstLongSeries([](auto a, auto b) -> decltype(a) { return log10(b) * a; }, "log10");
  checkAgainstLongSeries([](auto a, auto b) -> decltype(a) { return erf(a) * b; }, "erf", {-0.9, 0.9},
                         roundingWithCancellation);
}

// Order 0 alone, where 1 + a and exp(a) - 1 would lose half of the digits.
TEST(Functions, noCancellationInOrderZero) {
  Coefficients in = {{Values(1e-9), Values(1.0)}, {Values(0.0), Values(0.0)}};
  const auto e = [](auto a, auto) -> decltype(a) { return expm1(a); };
  const auto l = [](auto a, auto) -> decltype(a) { return log1p(a); };
  // a + a^2/2 and a - a^2/2, exact to a^3/6 = 1.7e-28; one rounding.
  EXPECT_NEAR(runSeries(Binary<decltype(e)>{e}, in, Mode::Direct).out[0][0][L - 1], 1.0000000005e-9, 4e-25);
  EXPECT_NEAR(runSeries(Binary<decltype(l)>{l}, in, Mode::Direct).out[0][0][L - 1], 0.9999999995e-9, 4e-25);
}

TEST(Functions, powersOfEveryKind) {
  checkAgainstLongSeries([](auto a, auto b) -> decltype(a) { return pow(b, a); }, "series^series");
  checkAgainstLongSeries([](auto a, auto) -> decltype(a) { return pow(1.7, a); }, "double^series");
  checkAgainstLongSeries([](auto a, auto) -> decltype(a) { return pow(Passive<decltype(a)>(0.4), a); },
                         "Lanes^series");
  checkAgainstLongSeries([](auto a, auto b) -> decltype(a) { return pow(b, Passive<decltype(a)>(-1.3)); },
                         "series^Lanes");
  checkAgainstLongSeries([](auto a, auto b) -> decltype(a) { return pow(b, Passive<decltype(a)>(3.0)); },
                         "series^integer in Lanes");
  checkAgainstLongSeries([](auto a, auto b) -> decltype(a) { return pow(b, decltype(a)(2.5)); },
                         "series^constant");
  checkAgainstLongSeries([](auto a, auto) -> decltype(a) { return pow(decltype(a)(2.5), a); },
                         "constant^series");
}

struct PowerOfData {
  static constexpr int numInputs = 1, numOutputs = 2, numData = 1;
  template <class T>
  void operator()(const T* in, const Passive<T>* data, T* out) const {
    out[0] = pow(in[0], data[0]);
    out[1] = pow(data[0], in[0]);
  }
};

TEST(Functions, powersThatDifferFromPointToPoint) {
  const Coefficients in = {testSeries(maxOrder, 0.5, 1.5, 1)};
  Values data;
  for (int l = 0; l < L; ++l) data[l] = 0.5 + l;
  for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
    const auto r = runSeries(PowerOfData{}, in, mode, &data);
    expectSeries(
        r.out[0],
        [&](int l) {
          const LongSeries c = pow(lane(in[0], l), data[l]);
          return [c](int k) { return c.at(k); };
        },
        roundingWithCancellation, "a^r");
    expectSeries(
        r.out[1],
        [&](int l) {
          const LongSeries c = pow(data[l], lane(in[0], l));
          return [c](int k) { return c.at(k); };
        },
        roundingWithCancellation, "r^a");
  }
}

TEST(Functions, inverseHyperbolic) {
  checkAgainstLongSeries([](auto a, auto b) -> decltype(a) { return asinh(a) * b; }, "asinh");
  checkAgainstLongSeries([](auto a, auto) -> decltype(a) { return asinh(a); }, "asinh around 0", {-0.9, 0.8},
                         roundingWithCancellation);
  checkAgainstLongSeries([](auto a, auto b) -> decltype(a) { return acosh(1.0 + b) * a; }, "acosh");
  checkAgainstLongSeries([](auto a, auto b) -> decltype(a) { return atanh(0.5 * a) * b; }, "atanh",
                         {-0.9, 0.8}, roundingWithCancellation);
}

TEST(Functions, angleOfAVector) {
  const auto f = [](auto y, auto x) -> decltype(y) { return atan2(y, x); };
  checkAgainstLongSeries(f, "atan2");
  checkAgainstLongSeries(f, "below and left", {-0.9, -0.3, -1.9, -1.1});
  checkAgainstLongSeries(f, "across the axes", {-0.9, 0.8, 1.1, 1.9}, roundingWithCancellation);
  checkAgainstLongSeries([](auto y, auto) -> decltype(y) { return atan2(y, 2.0) + atan2(-1.5, y); },
                         "one passive");
}

// Order 0 of a passes 0 and crosses that of b, so that lanes choose differently.
constexpr Range crossing = {-1.0, 1.1, 0.9, -0.8};

TEST(Functions, choices) {
  checkAgainstLongSeries([](auto a, auto b) -> decltype(a) { return fabs(a) * b; }, "fabs", crossing);
  checkAgainstLongSeries([](auto a, auto b) -> decltype(a) { return min(a, b) * a; }, "min", crossing);
  checkAgainstLongSeries([](auto a, auto b) -> decltype(a) { return max(a, b) * b; }, "max", crossing);
  checkAgainstLongSeries([](auto a, auto b) -> decltype(a) { return max(a + b, a * b); }, "of expressions",
                         crossing);
  checkAgainstLongSeries([](auto a, auto b) -> decltype(a) { return max(a, 0.0) * b + min(0.0, b); },
                         "with a double", crossing);
  checkAgainstLongSeries([](auto a, auto b) -> decltype(a) { return if_then_else(a < b, a * b, a - b) * a; },
                         "if_then_else", crossing);
  checkAgainstLongSeries(
      [](auto a, auto b) -> decltype(a) { return if_then_else(a > 0.1, exp(a), decltype(a)(2.0)) * b; },
      "with a constant", crossing);
}

// Each comparison, between each two kinds of operands, as 1 and 0.
struct Comparisons {
  static constexpr int numInputs = 2, numOutputs = 8, numData = 1;
  template <class T>
  void operator()(const T* in, const Passive<T>* data, T* out) const {
    const T a = in[0], b = in[1];
    out[0] = if_then_else(a < b, 1.0, 0.0);
    out[1] = if_then_else(a <= 0.5, 1.0, 0.0);
    out[2] = if_then_else(data[0] > a, 1.0, 0.0);
    out[3] = if_then_else(a + b >= 2.0 * b, 1.0, 0.0);
    out[4] = if_then_else(0.5 == a, 1.0, 0.0);
    out[5] = if_then_else(a != b, 1.0, 0.0);
    out[6] = if_then_else(a < b && !(a < data[0]), 1.0, 0.0);
    out[7] = if_then_else(a < 0.25 || b < 0.25, 1.0, 0.0);
  }
};

TEST(Functions, comparisonsOnTheValue) {
  // Coefficients of order 1 point the other way: they must not count.
  Coefficients in(2, std::vector<Values>(3));
  Values data;
  for (int l = 0; l < L; ++l) {
    in[0][0][l] = 0.125 * l;
    in[1][0][l] = 0.125 * (6 - l);
    for (int k = 1; k < 3; ++k) {
      in[0][k][l] = -in[0][0][l];
      in[1][k][l] = 3.0;
    }
    data[l] = 0.25;
  }
  for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
    const auto r = runSeries(Comparisons{}, in, mode, &data);
    for (int l = 0; l < L; ++l) {
      const double x[] = {in[0][0][l], in[1][0][l]}, d = data[l];
      double expected[8];
      Comparisons{}(x, &d, expected);
      for (int i = 0; i < 8; ++i) {
        EXPECT_EQ(r.out[i][0][l], expected[i]) << i << " lane " << l;
        for (int k = 1; k < 3; ++k) EXPECT_EQ(r.out[i][k][l], 0.0);
      }
    }
  }
}

}  // namespace
