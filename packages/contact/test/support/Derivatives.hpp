#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/Calls.hpp"
#include "atrapos/path/SeriesStep.hpp"
#include "support/Vectors.hpp"

namespace atrapos::contact::test {

using fem::test::Numbers;

/// To rounding of sums; all entries are there twice.
inline void expectSymmetric(const fem::test::Tangent& K) {
  const double largest = fem::test::largest(K.value);
  for (std::size_t i = 0; i + 1 < K.start.size(); ++i)
    for (std::size_t e = K.start[i]; e < K.start[i + 1]; ++e)
      ASSERT_NEAR(K.value[e], K.at(K.column[e], static_cast<int>(i)), 1e-13 * largest);
}

/// K v - rate F of the tangent at (u, lambda) against central differences of the residual, whose error must
/// fall by 4 with every halving of the step: from `step` three times.
inline void expectDerivative(fem::FeProblem& problem, const fem::test::Tangent& K, const Numbers& u,
                             double lambda, const Numbers& v, double rate, double step,
                             const fem::test::Memory& memory = nullptr) {
  const Numbers exact = fem::test::sum(K.times(v), -rate, K.F);
  double before = 0;
  for (int i = 0; i < 4; ++i, step /= 2) {
    const Numbers plus =
        fem::test::residual(problem, fem::test::sum(u, step, v), lambda + rate * step, memory).r;
    const Numbers minus =
        fem::test::residual(problem, fem::test::sum(u, -step, v), lambda - rate * step, memory).r;
    Numbers error = fem::test::sum(plus, -1, minus);
    for (std::size_t d = 0; d < error.size(); ++d) error[d] = error[d] / (2 * step) - exact[d];
    const double now = fem::test::norm(error);
    // Rounding is 1e-14/step, about 1e-11; the error itself 1e-6 to 1e-4 at the end.
    if (i > 0) {
      EXPECT_NEAR(before / now, 4.0, 0.1) << "halving " << i;
    }
    before = now;
  }
  EXPECT_LT(before, 1e-3 * fem::test::norm(exact));
}

/// The relative residual along a series of this order at an equilibrium falls as a^(order + 1). Returns an a
/// where it is `high`: high above rounding, inside the radius.
inline double expectOrder(fem::FeProblem& problem, const path::Series& series, int order,
                          double high = 1e-6) {
  auto r = fem::test::zeroVector(problem);
  double a = 1e-3, size = 0;
  const auto at = [&](double length) { return problem.residual(series.state(length), *r).relative(); };
  for (int i = 0; i < 60 && (size = at(a)) > high; ++i) a *= 0.8;
  for (int i = 0; i < 60 && (size = at(a)) < high; ++i) a *= 1.1;
  const double half = at(a / 2);
  EXPECT_GT(half, 1e-13);  // not rounding
  // The next term adds a (K+2)/(K+1)-th power: a few percent of the exponent.
  EXPECT_NEAR(std::log2(size / half), order + 1, 0.1 * (order + 1)) << "order " << order << " a " << a;
  return a;
}

/// Series of several orders at the equilibrium (u, lambda): expectOrder, and along each the event functions
/// are the multipliers of active conditions, unknowns behind the `bodyDofs` of the body, and the gaps of free
/// ones, gapsOf(what term 1 shows at its points).
template <class GapsOf>
void expectEventFunctions(fem::FeProblem& problem, const Numbers& u, double lambda,
                          const fem::test::Memory& memory, std::size_t bodyDofs, const GapsOf& gapsOf) {
  const auto solver = linear::makeTangentSolver();
  path::Calls calls(problem, *solver);
  const path::State start{fem::test::vectorOf(problem, u), lambda, memory};
  const auto conditions = problem.conditionsAt(start);
  for (const int order : {2, 5, 8}) {
    path::SeriesRequest request;
    request.order = order;
    const auto series = path::buildSeries(calls, start, request);
    const double a = expectOrder(problem, series, order);
    auto v = fem::test::zeroVector(problem);
    const double lambdaThere = series.evaluate(a, *v);
    const Numbers values = fem::FeProblem::values(*v);
    const Numbers gaps = gapsOf(problem.term(1).observe(fem::field(*v), lambdaThere));
    for (int i = 0; i < problem.eventCount(); ++i) {
      const double g = series.scalar(series.eventCoefficients(i))(a);
      // A multiplier is an unknown and its series its own; a gap's series misses what is beyond its order, as
      // the residual does.
      if (conditions[i] == 1) {
        EXPECT_NEAR(g, values[bodyDofs + i], 1e-14);
      } else {
        EXPECT_NEAR(g, gaps[i], 1e-4) << i;
      }
    }
  }
}

}  // namespace atrapos::contact::test
