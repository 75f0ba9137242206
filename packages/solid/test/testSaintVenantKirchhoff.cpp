#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "atrapos/solid/SaintVenantKirchhoff.hpp"
#include "support/Meshes.hpp"

using namespace atrapos;
using fem::test::randomNumbers;
using solid::SaintVenantKirchhoff;

namespace {

using Numbers = std::vector<double>;

const auto steel = SaintVenantKirchhoff::fromYoung(2.1, 0.3);  // stresses of size one

Numbers stress(const SaintVenantKirchhoff& law, const Numbers& H) {
  Numbers P(9);
  taylor::value(law, H.data(), nullptr, P.data());
  return P;
}

Numbers times(const double* A, const double* B) {
  Numbers C(9, 0.0);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) C[3 * i + j] += A[3 * i + k] * B[3 * k + j];
  return C;
}

Numbers rotation(double a, double b) {  // about z, then about x
  const double z[9] = {std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1};
  const double x[9] = {1, 0, 0, 0, std::cos(b), -std::sin(b), 0, std::sin(b), std::cos(b)};
  return times(x, z);
}

Numbers deformation(const Numbers& H) {
  Numbers F = H;
  for (int i = 0; i < 3; ++i) F[4 * i] += 1;
  return F;
}

Numbers gradient(Numbers F) {
  for (int i = 0; i < 3; ++i) F[4 * i] -= 1;
  return F;
}

/// Paper (4)-(6) as they are printed: gamma, S = lambda tr(gamma) I + 2 mu gamma, T = (I + H) S.
Numbers printedLaw(const SaintVenantKirchhoff& law, const Numbers& H) {
  double S[9];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double gamma = H[3 * i + j] + H[3 * j + i];
      for (int k = 0; k < 3; ++k) gamma += H[3 * k + i] * H[3 * k + j];
      S[3 * i + j] = law.mu * gamma;
    }
  const double trace = (S[0] + S[4] + S[8]) / (2 * law.mu);
  for (int i = 0; i < 3; ++i) S[4 * i] += law.lambda * trace;
  return times(deformation(H).data(), S);
}

double distance(const Numbers& a, const Numbers& b) {
  double d = 0;
  for (std::size_t i = 0; i < a.size(); ++i) d = std::max(d, std::abs(a[i] - b[i]));
  return d;
}

// Values of size one to ten from some thirty operations.
constexpr double rounding = 1e-14;

/// Counts products of two varying quantities: what costs a convolution in a Taylor sweep.
struct Counting {
  bool varies = false;
  static int products;
  Counting() = default;
  Counting(double) {}
  explicit Counting(bool v) : varies(v) {}
};
int Counting::products = 0;
Counting operator+(Counting a, Counting b) { return Counting(a.varies || b.varies); }
Counting operator*(Counting a, Counting b) {
  if (a.varies && b.varies) ++Counting::products;
  return Counting(a.varies || b.varies);
}
Counting& operator+=(Counting& a, Counting b) { return a = a + b; }
Counting& operator-=(Counting& a, Counting b) { return a = a + b; }

}  // namespace

TEST(SaintVenantKirchhoff, IsThePrintedLaw) {
  for (unsigned seed : {1u, 2u, 3u}) {
    const Numbers H = randomNumbers(9, 0.6, seed);
    EXPECT_LT(distance(stress(steel, H), printedLaw(steel, H)), rounding);
  }
}

TEST(SaintVenantKirchhoff, LameConstants) {
  // E = mu (3 lambda + 2 mu)/(lambda + mu), nu = lambda/(2 (lambda + mu))
  const auto law = SaintVenantKirchhoff::fromYoung(210e3, 0.3);
  EXPECT_NEAR(law.mu * (3 * law.lambda + 2 * law.mu) / (law.lambda + law.mu), 210e3, 210e3 * 1e-15 * 4);
  EXPECT_NEAR(law.lambda / (2 * (law.lambda + law.mu)), 0.3, 1e-15);
  EXPECT_THROW(SaintVenantKirchhoff::fromYoung(0, 0.3), std::invalid_argument);
  EXPECT_THROW(SaintVenantKirchhoff::fromYoung(-1, 0.3), std::invalid_argument);
  EXPECT_THROW(SaintVenantKirchhoff::fromYoung(1, 0.5), std::invalid_argument);
  EXPECT_THROW(SaintVenantKirchhoff::fromYoung(1, -1), std::invalid_argument);
  EXPECT_THROW(SaintVenantKirchhoff::fromYoung(std::nan(""), 0.3), std::invalid_argument);
}

