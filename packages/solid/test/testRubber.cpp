// The laws of rubber at a point: closed forms, energy, invariance. Derivatives: testRubberTangents.cpp
// and testRubberOrders.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "RubberLaws.hpp"
#include "support/Meshes.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::solid::test;
using fem::test::randomNumbers;

namespace {

Numbers times(const Numbers& A, const Numbers& B) {
  Numbers C(9, 0.0);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) C[3 * i + j] += A[3 * i + k] * B[3 * k + j];
  return C;
}

Numbers rotation(double a, double b) {  // about z, then about x
  return times({1, 0, 0, 0, std::cos(b), -std::sin(b), 0, std::sin(b), std::cos(b)},
               {std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1});
}

Numbers deformation(Numbers H) {
  for (int i = 0; i < 3; ++i) H[4 * i] += 1;
  return H;
}

Numbers gradient(Numbers F) {
  for (int i = 0; i < 3; ++i) F[4 * i] -= 1;
  return F;
}

double distance(const Numbers& a, const Numbers& b) {
  double d = 0;
  for (std::size_t i = 0; i < a.size(); ++i) d = std::max(d, std::abs(a[i] - b[i]));
  return d;
}

// The energies as docs/theory/rubber.md prints them.

struct Invariants {
  Real first, second, J;
};
Invariants invariants(const Numbers& H) {
  Real F[3][3], C[3][3];
  for (int i = 0; i < 9; ++i) F[i / 3][i % 3] = H[i] + Real(i % 4 == 0);
  Real trace = 0, squares = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      C[i][j] = F[0][i] * F[0][j] + F[1][i] * F[1][j] + F[2][i] * F[2][j];
      squares += C[i][j] * C[i][j];
      if (i == j) trace += C[i][i];
    }
  Real J = 0;
  for (int i = 0; i < 3; ++i)
    J += F[0][i] * (F[1][(i + 1) % 3] * F[2][(i + 2) % 3] - F[1][(i + 2) % 3] * F[2][(i + 1) % 3]);
  return {trace, (trace * trace - squares) / 2, J};
}
Real volumetric(double bulk, Real J) { return bulk / 4 * (J * J - 1 - 2 * std::log(J)); }
Real reducedFirst(const Invariants& I) { return std::pow(I.J, -2.0L / 3) * I.first - 3; }

Real energy(const NeoHookean& m, const Numbers& H) {
  const Invariants I = invariants(H);
  const Real logarithm = std::log(I.J);
  return m.mu / 2 * (I.first - 3) - m.mu * logarithm + m.lambda / 2 * logarithm * logarithm;
}
Real energy(const MooneyRivlin& m, const Numbers& H) {
  const Invariants I = invariants(H);
  return m.c1 * reducedFirst(I) + m.c2 * (std::pow(I.J, -4.0L / 3) * I.second - 3) + volumetric(m.bulk, I.J);
}
Real energy(const Yeoh& m, const Numbers& H) {
  const Invariants I = invariants(H);
  const Real x = reducedFirst(I);
  return m.c1 * x + m.c2 * x * x + m.c3 * x * x * x + volumetric(m.bulk, I.J);
}
Real energy(const Gent& m, const Numbers& H) {
  const Invariants I = invariants(H);
  return -m.mu * m.limit / 2 * std::log(1 - reducedFirst(I) / m.limit) + volumetric(m.bulk, I.J);
}

/// By the eigenvalues of C, which are apart here.
Real energy(const Ogden& m, const Numbers& H) {
  const Invariants I = invariants(H);
  const Real middle = I.first / 3, radius = std::sqrt(middle * middle - I.second / 3);
  const Real cosine =
      (2 * middle * middle * middle - middle * I.second + I.J * I.J) / (2 * radius * radius * radius);
  const Real angle = std::acos(cosine) / 3;
  Real sum = 0;
  for (int n = 0; n < 3; ++n) {
    const Real square = middle + 2 * radius * std::cos(angle - 2 * n * std::acos(-1.0L) / 3);
    for (int i = 0; i < m.numTerms; ++i) {
      const Real alpha = m.terms[i].alpha;
      sum += m.terms[i].mu / alpha * (std::pow(square * std::pow(I.J, -2.0L / 3), alpha / 2) - 1);
    }
  }
  return sum + volumetric(m.bulk, I.J);
}

