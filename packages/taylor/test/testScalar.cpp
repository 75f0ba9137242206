// The rules of the scalar: slots, passive values, overwritten variables, domains; and first derivatives
// computed three ways.

#include "SeriesRun.hpp"
#include "TestLaws.hpp"

using namespace atrapos::taylor;

namespace {

template <class F>
struct Unary {
  static constexpr int numInputs = 2, numOutputs = 1, numData = 0;
  F f;
  template <class T>
  void operator()(const T* in, const Passive<T>*, T* out) const {
    out[0] = f(in[0], in[1]);
  }
};

template <class F>
int slotsOf(F f) {
  return historySlots<L>(Unary<F>{f}) - 2;  // besides the two inputs
}

TEST(Slots, linearOperationsTakeNone) {
  EXPECT_EQ(slotsOf([](auto a, auto b) { return 2.0 * (a - b) / 3.0 + 1.0; }), 0);
}

TEST(Slots, productsAndTheirResultsTakeNoneButOperandsDo) {
  EXPECT_EQ(slotsOf([](auto a, auto b) { return a * b; }), 0);
  EXPECT_EQ(slotsOf([](auto a, auto b) { return a * b * b; }), 1);    // a b
  EXPECT_EQ(slotsOf([](auto a, auto b) { return (a + b) * b; }), 1);  // a + b
}

TEST(Slots, resultsWithTheirOwnRecurrenceKeepTheirSlot) {
  EXPECT_EQ(slotsOf([](auto a, auto b) { return a / b; }), 1);
  EXPECT_EQ(slotsOf([](auto a, auto b) {
              const auto q = a / b;
              return q * q * a;
            }),
            2);  // q and q q
  EXPECT_EQ(slotsOf([](auto a, auto) { return exp(a) * sqrt(a); }), 2);
}

TEST(Slots, anOperandUsedTwiceTakesOne) {
  EXPECT_EQ(slotsOf([](auto a, auto b) {
              const auto c = a + b;
              return c * a + c * b + c * c;
            }),
            1);
}

TEST(Slots, layout) {
  EXPECT_EQ(historyDoubles<L>(3, 20), 3u * 21u * L);
  const auto square = [](auto a, auto) { return a * a; };
  const auto a = testSeries(5, 1, 2, 1), b = testSeries(5, 3, 4, 2);
  const auto r = runSeries(Unary<decltype(square)>{square}, {a, b}, Mode::Direct);
  for (int k = 0; k <= 5; ++k)
    for (int l = 0; l < L; ++l) {
      EXPECT_EQ(r.history[k * L + l], a[k][l]);
      EXPECT_EQ(r.history[(6 + k) * L + l], b[k][l]);
    }
}

// A variable that is overwritten loses its history, a copy keeps it.
struct Overwriting {
  static constexpr int numInputs = 2, numOutputs = 3, numData = 0;
  template <class T>
  void operator()(const T* in, const Passive<T>*, T* out) const {
    T t = in[0] + in[1];
    const T first = t * t;
    const T copy = t;
    t = in[0] * in[1];
    const T second = t * t;
    t = 2.0;
    out[0] = t * in[0];
    t += in[1];
    out[1] = t * t + first;
    out[2] = second * copy;
  }
};

TEST(Scalar, overwrittenVariables) {
  const Coefficients in = {testSeries(20, 0.5, 1, 1), testSeries(20, 1, 2, 2)};
  for (const Mode mode : {Mode::Direct, Mode::ZeroThenComplete}) {
    const auto r = runSeries(Overwriting{}, in, mode);
    for (int i = 0; i < 3; ++i)
      expectSeries(
          r.out[i],
          [&](int l) {
            const LongSeries x[2] = {lane(in[0], l), lane(in[1], l)};
            LongSeries y[3];
            Overwriting{}.operator()<LongSeries>(x, nullptr, y);
            const LongSeries c = y[i];
            return [c](int k) { return c.at(k); };
          },
          200 * 2.2e-16,  // three nested sums of up to 21 rounded terms
          "output " + std::to_string(i));
  }
}

struct PassiveOutputs {
  static constexpr int numInputs = 1, numOutputs = 4, numData = 1;
  template <class T>
  void operator()(const T* in, const Passive<T>* data, T* out) const {
    using std::sqrt;
    out[0] = 7.0;
    out[1] = sqrt(T(data[0])) * 2.0;
    out[2] = T(data[0]) / T(4.0) * T(3.0);
    out[3] = in[0] * data[0] + data[0];
  }
};

TEST(Scalar, outputsThatDoNotDependOnTheInputs) {
  Values data;
  for (int l = 0; l < L; ++l) data[l] = 1.0 + l;
  const std::vector<Values> in = testSeries(3, 1, 2, 1);
  for (const Mode mode : {Mode::Direct, Mode::ZeroThenComplete}) {
    const auto r = runSeries(PassiveOutputs{}, {in}, mode, &data);
    for (int l = 0; l < L; ++l) {
      EXPECT_EQ(r.out[0][0][l], 7.0);
      EXPECT_DOUBLE_EQ(r.out[1][0][l], 2 * std::sqrt(1.0 + l));
      EXPECT_DOUBLE_EQ(r.out[2][0][l], 0.75 * (1.0 + l));
      EXPECT_DOUBLE_EQ(r.out[3][0][l], (in[0][l] + 1) * (1.0 + l));
      for (int k = 1; k <= 3; ++k) {
        for (int i = 0; i < 3; ++i) EXPECT_EQ(r.out[i][k][l], 0.0);
        EXPECT_DOUBLE_EQ(r.out[3][k][l], in[k][l] * (1.0 + l));
      }
    }
  }
}

template <class F>
void expectOnlyLaneIsBad(F f, int bad, const Coefficients& in) {
  const auto r = runSeries(Unary<F>{f}, in, Mode::Direct);
  for (int l = 0; l < L; ++l) {
    bool finite = true;
    for (const auto& c : r.out[0]) finite = finite && std::isfinite(c[l]);
    EXPECT_EQ(finite, l != bad) << l;
  }
}

TEST(Scalar, leavingADomainIsNotFiniteInItsLaneOnly) {
  Coefficients in = {testSeries(6, 0.5, 0.9, 1), testSeries(6, 1, 2, 2)};
  in[0][0][3] = -0.5;
  expectOnlyLaneIsBad([](auto a, auto) { return sqrt(a); }, 3, in);
  expectOnlyLaneIsBad([](auto a, auto) { return log(a); }, 3, in);
  expectOnlyLaneIsBad([](auto a, auto) { return pow(a, 0.5); }, 3, in);
  in[0][0][3] = 0.0;
  expectOnlyLaneIsBad([](auto a, auto) { return sqrt(a); }, 3, in);
  expectOnlyLaneIsBad([](auto a, auto) { return log(a); }, 3, in);
  expectOnlyLaneIsBad([](auto a, auto) { return pow(a, 2.5); }, 3, in);
  expectOnlyLaneIsBad([](auto a, auto b) { return b / a; }, 3, in);
  expectOnlyLaneIsBad([](auto a, auto) { return pow(a, -2); }, 3, in);
  in[0][0][3] = 1.5;
  expectOnlyLaneIsBad([](auto a, auto) { return asin(a); }, 3, in);
}

// x^2 + y^2 = 1 has no y where |x| > 1.
struct UnitCircle {
  template <class T>
  void operator()(const T* x, const T* y, T* g) const {
    g[0] = x[0] * x[0] + y[0] * y[0] - 1.0;
  }
};

TEST(Implicit, failureIsReportedAndIsNaN) {
  double x = 0.6, y = 1.0;
  EXPECT_TRUE((solveImplicit<1, 1>(UnitCircle{}, &x, &y)));
  EXPECT_NEAR(y, 0.8, 4e-16);  // Newton ends at rounding: a few units in the last place
  x = 2;
  y = 1;
  EXPECT_FALSE((solveImplicit<1, 1>(UnitCircle{}, &x, &y)));
  EXPECT_TRUE(std::isnan(y));
  Sacado::Fad::SFad<double, 1> xf(1, 0, 2.0), yf = 1.0;
  EXPECT_FALSE((solveImplicit<1, 1>(UnitCircle{}, &xf, &yf)));
  EXPECT_TRUE(std::isnan(yf.val()));
  const auto circle = [](auto a, auto) {
    auto b = a;
    b = 1.0;
    solveImplicit<1, 1>(UnitCircle{}, &a, &b);
    return b;
  };
  Coefficients in = {testSeries(6, 0.2, 0.7, 1), testSeries(6, 1, 2, 2)};
  in[0][0][5] = 2.0;
  expectOnlyLaneIsBad(circle, 5, in);
}

// The branch of y = +-sqrt(x_1^2 - x_0^2) that each point wants: a choice by value belongs in start.
struct SignedRoot {
  void start(const double* x, const double* side, double* y) const { y[0] = side[0] < 0 ? -x[1] : x[1]; }
  template <class T>
  void operator()(const T* x, const T* y, const Passive<T>*, T* g) const {
    g[0] = x[0] * x[0] + y[0] * y[0] - x[1] * x[1];
  }
};

struct SignedRootLaw {
  static constexpr int numInputs = 2, numOutputs = 1, numData = 1;
  template <class T>
  void operator()(const T* in, const Passive<T>* data, T* out) const {
    solveImplicit<2, 1, 1>(SignedRoot{}, in, data, out);
  }
};

TEST(Implicit, theLawsOwnStartChoosesTheBranchInEachLane) {
  const Coefficients in = {testSeries(20, 0.2, 0.7, 1), testSeries(20, 1, 2, 2)};
  Values side;
  for (int l = 0; l < L; ++l) side[l] = l % 3 == 0 ? -1 : 1;
  const auto r = runSeries(SignedRootLaw{}, in, Mode::ZeroThenComplete, &side);
  expectSeries(
      r.out[0],
      [&](int l) {
        const LongSeries x = lane(in[0], l), y = lane(in[1], l);
        const LongSeries c = side[l] * sqrt(y * y - x * x);
        return [c](int k) { return c.at(k); };
      },
      200 * 2.2e-16,  // three nested sums of up to 21 rounded terms, and one division by y_0
      "signed root");
}

TEST(Implicit, solutionIsIndependentOfTheUnits) {
  // The contact law from kilo to pico units of force: the same to rounding, however small R.
  for (const double unit : {1e3, 1.0, 1e-12}) {
    const double in = 0.9999999, gap = 1;
    double implicit, closed;
    const ContactLaw law{1000 * unit, 0.1 * unit};
    value(law, &in, &gap, &implicit);
    // Rationalised, because the closed form as printed cancels here: R = 2 eta (Delta - h)/(h + sqrt(...)).
    const double root = std::sqrt(in * in + 4 * law.eta / law.alpha * (gap - in));
    closed = 2 * law.eta * (gap - in) / (in + root);
    EXPECT_NEAR(implicit, closed, 1e-14 * closed);  // two well-conditioned formulas of ten operations
  }
}

// d out along a direction: central differences (error falling as step^2), Fad, Taylor order 1, Complete.
template <class Law>
void checkDerivatives(const Law& law, const std::vector<double>& in, const std::vector<double>& data) {
  constexpr int n = Law::numInputs, m = Law::numOutputs;
  double out[m], jacobian[n * m], direction[n], byFad[m];
  for (int j = 0; j < n; ++j) direction[j] = std::cos(1.0 + j);
  tangent(law, in.data(), data.data(), out, jacobian);
  double values[m];
  value(law, in.data(), data.data(), values);
  double scale = 0;
  for (int i = 0; i < m; ++i) {
    EXPECT_NEAR(out[i], values[i], 1e-13 * std::fabs(values[i]));  // same operations, other order of rounding
    byFad[i] = 0;
    for (int j = 0; j < n; ++j) byFad[i] += jacobian[i * n + j] * direction[j];
    scale = std::max(scale, std::fabs(byFad[i]));
  }

  Coefficients series(n, std::vector<Values>(2));
  for (int j = 0; j < n; ++j) {
    series[j][0] = in[j];
    series[j][1] = direction[j];
  }
  std::vector<Values> lanes(data.begin(), data.end());
  for (const Mode mode : {Mode::Direct, Mode::ZeroThenComplete}) {
    const auto r = runSeries(law, series, mode, lanes.data());
    for (int i = 0; i < m; ++i)
      for (int l = 0; l < L; ++l)
        EXPECT_NEAR(r.out[i][1][l], byFad[i], 1e-12 * scale) << i;  // rounding, see above
  }

  const auto error = [&](double step) {
    std::vector<double> ahead = in, behind = in;
    for (int j = 0; j < n; ++j) {
      ahead[j] += step * direction[j];
      behind[j] -= step * direction[j];
    }
    double fa[m], fb[m], e = 0;
    value(law, ahead.data(), data.data(), fa);
    value(law, behind.data(), data.data(), fb);
    for (int i = 0; i < m; ++i) e = std::max(e, std::fabs((fa[i] - fb[i]) / (2 * step) - byFad[i]));
    return e;
  };
  // Steps where the step^2 term is far above rounding (1e-16/step) and far above the step^4 term: a wrong
  // derivative leaves an error that does not fall, ratio 1.
  const double ratio = error(2e-3) / error(1e-3);
  EXPECT_NEAR(ratio, 4.0, 0.05);
}

TEST(Derivatives, saintVenantKirchhoff) {
  checkDerivatives(SaintVenantKirchhoff{}, {0.1, -0.2, 0.3, 0.05, 0.2, -0.1, 0.15, 0.25, -0.3}, {});
}
TEST(Derivatives, squarePlusExponential) { checkDerivatives(SquarePlusExponential{}, {0.4}, {}); }
TEST(Derivatives, cylinder) { checkDerivatives(CylinderLaw{}, {1.2, 0.4, 3.1}, {2.8}); }
TEST(Derivatives, contact) { checkDerivatives(ContactLaw{}, {0.3}, {1.0}); }
TEST(Derivatives, contactForce) { checkDerivatives(ContactForce{}, {1.2, 0.4, 3.1}, {2.8, 1.0}); }

// The law author's idiom: one source, std for double, argument-dependent look-up for the others.
struct EveryFunction {
  static constexpr int numInputs = 2, numOutputs = 4, numData = 0;
  template <class T>
  void operator()(const T* in, const Passive<T>*, T* out) const {
    using atrapos::taylor::sinCos, atrapos::taylor::sinhCosh;
    using std::acos, std::asin, std::atan, std::cos, std::cosh, std::exp, std::log, std::pow, std::sin,
        std::sinh, std::sqrt, std::tan, std::tanh;
    const T a = in[0], b = in[1];
    T s, c, sh, ch;
    sinCos(a, s, c);
    sinhCosh(b, sh, ch);
    out[0] = exp(a) * log(b) + sqrt(b) / pow(b, 1.5) + pow(a, 3);
    out[1] = sin(a) * cos(b) + tan(a);
    out[2] = sinh(a) * cosh(b) + tanh(a * b) + s * c + sh * ch;
    out[3] = asin(0.5 * a) * acos(0.5 * a) + atan(b);
  }
};
TEST(Derivatives, everyFunctionOfEachScalar) { checkDerivatives(EveryFunction{}, {0.4, 0.8}, {}); }

}  // namespace
