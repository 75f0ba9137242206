// Every operation of the sweep scalar, orders 0..40, all lanes different: against series in long double and
// against Sacado's Taylor type; and the three passes against each other.

#include "SeriesRun.hpp"

using atrapos::taylor::Passive;
using Tay = Sacado::Tay::Taylor<double>;

namespace {

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
  for (const Mode mode : {Mode::ZeroThenComplete, Mode::CompleteInThree}) {
    const auto completed = runSeries(law, in, mode);
    expectSeries(completed.out[0], expected, tolerance, std::string(name) + " completed");
    // The histories too are those of the true series: a later order depends on nothing else. Both carry
    // rounding, hence twice the tolerance.
    ASSERT_EQ(completed.history.size(), direct.history.size());
    for (int s = 0; s < direct.slots; ++s) {
      const auto at = [&](const SeriesResult& r) {
        std::vector<Values> c(maxOrder + 1);
        for (int k = 0; k <= maxOrder; ++k)
          for (int l = 0; l < L; ++l) c[k][l] = r.history[(s * (maxOrder + 1) + k) * L + l];
        return c;
      };
      const auto slot = at(direct);
      const auto true_ = [&](int l) { return [&, l](int k) -> long double { return slot[k][l]; }; };
      expectSeries(at(completed), true_, 2 * tolerance, std::string(name) + " slot " + std::to_string(s));
    }
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

TEST(Operations, sumsAndMultiples) {
  check([](auto a, auto b) { return a + b; }, "a+b");
  check([](auto a, auto b) { return -a - b; }, "-a-b");
  check([](auto a, auto b) { return 2.0 * a - b / 3.0 + (1.0 - a) + (b - 4.0) - (3.0 + a); }, "linear");
}

TEST(Operations, product) {
  check([](auto a, auto b) { return a * b; }, "a*b");
  check([](auto a, auto) { return a * a; }, "a*a");
  check([](auto a, auto b) { return (a + b) * (a - b) * a; }, "nested");
}

TEST(Operations, quotient) {
  check([](auto a, auto b) { return a / b; }, "a/b");
  check([](auto, auto b) { return 2.0 / b; }, "2/b");
  check([](auto a, auto b) { return (a / b) * (a / b) / (1.0 + a); }, "nested");
}

TEST(Operations, compoundAssignment) {
  check(
      [](auto a, auto b) {
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
  check([](auto a, auto b) { return b * sqrt(a * a + b * b); }, "norm");
}

TEST(Operations, exp) {
  check([](auto a, auto b) { return exp(a) * b; }, "exp");
}
TEST(Operations, log) {
  check([](auto a, auto b) { return log(b) * a; }, "log");
}

TEST(Operations, realPower) {
  check([](auto, auto b) { return pow(b, 1.0 / 3.0); }, "cube root");
  check([](auto a, auto b) { return pow(b, -2.5) * a; }, "b^-2.5");
}

TEST(Operations, integerPower) {
  const auto powers = [](auto a, auto b) { return pow(a, 5) + pow(b, -3) + pow(a, 2) * pow(b, 1); };
  check(powers, "integer powers");
  // 0 and negative values are in the domain. In long double only: Sacado takes the logarithm.
  checkAgainstLongSeries(powers, "at 0 and below", {-0.7, 0.7, -1.9, -1.1}, roundingWithCancellation);
  checkAgainstLongSeries(powers, "a_0 = 0 in the first lane", {0.0, 0.7}, roundingWithCancellation);
  const auto seventh = [](auto a, auto) {
    if constexpr (std::is_same_v<decltype(a), LongSeries>)
      return pow(a, 7);
    else
      return pow(a, 7.0);
  };
  checkAgainstLongSeries(seventh, "a double that is an integer", {-0.7, 0.7}, roundingWithCancellation);
  checkAgainstLongSeries([](auto a, auto b) { return pow(a, 0) + b * pow(b, 0); }, "power 0");
}

TEST(Operations, circular) {
  check([](auto a, auto b) { return sin(a) * b; }, "sin");
  check([](auto a, auto b) { return cos(a) * b; }, "cos");
  check([](auto a, auto b) { return tan(a) * b; }, "tan");
  check([](auto a, auto b) { return tan(b) * a; }, "tan on both sides of its pole", {0.3, 0.9, 2.2, 3.9});
}

TEST(Operations, hyperbolic) {
  check([](auto a, auto b) { return sinh(b) * a; }, "sinh");
  check([](auto a, auto b) { return cosh(b) * a; }, "cosh");
  check([](auto a, auto b) { return tanh(b) * a; }, "tanh");
  // In long double only: Sacado's 1 - tanh^2 cancels here. The same cancellation is in our oracle's
  // sinh/cosh, but with eleven bits to spare.
  checkAgainstLongSeries([](auto a, auto) { return tanh(a); }, "tanh far out", {2.0, 4.0});
}

TEST(Operations, inverseCircular) {
  check([](auto a, auto b) { return atan(b) * a; }, "atan");
  check([](auto a, auto b) { return asin(0.5 * a) * b; }, "asin");
  check([](auto a, auto b) { return acos(0.5 * a) * b; }, "acos");
}

TEST(Operations, sinCosOfOneArgument) {
  const auto f = [](auto a, auto b) {
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
  const auto g = [](auto a, auto b) {
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
  const auto r = runSeries(StandardFunctions{}, {pathParameter(rows.size())}, Mode::ZeroThenComplete);
  for (int i = 0; i < 8; ++i)
    expectSeries(
        r.out[i], [&](int) { return [&](int k) -> long double { return rows[k][i + 1]; }; }, rounding,
        "column " + std::to_string(i + 1));
}

TEST(Operations, referenceTangent) {
  const auto at0 = readColumns("taylor_tan.csv"), at1 = readColumns("taylor_tan_at1.csv");
  ASSERT_EQ(at0.size(), at1.size());
  const auto r = runSeries(Tangents{}, {pathParameter(at0.size())}, Mode::ZeroThenComplete);
  expectSeries(
      r.out[0], [&](int) { return [&](int k) -> long double { return at0[k][1]; }; }, rounding, "tan a");
  expectSeries(
      r.out[1], [&](int) { return [&](int k) -> long double { return at1[k][1]; }; }, rounding, "tan(1+a)");
}

}  // namespace