// Way one and two: the Fad tangent against central differences, whose error falls like h^2. P is a cubic in
// H, so the error is exactly h^2 times the third derivative and the rate exact to rounding.
TEST(SaintVenantKirchhoff, TangentIsTheDerivative) {
  const Numbers H = randomNumbers(9, 0.4, 4);
  Numbers P(9), dP(81);
  taylor::tangent(steel, H.data(), nullptr, P.data(), dP.data());
  EXPECT_LT(distance(P, stress(steel, H)), rounding);
  for (int j = 0; j < 9; ++j) {
    double errors[2];
    for (int level = 0; level < 2; ++level) {
      const double h = level == 0 ? 0.2 : 0.1;
      Numbers plus = H, minus = H;
      plus[j] += h;
      minus[j] -= h;
      const Numbers Pp = stress(steel, plus), Pm = stress(steel, minus);
      errors[level] = 0;
      for (int i = 0; i < 9; ++i)
        errors[level] = std::max(errors[level], std::abs((Pp[i] - Pm[i]) / (2 * h) - dP[9 * i + j]));
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 1e-8) << "input " << j;
    EXPECT_GT(errors[1], 1e-4);
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(dP[9 * i + j], dP[9 * j + i], rounding) << "symmetric";
  }
}

// Way three: order-k sweeps against the paper's formulae (7)-(9), written out here.
TEST(SaintVenantKirchhoff, SweepsAreThePapersOrders) {
  constexpr int L = taylor::nativeLanes, K = 6;
  const auto& law = steel;
  // Eight lanes with different series, alike in size to those of a step: |H_k| about 0.3.
  std::vector<Numbers> H;  // [lane * (K + 1) + k]
  for (int i = 0; i < L * (K + 1); ++i) H.push_back(randomNumbers(9, 0.3, 100 + i));

  taylor::Context<L> context;
  context.shape = taylor::historyShape(law);
  Numbers history(context.shape.doubles<L>(K), std::nan(""));
  context.memory = history.data();
  taylor::Lanes<L> in[9], nonlinear[9], linear[9];
  const auto give = [&](int k) {
    for (int m = 0; m < 9; ++m)
      for (int l = 0; l < L; ++l) in[m][l] = H[l * (K + 1) + k][m];
  };
  std::vector<Numbers> S(L * (K + 1), Numbers(9));
  for (int k = 0; k <= K; ++k) {
    context.order = k;
    for (auto& x : nonlinear) x = 0.0;
    if (k > 0) {
      taylor::sweep(law, context, static_cast<const taylor::Lanes<L>*>(nullptr), nonlinear);
    }
    give(k);
    const taylor::Lanes<L>* noData = nullptr;
    if (k == 0)
      taylor::start(law, context, in, noData, linear);
    else
      taylor::complete(law, context, in, noData, linear);

    for (int l = 0; l < L; ++l) {
      const Numbers* h = &H[l * (K + 1)];
      Numbers* s = &S[l * (K + 1)];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          double gamma = 0.5 * (h[k][3 * i + j] + h[k][3 * j + i]);  // (9)
          for (int o = 0; o <= k; ++o)
            for (int m = 0; m < 3; ++m) gamma += 0.5 * h[o][3 * m + i] * h[k - o][3 * m + j];
          s[k][3 * i + j] = 2 * law.mu * gamma;  // (8)
        }
      const double trace = (s[k][0] + s[k][4] + s[k][8]) / (2 * law.mu);
      for (int i = 0; i < 3; ++i) s[k][4 * i] += law.lambda * trace;
      Numbers T = s[k];  // (7)
      for (int o = 0; o <= k; ++o) {
        const Numbers product = times(h[o].data(), s[k - o].data());
        for (int m = 0; m < 9; ++m) T[m] += product[m];
      }
      // Sums of up to 7 x 27 terms of size 0.1.
      for (int m = 0; m < 9; ++m) EXPECT_NEAR(nonlinear[m][l] + linear[m][l], T[m], 10 * rounding);
    }
  }
}