template <class Law>
class Rubber : public testing::Test {};

}  // namespace

TYPED_TEST_SUITE(Rubber, RubberTypes);

TYPED_TEST(Rubber, ClosedFormsOfStretches) {
  const TypeParam law = rubber<TypeParam>();
  for (const Real s : {0.5L, 0.8L, 1.0L, 1.3L, 2.0L}) {
    SCOPED_TRACE(static_cast<double>(s));
    const Real uniaxial = freeStretch(law, s, 1, true), equibiaxial = freeStretch(law, s, s, false),
               pure = freeStretch(law, s, 1, false);
    for (const Stretches& e :
         {Stretches{s, uniaxial, uniaxial}, Stretches{s, s, equibiaxial}, Stretches{s, 1, pure}}) {
      const Numbers P = stress(law, diagonal(e.x, e.y, e.z));
      EXPECT_NEAR(P[0], principalStress(law, e), rounding);
      EXPECT_NEAR(P[4], principalStress(law, Stretches{e.y, e.z, e.x}), rounding);
      EXPECT_NEAR(P[8], 0, rounding);
      for (const int m : {1, 2, 3, 5, 6, 7}) EXPECT_EQ(P[m], 0);
    }
    if (s == 1) {
      EXPECT_NEAR(static_cast<double>(uniaxial), 1, 1e-17);
    }
  }
}

// x_1 = X_1 + g X_2: J = 1 and both invariants 3 + g^2. P_12 = 2 (W_1 + W_2) g whatever the volumetric part,
// and sigma_11 - sigma_22 = g sigma_12, which is universal of isotropic materials.
TYPED_TEST(Rubber, SimpleShear) {
  const TypeParam law = rubber<TypeParam>();
  for (const double g : {0.2, 1.0, 2.0}) {
    const Numbers P = stress(law, {0, g, 0, 0, 0, 0, 0, 0, 0});
    const Real shear = shearStress(law, g);
    EXPECT_NEAR(P[1], static_cast<double>(shear), rounding);
    double sigma[6];
    law.observe(Numbers{0, g, 0, 0, 0, 0, 0, 0, 0}.data(), nullptr, sigma);
    EXPECT_NEAR(sigma[3], static_cast<double>(shear), rounding);
    EXPECT_NEAR(sigma[0] - sigma[1], g * static_cast<double>(shear), rounding);
    for (const int m : {2, 5, 6, 7}) EXPECT_EQ(P[m], 0);
  }
}

