// The gap-pressure law, paper (15), against its quadratic formula and its inverse.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "SeriesRun.hpp"
#include "atrapos/contact/RegularisedPressure.hpp"
#include "support/Differences.hpp"

using namespace atrapos;
using contact::RegularisedPressure;
using namespace atrapos::contact::test;

namespace {

/// The law of one variable: in = gap, data = reference gap, out = pressure.
struct PressureOfGap {
  static constexpr int numInputs = 1, numOutputs = 1, numData = 1;
  RegularisedPressure law;
  template <class T>
  void operator()(const T* h, const taylor::Passive<T>* Delta, T* R) const {
    R[0] = T(0.0);
    taylor::solveImplicit<1, 1, 1>(law, h, Delta, R);
  }
};

double pressure(const RegularisedPressure& law, double h, double Delta) {
  double R;
  taylor::value(PressureOfGap{law}, &h, &Delta, &R);
  return R;
}

long double exactPressure(const RegularisedPressure& law, long double h, long double Delta) {
  const long double c = law.compliance, eta = law.eta, load = eta * (Delta - h);
  const long double root = std::sqrt(h * h + 4 * c * load);
  return h > 0 ? 2 * load / (h + root) : (root - h) / (2 * c);
}

/// Every combination of compliance, eta and Delta over many decades for which the law has its branch.
template <class F>
void forLaws(const F& f) {
  for (const double compliance : {0.0, 1e-14, 1e-9, 1e-6, 1e-3, 1.0})
    for (const double eta : {1e-12, 1e-5, 0.1, 1e4})
      for (const double Delta : {1e-9, 1e-3, 1.0, 1e3})
        if (Delta > 1.5 * compliance * eta) f(RegularisedPressure{compliance, eta}, Delta);
}

TEST(RegularisedPressure, IsTheRootWithoutCancellationOverManyDecades) {
  int compared = 0;
  forLaws([&](const RegularisedPressure& law, double Delta) {
    for (int decade = -18; decade <= 8; ++decade)
      for (const double sign : {1.0, -1.0}) {
        const double h = sign * 0.7 * Delta * std::pow(10.0, decade);
        if (h <= 0 && law.compliance == 0) continue;
        const long double exact = exactPressure(law, h, Delta);
        // Beyond Delta the square root's argument is a difference of its two terms.
        const double terms = h * h + 4 * law.compliance * law.eta * std::abs(Delta - h);
        const double argument = h * h + 4 * law.compliance * law.eta * (Delta - h);
        // About ten operations, none of which cancels.
        EXPECT_NEAR(pressure(law, h, Delta), exact, 10 * eps * terms / argument * std::abs(exact))
            << "c " << law.compliance << " eta " << law.eta << " Delta " << Delta << " h " << h;
        ++compared;
      }
  });
  EXPECT_GT(compared, 3000);
}

TEST(RegularisedPressure, VanishesExactlyAtTheReferenceGap) {
  forLaws([](const RegularisedPressure& law, double Delta) { EXPECT_EQ(pressure(law, Delta, Delta), 0.0); });
}

TEST(RegularisedPressure, FallsWithTheGapAndStaysOnThePhysicalBranch) {
  forLaws([](const RegularisedPressure& law, double Delta) {
    double before = std::numeric_limits<double>::infinity();
    for (double h = law.compliance > 0 ? -3 * Delta : 0.01 * Delta; h < 5 * Delta; h += 0.0625 * Delta) {
      const double R = pressure(law, h, Delta);
      EXPECT_LE(R, before);    // equal only where the change is below rounding
      EXPECT_GT(R, -law.eta);  // the other branch of the conic lies below
      EXPECT_EQ(R > 0, h < Delta);
      // The inverse of the branch. Its numerator is a difference, hence the size of its terms.
      const double c = law.compliance, eta = law.eta;
      const double size =
          (eta * Delta + c * R * R) / (R + eta) + std::abs(h) * (eta + std::abs(R)) / (eta + R);
      EXPECT_NEAR((eta * Delta - c * R * R) / (R + eta), h, 20 * eps * size) << c << ' ' << eta << ' ' << h;
      before = R;
    }
  });
}

TEST(RegularisedPressure, RigidContactAdmitsNoPenetration) {
  const RegularisedPressure rigid{0, 0.1};
  for (const double h : {0.0, -1e-12, -1.0}) {
    const double Delta = 1;
    double R = 0;
    EXPECT_FALSE((taylor::solveImplicit<1, 1, 1>(rigid, &h, &Delta, &R)));
    EXPECT_TRUE(std::isnan(R)) << h;
  }
}

TEST(RegularisedPressure, DoesNotDependOnUnits) {
  const double lengthUnit = 25.4, pressureUnit = 6.894757e-3;
  forLaws([&](const RegularisedPressure& law, double Delta) {
    const RegularisedPressure other{law.compliance * lengthUnit / pressureUnit, law.eta * pressureUnit};
    for (const double part : {-1.0, -1e-5, 1e-9, 1e-3, 0.3, 3.0}) {
      if (part < 0 && law.compliance == 0) continue;
      const double R = pressure(law, part * Delta, Delta);
      const double scaled = pressure(other, part * Delta * lengthUnit, Delta * lengthUnit);
      // Rounding of the scaled numbers themselves; the argument of the root is at worst 1/9 of its terms here
      // (Delta = 1.5 eta/alpha), Delta - h at least 0.7 Delta.
      EXPECT_NEAR(scaled, R * pressureUnit, 100 * eps * std::abs(R * pressureUnit));
    }
  });
}

// dR/dh = -(R + eta)/(2 c R + h), from (15).
TEST(RegularisedPressure, DerivativeThreeWays) {
  for (const double compliance : {0.0, 1e-3})
    for (const double h : {-0.2, -0.02, 1e-3, 0.02, 0.4, 1.0, 1.7}) {
      if (h < 0 && compliance == 0) continue;
      const PressureOfGap law{{compliance, 0.1}};
      const double Delta = 1;
      double R, slope;
      taylor::tangent(law, &h, &Delta, &R, &slope);
      const double exact = -(R + 0.1) / (2 * compliance * R + h);
      EXPECT_NEAR(slope, exact, 20 * eps * std::abs(exact));
      // Steps small against the distance to the branch points, where the differences converge.
      const double radius = compliance > 0 ? std::hypot(h, 2 * std::sqrt(compliance * 0.1)) : h;
      const auto f = [&](double d) { return std::array<double, 1>{pressure(law.law, h + d, Delta)}; };
      contact::test::expectDerivative(f, std::array<double, 1>{slope}, 0.05 * radius,
                                      10 * eps * (std::abs(R) + 0.1), "h " + std::to_string(h));
      // h + a: coefficient 1 of the sweep.
      Coefficients in(1, {Values(h), Values(1.0)});
      const Values data(Delta);
      EXPECT_NEAR(runSeries(law, in, Mode::Direct, &data).out[0][1][0], exact, 20 * eps * std::abs(exact));
    }
}

// Curved h(a), every lane its own gap on both sides of h = 0 and beyond Delta, none at it (R = 0 has no
// relative error), however many lanes there are; orders to 20.
TEST(RegularisedPressure, OrdersOfTheSeries) {
  struct Case {
    double compliance, first, last;
  };
  for (const Case& c : {Case{1e-3, -0.3, 0.3}, Case{1e-3, 0.5, 2.1}, Case{0.0, 0.4, 2.0}}) {
    const PressureOfGap law{{c.compliance, 0.1}};
    const Values Delta(1.0);
    const auto h = testSeries(20, c.first, c.last, 1);
    for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
      const auto r = runSeries(law, {h}, mode, &Delta);
      for (int l = 0; l < L; ++l) {
        const LongSeries gap = lane(h, l), load = law.law.eta * (1.0 - gap);
        const LongSeries root = sqrt(gap * gap + 4 * c.compliance * load);
        const LongSeries R = gap.c[0] > 0 ? 2.0 * load / (gap + root) : (root - gap) / (2 * c.compliance);
        double largest = 0;  // of the coefficients so far, each carried on at the series' own rate
        double growth = 0;
        for (int k = 1; k <= 20; ++k)
          growth = std::max(growth, static_cast<double>(std::pow(std::fabs(R.at(k) / R.at(0)), 1.0L / k)));
        for (int k = 0; k <= 20; ++k) {
          largest = std::max(largest * growth, static_cast<double>(std::fabs(R.at(k))));
          // Each order takes up the rounding of all lower ones; dg/dy is a small difference where h is near
          // 0.
          ASSERT_NEAR(r.out[0][k][l], static_cast<double>(R.at(k)), 1e-12 * largest)
              << "order " << k << " lane " << l;
        }
      }
    }
  }
}