// What docs/theory/solid.md says the law costs a point and order.
TEST(SaintVenantKirchhoff, Costs) {
  EXPECT_EQ(taylor::historyShape(steel).slots, 15);
  Counting H[9], P[9];
  for (auto& h : H) h.varies = true;
  Counting::products = 0;
  atrapos::solid::greenLagrange(taylor::Matrix3<Counting>(H));
  EXPECT_EQ(Counting::products, 18);
  // The rest, T = S + H S, is 27 more: counted on the whole operator.
  Counting::products = 0;
  steel(H, static_cast<const double*>(nullptr), P);
  EXPECT_EQ(Counting::products, 45);
}

TEST(SaintVenantKirchhoff, FrameIndifference) {
  const Numbers H = randomNumbers(9, 0.4, 5), Q = rotation(1.1, -2.3);
  const Numbers QF = times(Q.data(), deformation(H).data());
  const Numbers P = stress(steel, H);
  EXPECT_LT(distance(stress(steel, gradient(QF)), times(Q.data(), P.data())), 10 * rounding);
  // A rotation alone has no stress.
  EXPECT_LT(distance(stress(steel, gradient(Q)), Numbers(9, 0.0)), rounding);
}

// An isotropic law: turning the body before it is deformed turns the stress with it, P(F Q) = P(F) Q.
TEST(SaintVenantKirchhoff, Isotropy) {
  const Numbers H = randomNumbers(9, 0.4, 6), Q = rotation(0.4, 0.9);
  const Numbers FQ = times(deformation(H).data(), Q.data());
  const Numbers P = stress(steel, H);
  EXPECT_LT(distance(stress(steel, gradient(FQ)), times(P.data(), Q.data())), 10 * rounding);
}

// S = F^-1 P is symmetric, or P F^T is: the balance of moments.
TEST(SaintVenantKirchhoff, BalanceOfMoments) {
  const Numbers H = randomNumbers(9, 0.4, 7), F = deformation(H), P = stress(steel, H);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < i; ++j) {
      double a = 0, b = 0;
      for (int k = 0; k < 3; ++k) {
        a += P[3 * i + k] * F[3 * j + k];
        b += P[3 * j + k] * F[3 * i + k];
      }
      EXPECT_NEAR(a, b, rounding);
    }
}

// Stretch s along x and s_t across, with no stress across: sigma_xx = P / s_t^2 and P = E s (s^2 - 1)/2.
TEST(SaintVenantKirchhoff, ObservedStressInUniaxialStretch) {
  const double E = 2.1, nu = 0.3;
  for (double s : {0.8, 1.0, 1.4}) {
    const double across = std::sqrt(1 - nu * (s * s - 1));
    const Numbers H{s - 1, 0, 0, 0, across - 1, 0, 0, 0, across - 1};
    double sigma[6];
    steel.observe(H.data(), nullptr, sigma);
    EXPECT_NEAR(sigma[0], E * s * (s * s - 1) / 2 / (across * across), rounding);
    for (int m = 1; m < 6; ++m) EXPECT_NEAR(sigma[m], 0.0, rounding);
  }
}

// The observed stress turns with the body and its components are in the order of their names: xx yy zz xy yz
// zx.
TEST(SaintVenantKirchhoff, ObservedStressOfARotatedState) {
  const Numbers H = randomNumbers(9, 0.3, 8), Q = rotation(0.7, 1.9);
  double before[6], after[6];
  steel.observe(H.data(), nullptr, before);
  const Numbers turned = gradient(times(Q.data(), deformation(H).data()));
  steel.observe(turned.data(), nullptr, after);
  const int index[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
  double sigma[9], transposed[9];
  for (int m = 0; m < 9; ++m) {
    sigma[m] = before[index[m]];
    transposed[m] = Q[3 * (m % 3) + m / 3];
  }
  const Numbers expected = times(times(Q.data(), sigma).data(), transposed);
  for (int m = 0; m < 9; ++m) EXPECT_NEAR(after[index[m]], expected[m], 10 * rounding);
  ASSERT_EQ(SaintVenantKirchhoff::observedNames().size(), 6u);
  EXPECT_EQ(SaintVenantKirchhoff::observedNames()[4], "stress_yz");
  EXPECT_EQ(SaintVenantKirchhoff::observedNames()[5], "stress_zx");
}
