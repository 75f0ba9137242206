// Orders and derivatives of formulas: against the functions' own series in long double, against Fad types,
// and those against central differences.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "SeriesRun.hpp"
#include "atrapos/formula/Parse.hpp"

using namespace atrapos;
using namespace atrapos::formula;

namespace {

/// in: u, w, lambda; datum: x.
struct FormulaLaw {
  static constexpr int numInputs = 3, numOutputs = 1, numData = 1;
  Program program;

  explicit FormulaLaw(const std::string& text) {
    Builder builder;
    const Symbols symbols{{{"u", builder.input(0)},
                           {"w", builder.input(1)},
                           {"lambda", builder.input(2)},
                           {"x", builder.datum(0)}},
                          {}};
    program = builder.program({parse(text, symbols, builder)});
  }

  template <class T>
  void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    evaluate(program, in, data, out);
  }
};

struct Case {
  const char* text;
  LongSeries (*series)(const LongSeries& u, const LongSeries& w, const LongSeries& lambda,
                       const LongSeries& x);
};

#define FORMULA(TEXT, ...)                                                                              \
  Case {                                                                                                \
    TEXT, [](const LongSeries& u, const LongSeries& w, const LongSeries& lambda, const LongSeries& x) { \
      (void)u, (void)w, (void)lambda, (void)x;                                                          \
      return LongSeries(__VA_ARGS__);                                                                   \
    }                                                                                                   \
  }

const Case cases[] = {
    FORMULA("lambda*exp(u)", lambda* exp(u)),
    FORMULA("x*u^3 - 2*w", x* u* u* u - 2.0 * w),
    FORMULA("u^2.5/(1 + w^2)", pow(u, 2.5) / (1.0 + w * w)),
    FORMULA("pow(u, w)", exp(w* log(u))),
    FORMULA("2^u + pow(x, w)", exp(std::log(2.0) * u) + exp(w * log(x))),
    FORMULA("log(u) + log10(w + lambda)", log(u) + log(w + lambda) / std::log(10.0)),
    FORMULA("sqrt(u*w + 1)", sqrt(u* w + LongSeries(1.0))),
    FORMULA("sin(u)*cos(w) + tan(x*u/2)", sin(u) * cos(w) + tan(0.5 * (x * u))),
    FORMULA("asin(u/3) - acos(w/3) + atan(lambda)", asin(u / 3.0) - acos(w / 3.0) + atan(lambda)),
    FORMULA("sinh(u)/cosh(w) + tanh(lambda*u)", sinh(u) / cosh(w) + tanh(lambda * u)),
    FORMULA("erf(u - w)", erf(u - w)),
    FORMULA("exp(u/(1 + 0.2*u))", exp(u / (1.0 + 0.2 * u))),
    FORMULA("-u - (-w)^-2", -u - 1.0 / (w * w))};

}  // namespace

/// Against the functions' own series in 64-bit mantissas. Tolerance: rounding errors of some ten operations,
/// each carried along by the recurrences (roundingScale).
TEST(FormulaOrders, AreThoseOfTheFunctions) {
  constexpr int K = 20;
  const Coefficients in{testSeries(K, 0.6, 1.1, 1), testSeries(K, 0.5, 0.9, 2), testSeries(K, 0.8, 1.2, 3)};
  const Values x = 0.3;
  for (const Case& c : cases)
    for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
      const auto result = runSeries(FormulaLaw(c.text), in, mode, &x);
      expectSeries(
          result.out[0],
          [&](int l) {
            const LongSeries expected =
                c.series(lane(in[0], l), lane(in[1], l), lane(in[2], l), LongSeries(0.3));
            return [expected](int k) { return expected.at(k); };
          },
          1e-13, c.text);
    }
}

TEST(FormulaTangents, ThreeWays) {
  for (const Case& c : cases) {
    const FormulaLaw law(c.text);
    const double in[] = {0.9, 0.7, 1.1}, x = 0.3;
    double value, slope[3];
    taylor::tangent(law, in, &x, &value, slope);
    for (int j = 0; j < 3; ++j) {
      const auto error = [&](double h) {
        double plus[] = {in[0], in[1], in[2]}, minus[] = {in[0], in[1], in[2]}, p, m;
        plus[j] += h;
        minus[j] -= h;
        law(plus, &x, &p);
        law(minus, &x, &m);
        return std::abs((p - m) / (2 * h) - slope[j]);
      };
      const double coarse = error(0.02), fine = error(0.01);
      if (coarse > 1e-10) {
        EXPECT_NEAR(coarse / fine, 4, 0.05) << c.text << ", input " << j;
      }
    }
    // Lanes against Fad types.
    taylor::Context<L> context;
    context.shape = taylor::historyShape(law);
    std::vector<double> memory(context.shape.doubles<L>(0));
    context.memory = memory.data();
    Values laneIn[3] = {in[0], in[1], in[2]}, laneX = x, laneOut, laneSlope[3];
    taylor::tangent(law, context, laneIn, &laneX, &laneOut, laneSlope);
    for (int j = 0; j < 3; ++j)
      EXPECT_NEAR(laneSlope[j][0], slope[j], 1e-13 * (1 + std::abs(slope[j]))) << c.text << ", input " << j;
  }
}

/// Outside the domain of one of its functions a formula has no series, and the function is named.
TEST(FormulaOrders, EndAtTheDomain) {
  const Coefficients in{testSeries(3, -1.0, -0.5, 1), testSeries(3, 0.5, 0.9, 2), testSeries(3, 0.8, 1.2, 3)};
  const Values x = 0.3;
  const auto series = runSeries(FormulaLaw("w + log(u)"), in, Mode::AsASolver, &x);
  EXPECT_EQ(series.failures.operation[0], taylor::Operation::Log);
  EXPECT_TRUE(std::isnan(series.out[0][0][0]));
}
