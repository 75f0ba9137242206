// Laws of rubber with a pressure as a further input.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "RubberLaws.hpp"
#include "atrapos/solid/MixedLaw.hpp"
#include "support/Meshes.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::solid::test;
using fem::test::randomNumbers;

namespace {

constexpr int L = taylor::nativeLanes;
using Values = taylor::Lanes<L>;
constexpr double scale = 0.7;

template <class Law>
class MixedLaws : public testing::Test {};

/// The volumetric stress of J, as MixedLaw defines it.
double volumetric(const NeoHookean& m, double J) { return m.lambda * std::log(J); }
template <class Law>
double volumetric(const Law& m, double J) {
  return m.bulk / 2 * (J - 1 / J);
}

double determinant(const Numbers& H) {
  const auto F = [&](int i, int j) { return H[3 * i + j] + (i == j); };
  return F(0, 0) * (F(1, 1) * F(2, 2) - F(1, 2) * F(2, 1)) -
         F(0, 1) * (F(1, 0) * F(2, 2) - F(1, 2) * F(2, 0)) +
         F(0, 2) * (F(1, 0) * F(2, 1) - F(1, 1) * F(2, 0));
}

void setInfinite(NeoHookean& m) { m.lambda = std::numeric_limits<double>::infinity(); }
template <class Law>
void setInfinite(Law& m) {
  m.bulk = std::numeric_limits<double>::infinity();
}

template <class Law>
Numbers valueOf(const MixedLaw<Law>& law, const Numbers& in) {
  Numbers out(10);
  taylor::value(law, in.data(), nullptr, out.data());
  return out;
}

}  // namespace

TYPED_TEST_SUITE(MixedLaws, RubberTypes);

// With the stress that belongs to the volume, stresses are those of the law and the last output vanishes.
TYPED_TEST(MixedLaws, IsTheLawWhereThePressureIsIts) {
  const MixedLaw<TypeParam> law{rubber<TypeParam>(), scale};
  for (const double size : {1e-6, 0.3}) {
    Numbers in = randomNumbers(9, size, 6);
    const Numbers P = stress(law.material, in);
    in.push_back(volumetric(law.material, determinant(in)) / scale);
    const Numbers out = valueOf(law, in);
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(out[i], P[i], rounding);
    EXPECT_NEAR(out[9], 0, rounding);
  }
}

// An infinite modulus asks for J = 1 whatever the pressure.
TYPED_TEST(MixedLaws, IncompressibleIsTheVolumeAlone) {
  MixedLaw<TypeParam> law{rubber<TypeParam>(), scale};
  setInfinite(law.material);
  Numbers in = randomNumbers(10, 0.3, 6);
  const double J = determinant(in);
  const bool logarithm = std::is_same_v<TypeParam, NeoHookean>;
  EXPECT_NEAR(valueOf(law, in)[9], scale * (logarithm ? std::log(J) : J - 1), rounding);
  in[9] = 100;
  EXPECT_NEAR(valueOf(law, in)[9], scale * (logarithm ? std::log(J) : J - 1), rounding);
}

// Fad types against central differences whose error falls like h^2, the first order of a series against Fad
// types; the tangent of a saddle is symmetric.
TYPED_TEST(MixedLaws, ThreeWays) {
  const MixedLaw<TypeParam> law{rubber<TypeParam>(), scale};
  const Numbers in = randomNumbers(10, 0.3, 6), direction = randomNumbers(10, 1, 7);
  Numbers out(10), jacobian(100), along(10, 0.0);
  taylor::tangent(law, in.data(), nullptr, out.data(), jacobian.data());
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j) {
      EXPECT_NEAR(jacobian[10 * i + j], jacobian[10 * j + i], 10 * rounding);
      along[i] += jacobian[10 * i + j] * direction[j];
    }
  EXPECT_LT(jacobian[99], 0);  // each pressure owes a negative pivot
  const auto error = [&](double h) {
    Numbers plus = in, minus = in;
    for (int j = 0; j < 10; ++j) {
      plus[j] += h * direction[j];
      minus[j] -= h * direction[j];
    }
    const Numbers p = valueOf(law, plus), m = valueOf(law, minus);
    double worst = 0;
    for (int i = 0; i < 10; ++i) worst = std::max(worst, std::abs((p[i] - m[i]) / (2 * h) - along[i]));
    return worst;
  };
  EXPECT_NEAR(error(0.004) / error(0.002), 4, 0.03);

  taylor::Context<L> context;
  context.shape = taylor::historyShape(law);
  Numbers memory(context.shape.template doubles<L>(1), std::nan(""));
  context.memory = memory.data();
  Values x[10], y[10];
  const Values* none = nullptr;
  for (int i = 0; i < 10; ++i) x[i] = in[i];
  taylor::start(law, context, x, none, y);
  context.order = 1;
  for (int i = 0; i < 10; ++i) x[i] = direction[i];
  taylor::sweepKnown(law, context, x, none, y);
  for (int i = 0; i < 10; ++i)
    for (int l = 0; l < L; ++l) EXPECT_NEAR(y[i][l], along[i], 20 * rounding);
}