// R = (root - h)/(2c) with root = sqrt((h - 2 c eta)^2 + rho^2): from h = 2 c eta the even coefficients are
// those of a binomial series with the radius rho = 2 sqrt(c eta Delta - c^2 eta^2), which limits steps near h
// = 0.
TEST(RegularisedPressure, RadiusOfConvergenceNearClosing) {
  const double compliance = 1e-3, eta = 0.1, Delta = 2;
  const PressureOfGap law{{compliance, eta}};
  Coefficients in(1, std::vector<Values>(21, Values(0.0)));
  in[0][0] = 2 * compliance * eta;
  const double rho = 2 * std::sqrt(compliance * eta * Delta - compliance * compliance * eta * eta);
  in[0][1] = rho;  // h in units of the radius: coefficients of order 1
  const Values data(Delta);
  const auto R = runSeries(law, in, Mode::AsASolver, &data).out[0];
  double binomial = 1;
  for (int k = 0; k <= 20; k += 2) {
    const double expected = rho / (2 * compliance) * binomial - (k == 0 ? eta : 0.0);
    EXPECT_NEAR(R[k][0], expected, 1e-13 * rho / compliance) << k;  // 20 orders of a few roundings each
    binomial *= (0.5 - k / 2) / (k / 2 + 1);
  }
}

}  // namespace
