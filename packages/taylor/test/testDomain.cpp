// The edges of the operations' domains: right where there is a series, otherwise NaN at order 0 in that lane
// alone and a note of operation and value; and what the note says.

#include <limits>

#include "OperationChecks.hpp"
#include "TestLaws.hpp"

using namespace atrapos::taylor;

namespace {

constexpr int badLane = L - 1;
constexpr int orders = 6;

/// The first operand leaves the domain with order-0 value x in one lane; elsewhere it lies in [0.5, 0.9].
template <class F>
void expectOutside(F f, double x, Operation operation, double noted) {
  Coefficients in = {testSeries(orders, 0.5, 0.9, 1), testSeries(orders, 1, 2, 2)};
  in[0][0][badLane] = x;
  for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
    const auto r = runSeries(Binary<F>{f}, in, mode);
    // Where order 0 does not exist nobody asks for the others.
    EXPECT_TRUE(std::isnan(r.out[0][0][badLane])) << describe(operation, x);
    for (int l = 0; l < L; ++l)
      for (int k = 0; k <= orders && l != badLane; ++k)
        EXPECT_TRUE(std::isfinite(r.out[0][k][l]))
            << describe(operation, x) << " lane " << l << " order " << k;
    for (int l = 0; l < L; ++l) {
      EXPECT_EQ(r.failures.operation[l], l == badLane ? operation : Operation::None)
          << describe(operation, x);
      EXPECT_EQ(r.failures.value[l], l == badLane ? noted : 0.0) << describe(operation, x);
    }
  }
}
template <class F>
void expectOutside(F f, double x, Operation operation) {
  expectOutside(f, x, operation, x);
}

TEST(Domain, rootsAndLogarithms) {
  for (const double x : {0.0, -0.5}) {
    expectOutside([](auto a, auto) -> decltype(a) { return sqrt(a); }, x, Operation::Sqrt);
    expectOutside([](auto a, auto) -> decltype(a) { return log(a); }, x, Operation::Log);
    expectOutside([](auto a, auto) -> decltype(a) { return log10(a); }, x, Operation::Log10);
  }
  expectOutside([](auto a, auto) -> decltype(a) { return cbrt(a); }, 0.0, Operation::Cbrt);
  expectOutside([](auto a, auto) -> decltype(a) { return log1p(a); }, -1.0, Operation::Log1p);
  expectOutside([](auto a, auto) -> decltype(a) { return log1p(a); }, -1.5, Operation::Log1p);
  expectOutside([](auto a, auto) -> decltype(a) { return hypot(a, 2.0 * a); }, 0.0, Operation::Hypot);
}

TEST(Domain, quotient) {
  expectOutside([](auto a, auto b) -> decltype(a) { return b / a; }, 0.0, Operation::Division);
  expectOutside([](auto a, auto) -> decltype(a) { return a / a; }, 0.0, Operation::Division);
}

TEST(Domain, inverseFunctions) {
  for (const double x : {1.0, -1.0, 1.5, -1.5}) {
    expectOutside([](auto a, auto) -> decltype(a) { return asin(a); }, x, Operation::Asin);
    expectOutside([](auto a, auto) -> decltype(a) { return acos(a); }, x, Operation::Acos);
    expectOutside([](auto a, auto) -> decltype(a) { return atanh(a); }, x, Operation::Atanh);
  }
  expectOutside([](auto a, auto) -> decltype(a) { return acosh(1.0 + a); }, 0.0, Operation::Acosh, 1.0);
  expectOutside([](auto a, auto) -> decltype(a) { return acosh(1.0 + a); }, -3.0, Operation::Acosh, -2.0);
  expectOutside([](auto a, auto) -> decltype(a) { return atan2(a, 3.0 * a); }, 0.0, Operation::Atan2);
}

TEST(Domain, powers) {
  expectOutside([](auto a, auto) -> decltype(a) { return pow(a, 0.5); }, -0.5, Operation::Pow);
  expectOutside([](auto a, auto) -> decltype(a) { return pow(a, 2.5); }, 0.0, Operation::Pow);
  expectOutside([](auto a, auto) -> decltype(a) { return pow(a, -2); }, 0.0, Operation::Pow);
  expectOutside([](auto a, auto) -> decltype(a) { return pow(a, -1.0); }, 0.0, Operation::Pow);
  expectOutside([](auto a, auto) -> decltype(a) { return pow(a, Passive<decltype(a)>(2.0)); }, 0.0,
                Operation::Pow);
  expectOutside([](auto a, auto) -> decltype(a) { return pow(a, Passive<decltype(a)>(2.5)); }, -1.0,
                Operation::Pow);
  expectOutside([](auto a, auto b) -> decltype(a) { return pow(a, b); }, -0.5, Operation::Pow);
  expectOutside([](auto a, auto b) -> decltype(a) { return pow(a, b); }, 0.0, Operation::Pow);
}

