// Whole series of derived quantities, and series with known coefficients and radii of convergence. Solutions
// of x' = f(x) are among them: coefficient k of f gives coefficient k+1 of x.

#include "atrapos/taylor/Polynomial.hpp"

#include "SeriesRun.hpp"
#include "TestLaws.hpp"

using namespace atrapos::taylor;

namespace {

TEST(Polynomial, valueAndDerivative) {
  const Polynomial p({1.0, -2.0, 0.0, 4.0});
  EXPECT_EQ(p.value(0.5), 0.5);  // all numbers are exact in binary
  EXPECT_EQ(p.derivative().coefficients(), (std::vector<double>{-2.0, 0.0, 12.0}));
  EXPECT_EQ(p.derivative().value(0.5), 1.0);
  EXPECT_EQ(Polynomial().value(3.0), 0.0);
  EXPECT_TRUE(Polynomial({7.0}).derivative().coefficients().empty());
}

TEST(Polynomial, derivedQuantityInsideTheDisc) {
  // Stress along a gradient that is a cubic in a: the law is a polynomial of degree 3 in it, so 10
  // coefficients are the whole series and any a will do.
  std::vector<Polynomial> H;
  for (int i = 0; i < 9; ++i) {
    std::vector<double> c(i == 4 ? 10 : 4, 0.0);  // one is filled up with zeros, the others are not
    for (int k = 0; k < 4; ++k) c[k] = 0.3 * std::cos(1.0 + i + 2.3 * k);
    H.emplace_back(c);
  }
  const SaintVenantKirchhoff law;
  const auto P = polynomials(law, H);
  ASSERT_EQ(P.size(), 9u);
  for (const double a : {-1.5, 0.0, 0.3, 1.0}) {
    double at[9], expected[9];
    for (int i = 0; i < 9; ++i) at[i] = H[i].value(a);
    value(law, at, nullptr, expected);
    double size = 0;
    for (const double e : expected) size = std::max(size, std::fabs(e));
    // Some hundred roundings of terms up to |a|^9 times the size of a coefficient.
    for (int i = 0; i < 9; ++i) {
      ASSERT_EQ(P[i].coefficients().size(), 10u);
      EXPECT_NEAR(P[i].value(a), expected[i], 1e-13 * std::max(1.0, size)) << i << " at " << a;
    }
  }
}

TEST(Polynomial, errorFallsWithTheOrderAndTheDistance) {
  // |f(a) - P_K(a)| = O(a^(K+1)): halving a divides the error by 2^(K+1).
  const SquarePlusExponential law;
  for (const int K : {3, 6, 9}) {
    std::vector<double> c(K + 1, 0.0);
    c[0] = 0.2;
    c[1] = 1.0;
    const Polynomial p = polynomials(law, {Polynomial(c)})[0];
    const auto error = [&](double a) {
      const double x = 0.2 + a;
      return std::fabs(p.value(a) - (x * x + std::exp(3 * x)));
    };
    const double rate = std::log2(error(0.2) / error(0.1));
    // The next term of exp(3a) changes the rate by log2 of (1 + 0.6/(K+2))/(1 + 0.3/(K+2)): below 0.1 here.
    EXPECT_NEAR(rate, K + 1, 0.1) << K;
  }
}

TEST(Polynomial, withDataAndImplicitLaws) {
  const double data[] = {2.8, 1.5};
  const std::vector<Polynomial> point = {Polynomial({1.2, 0.1, -0.05, 0.02, 0.0, 0.0, 0.0, 0.0}),
                                         Polynomial({0.4, 0.3}), Polynomial({3.1, -0.2, 0.1})};
  const auto force = polynomials(ContactForce{}, point, data);
  const auto oracle = polynomials(ContactForceClosedForm{}, point, data);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 8; ++k)
      // Gap 0.5, pressure 0.2: rounding of the gap amplified some ten times by the closed form's difference.
      EXPECT_NEAR(force[i].coefficients()[k], oracle[i].coefficients()[k], 1e-11) << i << " order " << k;
}

struct Logarithm {
  static constexpr int numInputs = 1, numOutputs = 1, numData = 0;
  template <class T>
  void operator()(const T* in, const Passive<T>*, T* out) const {
    using std::log;
    out[0] = log(in[0]);
  }
};