// Stretch, P/E, lateral stretch and J of a bar with nu = 0.3, then 0.45, by high-precision arithmetic
// elsewhere: the root of the lateral stress for the same energy.
TEST(NeoHookeanReference, UniaxialTable) {
  struct Row {
    double stretch, P, lateral, J;
  };
  const auto check = [](double nu, const std::vector<Row>& rows) {
    const NeoHookean law = NeoHookean::fromYoung(1, nu);
    for (const Row& row : rows) {
      const Numbers P = stress(law, diagonal(row.stretch, row.lateral, row.lateral));
      // 14 digits of the lateral stretch are given: an error of the volume, of which the stress is lambda = 3
      // times as much.
      EXPECT_NEAR(P[0], row.P, 1e-12) << nu << ' ' << row.stretch;
      EXPECT_NEAR(P[4], 0, 1e-12) << nu << ' ' << row.stretch;
      EXPECT_NEAR(static_cast<double>(freeStretch(law, row.stretch, 1, true)), row.lateral, 1e-13);
      EXPECT_NEAR(row.stretch * row.lateral * row.lateral, row.J, 1e-13);
    }
  };
  check(0.3, {{0.3, -2.2799541548067, 1.3668812094506, 0.56050927222478},
              {0.5, -0.9353520568882, 1.2107673905233, 0.73297883697733},
              {0.9, -0.10872218513631, 1.0317024344349, 0.95796892189707},
              {1.1, 0.093077432184082, 0.97149294591033, 1.0381783983489},
              {1.5, 0.37828017639432, 0.88017459180674, 1.1620609680932},
              {3, 1.0931414373173, 0.68811102950421, 1.420490366776}});
  check(0.45, {{0.3, -3.0524563976041, 1.6569963988843, 0.82369111977467},
               {0.5, -1.0861028086216, 1.3508697466822, 0.91242453625067},
               {0.9, -0.11071289961611, 1.0483132489853, 0.98906460119824},
               {1.1, 0.091703442638026, 0.95784446440155, 1.0092126197832},
               {1.5, 0.35861435192005, 0.83067898080293, 1.0350413537217},
               {3, 0.99333557571501, 0.5983147092287, 1.0739414738383}});
}

// Small strains have small errors too: at H of 1e-9 what is left is of second order, below 3e-8 of the
// stress; differences of moduli would leave some 4e-7.
TYPED_TEST(Rubber, SmallStrainsAreLinearElasticity) {
  const TypeParam law = rubber<TypeParam>();
  const AtRest m = atRest(law);
  const double E = 9 * m.bulk * m.shear / (3 * m.bulk + m.shear);
  const double nu = (3 * m.bulk - 2 * m.shear) / (2 * (3 * m.bulk + m.shear));
  const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
  const Numbers direction = randomNumbers(9, 1, 3);
  for (const double size : {1e-9, 1e-6}) {
    Numbers H = direction, linear(9);
    for (double& h : H) h *= size;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        linear[3 * i + j] = mu * (H[3 * i + j] + H[3 * j + i]) + (i == j ? lambda * (H[0] + H[4] + H[8]) : 0);
    EXPECT_LT(distance(stress(law, H), linear), 30 * size * size);
    const double E6[6] = {H[0], H[4], H[8], (H[1] + H[3]) / 2, (H[5] + H[7]) / 2, (H[2] + H[6]) / 2};
    const auto S = law.secondPiola(taylor::Symmetric3<double>(E6));
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(S(i / 3, i % 3), linear[i], 30 * size * size);
  }
}

TEST(RubberAtRest, Young) {
  const AtRest m = atRest(NeoHookean::fromYoung(2.1, 0.3));
  EXPECT_NEAR(9 * m.bulk * m.shear / (3 * m.bulk + m.shear), 2.1, 1e-15);
  EXPECT_NEAR((3 * m.bulk - 2 * m.shear) / (2 * (3 * m.bulk + m.shear)), 0.3, 1e-15);
  const NeoHookean same = NeoHookean::fromModuli(m.shear, m.bulk);
  EXPECT_NEAR(same.lambda, NeoHookean::fromYoung(2.1, 0.3).lambda, 1e-15);
}

// P of F and cof F, S of C: two ways to the same stress.
TYPED_TEST(Rubber, StressOfSolidsIsThatOfShells) {
  const TypeParam law = rubber<TypeParam>();
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Numbers H = randomNumbers(9, 0.3, seed);
    const auto S = law.secondPiola(greenLagrange(taylor::Matrix3<double>(H.data())));
    Numbers full(9);
    for (int i = 0; i < 9; ++i) full[i] = S(i / 3, i % 3);
    EXPECT_LT(distance(stress(law, H), times(deformation(H), full)), rounding);
  }
}