// A base that no lane may have.
TEST(Domain, powersOfPassiveBases) {
  const Coefficients in = {testSeries(orders, 0.5, 0.9, 1), testSeries(orders, 1, 2, 2)};
  const auto check = [&](auto f, double base) {
    const auto r = runSeries(Binary<decltype(f)>{f}, in, Mode::Direct);
    for (int l = 0; l < L; ++l) {
      EXPECT_TRUE(std::isnan(r.out[0][0][l]) && std::isnan(r.out[0][2][l]));
      EXPECT_EQ(r.failures.operation[l], Operation::Pow);
      EXPECT_EQ(r.failures.value[l], base);
    }
  };
  check([](auto a, auto) -> decltype(a) { return pow(-2.0, a); }, -2.0);
  check([](auto a, auto) -> decltype(a) { return pow(0.0, a); }, 0.0);
  check([](auto a, auto) -> decltype(a) { return pow(Passive<decltype(a)>(-2.0), a); }, -2.0);
  check([](auto a, auto) -> decltype(a) { return pow(decltype(a)(-2.0), a); }, -2.0);
  // Constants alone are a number, whatever the base.
  const auto constants = [](auto a, auto) -> decltype(a) { return pow(-2.0, decltype(a)(3.0)) * a; };
  const auto r = runSeries(Binary<decltype(constants)>{constants}, in, Mode::Direct);
  for (int k = 0; k <= orders; ++k) EXPECT_EQ(r.out[0][k][badLane], -8.0 * in[0][k][badLane]);
}

TEST(Domain, integerPowersAtZeroAreInside) {
  Coefficients in = {std::vector<Values>(7, Values(0.0)), std::vector<Values>(7, Values(0.0))};
  in[0][1] = 2.0;  // a = 2t, b = 0
  const auto check = [&](auto f, int degree, double coefficient) {
    for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
      const auto r = runSeries(Binary<decltype(f)>{f}, in, mode);
      EXPECT_EQ(r.failures.operation[0], Operation::None);
      for (int k = 0; k <= 6; ++k) EXPECT_EQ(r.out[0][k][0], k == degree ? coefficient : 0.0) << k;
    }
  };
  check([](auto a, auto) -> decltype(a) { return pow(a, 3); }, 3, 8.0);
  check([](auto a, auto) -> decltype(a) { return pow(a, 5.0); }, 5, 32.0);
  check([](auto a, auto) -> decltype(a) { return pow(a, 1); }, 1, 2.0);
  check([](auto a, auto b) -> decltype(a) { return pow(a, 0) + pow(b, 0.0); }, 0, 2.0);
  check([](auto, auto b) { return pow(b, 2); }, 0, 0.0);
  check([](auto a, auto) -> decltype(a) { return sin(a) - 0.5 * (exp(a) - exp(-a)) * 0.0 - sin(a); }, 0, 0.0);
}

TEST(Domain, tiesHaveNoSeries) {
  expectOutside([](auto a, auto) -> decltype(a) { return fabs(a); }, 0.0, Operation::Abs);
  expectOutside([](auto a, auto) -> decltype(a) { return abs(a); }, -0.0, Operation::Abs);
  expectOutside([](auto a, auto) -> decltype(a) { return min(a, 0.25); }, 0.25, Operation::Min);
  expectOutside([](auto a, auto) -> decltype(a) { return max(0.25, a); }, 0.25, Operation::Max);
  expectOutside([](auto a, auto) -> decltype(a) { return max(a, 2.0 * a); }, 0.0, Operation::Max);
}

// g(x, y) = 0 without a solution: the lane's note says how far Newton came.
struct Circle {
  template <class T>
  void operator()(const T* x, const T* y, T* g) const {
    g[0] = x[0] * x[0] + y[0] * y[0] - 1.0;
  }
};

TEST(Domain, implicitLaws) {
  const auto f = [](auto a, auto) -> decltype(a) {
    decltype(a) y = 1.0;
    solveImplicit<1, 1>(Circle{}, &a, &y);
    return y;
  };
  Coefficients in = {testSeries(orders, 0.2, 0.7, 1), testSeries(orders, 1, 2, 2)};
  in[0][0][badLane] = 2.0;
  const auto r = runSeries(Binary<decltype(f)>{f}, in, Mode::AsASolver);
  for (int l = 0; l < L; ++l) {
    EXPECT_EQ(r.failures.operation[l], l == badLane ? Operation::Implicit : Operation::None);
    for (int k = 0; k <= orders; ++k) EXPECT_EQ(std::isnan(r.out[0][k][l]), l == badLane);
  }
  EXPECT_GT(r.failures.value[badLane], 0.1);  // x^2 = 4 against 1: far from a root
}

