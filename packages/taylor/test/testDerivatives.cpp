// First derivatives of whole laws computed five ways: Fad, Taylor order 1, completion,
// unit vectors in lanes, finite differences.

#include "SeriesRun.hpp"
#include "TestLaws.hpp"
#include "atrapos/taylor/FadFunctions.hpp"
#include "atrapos/taylor/Tensor.hpp"

using namespace atrapos::taylor;

namespace {

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

  // In lanes: NaN in the memory would show what is read before it is written.
  Context<L> context;
  context.shape = historyShape(law);
  std::vector<double> memory(context.shape.template doubles<L>(0), std::nan(""));
  context.memory = memory.data();
  const std::vector<Values> lanes(data.begin(), data.end()), there(in.begin(), in.end());
  Values valueInLanes[m], jacobianInLanes[n * m];
  tangent(law, context, there.data(), lanes.data(), valueInLanes, jacobianInLanes);
  double size = 0;
  for (const double d : jacobian) size = std::max(size, std::fabs(d));
  for (int l = 0; l < L; ++l) {
    for (int i = 0; i < m; ++i) EXPECT_NEAR(valueInLanes[i][l], values[i], 1e-13 * std::fabs(values[i]));
    for (int i = 0; i < n * m; ++i) EXPECT_NEAR(jacobianInLanes[i][l], jacobian[i], 1e-12 * size) << i;
  }

  Coefficients series(n, std::vector<Values>(2));
  for (int j = 0; j < n; ++j) {
    series[j][0] = in[j];
    series[j][1] = direction[j];
  }
  for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
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
  static constexpr int numInputs = 2, numOutputs = 6, numData = 0;
  template <class T>
  void operator()(const T* in, const Passive<T>*, T* out) const {
    using atrapos::taylor::erf, atrapos::taylor::expm1, atrapos::taylor::hypot, atrapos::taylor::log1p;
    using atrapos::taylor::sinCos, atrapos::taylor::sinhCosh;
    using std::acos, std::acosh, std::asin, std::asinh, std::atan, std::atan2, std::atanh, std::cbrt,
        std::cos, std::cosh, std::exp, std::log, std::log10, std::pow, std::sin, std::sinh, std::sqrt,
        std::tan, std::tanh;
    using std::erf, std::expm1, std::hypot, std::log1p;
    const T a = in[0], b = in[1];
    T s, c, sh, ch;
    sinCos(a, s, c);
    sinhCosh(b, sh, ch);
    out[0] = exp(a) * log(b) + sqrt(b) / pow(b, 1.5) + pow(a, 3) + pow(a, b) + pow(2.0, a);
    out[1] = sin(a) * cos(b) + tan(a) + log10(a + b) * cbrt(b);
    out[2] = sinh(a) * cosh(b) + tanh(a * b) + s * c + sh * ch;
    out[3] = asin(0.5 * a) * acos(0.5 * a) + atan(b) + atan2(a, b);
    out[4] = asinh(a) * acosh(1.5 + b) + atanh(0.5 * a);
    out[5] = erf(a) * expm1(b) + log1p(a * b) + hypot(a, b) + hypot(a, 2.0) * hypot(0.5, b);
  }
};
TEST(Derivatives, everyFunctionOfEachScalar) { checkDerivatives(EveryFunction{}, {0.4, 0.8}, {}); }

// Choices: for double and Fad on their values, for the series lane by lane.
struct Choices {
  static constexpr int numInputs = 2, numOutputs = 3, numData = 1;
  template <class T>
  void operator()(const T* in, const Passive<T>* data, T* out) const {
    using atrapos::taylor::if_then_else;
    using std::abs, std::fabs, std::max, std::min, std::exp;
    const T a = in[0], b = in[1], ab = a * b;
    out[0] = exp(fabs(a - b)) + abs(ab - 1.0) * ab;
    out[1] = exp(min(a, ab) + max(a, b)) + T(max(ab, T(data[0]))) * ab;
    out[2] = if_then_else(a < b, T(exp(ab)), T(a * a)) + if_then_else(ab > data[0], ab, T(2.0)) * ab * b;
  }
};
TEST(Derivatives, choices) {
  checkDerivatives(Choices{}, {0.4, 0.8}, {0.5});
  checkDerivatives(Choices{}, {0.9, 0.7}, {0.5});
}

}  // namespace
