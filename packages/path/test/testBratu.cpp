#include <cmath>

#include <gtest/gtest.h>

#include "problems/ChebyshevBratu.hpp"
#include "problems/Record.hpp"

using namespace atrapos::path;

namespace {

/// The fold of Bratu's problem: load and value in the middle.
struct BratuFold {
  int count = 0;
  double lambda = 0, middle = 0;
  int steps = 0;
};

BratuFold fold(int N, int dimension) {
  const ChebyshevBratu law(N, dimension);
  JetProblem<ChebyshevBratu> problem(law);
  std::vector<double> weights(law.size(), 0.0);
  weights.back() = 1;
  Stops stops;
  stops.functionals.push_back({"middle", problem.vector(weights), 2.5});
  Options options;
  options.delta = options.residualBound = 1e-11;
  Followed<ChebyshevBratu> f(law, std::vector<double>(law.size(), 0.0), 0, options, stops);
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  BratuFold result;
  result.steps = f.outcome.steps;
  for (std::size_t i = 0; i < f.record.steps.size(); ++i)
    for (const auto& p : f.record.steps[i].limitPoints) {
      ++result.count;
      result.lambda = p.lambda;
      result.middle = f.record.series[i].functional(*problem.vector(weights))(p.a);
    }
  return result;
}

/// Exact to the 16 digits known; spectral discretisation, so 1e-8 is the accuracy of path and root, not of
/// the mesh.
TEST(Bratu, FoldInOneDimension) {
  const BratuFold f = fold(24, 1);
  EXPECT_EQ(f.count, 1);
  EXPECT_NEAR(f.lambda, 3.513830719125161, 1e-8);
  EXPECT_NEAR(f.middle, 1.186842168634389, 1e-8);
  EXPECT_LE(f.steps, 5);
}

/// Unit square, 100 unknowns: 6.80812442258 by collocation of higher order in the reference.
TEST(Bratu, FoldInTwoDimensions) {
  const BratuFold f = fold(20, 2);
  EXPECT_EQ(f.count, 1);
  EXPECT_NEAR(f.lambda, 6.80812442258, 6.8e-8);  // 1e-8 of it
  EXPECT_NEAR(f.middle, 1.39166120598, 1e-8);
  EXPECT_LE(f.steps, 5);
}

}  // namespace
