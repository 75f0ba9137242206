// Power, exponential and smoothed linear laws: values, derivatives three ways, orders to 20, radii, bad
// numbers.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "SeriesRun.hpp"
#include "atrapos/contact/ContactLaw.hpp"
#include "atrapos/contact/ExponentialPressure.hpp"
#include "atrapos/contact/PowerBarrier.hpp"
#include "atrapos/contact/SmoothedPenalty.hpp"
#include "support/Differences.hpp"
#include "support/Refusals.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

/// in = gap, data = reference gap, out = pressure.
template <class Pressure>
struct OfGap {
  static constexpr int numInputs = 1, numOutputs = 1, numData = 1;
  Pressure law;
  template <class T>
  void operator()(const T* h, const taylor::Passive<T>* Delta, T* R) const {
    R[0] = T(0.0);
    taylor::solveImplicit<1, 1, 1>(law, h, Delta, R);
  }
};

template <class Pressure>
double pressure(const Pressure& law, double h, double Delta) {
  double R;
  taylor::value(OfGap<Pressure>{law}, &h, &Delta, &R);
  return R;
}

// Units of length about 1: Delta = 1. scale: a pressure that rounding errors of R are measured by; reach: the
// distance in gap to the nearest singularity.
template <class F>
void forLaws(const F& f) {
  for (const double m : {1.0, 2.0, 2.5, 6.0}) {
    const PowerBarrier rigid{0, 0.1, m}, soft{1e-3, 0.1, m};
    for (const double h : {0.05, 0.4, 1.0, 1.7}) f(rigid, h, 0.1, h);
    for (const double h : {-0.3, -0.02, 0.02, 0.4, 1.7}) f(soft, h, 1.0, 0.02);
  }
  const ExponentialPressure exponential{3.0, 0.1};
  for (const double h : {-0.3, 0.0, 0.2, 1.0, 1.7}) f(exponential, h, 3.0, 0.2);
  const SmoothedPenalty penalty{1e3, 0.1};
  for (const double h : {-2.0, -0.1, 0.0, 0.1, 1.0, 1.7}) f(penalty, h, 100.0, 0.2);
}

TEST(PressureLaws, DerivativeThreeWays) {
  forLaws([](const auto& law, double h, double scale, double reach) {
    const OfGap<std::decay_t<decltype(law)>> ofGap{law};
    const double Delta = 1;
    double R, slope;
    taylor::tangent(ofGap, &h, &Delta, &R, &slope);
    EXPECT_LT(slope, 0.0) << h;
    const auto f = [&](double d) { return std::array<double, 1>{pressure(law, h + d, Delta)}; };
    test::expectDerivative(f, std::array<double, 1>{slope}, 0.05 * reach, 20 * eps * (scale + std::fabs(R)),
                           "h " + std::to_string(h));
    Coefficients in(1, {Values(h), Values(1.0)});
    const Values data(Delta);
    EXPECT_NEAR(runSeries(ofGap, in, Mode::AsASolver, &data).out[0][1][0], slope,
                1e4 * eps * std::fabs(slope));
  });
}

TEST(PressureLaws, VanishAtTheReferenceGapAndFall) {
  forLaws([](const auto& law, double h, double scale, double) {
    EXPECT_NEAR(pressure(law, 1.0, 1.0), 0.0, 10 * eps * scale);
    if (h < 1) {
      EXPECT_GT(pressure(law, h, 1.0), pressure(law, h + 0.1, 1.0));
      EXPECT_GT(pressure(law, h, 1.0), 0.0);
    }
    if (h > 1) {
      EXPECT_LT(pressure(law, h, 1.0), 0.0);
    }
  });
}

