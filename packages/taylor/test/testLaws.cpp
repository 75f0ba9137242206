// Whole laws, explicit and implicit: against closed forms, reference files and long double series; a
// solver's use of the passes; the radius of convergence of a branch.

#include "TestLaws.hpp"
#include "SeriesRun.hpp"

namespace {

// Some tens of operations, each with sums of up to 31 rounded terms; seen: 20 to 40 eps.
constexpr double rounding = 100 * 2.2e-16;

template <class Law, class Oracle>
void checkLaw(const Law& law, const Oracle& oracle, const Coefficients& in, const Values* data,
              double tolerance) {
  const int n = Law::numInputs;
  for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
    const auto r = runSeries(law, in, mode, data);
    for (int i = 0; i < Law::numOutputs; ++i)
      expectSeries(
          r.out[i],
          [&](int l) {
            std::vector<LongSeries> x(n), y(Law::numOutputs);
            for (int j = 0; j < n; ++j) x[j] = lane(in[j], l);
            double d[Law::numData + 1];
            for (int j = 0; j < Law::numData; ++j) d[j] = data[j][l];
            oracle(x.data(), d, y.data());
            const LongSeries c = y[i];
            return [c](int k) { return c.at(k); };
          },
          tolerance, "output " + std::to_string(i));
  }
}

TEST(Laws, saintVenantKirchhoff) {
  Coefficients H;
  for (int i = 0; i < 9; ++i) H.push_back(testSeries(30, -0.4 + 0.1 * i, 0.5 - 0.05 * i, i + 1));
  const auto oracle = [](const LongSeries* x, const double*, LongSeries* y) {
    SaintVenantKirchhoff law;
    law.operator()<LongSeries>(x, nullptr, y);
  };
  // The stresses of order 0 of some lanes are small differences: their scale is that of the terms, about 1.
  checkLaw(SaintVenantKirchhoff{}, oracle, H, nullptr, rounding);
}

TEST(Laws, squarePlusExponential) {
  const auto rows = readColumns("taylor_x2_exp3x.csv");
  std::vector<Values> x(rows.size(), Values(0.0));
  for (int l = 0; l < L; ++l) x[0][l] = l % 2 == 0 ? 0.0 : 0.5;
  x[1] = 1.0;
  const auto r = runSeries(SquarePlusExponential{}, {x}, Mode::AsASolver);
  expectSeries(
      r.out[0], [&](int l) { return [&, l](int k) -> long double { return rows[k][1 + l % 2]; }; }, rounding,
      "x^2 + exp(3x)");
}

TEST(Laws, cylinderReference) {
  const auto rows = readColumns("projection_cylinder_taylor.csv");  // point (30, 50) + a (10, -20), r = 50
  Coefficients in(3, std::vector<Values>(rows.size(), Values(0.0)));
  in[0][0] = 30.0;
  in[0][1] = 10.0;
  in[2][0] = 50.0;
  in[2][1] = -20.0;
  const Values radius = 50.0;
  const auto r = runSeries(CylinderLaw{}, in, Mode::AsASolver, &radius);
  const int column[] = {1, 2, 0, 3};
  for (const int i : {0, 1, 3})
    expectSeries(
        r.out[i], [&](int) { return [&](int k) -> long double { return rows[k][column[i]]; }; },
        // Reference digits end at 1e-16 of the distance 58 (the gap is 8); the series decays as 2.6^-k, so
        // slightly faster than the scale assumes.
        rounding, "column " + std::to_string(column[i]));
  for (const auto& ny : r.out[2])
    for (int l = 0; l < L; ++l) EXPECT_EQ(ny[l], 0.0);
}

Coefficients contactPoint() {
  return {testSeries(30, 1.0, 2.0, 1), testSeries(30, -1.0, 1.0, 2), testSeries(30, 3.0, 4.0, 3)};
}

TEST(Laws, cylinderAgainstClosedForm) {
  Values radius;
  for (int l = 0; l < L; ++l) radius[l] = 2.5 + 0.1 * l;
  checkLaw(CylinderLaw{}, CylinderClosedForm{}, contactPoint(), &radius, rounding);
}

TEST(Laws, contactAgainstClosedForm) {
  Values gap;
  for (int l = 0; l < L; ++l) gap[l] = 1.0 + 0.1 * l;
  // From open (R small against alpha h) to pressed in.
  checkLaw(ContactLaw{}, ContactClosedForm{}, {testSeries(30, -0.3, 1.0, 1)}, &gap,
           // dg/dy = 2R/alpha + h is small near h = 0: its relative rounding error, |h|/|2R/alpha + h| times
           // larger, enters every order.
           1e-10);
}

TEST(Laws, implicitInsideALaw) {
  Values data[2];
  for (int l = 0; l < L; ++l) {
    data[0][l] = 2.5 + 0.1 * l;
    data[1][l] = 1.5;
  }
  checkLaw(ContactForce{}, ContactForceClosedForm{}, contactPoint(), data, 1e-10);  // as above
}

// P/(E A) = s (s^2 - 1)/2 as a bar's equation p = P(s): each order a sweep with zero, a scalar solve, a
// completion. What finite elements do, with one unknown.
struct BarForce {
  static constexpr int numInputs = 1, numOutputs = 1, numData = 0;
  template <class T>
  void operator()(const T* s, const Passive<T>*, T* p) const {
    p[0] = 0.5 * s[0] * (s[0] * s[0] - 1.0);
  }
};

std::vector<double> barBranch(int maxOrder) {
  using namespace atrapos::taylor;
  const BarForce law;
  Context<L> context;
  context.shape = historyShape(law);
  std::vector<double> memory(context.shape.doubles<L>(maxOrder)), s = {1.0};
  context.memory = memory.data();
  Values in = 1.0, out;
  const Values* none = nullptr;
  start(law, context, &in, none, &out);
  double p0, tangentAt1;
  tangent(law, s.data(), nullptr, &p0, &tangentAt1);
  for (int k = 1; k <= maxOrder; ++k) {
    context.order = k;
    sweep(law, context, none, &out);
    in = ((k == 1 ? 1.0 : 0.0) - out) / tangentAt1;
    s.push_back(in[L - 1]);
    complete(law, context, &in, none);
  }
  return s;
}

TEST(Laws, barBranch) {
  const auto rows = readColumns("stvk_bar_taylor.csv");
  const auto s = barBranch(static_cast<int>(rows.size()) - 1);
  // The coefficients alternate in sign and grow as 5.2^k: sums of equal signs, nothing cancels; k roundings.
  for (std::size_t k = 0; k < rows.size(); ++k)
    EXPECT_NEAR(s[k], rows[k][1], 1e-13 * std::fabs(rows[k][1])) << k;
}

TEST(Laws, barRadiusOfConvergence) {
  const int K = 60;
  const auto s = barBranch(K);
  // A square-root branch point at -p_c alone: s_k/s_{k-1} = -(1 - 3/(2k))/p_c (1 + O(1/k^2)).
  const double radius = -(1 - 1.5 / K) * s[K - 1] / s[K];
  EXPECT_NEAR(radius, 1 / (3 * std::sqrt(3.0)), 1.0 / (K * K) * radius);
}

}  // namespace
