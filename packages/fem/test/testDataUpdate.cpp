// Passive data that follow the state: a force that depends on the cell of space a point is in.
#include <gtest/gtest.h>

#include <cmath>

#include "support/Model.hpp"
#include "support/Vectors.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;

namespace {

/// exp(c x) times the datum, along x.
struct CellForce {
  static constexpr int numInputs = 3, numOutputs = 3, numData = 1;
  static constexpr bool symmetric = true;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const atrapos::taylor::Passive<T>* data, T* f) const {
    using std::exp;
    f[0] = data[0] * exp(0.3 * x[0]);
    f[1] = T(0.0);
    f[2] = T(0.0);
  }

  static constexpr int numObserved = 1;
  static std::vector<std::string> observedNames() { return {"datum"}; }
  KOKKOS_INLINE_FUNCTION void observe(const double*, const double* data, double* observed) const {
    observed[0] = data[0];
  }
};

/// 1 in the cell [0, 0.5), 2 in the next one, ...; what is on entry is added.
double datum(double x) { return 1 + std::floor(2 * x); }

void byCell(int numPoints, const double* in, double* data) {
  for (int p = 0; p < numPoints; ++p) data[p] += datum(in[3 * p]);
}

constexpr double initial = 0.25;

/// A solid with the force at the points of a face; `data` fixed ones, or none for those that follow.
FeProblem problemWith(const Mesh& mesh, const PointSet& points, const std::vector<double>& data) {
  FeModel model = busyModel(mesh);
  if (data.empty())
    model.terms.push_back(
        lawTerm(pointLaw(CellForce{}), points, std::vector<double>(points.numPoints(), initial), byCell));
  else
    model.terms.push_back(lawTerm(pointLaw(CellForce{}), points, data));
  return FeProblem(std::move(model));
}

class FollowingData : public testing::Test {
 protected:
  FollowingData()
      : mesh_(box(Topology::Hex8, {4, 2, 2})), points_(facePoints(mesh_, sideSet(mesh_, "z_min"), 2)[0]) {}

  /// Data of the points in the state u.
  std::vector<double> dataAt(const Numbers& u) const {
    std::vector<double> data;
    const int N = points_.nodesPerEntity;
    for (int p = 0; p < points_.numPoints(); ++p) {
      double x = points_.positions[3 * p];
      for (int n = 0; n < N; ++n)
        x += points_.shape[p * N + n] * u[3 * points_.nodes[p / points_.pointsPerEntity * N + n]];
      data.push_back(initial + datum(x));
    }
    return data;
  }

  Numbers orders(FeProblem& problem, const Numbers& u, const Numbers* between) const {
    problem.beginSeries({vectorOf(problem, u), 0}, 4);
    if (between) residual(problem, *between, 0);
    auto F = zeroVector(problem);
    for (int k = 1; k <= 4; ++k) {
      problem.orderRhs(k, *F);
      problem.completeOrder(k, *vectorOf(problem, randomNumbers(u.size(), 0.1, 50 + k)), 0);
    }
    return FeProblem::values(*F);
  }

  Mesh mesh_;
  PointSet points_;
};

}  // namespace

// Bit by bit those of the fixed data of each state, whatever was evaluated before.
TEST_F(FollowingData, IsAFunctionOfTheState) {
  FeProblem following = problemWith(mesh_, points_, {});
  const Numbers u1 = randomNumbers(3 * mesh_.numNodes(), 0.2, 1),
                u2 = randomNumbers(3 * mesh_.numNodes(), 0.2, 2);
  ASSERT_NE(dataAt(u1), dataAt(u2));
  for (const Numbers* u : {&u1, &u2, &u1}) {
    FeProblem fixed = problemWith(mesh_, points_, dataAt(*u));
    // The tangent first: its diagonal is the size of the prescribed rows of the residual.
    EXPECT_EQ(tangent(following, *u, 0).value, tangent(fixed, *u, 0).value);
    EXPECT_EQ(residual(following, *u, 0).r, residual(fixed, *u, 0).r);
  }
}

TEST_F(FollowingData, SeriesKeepThoseOfTheirStart) {
  FeProblem following = problemWith(mesh_, points_, {});
  const Numbers u1 = randomNumbers(3 * mesh_.numNodes(), 0.2, 1),
                u2 = randomNumbers(3 * mesh_.numNodes(), 0.2, 2);
  FeProblem fixed = problemWith(mesh_, points_, dataAt(u1));
  const Numbers expected = orders(fixed, u1, nullptr);
  EXPECT_GT(norm(expected), 1e-6);
  EXPECT_EQ(orders(following, u1, nullptr), expected);
  EXPECT_EQ(orders(following, u1, &u2), expected);
}