/// The series put into the law's equation, in long double, leaves nothing at any order up to 20.
TEST(PressureLaws, OrdersTo20) {
  forLaws([](const auto& law, double h, double scale, double reach) {
    const OfGap<std::decay_t<decltype(law)>> ofGap{law};
    const double Delta = 1;
    std::vector<Values> gap(21);
    for (int l = 0; l < L; ++l)
      for (int k = 0; k <= 20; ++k)
        gap[k][l] = k == 0 ? h * (1 + 0.01 * l) : 0.2 * reach * std::pow(0.4, k - 1) * std::cos(1.0 + k + l);
    const Values data(Delta);
    for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
      const auto r = runSeries(ofGap, {gap}, mode, &data);
      for (int l = 0; l < L; ++l) {
        const LongSeries x[1] = {lane(gap, l)}, y[1] = {lane(r.out[0], l)};
        LongSeries g[1];
        law(x, y, &Delta, g);
        // Each term of g is at most of the size (scale + |R|) or 2; orders decay at least as 0.7^k.
        const double size = std::max(2.0, scale + static_cast<double>(std::fabs(y[0].at(0))));
        for (int k = 0; k <= 20; ++k)
          ASSERT_NEAR(static_cast<double>(g[0].at(k)), 0.0, 1000 * eps * size * std::pow(0.7, k))
              << "order " << k << " gap " << h;
      }
    }
  });
}

TEST(PressureLaws, PowerOfOneIsTheBarrierOfPaper15) {
  for (const double h : {1e-9, 1e-3, 0.4, 1.0, 30.0}) {
    const double R = pressure(RegularisedPressure{0, 0.1}, h, 1);
    EXPECT_NEAR(pressure(PowerBarrier{0, 0.1, 1}, h, 1), R, 10 * eps * (std::fabs(R) + 0.1));
  }
  EXPECT_TRUE(std::isnan(pressure(PowerBarrier{0, 0.1, 2}, -1e-3, 1)));
  EXPECT_TRUE(std::isnan(pressure(PowerBarrier{0, 0.1, 2}, 0, 1)));
}

// Its equation has one root with R > -eta: over many decades, against the equation itself.
TEST(PressureLaws, PowerWithStiffnessFindsItsRoot) {
  for (const double c : {1e-9, 1e-6, 1e-3})
    for (const double m : {1.0, 2.0, 5.0})
      for (const double h : {-10.0, -0.1, -1e-9, 0.0, 1e-9, 0.1, 0.9, 1.1, 50.0}) {
        const PowerBarrier law{c, 0.1, m};
        const double R = pressure(law, h, 1);
        ASSERT_FALSE(std::isnan(R)) << c << ' ' << m << ' ' << h;
        EXPECT_GT(h + c * R, 0.0);
        EXPECT_GT(R, -0.1);
        const long double opening = static_cast<long double>(h) + static_cast<long double>(c) * R;
        const double relative =
            static_cast<double>((static_cast<long double>(R) + 0.1L) * std::pow(opening, m) / 0.1L - 1);
        // R is right to rounding of its own size or of h/c; the power of a small difference magnifies that.
        const double error = 10 * eps * m * (std::fabs(h) + c * std::fabs(R)) / static_cast<double>(opening);
        EXPECT_NEAR(relative, 0.0, error + 1e-13 * (1 + 0.1 / (R + 0.1))) << c << ' ' << m << ' ' << h;
      }
}

TEST(PressureLaws, ExponentialIsEntire) {
  const double Delta = 1, l = 0.01;
  const ExponentialPressure law{3.0, l};
  // Straight motion: R_k = R_0 (-1/l)^k e^(-h/l)/k!, no radius.
  Coefficients in(1, std::vector<Values>(21, Values(0.0)));
  in[0][0] = 0.02;
  in[0][1] = l;
  const Values data(Delta);
  const auto R = runSeries(OfGap<ExponentialPressure>{law}, in, Mode::AsASolver, &data).out[0];
  double expected = 3.0 * std::exp(-2.0);
  for (int k = 1; k <= 20; ++k) {
    expected *= -1.0 / k;
    EXPECT_NEAR(R[k][0], expected, 100 * eps * std::fabs(expected)) << k;
  }
  EXPECT_NEAR(pressure(law, -l * std::log(1e4 / 3.0), Delta), 1e4, 1e4 * 100 * eps);  // h = -l ln(R/R_0)
}

