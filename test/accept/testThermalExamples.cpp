// examples/heat with contacts and shells against closed forms (docs/physics.md, docs/theory/balance.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "support/ExampleRun.hpp"

namespace atrapos::test {
namespace {

/// The rod of examples/heat/contact_rod.yaml: along the gap g of its end, the end's temperature and the
/// wall's.
struct ContactRod {
  double modulus = 1e5, alpha = 1e-5, gap = 1e-4, eta = 1e-4, h0 = 0.2, c = 0.2;

  double pressure(double g) const { return eta * (gap - g) / g; }
  double end(double g) const { return 2 * (gap - g + pressure(g) / modulus) / alpha; }
  double wall(double g) const { return end(g) * (1 + 1 / (h0 + c * pressure(g))); }
  /// The gap at which the end has this temperature: the warmer, the smaller.
  double gapAt(double temperature) const {
    double low = 1e-9 * gap, high = gap;
    for (int i = 0; i < 200; ++i) {
      const double middle = std::sqrt(low * high);
      (end(middle) > temperature ? low : high) = middle;
    }
    return low;
  }
};

/// Where f is largest between two gaps: golden section of their logarithms.
template <class F>
double largestBetween(double low, double high, const F& f) {
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  double a = std::log(low), b = std::log(high);
  for (int i = 0; i < 100; ++i) {
    const double x = b - ratio * (b - a), y = a + ratio * (b - a);
    (f(std::exp(x)) > f(std::exp(y)) ? b : a) = f(std::exp(x)) > f(std::exp(y)) ? y : x;
  }
  return std::exp((a + b) / 2);
}

/// The rod of examples/heat/oscillator.yaml, which grows by 5 alpha (1 - y)^4 T, where the wall has come
/// nearer by d: its steady state, and what of cosh and sinh must vanish where a disturbance
/// sinh(z y) exp(z^2 t) of its temperature goes on.
struct Oscillator {
  static constexpr double modulus = 1e5, alpha = 1e-5, gap = 1.2e-4, eta = 1e-6, h0 = 0.2, c = 60, foot = 10;

  double g = 0, pressure = 0, end = 0;

  explicit Oscillator(double d) {
    double low = 1e-6 * gap, high = gap;
    for (int i = 0; i < 200; ++i) {
      g = std::sqrt(low * high);
      pressure = eta * (gap - g) / g;
      end = foot / (1 + h0 + c * pressure);
      // The mean of a temperature that is linear, weighted by 5 (1 - y)^4.
      const double grown = alpha * (foot + (end - foot) / 6);
      (g < gap - d - grown + pressure / modulus ? low : high) = g;
    }
  }

