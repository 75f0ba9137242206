// Arithmetic and elementary functions of the sweep scalar, orders 0..40, all lanes different: against series
// in long double and against Sacado's Taylor type; and the three passes against each other.

#include "OperationChecks.hpp"

namespace {

TEST(Operations, sumsAndMultiples) {
  check([](auto a, auto b) -> decltype(a) { return a + b; }, "a+b");
  check([](auto a, auto b) -> decltype(a) { return -a - b; }, "-a-b");
  check([](auto a, auto b) -> decltype(a) { return 2.0 * a - b / 3.0 + (1.0 - a) + (b - 4.0) - (3.0 + a); },
        "linear");
}

TEST(Operations, product) {
  check([](auto a, auto b) -> decltype(a) { return a * b; }, "a*b");
  check([](auto a, auto) -> decltype(a) { return a * a; }, "a*a");
  check([](auto a, auto b) -> decltype(a) { return (a + b) * (a - b) * a; }, "nested");
}

TEST(Operations, quotient) {
  check([](auto a, auto b) -> decltype(a) { return a / b; }, "a/b");
  check([](auto, auto b) { return 2.0 / b; }, "2/b");
  check([](auto a, auto b) -> decltype(a) { return (a / b) * (a / b) / (1.0 + a); }, "nested");
}

TEST(Operations, compoundAssignment) {
  check(
      [](auto a, auto b) -> decltype(a) {
        auto c = a;
        c *= b;
        c += a;
        c -= 2.0;
        c /= b;
        c *= c;
        return c;
      },
      "compound");
}

TEST(Operations, sqrt) {
  check([](auto, auto b) { return sqrt(b); }, "sqrt");
  check([](auto a, auto b) -> decltype(a) { return b * sqrt(a * a + b * b); }, "norm");
}

TEST(Operations, exp) {
  check([](auto a, auto b) -> decltype(a) { return exp(a) * b; }, "exp");
}
TEST(Operations, log) {
  check([](auto a, auto b) -> decltype(a) { return log(b) * a; }, "log");
}

TEST(Operations, realPower) {
  check([](auto, auto b) { return pow(b, 1.0 / 3.0); }, "cube root");
  check([](auto a, auto b) -> decltype(a) { return pow(b, -2.5) * a; }, "b^-2.5");
}

TEST(Operations, integerPower) {
  const auto powers = [](auto a, auto b) -> decltype(a) {
    return pow(a, 5) + pow(b, -3) + pow(a, 2) * pow(b, 1);
  };
  check(powers, "integer powers");
  // 0 and negative values are in the domain. In long double only: Sacado takes the logarithm.
  checkAgainstLongSeries(powers, "at 0 and below", {-0.7, 0.7, -1.9, -1.1}, roundingWithCancellation);
  checkAgainstLongSeries(powers, "a_0 = 0 in the first lane", {0.0, 0.7}, roundingWithCancellation);
  const auto seventh = [](auto a, auto) -> decltype(a) {
    if constexpr (std::is_same_v<decltype(a), LongSeries>)
      return pow(a, 7);
    else
      return pow(a, 7.0);
  };
  checkAgainstLongSeries(seventh, "a double that is an integer", {-0.7, 0.7}, roundingWithCancellation);
  checkAgainstLongSeries([](auto a, auto b) -> decltype(a) { return pow(a, 0) + b * pow(b, 0); }, "power 0");
}

TEST(Operations, circular) {
  check([](auto a, auto b) -> decltype(a) { return sin(a) * b; }, "sin");
  check([](auto a, auto b) -> decltype(a) { return cos(a) * b; }, "cos");
  check([](auto a, auto b) -> decltype(a) { return tan(a) * b; }, "tan");
  check([](auto a, auto b) -> decltype(a) { return tan(b) * a; }, "tan on both sides of its pole",
        {0.3, 0.9, 2.2, 3.9});
}

TEST(Operations, hyperbolic) {
  check([](auto a, auto b) -> decltype(a) { return sinh(b) * a; }, "sinh");
  check([](auto a, auto b) -> decltype(a) { return cosh(b) * a; }, "cosh");
  check([](auto a, auto b) -> decltype(a) { return tanh(b) * a; }, "tanh");
  // In long double only: Sacado's 1 - tanh^2 cancels here. The same cancellation is in our oracle's
  // sinh/cosh, but with eleven bits to spare.
  checkAgainstLongSeries([](auto a, auto) -> decltype(a) { return tanh(a); }, "tanh far out", {2.0, 4.0});
}

TEST(Operations, inverseCircular) {
  check([](auto a, auto b) -> decltype(a) { return atan(b) * a; }, "atan");
  check([](auto a, auto b) -> decltype(a) { return asin(0.5 * a) * b; }, "asin");
  check([](auto a, auto b) -> decltype(a) { return acos(0.5 * a) * b; }, "acos");
}

TEST(Operations, sinCosOfOneArgument) {
  const auto f = [](auto a, auto b) -> decltype(a) {
    auto s = a, c = a;
    if constexpr (std::is_same_v<decltype(a), LongSeries>) {
      s = sin(a);
      c = cos(a);
    } else {
      sinCos(a, s, c);
    }
    return s * c * b;
  };
  checkAgainstLongSeries(f, "sinCos");
  const auto g = [](auto a, auto b) -> decltype(a) {
    auto s = a, c = a;
    if constexpr (std::is_same_v<decltype(a), LongSeries>) {
      s = sinh(a);
      c = cosh(a);
    } else {
      sinhCosh(a, s, c);
    }
    return s * c * b;
  };
  checkAgainstLongSeries(g, "sinhCosh");
}

// exp(a), log(2+a), sqrt(2+a), 1/(2+a), (2+a)^(1/3), atan(1+a), tanh(a), sinh(a) cos(a) to 20 digits.
struct StandardFunctions {
  static constexpr int numInputs = 1, numOutputs = 8, numData = 0;
  template <class T>
  void operator()(const T* in, const Passive<T>*, T* out) const {
    const T a = in[0];
    out[0] = exp(a);
    out[1] = log(2.0 + a);
    out[2] = sqrt(2.0 + a);
    out[3] = 1.0 / (2.0 + a);
    out[4] = pow(2.0 + a, 1.0 / 3.0);
    out[5] = atan(1.0 + a);
    out[6] = tanh(a);
    out[7] = sinh(a) * cos(a);
  }
};

struct Tangents {
  static constexpr int numInputs = 1, numOutputs = 2, numData = 0;
  template <class T>
  void operator()(const T* in, const Passive<T>*, T* out) const {
    out[0] = tan(in[0]);
    out[1] = tan(1.0 + in[0]);
  }
};

std::vector<Values> pathParameter(std::size_t n) {  // a itself: 0 + 1 a
  std::vector<Values> a(n, Values(0.0));
  a[1] = 1.0;
  return a;
}

TEST(Operations, referenceCoefficients) {
  const auto rows = readColumns("taylor_std.csv");
  const auto r = runSeries(StandardFunctions{}, {pathParameter(rows.size())}, Mode::AsASolver);
  for (int i = 0; i < 8; ++i)
    expectSeries(
        r.out[i], [&](int) { return [&](int k) -> long double { return rows[k][i + 1]; }; }, rounding,
        "column " + std::to_string(i + 1));
}

TEST(Operations, referenceTangent) {
  const auto at0 = readColumns("taylor_tan.csv"), at1 = readColumns("taylor_tan_at1.csv");
  ASSERT_EQ(at0.size(), at1.size());
  const auto r = runSeries(Tangents{}, {pathParameter(at0.size())}, Mode::AsASolver);
  expectSeries(
      r.out[0], [&](int) { return [&](int k) -> long double { return at0[k][1]; }; }, rounding, "tan a");
  expectSeries(
      r.out[1], [&](int) { return [&](int k) -> long double { return at1[k][1]; }; }, rounding, "tan(1+a)");
}

}  // namespace