TYPED_TEST(Rubber, FrameIndifferenceAndIsotropy) {
  const TypeParam law = rubber<TypeParam>();
  const Numbers H = randomNumbers(9, 0.3, 5), Q = rotation(1.1, -2.3), F = deformation(H), P = stress(law, H);
  EXPECT_LT(distance(stress(law, gradient(times(Q, F))), times(Q, P)), rounding);
  EXPECT_LT(distance(stress(law, gradient(times(F, Q))), times(P, Q)), rounding);
  EXPECT_LT(distance(stress(law, gradient(Q)), Numbers(9, 0.0)), rounding);
}

TYPED_TEST(Rubber, StressIsTheDerivativeOfTheEnergy) {
  const TypeParam law = rubber<TypeParam>();
  const Numbers H = randomNumbers(9, 0.3, 4), P = stress(law, H);
  const auto error = [&](double h) {
    Numbers byDifferences(9);
    for (int j = 0; j < 9; ++j) {
      Numbers plus = H, minus = H;
      plus[j] += h;
      minus[j] -= h;
      byDifferences[j] =
          static_cast<double>((energy(law, plus) - energy(law, minus)) / (Real(plus[j]) - minus[j]));
    }
    return distance(byDifferences, P);
  };
  // h^2 with terms of h^4 behind.
  EXPECT_NEAR(error(0.004) / error(0.002), 4, 0.02);
  EXPECT_LT(error(1e-6), 1e-10);
}

TEST(GentLimit, IsADomainError) {
  const Gent law = Gent::fromModuli(1, 2, 1e3);
  // Simple shear has x = g^2.
  EXPECT_TRUE(std::isfinite(stress(law, {0, 1.41, 0, 0, 0, 0, 0, 0, 0})[1]));
  EXPECT_TRUE(std::isnan(stress(law, {0, 1.42, 0, 0, 0, 0, 0, 0, 0})[1]));
  EXPECT_NEAR(stress(law, {0, 1, 0, 0, 0, 0, 0, 0, 0})[1], 2, rounding);
}

Numbers principalStresses(const Ogden& law, const Stretches& s) {
  return {static_cast<double>(principalStress(law, s)),
          static_cast<double>(principalStress(law, Stretches{s.y, s.z, s.x})),
          static_cast<double>(principalStress(law, Stretches{s.z, s.x, s.y}))};
}

// Ogden's constants of Treloar's rubber (1972), fractional, large and negative powers; stretches far apart,
// nearly equal, equal.
TEST(OgdenLaw, AnyPowersOfAnyStretches) {
  const Ogden law = Ogden::fromModuli({6.3, 0.012, -0.1}, {1.3, 5, -2}, 1e3);
  EXPECT_NEAR(law.shearModulus(), 4.225, 1e-15);
  for (const Stretches& s :
       {Stretches{1, 1, 1}, Stretches{1.5L, 1.5L, 1 / 2.25L}, Stretches{3, 1 / 3.0L, 1},
        Stretches{2, 2 + 1e-7L, 0.25L}, Stretches{1 + 1e-9L, 1 - 1e-9L, 1}, Stretches{4, 0.5L, 0.5L}}) {
    const Numbers H = diagonal(s.x, s.y, s.z), P = stress(law, H);
    const Stretches t{1 + Real(H[0]), 1 + Real(H[4]), 1 + Real(H[8])};
    const Numbers expected = principalStresses(law, t);
    // 1e3 times the rounding of the volume, beside the stresses' own
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(P[4 * i], expected[i], 4e-13 + 1e-14 * std::abs(expected[i])) << static_cast<double>(s.x);
  }
}

// Each step of Cayley and Hamilton's recurrence costs a few roundings: 18 of them at powers of 39.
TEST(OgdenLaw, LargePowers) {
  for (const double alpha : {11.7, 39.1, -8.3, -38.3}) {
    const Ogden law = Ogden::fromModuli({1 / alpha}, {alpha}, 1);
    const Stretches s{2, 0.6L, 0.9L};
    const Numbers H = diagonal(s.x, s.y, s.z), P = stress(law, H);
    const Stretches t{1 + Real(H[0]), 1 + Real(H[4]), 1 + Real(H[8])};
    const Numbers expected = principalStresses(law, t);
    const double size = std::max({std::abs(expected[0]), std::abs(expected[1]), std::abs(expected[2])});
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(P[4 * i], expected[i], 2e-13 * size) << alpha;
  }
}

