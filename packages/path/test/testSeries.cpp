#include <cmath>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "atrapos/path/SeriesStep.hpp"
#include "problems/Record.hpp"

using namespace atrapos::path;

namespace {

template <class Law>
struct Built {
  JetProblem<Law> problem;
  DenseSolver solver;
  Calls calls{problem, solver};
  explicit Built(Law law, double internalWeight = 0) : problem(law, internalWeight) {}
  Series series(std::vector<double> u, double lambda, SeriesRequest request = {}) {
    return buildSeries(calls, {problem.vector(u), lambda}, request);
  }
};

/// a = w <X - X0, X_1> + (lambda - lambda0) lambda_1 must hold at every order.
template <class Law>
void expectPathParameter(const Problem& problem, const Series& s) {
  for (int k = 1; k <= s.order(); ++k) {
    const double p = s.weight() * problem.inner(s.coefficient(k), s.coefficient(1)) +
                     s.lambdaCoefficient(k) * s.lambdaCoefficient(1);
    const double size = s.weight() * s.norm(k) * s.norm(1) + std::abs(s.lambdaCoefficient(k));
    EXPECT_NEAR(p, k == 1 ? 1 : 0, 1e-13 * (1 + size)) << "order " << k;  // rounding of two cancelling terms
  }
}

TEST(Series, MeetsThePathParameterAtEveryOrder) {
  Built<TrussOnSpring> truss(TrussOnSpring{});
  expectPathParameter<TrussOnSpring>(truss.problem, truss.series({0, 0}, 0));
  Built<Contact> contact(Contact{}, 1.0);  // with the internal variable in the inner product
  const auto s = contact.series({0.5}, 0.599980007995992);
  expectPathParameter<Contact>(contact.problem, s);
  EXPECT_NE(s.coefficient(1).internal.at(0), 0);
}

TEST(Series, DefaultWeightBalancesLoadAndDisplacement) {
  Built<TrussOnSpring> truss(TrussOnSpring{});
  const auto s = truss.series({0, 0}, 0);
  EXPECT_NEAR(s.lambdaCoefficient(1), std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(s.weight() * s.norm(1) * s.norm(1), 0.5, 1e-14);
}

/// Order K leaves a residual of order K + 1: halving a divides it by 2^(K+1).
TEST(Series, ResidualFallsLikeThePowerOfTheOrder) {
  for (const int order : {1, 2, 3, 5, 8}) {
    Built<TrussOnSpring> truss(TrussOnSpring{0.5});
    SeriesRequest request;
    request.order = order;
    const auto s = truss.series({0, 0}, 0, request);
    auto u = truss.problem.vector({}), r = truss.problem.vector({});
    const auto residualAt = [&](double a) {
      const double lambda = s.evaluate(a, *u);
      return truss.problem.residual({u, lambda}, *r).norm;
    };
    // Small against the radius (about 0.9), large enough for a residual above rounding at order 8.
    const double a = 0.1;
    const double rate = std::log2(residualAt(a) / residualAt(a / 2));
    EXPECT_NEAR(rate, order + 1, 0.15) << "order " << order;  // next term of the expansion: a relative O(a)
  }
}

/// With the load as the only weight of a (w -> 0), s(p) must have the closed-form coefficients.
TEST(Series, ReproducesTheBarsTaylorCoefficients) {
  Built<StvkBar> bar(StvkBar{});
  SeriesRequest request;
  request.order = 12;
  request.weight = 1e-30;  // lambda_1 = 1 - O(1e-30), lambda_k = O(1e-30): a is lambda
  const auto s = bar.series({0}, 0, request);
  std::ifstream file(ATRAPOS_TEST_DATA "/stvk_bar_taylor.csv");
  std::string text;
  std::getline(file, text);  // comment
  int k = 0, read = 0;
  char comma;
  double value;
  while (file >> k >> comma >> value) {
    ++read;
    if (k < 1 || k > 12) continue;
    // Printed to 15 digits or so; recurrences lose a few roundings.
    EXPECT_NEAR(s.coefficient(k).u->getData()[0], value, 1e-13 * std::abs(value)) << k;
  }
  EXPECT_GT(read, 12);
}

TEST(Series, RadiusOfAGeometricSeries) {
  // u_k = rho^-k: eq. (36) gives rho delta^(1/(K-1)) exactly.
  JetProblem<StvkBar> problem(StvkBar{});
  const double rho = 0.3, delta = 1e-6;
  Series s({problem.vector({0}), 0}, 1.0);
  const int K = 20;
  for (int k = 1; k <= K; ++k) {
    const double c = std::pow(rho, -k);
    s.append({problem.vector({c}), {}}, 0, c);
  }
  EXPECT_NEAR(s.radius(delta), rho * std::pow(delta, 1.0 / (K - 1)), 1e-14);
}

TEST(Series, RadiusSurvivesAnEvenSeriesAndTermination) {
  JetProblem<StvkBar> problem(StvkBar{});
  Series odd({problem.vector({0}), 0}, 1.0);
  for (int k = 1; k <= 20; ++k) {
    const double c = k % 2 ? 1.0 : 1e-30;
    odd.append({problem.vector({c}), {}}, 0, c);
  }
  EXPECT_NEAR(odd.radius(1e-6), std::pow(1e-6, 1.0 / 19), 1e-14);
  Series finite({problem.vector({0}), 0}, 1.0);
  for (int k = 1; k <= 20; ++k) finite.append({problem.vector({k == 1 ? 1.0 : 0}), {}}, 0, k == 1 ? 1.0 : 0);
  EXPECT_TRUE(std::isinf(finite.radius(1e-6)));
}

TEST(Series, DerivativeMatchesDifference) {
  Built<TrussOnSpring> truss(TrussOnSpring{});
  const auto s = truss.series({0, 0}, 0);
  auto up = truss.problem.vector({}), um = truss.problem.vector({}), du = truss.problem.vector({});
  const double a = 0.05, h = 1e-5;
  const double dLambda = s.derivative(a, *du);
  const double difference = (s.evaluate(a + h, *up) - s.evaluate(a - h, *um)) / (2 * h);
  // Central difference: h^2 times a third derivative of order 10, plus rounding / h.
  EXPECT_NEAR(dLambda, difference, 1e-8);
  for (int i = 0; i < 2; ++i)
    EXPECT_NEAR(du->getData()[i], (up->getData()[i] - um->getData()[i]) / (2 * h), 1e-8);
  EXPECT_NEAR(s.functional(*truss.problem.vector({0, 1}))(a), 0.5 * (up->getData()[1] + um->getData()[1]),
              1e-8);
}

/// A residual R0 at the start leaves along the step: R(a) = R0 (1 - a / relaxOver) + truncation.
TEST(Series, TakesTheStartsResidualToZero) {
  Built<TrussOnSpring> truss(TrussOnSpring{});
  auto r = truss.problem.vector({}), u = truss.problem.vector({1e-5, 0});
  truss.problem.residual({u, 0}, *r);
  SeriesRequest request;
  request.residual = r.get();
  request.relaxOver = 0.1;
  const auto s = truss.series({1e-5, 0}, 0, request);
  const double r0 = r->norm2();
  for (const double a : {0.025, 0.05, 0.1}) {
    const double lambda = s.evaluate(a, *u);
    // The truncation at a = 0.1 of a series with radius about 0.3 is (1/3)^21 = 1e-10.
    EXPECT_NEAR(truss.problem.residual({u, lambda}, *r).norm, r0 * (1 - a / 0.1), 1e-9) << a;
  }
  EXPECT_GT(r0, 1e-6);
}

}  // namespace
