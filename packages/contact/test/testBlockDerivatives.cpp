// Tangent and series of a whole problem with active contact of both kinds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include "atrapos/path/SeriesStep.hpp"

#include "support/ContactModel.hpp"
#include "support/Derivatives.hpp"
#include "support/Differences.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

/// A block between a plane that touches nodes of its top and a skew cylinder below that touches quadrature
/// points.
fem::FeModel squeezed(const fem::Mesh& mesh) {
  fem::FeModel model = solidModel(mesh, 10, 0.3);
  const double slope = 0.1, n = std::hypot(1.0, slope);
  const Plane lid{{0, 0, 1.0}, {slope / n, 0, -1 / n}};
  addContact(model, contactPoints(mesh, "z_max", Where::Nodes), lid, {1e-1, 1e-2}, 0.05);
  const Cylinder tool{{0.4, 0, -2.005}, {0.28, 0.96, 0}, 2.0};
  addContact(model, contactPoints(mesh, "z_min", Where::Quadrature), tool, {1e-2, 1e-1}, 0.05);
  return model;
}

fem::Mesh crookedBox() {
  return fem::test::distorted(fem::test::box(fem::Topology::Hex20, {2, 2, 2}, {1, 1, 1}), 0.02);
}

int count(const Numbers& x, double sign) {
  return std::count_if(x.begin(), x.end(), [&](double v) { return sign * v > 0; });
}

// No supports, so that every row and column is the terms' own.
TEST(BlockDerivatives, TangentIsTheSymmetricDerivativeOfTheResidual) {
  const auto mesh = crookedBox();
  fem::FeProblem problem(squeezed(mesh));
  const Numbers u = fem::test::randomNumbers(mesh.coordinates.size(), 0.08, 5);
  const auto state = fem::test::vectorOf(problem, u);
  for (const int term : {1, 2}) {  // on both sides of h = 0
    EXPECT_GT(count(observed(problem, term, {state, 0}, "contact_gap"), +1), 1) << term;
    EXPECT_GT(count(observed(problem, term, {state, 0}, "contact_gap"), -1), 1) << term;
  }

  const auto K = fem::test::tangent(problem, u, 0);
  const double largest = fem::test::largest(K.value);
  for (std::size_t i = 0; i + 1 < K.start.size(); ++i)
    for (std::size_t e = K.start[i]; e < K.start[i + 1]; ++e)
      // Sums of some 100 rounded products.
      ASSERT_NEAR(K.value[e], K.at(K.column[e], static_cast<int>(i)), 1e-13 * largest);

  // Central differences along random directions: the error falls by 4.
  for (unsigned seed = 6; seed < 9; ++seed)
    // Far below the distance to the laws' branch points, 2 sqrt(eta Delta/alpha) >= 0.014.
    expectDerivative(problem, K, u, 0, fem::test::randomNumbers(u.size(), 1, seed), 0, 4e-4);
}

// The residual along a series of order K at an equilibrium with contact falls as a^(K+1).
TEST(BlockDerivatives, ResidualOfASeriesFallsWithItsOrder) {
  const auto mesh = fem::test::box(fem::Topology::Hex20, {2, 2, 2}, {1, 1, 1});
  fem::FeModel model = squeezed(mesh);
  for (int n : fem::test::nodesOfSet(mesh, "x_min"))
    for (int i = 0; i < 3; ++i) model.prescribe(n, i, 0, i == 2 ? 1.0 : 0.3);
  fem::FeProblem problem(std::move(model));
  const auto start = follow(problem, {problem.initialState(0), 0.0}, -0.03, tightOptions(1e-9));
  // To rounding: what the start leaves must not hide the series' own residual.
  const Numbers u = fem::test::equilibrium(problem, -0.03, fem::FeProblem::values(*start.final.u), 1e-12).u;
  const auto solver = linear::makeTangentSolver();
  path::Calls calls(problem, *solver);
  for (const int order : {2, 5, 8}) {
    path::SeriesRequest request;
    request.order = order;
    const auto series = path::buildSeries(calls, {fem::test::vectorOf(problem, u), -0.03}, request);
    expectOrder(problem, series, order);
  }
}

}  // namespace