TEST(Domain, theFirstFailureIsTheOneReported) {
  // In statements of their own: the operands of + are evaluated in an order that the compiler chooses.
  expectOutside(
      [](auto a, auto) -> decltype(a) {
        const decltype(a) root = sqrt(a);
        const decltype(a) logarithm = log(a);
        return root + logarithm;
      },
      -0.5, Operation::Sqrt);
  expectOutside(
      [](auto a, auto) -> decltype(a) {
        const decltype(a) logarithm = log(a);
        return sqrt(logarithm * logarithm + 1.0);
      },
      -0.5, Operation::Log);
}

// log(a) for a > 0, a^2 elsewhere, in every lane the one that exists; a passes 0 exactly in one lane.
TEST(Domain, anUnchosenBranchDoesNoHarm) {
  const auto guarded = [](auto a, auto b) -> decltype(a) {
    using std::log, std::sqrt;
    return if_then_else(a > 0.0, log(a) + sqrt(a), a * a) * b;
  };
  Coefficients in = {testSeries(20, -0.75, 1.0, 1), testSeries(20, 1, 2, 2)};
  in[0][0][badLane] = 0.0;
  for (const Mode mode : {Mode::Direct, Mode::AsASolver})
    expectSeries(
        runSeries(Binary<decltype(guarded)>{guarded}, in, mode).out[0],
        [&](int l) {
          const LongSeries a = lane(in[0], l), b = lane(in[1], l);
          const LongSeries c = (a > 0.0 ? log(a) + sqrt(a) : a * a) * b;
          return [c](int k) { return c.at(k); };
        },
        // a_0 = 0.25 with coefficients of size 0.5^(k+1): the logarithm's sums hold cancelling terms.
        1e-11, "guarded");
}

TEST(Domain, everyNoteIsOneClearLine) {
  EXPECT_EQ(describe(Operation::Log, -0.3), "log of -0.3: its argument must be positive");
  EXPECT_EQ(describe(Operation::Log10, 0), "log10 of 0: its argument must be positive");
  EXPECT_EQ(describe(Operation::Log1p, -1), "log1p of -1: its argument must be above -1");
  EXPECT_EQ(describe(Operation::Sqrt, -1e-9), "sqrt of -1e-09: its argument must be positive");
  EXPECT_EQ(describe(Operation::Cbrt, 0), "cbrt of 0: its argument must not vanish");
  EXPECT_EQ(describe(Operation::Hypot, 0), "hypot of 0: its arguments must not both vanish");
  EXPECT_EQ(describe(Operation::Division, 0), "division by 0: the divisor must not vanish");
  EXPECT_EQ(describe(Operation::Asin, 2), "asin of 2: its argument must lie between -1 and 1");
  EXPECT_EQ(describe(Operation::Acos, -2), "acos of -2: its argument must lie between -1 and 1");
  EXPECT_EQ(describe(Operation::Atan2, 0), "atan2 of 0: its arguments must not both vanish");
  EXPECT_EQ(describe(Operation::Acosh, 0.5), "acosh of 0.5: its argument must be above 1");
  EXPECT_EQ(describe(Operation::Atanh, 1), "atanh of 1: its argument must lie between -1 and 1");
  EXPECT_EQ(describe(Operation::Abs, 0), "abs of 0: its argument must not vanish");
  EXPECT_EQ(describe(Operation::Min, 0.25), "min of 0.25: its arguments must differ");
  EXPECT_EQ(describe(Operation::Max, 0.25), "max of 0.25: its arguments must differ");
  EXPECT_EQ(
      describe(Operation::Pow, -0.5),
      "pow of -0.5: the base must be positive where the exponent is not an integer, and must not vanish "
      "where it is negative or differs from point to point");
  EXPECT_EQ(
      describe(Operation::Implicit, 0.75),
      "the local system g(x, y) = 0 has no regular solution here: Newton's method ended with a relative "
      "residual of 0.75");
  EXPECT_EQ(describe(Operation::Result, 0), "the law's result is not a number");
  const DomainError error(Operation::Sqrt, -2, "solid, element 7, point 3");
  EXPECT_STREQ(error.what(), "solid, element 7, point 3: sqrt of -2: its argument must be positive");
  EXPECT_EQ(error.operation, Operation::Sqrt);
  EXPECT_EQ(error.value, -2);
}

}  // namespace