// What the docs say of stretches beyond: the quadrature's error, not a wall.
TEST(OgdenLaw, LargeStretches) {
  const Ogden law = Ogden::fromModuli({1}, {1.3}, 1);
  const auto error = [&](Real s) {
    const Stretches t{s, 1 / std::sqrt(s), 1 / std::sqrt(s)};
    const Numbers P = stress(law, diagonal(t.x, t.y, t.z));
    const Real expected = principalStress(law, t);
    return static_cast<double>(std::abs((P[0] - expected) / expected));
  };
  EXPECT_LT(error(5), 2e-14);
  EXPECT_LT(error(10), 1e-10);
  EXPECT_LT(error(20), 1e-7);
}

// A power of 2 is a neo-Hookean law, 2 and -2 are Mooney-Rivlin's, and powers near them are near.
TEST(OgdenLaw, WholePowersAreMooneyRivlin) {
  const MooneyRivlin mooney = MooneyRivlin::fromModuli(0.5, 0.2, 3);
  const Numbers H = randomNumbers(9, 0.3, 11), expected = stress(mooney, H);
  EXPECT_LT(distance(stress(Ogden::fromModuli({1, -0.4}, {2, -2}, 3), H), expected), rounding);
  const double near = distance(stress(Ogden::fromModuli({1, -0.4}, {2 + 1e-8, -2 - 1e-8}, 3), H), expected);
  EXPECT_LT(near, 1e-8);
  EXPECT_GT(near, 1e-12);
}

TEST(RubberErrors, BadMaterialsAreRefused) {
  const auto messageOf = [](const auto& f) -> std::string {
    try {
      f();
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(messageOf([] { NeoHookean::fromYoung(0, 0.3); }), "Young's modulus must be positive");
  EXPECT_EQ(messageOf([] { NeoHookean::fromYoung(1, 0.5); }), "Poisson's ratio must lie between -1 and 0.5");
  EXPECT_EQ(messageOf([] { NeoHookean::fromModuli(-1, 1); }), "the shear modulus must be positive");
  EXPECT_EQ(messageOf([] { NeoHookean::fromModuli(1, 0); }), "the bulk modulus must be positive");
  EXPECT_EQ(messageOf([] { MooneyRivlin::fromModuli(0.3, -0.3, 1); }),
            "c1 + c2, half the shear modulus at rest, must be positive");
  EXPECT_EQ(messageOf([] { MooneyRivlin::fromModuli(0.3, 0.1, -1); }), "the bulk modulus must be positive");
  EXPECT_EQ(messageOf([] { Yeoh::fromModuli(0, 1, 1, 1); }),
            "c1, half the shear modulus at rest, must be positive");
  EXPECT_EQ(messageOf([] { Yeoh::fromModuli(1, std::nan(""), 1, 1); }), "c2 and c3 must be finite");
  EXPECT_EQ(messageOf([] {
              Ogden::fromModuli({1, 2}, {1}, 1);
            }),
            "there must be one to six mu, and as many alpha");
  EXPECT_EQ(messageOf([] {
              Ogden::fromModuli({1, 2}, {1, 0}, 1);
            }),
            "no mu and no alpha may be 0, and alpha is 40 at most");
  EXPECT_EQ(messageOf([] {
              Ogden::fromModuli({1, 1}, {1, -1}, 1);
            }),
            "the sum of mu alpha, twice the shear modulus at rest, must be positive");
  EXPECT_EQ(messageOf([] { Gent::fromModuli(1, 0, 1); }), "the limit J_m must be positive");
  EXPECT_EQ(messageOf([] { Gent::fromModuli(1, 1, std::nan("")); }), "the bulk modulus must be positive");
}
