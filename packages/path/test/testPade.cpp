#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "../src/PadeFit.hpp"
#include "../src/PadePatience.hpp"
#include "problems/Ends.hpp"
#include "problems/Record.hpp"

using namespace atrapos::path;

namespace {

/// A series with given coefficients x[k][i] of n unknowns and lambda = a, in the Euclidean product.
Series made(const JetProblem<Bratu>& space, const std::vector<std::vector<double>>& x) {
  Series s({space.vector(x[0]), 0}, 1);
  for (std::size_t k = 1; k < x.size(); ++k) {
    auto u = space.vector(x[k]);
    const double norm = u->norm2();
    s.append({u, {}}, k == 1 ? 1 : 0, norm);
  }
  return s;
}

/// Coefficients of v_1/(1 - a/p_1) + v_2/(1 - a/p_2) + v_3/(1 - a/p_3) with fixed v, n = 5.
constexpr double poles[] = {0.7, 1.1, -0.9};
double residue(int pole, int i) { return std::cos(1.0 + 2 * pole + i); }
std::vector<std::vector<double>> threePoles(int N) {
  std::vector<std::vector<double>> x(N + 1, std::vector<double>(5, 0.0));
  for (int k = 0; k <= N; ++k)
    for (int i = 0; i < 5; ++i)
      for (int p = 0; p < 3; ++p) x[k][i] += residue(p, i) * std::pow(poles[p], -k);
  return x;
}

TEST(Pade, ReproducesARationalFunctionAlsoBeyondItsPoles) {
  JetProblem<Bratu> space(Bratu{5});
  const Series s = made(space, threePoles(8));
  const PadeFit fit = fitPade(space, s, 1e-6, 100);
  ASSERT_TRUE(fit.usable());
  EXPECT_NEAR(fit.range, 0.95 * 0.7, 1e-12);  // up to the first positive pole with the margin of 5 %
  auto u = space.vector({});
  Series form = s;
  form.setForm(fit.form);
  for (const double a : {0.3, -2.0, 0.85, 5.0}) {
    EXPECT_NEAR(form.evaluate(a, *u), a, 1e-9 * (1 + std::abs(a)));
    for (int i = 0; i < 5; ++i) {
      double exact = 0;
      for (int p = 0; p < 3; ++p) exact += residue(p, i) / (1 - a / poles[p]);
      // Rounding of the coefficients, 1e-16, times the condition of a fit of eight orders.
      EXPECT_NEAR(u->getData()[i], exact, 1e-9 * (1 + std::abs(exact))) << a;
    }
  }
  const auto found = realPoles(space, s, 1, 2, 1e-13, 1e-6);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[0], 0.7, 1e-9);
  EXPECT_NEAR(found[1], -0.9, 1e-9);
  EXPECT_NEAR(found[2], 1.1, 1e-9);
}

/// With coefficients that are linearly independent the fit is Cochelin and Najah's:
/// d_i = -(1/alpha_{N-i,N-i}) sum_{j<i} d_j alpha_{N-j,N-i} on the Gram-Schmidt basis.
TEST(Pade, IsCochelinAndNajahsWhereTheSeriesHasFullRank) {
  constexpr int n = 8, N = 6;
  JetProblem<Bratu> space(Bratu{n});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<std::vector<double>> x(N + 1, std::vector<double>(n));
  for (auto& xk : x)
    for (double& value : xk) value = uniform(random);
  const Series s = made(space, x);
  const PadeFit fit = fitPade(space, s, 1.0, 100);  // any accuracy: the form is what is looked at
  ASSERT_TRUE(fit.form);
  // Gram-Schmidt of the coefficients with lambda as one more component.
  std::vector<std::vector<double>> q, alpha(N + 1, std::vector<double>(N + 1, 0.0));
  for (int i = 1; i <= N; ++i) {
    auto v = x[i];
    v.push_back(i == 1 ? 1 : 0);
    for (int j = 1; j < i; ++j) {
      for (int c = 0; c <= n; ++c) alpha[i][j] += v[c] * q[j - 1][c];
      for (int c = 0; c <= n; ++c) v[c] -= alpha[i][j] * q[j - 1][c];
    }
    double size = 0;
    for (const double c : v) size += c * c;
    alpha[i][i] = std::sqrt(size);
    for (double& c : v) c /= alpha[i][i];
    q.push_back(v);
  }
  std::vector<double> d{1};
  for (int i = 1; i <= N - 1; ++i) {
    double sum = 0;
    for (int j = 0; j < i; ++j) sum += d[j] * alpha[N - j][N - i];
    d.push_back(-sum / alpha[N - i][N - i]);
  }
  ASSERT_EQ(fit.form->denominator().coefficients().size(), d.size());
  for (int i = 0; i < N; ++i)  // rounding times the condition of a random triangle of size 6
    EXPECT_NEAR(fit.form->denominator().coefficients()[i], d[i], 1e-10 * (1 + std::abs(d[i]))) << i;
}

