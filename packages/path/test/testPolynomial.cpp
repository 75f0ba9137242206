#include <cmath>

#include <gtest/gtest.h>

#include "atrapos/path/Polynomial.hpp"

using atrapos::path::Polynomial;

namespace {

Polynomial fromRoots(const std::vector<double>& roots) {
  std::vector<double> c{1};
  for (const double r : roots) {
    c.insert(c.begin(), 0);
    for (std::size_t k = 0; k + 1 < c.size(); ++k) c[k] -= r * c[k + 1];
  }
  return Polynomial(c);
}

TEST(Polynomial, FindsAllRootsInTheInterval) {
  const auto p = fromRoots({-0.5, 0.1, 0.1001, 0.7, 1.3});
  const auto roots = p.roots(1.0);
  ASSERT_EQ(roots.size(), 3u);
  // Roots 1e-4 apart: conditioning 1 / p' is about 1e4 times rounding.
  EXPECT_NEAR(roots[0], 0.1, 1e-10);
  EXPECT_NEAR(roots[1], 0.1001, 1e-10);
  EXPECT_NEAR(roots[2], 0.7, 1e-14);  // well separated: rounding
}

TEST(Polynomial, FindsWiggleBetweenSamples) {
  // Two crossings 2e-7 apart, far closer than any sampling of the step would be.
  const auto p = fromRoots({0.333333, 0.3333332});
  EXPECT_EQ(p.roots(1.0).size(), 2u);
}

TEST(Polynomial, TouchingRootIsReportedOnce) {
  const auto roots = fromRoots({0.3, 0.3, 2.0}).roots(1.0);
  ASSERT_EQ(roots.size(), 1u);
  EXPECT_NEAR(roots[0], 0.3, 1e-7);  // a double root is known to sqrt(rounding)
}

TEST(Polynomial, IntervalIsOpenAtZeroAndClosedAtEnd) {
  EXPECT_EQ(fromRoots({0.0, 1.0}).roots(1.0), std::vector<double>{1.0});
  EXPECT_EQ(fromRoots({0.0, 0.5, 1.0}).roots(1.0).size(), 2u);  // 0.5 is where the first bisection falls
  EXPECT_TRUE(fromRoots({-1.0, 1.5}).roots(1.0).empty());
  EXPECT_TRUE(Polynomial({0.0, 0.0}).roots(1.0).empty());
}

TEST(Polynomial, SmallAndLargeScales) {
  // A series of order 20 with radius 1e-6: coefficients up to 1e120.
  std::vector<double> c(21);
  for (int k = 0; k <= 20; ++k) c[k] = std::pow(1e6, k);
  c[0] = -0.5;  // root of 1.5 = 1/(1 - t) (up to order 20), t = 1/3
  const auto roots = Polynomial(c).roots(0.9e-6);
  ASSERT_EQ(roots.size(), 1u);
  EXPECT_NEAR(roots[0] * 1e6, 1.0 / 3, 1e-9);  // truncation of the geometric series: 3^-21
}

TEST(Polynomial, DerivativeAndShift) {
  const Polynomial p({1, -2, 3});
  EXPECT_DOUBLE_EQ(p(2), 9);
  EXPECT_DOUBLE_EQ(p.derivative()(2), 10);
  EXPECT_DOUBLE_EQ(p.minus(4)(2), 5);
  EXPECT_DOUBLE_EQ(p.withoutRootAtZero()(2), 4);
}

}  // namespace
