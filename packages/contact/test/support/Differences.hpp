#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

namespace atrapos::contact::test {

/// Of doubles: what one operation rounds by.
constexpr double eps = 2.2e-16;

/// The derivative of N values against central differences, whose error is f''' step^2/6: it must fall by 4 at
/// every halving. f takes the signed step; `rounding` is the absolute error of one value of f. Where the
/// error is of the size of rounding (a linear function), being that small is all that is asked for.
template <std::size_t N, class F>
void expectDerivative(const F& f, const std::array<double, N>& exact, double step, double rounding,
                      const std::string& what) {
  double before = 0;
  for (int i = 0; i < 4; ++i, step /= 2) {
    const std::array<double, N> plus = f(step), minus = f(-step);
    double square = 0;
    for (std::size_t n = 0; n < N; ++n) {
      const double e = (plus[n] - minus[n]) / (2 * step) - exact[n];
      square += e * e;
    }
    const double error = std::sqrt(square), noise = 2 * N * rounding / step;
    if (i > 0 && before > 40 * noise) {
      // The next term of the error keeps the ratio from being 4 exactly: by a few percent at these steps.
      EXPECT_NEAR(before / error, 4.0, 0.4) << what << ", halving " << i;
    } else if (i > 0) {
      EXPECT_LT(error, 40 * noise) << what << ", halving " << i;
    }
    before = error;
  }
}

}  // namespace atrapos::contact::test