template <class F>
std::string messageOf(F f) {
  try {
    f();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "no exception";
}

TEST(Polynomial, errorsNameWhatIsWrong) {
  const Logarithm law;
  EXPECT_EQ(messageOf([&] {
              polynomials(law, {Polynomial({-0.3, 1.0})});
            }),
            "output 0, order 0: log of -0.3: its argument must be positive");
  EXPECT_THROW(polynomials(law, {Polynomial({0.0, 1.0})}), DomainError);
  EXPECT_EQ(messageOf([&] { polynomials(law, {}); }),
            "polynomials: the law has 1 inputs, 0 series were given");
  EXPECT_THROW(polynomials(law, {Polynomial()}), std::invalid_argument);
  EXPECT_EQ(messageOf([&] { polynomials(CylinderLaw{}, std::vector<Polynomial>(3, Polynomial({1.0}))); }),
            "polynomials: the law needs 1 data, none were given");
  // Finite input, infinite result: no operation is to blame.
  EXPECT_EQ(messageOf([&] {
              polynomials(SquarePlusExponential{}, {Polynomial({1e4, 1.0})});
            }),
            "output 0, order 0: the law's result is not a number");
}

// ----------------------------------------------------------------------------------- known series and radii

struct Geometric {
  static constexpr int numInputs = 1, numOutputs = 2, numData = 0;
  template <class T>
  void operator()(const T* in, const Passive<T>*, T* out) const {
    out[0] = 1.0 / (1.0 - in[0]);
    out[1] = out[0] * out[0];
  }
};

TEST(KnownSeries, geometric) {
  std::vector<double> a(41, 0.0);
  a[1] = 1.0;
  const auto p = polynomials(Geometric{}, {Polynomial(a)});
  for (int k = 0; k <= 40; ++k) {
    EXPECT_EQ(p[0].coefficients()[k], 1.0);  // sums and quotients of small integers are exact
    EXPECT_EQ(p[1].coefficients()[k], k + 1.0);
  }
}

/// The series of the solution of x' = f(x) from its initial values.
template <class Law>
std::vector<std::vector<double>> solveOde(const Law& f, const std::vector<double>& initial, int maxOrder) {
  constexpr int n = Law::numInputs;
  static_assert(Law::numOutputs == n);
  Context<1> context;
  context.shape = historyShape(f);
  std::vector<double> memory(context.shape.template doubles<1>(maxOrder));
  context.memory = memory.data();
  std::vector<std::vector<double>> x(n, std::vector<double>(maxOrder + 1));
  Lanes<1> in[n], out[n];
  const Lanes<1>* none = nullptr;
  for (int k = 0; k <= maxOrder; ++k) {
    context.order = k;
    for (int j = 0; j < n; ++j) {
      x[j][k] = k == 0 ? initial[j] : out[j][0] / k;
      in[j] = x[j][k];
    }
    if (k == 0)
      start(f, context, in, none, out);
    else
      sweepKnown(f, context, in, none, out);
  }
  return x;
}

// sn' = cn dn, cn' = -sn dn, dn' = -m sn cn
struct Jacobi {
  static constexpr int numInputs = 3, numOutputs = 3, numData = 0;
  template <class T>
  void operator()(const T* x, const Passive<T>*, T* f) const {
    f[0] = x[1] * x[2];
    f[1] = -x[0] * x[2];
    f[2] = -0.5 * x[0] * x[1];
  }
};

TEST(KnownSeries, jacobisEllipticFunctions) {
  const auto rows = readColumns("taylor_jacobi_m05.csv");
  const auto x = solveOde(Jacobi{}, {0.0, 1.0, 1.0}, 60);
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (int i = 0; i < 3; ++i)
      // Sums of up to 20 rounded terms of both signs; the series decays as 1.85^-k.
      EXPECT_NEAR(x[i][k], rows[k][i + 1], 100 * 2.2e-16 * std::pow(1.85, -static_cast<double>(k)))
          << i << " order " << k;
  // Simple poles at +-i K' alone up to twice that distance: s_{k+2}/s_k = -1/K'^2 up to 2^-k and rounding.
  const double radius = std::sqrt(-x[0][57] / x[0][59]);
  EXPECT_NEAR(radius, 1.8540746773013719184, 1e-12);
}

// Painleve I, y'' = 6 y^2 + x, as a system of y, y' and x.
struct PainleveOne {
  static constexpr int numInputs = 3, numOutputs = 3, numData = 0;
  template <class T>
  void operator()(const T* x, const Passive<T>*, T* f) const {
    f[0] = x[1];
    f[1] = 6.0 * x[0] * x[0] + x[2];
    f[2] = T(1.0);
  }
};

TEST(KnownSeries, painleveOne) {
  const auto rows = readColumns("taylor_painleve1.csv");
  const auto x = solveOde(PainleveOne{}, {0.0, 0.0, 0.0}, 128);
  for (const auto& row : rows) {
    const int k = static_cast<int>(row[0]);
    // All terms are positive: nothing cancels.
    EXPECT_NEAR(x[0][k], row[1], 1e-13 * row[1]) << k;
    EXPECT_EQ(x[0][k - 1], 0.0);
  }
  // Five double poles at x0 times the fifth roots of 1: b_j x0^(5j+3) = const (k+1), k = 5j+3, once the next
  // poles, 1.5 times and more away, have died out.
  const double radius = std::pow(x[0][123] / x[0][128] * 129.0 / 124.0, 0.2);
  EXPECT_NEAR(radius, 2.61557120988237385, 1e-10);
}

}  // namespace