TEST(Pade, FractionWeightsAndDerivativesAreOneThing) {
  const Pade form(4, {1, 0.3, -0.2, 0.1});
  const std::vector<double> x{0.5, -1, 2, 0.7, 3, 9};
  const Rational f = form.fraction(x);
  const double a = 0.6, h = 1e-4;
  double sum = 0, slope = 0;
  const auto c = form.weights(a), d = form.derivativeWeights(a);
  for (int i = 0; i <= 4; ++i) {
    sum += c[i] * x[i];
    slope += d[i] * x[i];
  }
  EXPECT_NEAR(f(a), sum, 1e-15);  // a few roundings
  EXPECT_NEAR(f.derivative()(a), slope, 1e-14);
  EXPECT_NEAR((f(a + h) - f(a - h)) / (2 * h), slope, 1e-7);  // h^2 times a third derivative of order 10
  EXPECT_NEAR(f.minus(f(a)).roots(0.61).back(), a, 1e-14);
  // Orders 0 .. 4 of the fraction are the coefficients: the rest is of order 5.
  const auto rest = [&](double t) { return std::abs(f(t) - Polynomial({0.5, -1, 2, 0.7, 3})(t)); };
  EXPECT_NEAR(std::log2(rest(0.02) / rest(0.01)), 5, 0.1);  // the next order contributes 0.01
}

template <class Law>
Followed<Law> followed(Law law, std::vector<double> u, int dof, double value, PadeUse use) {
  Options options;
  options.pade = use;
  return Followed<Law>(law, u, 0, options, unknown(law, dof, value));
}

/// Fewer steps at the same residual, inside the steps too, and the same path.
template <class Law>
void expectGain(Law law, std::vector<double> u, int dof, double value) {
  auto off = followed(law, u, dof, value, PadeUse::off);
  auto automatic = followed(law, u, dof, value, PadeUse::automatic);
  auto on = followed(law, u, dof, value, PadeUse::on);
  EXPECT_LT(automatic.outcome.factorizations, off.outcome.factorizations);
  EXPECT_LE(on.outcome.steps, off.outcome.steps);
  for (auto* f : {&off, &automatic, &on}) {
    EXPECT_EQ(f->outcome.reason, EndReason::stopReached) << f->outcome.text;
    EXPECT_NEAR(f->final(dof), value, 1e-12 * std::abs(value));  // root to the conditioning of the fraction
    EXPECT_LE(f->worstInside(), 1e-6);                           // the residual bound
    ASSERT_EQ(f->record.limitPoints().size(), off.record.limitPoints().size());
    for (std::size_t i = 0; i < off.record.limitPoints().size(); ++i)
      // Residual bound 1e-6 times the force scale: 0.1, and sqrt(31) in Bratu's equation.
      EXPECT_NEAR(f->record.limitPoints()[i].lambda, off.record.limitPoints()[i].lambda, 2e-6);
  }
}

TEST(Pade, SavesStepsAtTheSameResidual) {
  expectGain(Truss{}, {0}, 0, 2.2);                            // 6 and 2 steps
  expectGain(TrussOnSpring{0.3}, {0, 0}, 0, 2.2);              // 23 and 13
  expectGain(TrussOnSpring{0.05}, {0, 0}, 0, 2.2);             // 40 and 26
  expectGain(Bratu{31}, std::vector<double>(31, 0.0), 15, 3);  // 3 and 2
}

/// The branch points of the contact law bound the polynomial, not the fraction.
TEST(Pade, PassesTheContactLawsBranchPoints) {
  Options options;
  Stops stops = loads({3});
  options.pade = PadeUse::off;
  Followed<Contact> off(Contact{1e6, 1e-5}, {0}, 0, options, stops);
  options.pade = PadeUse::automatic;
  Followed<Contact> on(Contact{1e6, 1e-5}, {0}, 0, options, stops);
  EXPECT_LT(1.5 * on.outcome.steps, off.outcome.steps);  // 10 and 20 here
  EXPECT_LE(on.worstInside(), 1e-6);
}

/// After failures in a row it rests for 0, 2, 6 and at most 14 steps; one success and it starts again.
TEST(PadePatience, IsShorterTheLongerItHasNotHelped) {
  PadePatience patience;
  const auto rest = [&] {
    int steps = 0;
    while (patience.rests()) ++steps;
    return steps;
  };
  EXPECT_EQ(rest(), 0);
  for (const int expected : {0, 2, 6, 14, 14}) {
    patience.failed();
    EXPECT_EQ(rest(), expected);
  }
  patience.helped();
  patience.failed();
  EXPECT_EQ(rest(), 0);
}

}  // namespace
