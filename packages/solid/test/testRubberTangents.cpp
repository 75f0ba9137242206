// Tangents of the laws of rubber.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "RubberLaws.hpp"
#include "support/Meshes.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::solid::test;
using fem::test::randomNumbers;

namespace {

constexpr int L = taylor::nativeLanes;
using Values = taylor::Lanes<L>;

template <class Law>
class RubberTangents : public testing::Test {};

}  // namespace

TYPED_TEST_SUITE(RubberTangents, RubberTypes);

// Fad types against central differences whose error falls like h^2, lanes and the first order of a series
// against Fad types; the tangent of an energy is symmetric.
TYPED_TEST(RubberTangents, ThreeWays) {
  const TypeParam law = rubber<TypeParam>();
  const Numbers H = randomNumbers(9, 0.3, 6), direction = randomNumbers(9, 1, 7);
  Numbers P(9), dP(81), along(9, 0.0);
  taylor::tangent(law, H.data(), nullptr, P.data(), dP.data());
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(P[i], stress(law, H)[i], rounding);
  for (int j = 0; j < 9; ++j) {
    const auto error = [&](double h) {
      Numbers plus = H, minus = H;
      plus[j] += h;
      minus[j] -= h;
      const Numbers Pp = stress(law, plus), Pm = stress(law, minus);
      double worst = 0;
      for (int i = 0; i < 9; ++i)
        worst = std::max(worst, std::abs((Pp[i] - Pm[i]) / (2 * h) - dP[9 * i + j]));
      return worst;
    };
    EXPECT_NEAR(error(0.004) / error(0.002), 4, 0.02) << "input " << j;
    for (int i = 0; i < 9; ++i) {
      EXPECT_NEAR(dP[9 * i + j], dP[9 * j + i], 10 * rounding) << "symmetric";
      along[i] += dP[9 * i + j] * direction[j];
    }
  }

  taylor::Context<L> context;
  context.shape = taylor::historyShape(law);
  Numbers memory(context.shape.doubles<L>(1), std::nan(""));
  context.memory = memory.data();
  Values in[9], out[9], jacobian[81];
  const Values* none = nullptr;
  for (int i = 0; i < 9; ++i) in[i] = H[i];
  taylor::tangent(law, context, in, none, out, jacobian);
  for (int i = 0; i < 81; ++i)
    for (int l = 0; l < L; ++l) EXPECT_NEAR(jacobian[i][l], dP[i], 10 * rounding);

  taylor::start(law, context, in, none, out);
  context.order = 1;
  for (int i = 0; i < 9; ++i) in[i] = direction[i];
  taylor::sweepKnown(law, context, in, none, out);
  for (int i = 0; i < 9; ++i)
    for (int l = 0; l < L; ++l) EXPECT_NEAR(out[i][l], along[i], 10 * rounding);
}