// P = ln(1 + e^-z) has its singularities at z = +-i pi: from z = 0 the even coefficients alternate and tend
// to the ratio -1/pi^2 (two conjugate logarithms: the next correction is 2/k).
TEST(PressureLaws, SmoothedPenaltyHasTheRadiusPiLengths) {
  const SmoothedPenalty law{1.0, 1.0};
  Coefficients in(1, std::vector<Values>(31, Values(0.0)));
  in[0][1] = 1.0;
  const Values data(40.0);
  const auto R = runSeries(OfGap<SmoothedPenalty>{law}, in, Mode::AsASolver, &data).out[0];
  const double pi = std::acos(-1.0);
  for (int k = 10; k <= 28; k += 2) {
    const double ratio = R[k + 2][0] / R[k][0] * (k + 2) / k;  // logarithms: coefficients fall as 1/k too
    EXPECT_NEAR(ratio, -1 / (pi * pi), 1e-4) << k;             // the next pair is at 3 pi: 3^-k
  }
}

TEST(PressureLaws, SmoothedPenaltyHoldsFarInAndFarOut) {
  const SmoothedPenalty law{1e6, 1e-3};
  EXPECT_NEAR(pressure(law, -30.0, 4.0), 30e6, 30e6 * 4 * eps);  // 30000 lengths deep: no overflow
  EXPECT_EQ(pressure(law, 4.0, 4.0), 0.0);
  EXPECT_NEAR(pressure(law, 0.0, 4.0), 1e3 * std::log(2.0), 1e3 * 10 * eps);
  for (double z = 1; z < 40; z += 0.5) {
    const double exact = 1e3 * std::log1p(std::exp(-z));
    EXPECT_NEAR(pressure(law, 1e-3 * z, 4.0), exact, 1e-12 * exact) << z;  // relative, where 1 - e^-P cancels
  }
}

// Where the force is a denormal number, at some 745 lengths, there is a root all the same.
TEST(PressureLaws, SmoothedPenaltyUnderflows) {
  const SmoothedPenalty law{2e6, 4e-9};
  for (double z = 700; z < 760; z += 0.1) EXPECT_NEAR(pressure(law, 4e-9 * z, 1.0), 0, 1e-290) << z;
}

// Each of them as the law of a tool: force, and a point held at h = Delta.
TEST(PressureLaws, ServeContactLaw) {
  const Plane floor;
  const double x[3] = {0.3, 0.2, 0.05}, Delta = 1;
  forLaws([&](const auto& law, double, double, double) {
    const ContactLaw<Plane, std::decay_t<decltype(law)>> contact{floor, law};
    double out[3], jacobian[9];
    taylor::tangent(contact, x, &Delta, out, jacobian);
    EXPECT_NEAR(out[2], -pressure(law, 0.05, 1), 10 * eps * std::fabs(out[2]));
    EXPECT_EQ(out[0], 0.0);
    EXPECT_GT(jacobian[8], 0.0);
    EXPECT_NO_THROW(contact.validate());
  });
}

TEST(PressureLaws, BadNumbersAreRefused) {
  expectRefused([] { RegularisedPressure{-1, 0.1}.validate(); }, "compliance must be >= 0");
  expectRefused([] { RegularisedPressure{0, 0}.validate(); }, "contact law: eta must be > 0");
  expectRefused([] { PowerBarrier{0, 0.1, 0.5}.validate(); }, "exponent must be between 1 and 16, got 0.5");
  expectRefused([] { PowerBarrier{0, -0.1, 2}.validate(); }, "power law: eta must be > 0");
  expectRefused([] { ExponentialPressure{0, 1}.validate(); }, "pressure of touching must be > 0");
  expectRefused([] { ExponentialPressure{1, 0}.validate(); }, "exponential law: length must be > 0");
  expectRefused([] { SmoothedPenalty{0, 1}.validate(); }, "stiffness must be > 0");
}

}  // namespace