  std::complex<double> characteristic(std::complex<double> z) const {
    // The end presses by dp = grown / (1/E + 1/R'), R' the stiffness of the contact, and loses c dp T more.
    const double stiffness = eta * gap / (g * g);
    const double Q = c * end * alpha / (1 / modulus + 1 / stiffness);
    std::complex<double> grown = 0;  // int 5 (1 - y)^4 sinh(z y) dy, by Simpson's rule: error 1e-9
    const int n = 400;
    for (int i = 0; i <= n; ++i) {
      const double y = static_cast<double>(i) / n, weight = i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2;
      grown += weight / (3.0 * n) * 5 * std::pow(1 - y, 4) * std::sinh(z * y);
    }
    return z * std::cosh(z) + (h0 + c * pressure) * std::sinh(z) + Q * grown;
  }
};

struct HopfPoint {
  double loadFactor, frequency;
};

/// Where z^2 = i omega is a root, by Newton's method from nearby.
HopfPoint hopfPoint(double loadFactor, double frequency) {
  const auto f = [](double l, double omega) {
    return Oscillator(1e-4 * l).characteristic(std::sqrt(std::complex<double>(0, omega)));
  };
  for (int i = 0; i < 20; ++i) {
    const std::complex<double> value = f(loadFactor, frequency);
    const double step = 1e-6;
    const std::complex<double> byLoad =
        (f(loadFactor + step, frequency) - f(loadFactor - step, frequency)) / (2 * step);
    const std::complex<double> byFrequency =
        (f(loadFactor, frequency + step) - f(loadFactor, frequency - step)) / (2 * step);
    const double det = byLoad.real() * byFrequency.imag() - byLoad.imag() * byFrequency.real();
    loadFactor -= (value.real() * byFrequency.imag() - value.imag() * byFrequency.real()) / det;
    frequency -= (byLoad.real() * value.imag() - byLoad.imag() * value.real()) / det;
  }
  return {loadFactor, frequency};
}

}  // namespace

/// Both folds and the whole curve. The closed form leaves out what is of second order in strains, which are
/// 4e-4 at the folds and 1.4e-3 at the end.
TEST(ContactRod, TouchesAndLetsGo) {
  const ExampleRun run("heat/contact_rod.yaml");
  const ContactRod rod;
  const auto folds = run.summary.at("load_limits");
  ASSERT_EQ(folds.size(), 2u);
  const double touches = largestBetween(1e-3 * rod.gap, 0.9 * rod.gap, [&](double g) { return rod.wall(g); });
  const double letsGo = largestBetween(1e-5 * rod.gap, touches, [&](double g) { return -rod.wall(g); });
  EXPECT_NEAR(folds[0].at("load_factor").get<double>(), rod.wall(touches) / 100, 1e-3);
  EXPECT_NEAR(folds[1].at("load_factor").get<double>(), rod.wall(letsGo) / 100, 1e-3);
  EXPECT_NEAR(folds[1].at("load_factor").get<double>(), 0.54833, 1e-3);  // of a rigid wall
  const auto load = run.column("load_factor"), end = run.column("end"), pressure = run.column("pressure"),
             heat = run.column("heat");
  double largest = 0;
  for (std::size_t k = 0; k < load.size(); ++k) {
    const double g = rod.gapAt(end[k]);
    largest = std::max(largest, std::abs(rod.wall(g) / 100 - load[k]));
    EXPECT_NEAR(pressure[k], rod.pressure(g), 1e-3 * (1 + pressure[k]));
    EXPECT_NEAR(heat[k], -0.2 * end[k], 1e-6 * (1 + end[k]));  // what comes in at the end leaves at the foot
  }
  EXPECT_LT(largest, 2e-3);
}

/// Displacements follow at once, so that the rates are the heat's. The cells' error is of order 4.
TEST(Oscillator, TurnsWhereTheWallTouches) {
  const HopfPoint exact[] = {hopfPoint(0.241, 26.9), hopfPoint(0.3146, 30.3)};
  ASSERT_NEAR(exact[0].frequency, 26.916369, 1e-5);
  ASSERT_NEAR(exact[1].frequency, 30.263552, 1e-5);
  double error[2][2];
  for (int i = 0; i < 2; ++i) {
    const ExampleRun run("heat/oscillator.yaml", {{"[1, 16]", i == 0 ? "[1, 8]" : "[1, 16]"}});
    const auto& points = run.summary.at("hopf_points");
    ASSERT_EQ(points.size(), 2u);
    for (int n = 0; n < 2; ++n) {
      EXPECT_NEAR(points[n].at("load_factor").get<double>(), exact[n].loadFactor, i == 0 ? 2e-4 : 1e-5);
      error[i][n] = points[n].at("frequency").get<double>() - exact[n].frequency;
      EXPECT_EQ(points[n].at("negative_change"), n == 0 ? 2 : -2);
    }
    EXPECT_TRUE(run.summary.at("points").empty());
  }
  for (int n = 0; n < 2; ++n) EXPECT_LT(std::abs(error[1][n]), 2e-3);
  // At the second point what is of the order of the strains, 1e-4, counts too.
  EXPECT_NEAR(std::log2(error[0][0] / error[1][0]), 4, 0.2);
}

/// The temperature along the panel, what it grows by and how far its tip moves.
TEST(Panel, BendsAwayFromTheSun) {
  const ExampleRun run("heat/panel.yaml");
  const double q = 1000, k = 1, air = 10, h = 0.01, alpha = 1e-5, L = 0.2;
  const double m = std::sqrt(2 * air / (k * h)), difference = q / (4 * k / h + 2 * air);
  // 16 cells over nine lengths of decay from the root.
  EXPECT_NEAR(run.column("tip_T").back(), q / (2 * air) * (1 - 1 / std::cosh(m * L)), 1e-4);
  EXPECT_NEAR(run.column("tip_D").back(), difference, 1e-9 * difference);
  const double growth = alpha * q / (2 * air) * (L - std::tanh(m * L) / m);
  // Strains are 5e-4: so are these, but for what is of their second order.
  EXPECT_NEAR(run.column("growth").back(), growth, 1e-3 * growth);
  const double deflection = -alpha * difference * L * L / h;
  EXPECT_NEAR(run.column("deflection").back(), deflection, 2e-3 * std::abs(deflection));
}

}  // namespace atrapos::test
