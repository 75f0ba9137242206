// Laws given by an equation g(x, y) = 0: failures, the choice of a branch, units.

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
void expectOnlyLaneIsBad(F f, int bad, const Coefficients& in) {
  const auto r = runSeries(Unary<F>{f}, in, Mode::Direct);
  for (int l = 0; l < L; ++l) {
    bool finite = true;
    for (const auto& c : r.out[0]) finite = finite && std::isfinite(c[l]);
    EXPECT_EQ(finite, l != bad) << l;
  }
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
  const auto circle = [](auto a, auto) -> decltype(a) {
    auto b = a;
    b = 1.0;
    solveImplicit<1, 1>(UnitCircle{}, &a, &b);
    return b;
  };
  Coefficients in = {testSeries(6, 0.2, 0.7, 1), testSeries(6, 1, 2, 2)};
  in[0][0][L - 1] = 2.0;
  expectOnlyLaneIsBad(circle, L - 1, in);
}

// What needs no derivatives is found with less work, and is the same: to what the residual's rounding, 2 eps,
// leaves of y, as each compilation of the law fuses its multiply-adds in its own way.
TEST(Implicit, theValueAloneIsTheSame) {
  for (int i = -999; i < 1000; ++i) {
    const double x = i / 1000.0;
    for (const double guess : {1.0, 0.1, 7.0, std::sqrt(1 - x * x)}) {
      double y = guess;
      Sacado::Fad::SFad<double, 1> xf(1, 0, x), yf = guess;
      ASSERT_TRUE((solveImplicit<1, 1>(UnitCircle{}, &x, &y)));
      ASSERT_TRUE((solveImplicit<1, 1>(UnitCircle{}, &xf, &yf)));
      ASSERT_NEAR(y, yf.val(), 2 * 2.2e-16 / y) << x << " from " << guess;
    }
  }
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
  const auto r = runSeries(SignedRootLaw{}, in, Mode::AsASolver, &side);
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

}  // namespace
