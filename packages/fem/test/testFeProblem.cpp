// Residual, tangent and load direction of FeProblem against plain loops and finite differences.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "atrapos/fem/Loads.hpp"
#include "support/Checks.hpp"
#include "support/Model.hpp"
#include "support/Vectors.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;

namespace {

/// sum over points of weight B^T law(B u), one point after the other, without lanes or batches.
template <class Law>
Numbers plainForces(const Law& law, const PointSet& p, const Numbers& data, const Numbers& u) {
  Numbers f(u.size(), 0.0);
  const int C = p.shapeComponents, I = Law::numInputs;
  for (int e = 0; e < p.numEntities; ++e)
    for (int q = 0; q < p.pointsPerEntity; ++q) {
      const int point = e * p.pointsPerEntity + q;
      double in[9] = {}, out[9];
      for (int i = 0; C == 1 && i < 3; ++i) in[i] = p.positions[3 * point + i];
      for (int n = 0; n < p.nodesPerEntity; ++n)
        for (int m = 0; m < I; ++m)
          in[m] += u[3 * p.nodes[e * p.nodesPerEntity + n] + m / C] * p.shapeAt(point, n, m % C);
      law(in, data.data() + point * Law::numData, out);
      for (int n = 0; n < p.nodesPerEntity; ++n)
        for (int m = 0; m < I; ++m)
          f[3 * p.nodes[e * p.nodesPerEntity + n] + m / C] +=
              p.weights[point] * out[m] * p.shapeAt(point, n, m % C);
    }
  return f;
}

/// The same points with all gradients written out for each entity.
PointSet writtenOut(PointSet p) {
  Numbers shape;
  for (int point = 0; point < p.numPoints(); ++point)
    for (int n = 0; n < p.nodesPerEntity; ++n)
      for (int i = 0; i < 3; ++i) shape.push_back(p.shapeAt(point, n, i));
  p.shape = shape;
  p.maps.clear();
  return p;
}

double asymmetry(const Tangent& K, const Numbers& x, const Numbers& y) {
  const double a = dot(K.times(x), y), b = dot(K.times(y), x);
  return std::abs(a - b) / (norm(K.times(x)) * norm(y));
}

class Cells : public testing::TestWithParam<Topology> {};

}  // namespace

TEST_P(Cells, ForcesAreThoseOfAPlainLoop) {
  Mesh mesh = distorted(box(GetParam()), 0.03);
  auto& cells = mesh.blocks[0].nodes;
  const std::size_t nodesPerCell = nodesPerElement(GetParam());
  // An odd number of cells: the last batch is an incomplete one however many lanes there are.
  if (cells.size() / nodesPerCell % 2 == 0) cells.resize(cells.size() - nodesPerCell);
  const PointSet points = volumePoints(mesh, mesh.blocks[0], tabulate(GetParam()));
  ASSERT_NE(points.numEntities % kLanes, 0);
  const Numbers scale = unevenScale(points, 11);
  Numbers u = randomNumbers(3 * mesh.numNodes(), 0.02, 12);
  for (int node = 0; node < mesh.numNodes(); ++node)  // what holds a node of no cell is no force of cells
    if (std::find(cells.begin(), cells.end(), node) == cells.end()) std::fill_n(&u[3 * node], 3, 0.0);
  FeModel model;
  model.dofs = DofMap::displacements(mesh.numNodes());
  model.terms = solidTerms(mesh);
  FeProblem problem(std::move(model));
  const Numbers expected = plainForces(ExponentialSolid{}, points, scale, u);
  // Sums of about a hundred terms.
  EXPECT_LT(norm(sum(residual(problem, u, 0).r, -1, expected)), 1e-14 * norm(expected) * 10);
}

// Shared gradients with maps and gradients of each entity's own go through different loops.
TEST_P(Cells, OwnGradientsDoAsThoseThatEntitiesShare) {
  const Mesh mesh = distorted(box(GetParam()), 0.03);
  const PointSet points = volumePoints(mesh, mesh.blocks[0], tabulate(GetParam()));
  ASSERT_FALSE(points.maps.empty());
  const Numbers u = randomNumbers(3 * mesh.numNodes(), 0.02, 12),
                x = randomNumbers(3 * mesh.numNodes(), 1, 13);
  const auto along = [&](const PointSet& p) {
    FeModel model;
    model.dofs = DofMap::displacements(mesh.numNodes());
    model.terms.push_back(lawTerm(pointLaw(ExponentialSolid{}), p, unevenScale(p, 11)));
    FeProblem problem(std::move(model));
    return std::pair(residual(problem, u, 0).r, tangent(problem, u, 0).times(x));
  };
  const auto [r, Kx] = along(points);
  const auto [ownR, ownKx] = along(writtenOut(points));
  // Sums of some hundred terms.
  EXPECT_LT(norm(sum(ownR, -1, r)), 1e-13 * norm(r));
  EXPECT_LT(norm(sum(ownKx, -1, Kx)), 1e-13 * norm(Kx));
}

TEST_P(Cells, TangentIsTheDerivativeOfTheResidual) {
  checkTangent(busyModel(distorted(box(GetParam()), 0.03)));
}

// A term that sees the load factor: its share of dR/dlambda, and what it shows.
TEST(FeProblem, TermsSeeTheLoadFactor) {
  const Mesh mesh = distorted(box(Topology::Hex8), 0.03);
  const auto pulled = [&] {
    FeModel model = busyModel(mesh);
    for (const PointSet& p : facePoints(mesh, sideSet(mesh, "x_max"), 3))
      model.terms.push_back(lawTerm(pointLaw(MovingPull{0.2}), p));
    return model;
  };
  checkTangent(pulled());
  const int last = static_cast<int>(pulled().terms.size()) - 1;
  FeProblem problem(pulled());
  EXPECT_TRUE(problem.term(last).seesLoadFactor());
  EXPECT_FALSE(problem.term(0).seesLoadFactor());
  const auto state = vectorOf(problem, Numbers(3 * mesh.numNodes(), 0.0));
  EXPECT_DOUBLE_EQ(problem.term(last).observe(field(*state), 3).values.at(0), 0.2 + 9);
  EXPECT_GT(norm(sum(problem.forces(problem.term(last), {state, 1}), -1,
                     problem.forces(problem.term(last), {state, 2}))),
            0.1);
}

INSTANTIATE_TEST_SUITE_P(All, Cells, testing::ValuesIn(allCells()),
                         [](const auto& info) { return std::string(topologyName(info.param)); });

TEST(FeProblem, TangentOfSeveralBlocksWithContactLikeTerms) {
  const Mesh mesh = mixedMesh();
  FeModel model = busyModel(mesh);
  for (const char* set : {"x_max", "y_min"})
    for (const PointSet& p : facePoints(mesh, sideSet(mesh, set), 3))
      model.terms.push_back(lawTerm(pointLaw(CentralForce{}), p));
  model.terms.push_back(lawTerm(pointLaw(CentralForce{0.7}), nodePoints(mesh, {3, 8, 50})));
  checkTangent(std::move(model));
}

TEST(FeProblem, TermsAddUpAndLoadsAreSubtracted) {
  const Mesh mesh = mixedMesh();
  FeModel model = busyModel(mesh);
  const Supports supports = model.supports;
  const Numbers constant = model.constantLoad, load = model.load;
  const PointSet faces = facePoints(mesh, sideSet(mesh, "x_max"), 3).at(0);
  model.terms.push_back(lawTerm(pointLaw(CentralForce{}), faces));
  const Numbers u = randomNumbers(3 * mesh.numNodes(), 0.02, 12);
  Numbers expected(u.size(), 0.0);
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const PointSet p = volumePoints(mesh, mesh.blocks[b], tabulate(mesh.blocks[b].topology));
    expected = sum(expected, 1, plainForces(ExponentialSolid{}, p, unevenScale(p, 11 + b), u));
  }
  const Numbers central = plainForces(CentralForce{}, faces, {}, u);
  expected = sum(expected, 1, central);
  const double lambda = 0.6;
  expected = sum(sum(expected, -1, constant), -lambda, load);

  FeProblem problem(std::move(model));
  EXPECT_EQ(problem.numTerms(), 8);
  const auto got = residual(problem, u, lambda);
  Numbers reactions = problem.reactions({vectorOf(problem, u), lambda});
  Numbers difference, reactionError;
  for (std::size_t d = 0; d < u.size(); ++d) {
    const bool loose = d / 3 + 2 >= static_cast<std::size_t>(mesh.numNodes());
    if (supports.fixed(d)) {
      reactionError.push_back(reactions[d] - expected[d]);
    } else {
      EXPECT_EQ(reactions[d], 0.0);
      if (loose) continue;
      difference.push_back(got.r[d] - expected[d]);
    }
  }
  // Sums of a few hundred terms.
  const double rounding = 1e-13 * norm(expected);
  EXPECT_LT(norm(difference), rounding);
  EXPECT_LT(norm(reactionError), rounding);
  // All rows count, those of the supports that this random u violates as well.
  EXPECT_NEAR(got.norm.norm, norm(got.r), 1e-13 * norm(got.r));
  EXPECT_LT(norm(sum(problem.forces(problem.term(7), {vectorOf(problem, u), 0}), -1, central)), rounding);
}

TEST(FeProblem, TangentIsSymmetricWhereAllLawsAre) {
  const Mesh mesh = mixedMesh();
  const auto x = randomNumbers(3 * mesh.numNodes(), 1, 1), y = randomNumbers(3 * mesh.numNodes(), 1, 2);
  const auto u = randomNumbers(3 * mesh.numNodes(), 0.02, 3);
  FeProblem symmetric(busyModel(mesh));
  EXPECT_TRUE(symmetric.symmetric());
  EXPECT_LT(asymmetry(tangent(symmetric, u, 0.4), x, y), 1e-14);  // rounding of sums of like signs

  FeModel model = busyModel(mesh);
  model.terms.push_back(lawTerm(pointLaw(Swirl{}), facePoints(mesh, sideSet(mesh, "x_max"), 3).at(0)));
  FeProblem unsymmetric(std::move(model));
  EXPECT_FALSE(unsymmetric.symmetric());
  EXPECT_GT(asymmetry(tangent(unsymmetric, u, 0.4), x, y), 1e-6);
}

TEST(FeProblem, TangentOfAnUnsymmetricLaw) {
  const Mesh mesh = box(Topology::Hex8);
  FeModel model = busyModel(mesh);
  for (const char* set : {"z_max", "y_max"})
    model.terms.push_back(lawTerm(pointLaw(Swirl{2.0}), facePoints(mesh, sideSet(mesh, set), 3).at(0)));
  checkTangent(std::move(model));
}

TEST(FeProblem, RowsAndColumnsOfPrescribedDofs) {
  const Mesh mesh = mixedMesh();
  FeModel model = busyModel(mesh);
  const Supports supports = model.supports;
  FeProblem problem(std::move(model));
  const Tangent K = tangent(problem, randomNumbers(3 * mesh.numNodes(), 0.02, 12), 0.3);
  double s = 0;
  int fixed = 0;
  for (int d = 0; d < 3 * mesh.numNodes(); ++d) {
    const bool loose = d / 3 + 2 >= mesh.numNodes();
    if (!supports.fixed(d) && !loose) continue;
    ++fixed;
    s = K.at(d, d);
    for (std::size_t e = K.start[d]; e < K.start[d + 1]; ++e)
      EXPECT_EQ(K.value[e], K.column[e] == d ? s : 0.0);
    EXPECT_EQ(K.F[d], s * supports.perLoadFactor(d));
  }
  EXPECT_EQ(problem.numFreeDofs(), 3 * mesh.numNodes() - fixed);
  const Tangent atStart = tangent(problem, FeProblem::values(*problem.initialState(0)), 0);
  double diagonal = 0;
  for (int row = 0; row < 3 * mesh.numNodes(); ++row) {
    const bool free = !supports.fixed(row) && row / 3 + 2 < mesh.numNodes();
    if (free) diagonal = std::max(diagonal, std::abs(atStart.at(row, row)));
    for (std::size_t e = K.start[row]; free && e < K.start[row + 1]; ++e)
      if (supports.fixed(K.column[e])) {
        EXPECT_EQ(K.value[e], 0.0);
      }
  }
  EXPECT_EQ(s, diagonal) << "the rows have the size of the first tangent, whatever came before";
  // The residual's rows are those of K: one Newton step repairs a state off its supports.
  Numbers u(3 * mesh.numNodes(), 0.0);
  const Numbers r = residual(problem, u, 0.3).r;
  for (int d = 0; d < 3 * mesh.numNodes(); ++d)
    if (supports.fixed(d)) {
      EXPECT_DOUBLE_EQ(r[d], -s * supports.at(d, 0.3));
    }
}

TEST(FeProblem, InitialStateKeepsTheSupports) {
  const Mesh mesh = mixedMesh();
  FeModel model = busyModel(mesh);
  const Supports supports = model.supports;
  FeProblem problem(std::move(model));
  const Numbers u = FeProblem::values(*problem.initialState(0.7));
  for (int d = 0; d < 3 * mesh.numNodes(); ++d) EXPECT_EQ(u[d], supports.at(d, 0.7));
}

// At an equilibrium the loads and the reactions on the deformed body have no force and no moment.
TEST(FeProblem, ReactionsBalanceTheLoads) {
  // Not HEX20: reduced integration lets forces at single nodes excite its hourglass modes without bound.
  for (Topology cell : {Topology::Hex27, Topology::Tet10, Topology::Wedge6}) {
    SCOPED_TRACE(topologyName(cell));
    const Mesh mesh = distorted(box(cell), 0.02);
    FeModel model = busyModel(mesh);
    for (double& f : model.load) f *= 0.2;
    for (double& f : model.constantLoad) f *= 0.2;
    const Numbers constant = model.constantLoad, load = model.load;
    FeProblem problem(std::move(model));
    const double lambda = 0.3;
    Equilibrium state{FeProblem::values(*problem.initialState(0.0)), {}};
    for (int i = 0; i <= 5; ++i) state = equilibrium(problem, 0.2 * i * lambda, state.u);
    const Numbers forces =
        sum(sum(problem.reactions({vectorOf(problem, state.u), lambda}), 1, constant), lambda, load);
    const Numbers x = sum(mesh.coordinates, 1, state.u);
    double force[3] = {}, moment[3] = {};
    for (int n = 0; n < mesh.numNodes(); ++n)
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        force[i] += forces[3 * n + i];
        moment[i] += x[3 * n + j] * forces[3 * n + k] - x[3 * n + k] * forces[3 * n + j];
      }
    EXPECT_GT(largest(forces), 0.002);
    for (int i = 0; i < 3; ++i) {
      // Newton leaves residuals of rounding, 1e-15, at each of up to 500 dofs.
      EXPECT_NEAR(force[i], 0.0, 1e-12);
      EXPECT_NEAR(moment[i], 0.0, 1e-12);
    }
  }
}

TEST(FeProblem, UnloadedBodyHasNoNegativePivot) {
  for (Topology cell : allCells()) {
    SCOPED_TRACE(topologyName(cell));
    const Mesh mesh = box(cell);
    FeModel model = busyModel(mesh);
    model.supports = {};
    for (int n : nodesOfSet(mesh, "x_min"))
      for (int c = 0; c < 3; ++c) model.prescribe(n, c, 0.0, 0.0);
    for (int n : nodesOfSet(mesh, "x_max")) model.prescribe(n, 1, 0.0, 0.5);
    model.constantLoad.assign(3 * mesh.numNodes(), 0.0);
    FeProblem problem(std::move(model));
    const auto state = equilibrium(problem, 0.0, Numbers(3 * mesh.numNodes(), 0.0));
    EXPECT_EQ(largest(state.u), 0.0);
    ASSERT_TRUE(state.inertia);
    EXPECT_EQ(state.inertia->negative, 0);
  }
}

TEST(FeProblem, ScaleIsTheLargestOfTheForces) {
  const Mesh mesh = box(Topology::Hex8, {1, 1, 1});
  FeModel model = busyModel(mesh);
  const Numbers constant = model.constantLoad, load = model.load;
  FeProblem problem(std::move(model));
  Numbers u(3 * mesh.numNodes(), 0.0);
  EXPECT_DOUBLE_EQ(residual(problem, u, 0.0).norm.scale, norm(constant));
  EXPECT_DOUBLE_EQ(residual(problem, u, 100.0).norm.scale, norm(sum(constant, 100.0, load)));
  u = randomNumbers(u.size(), 0.3, 4);
  const Numbers internal = problem.forces(problem.term(0), {vectorOf(problem, u), 0});
  EXPECT_GT(norm(internal), norm(constant));
  EXPECT_DOUBLE_EQ(residual(problem, u, 0.0).norm.scale, norm(internal));
}

// A bar stretched evenly: the forces of its cells cancel at the nodes between them, and count all the same.
TEST(FeProblem, ScaleCountsWhatCancelsAtTheNodes) {
  const Mesh mesh = box(Topology::Hex8, {3, 1, 1});
  const PointSet points = volumePoints(mesh, mesh.blocks[0], tabulate(Topology::Hex8));
  const Numbers ones(points.numPoints(), 1.0);
  Numbers u(3 * mesh.numNodes(), 0.0);
  for (int n = 0; n < mesh.numNodes(); ++n) u[3 * n] = 0.1 * mesh.coordinates[3 * n];
  double squares = 0;
  for (int e = 0; e < points.numEntities; ++e) {
    Block cell = mesh.blocks[0];
    cell.nodes.assign(mesh.blocks[0].nodes.begin() + 8 * e, mesh.blocks[0].nodes.begin() + 8 * (e + 1));
    const PointSet own = volumePoints(mesh, cell, tabulate(Topology::Hex8));
    const double force = norm(plainForces(ExponentialSolid{}, own, Numbers(own.numPoints(), 1.0), u));
    squares += force * force;
  }
  FeModel model;
  model.dofs = DofMap::displacements(mesh.numNodes());
  model.terms.push_back(lawTerm(pointLaw(ExponentialSolid{}), points, ones));
  FeProblem problem(std::move(model));
  const double scale = residual(problem, u, 0.0).norm.scale;
  EXPECT_NEAR(scale, std::sqrt(squares), 1e-13 * scale);  // rounding of sums of some hundred terms
  EXPECT_LT(norm(problem.forces(problem.term(0), {vectorOf(problem, u), 0})),
            0.7 * scale);  // 0.60: the end faces are left
}

// Nothing acts at lambda = 0: the scale must stay above zero, also where supports alone drive the body.
TEST(FeProblem, ScaleOfAnUnloadedState) {
  const Mesh mesh = box(Topology::Hex8, {2, 1, 1});
  FeModel model;
  model.dofs = DofMap::displacements(mesh.numNodes());
  model.terms = solidTerms(mesh);
  for (int n : nodesOfSet(mesh, "x_max")) model.prescribe(n, 0, 0.0, 0.1);
  FeProblem problem(std::move(model));
  const auto norm = residual(problem, Numbers(3 * mesh.numNodes(), 0.0), 0.0).norm;
  EXPECT_EQ(norm.norm, 0.0);
  EXPECT_GT(norm.scale, 1e-14);
  EXPECT_EQ(norm.relative(), 0.0);
}

// Supports that would crush a body of length 2 to nothing at load factor 1: the scale is that of their rate.
TEST(FeProblem, ScaleOfSupportsIsThatOfTheirRate) {
  const Mesh mesh = box(Topology::Hex8, {2, 1, 1});
  const auto scale = [&](double perLoadFactor) {
    FeModel model;
    model.dofs = DofMap::displacements(mesh.numNodes());
    model.terms = solidTerms(mesh);
    for (int n : nodesOfSet(mesh, "x_max")) model.prescribe(n, 0, 0.0, perLoadFactor);
    FeProblem problem(std::move(model));
    return residual(problem, Numbers(3 * mesh.numNodes(), 0.0), 0.0).norm.scale;
  };
  const double length = 2, small = scale(-1e-3);
  // What is not linear: a part of about the strain at a thousandth of the displacement, 1e-3 here.
  EXPECT_NEAR(scale(-length) / small, length / 1e-3, 0.01 * length / 1e-3);
}

TEST(FeProblem, ObserveShowsEveryPointInItsPlace) {
  const Mesh mesh = distorted(box(Topology::Tet10, {1, 1, 2}), 0.03);
  FeModel model;
  model.dofs = DofMap::displacements(mesh.numNodes());
  model.terms = solidTerms(mesh);
  const PointSet faces = facePoints(mesh, sideSet(mesh, "y_max"), 2).at(0);
  model.terms.push_back(lawTerm(pointLaw(CentralForce{}), faces));
  const PointSet points = volumePoints(mesh, mesh.blocks[0], tabulate(Topology::Tet10));
  FeProblem problem(std::move(model));
  Numbers u = mesh.coordinates;  // u = A x: trace of A at every point
  for (int n = 0; n < mesh.numNodes(); ++n) {
    const double *x = &mesh.coordinates[3 * n], y = x[1];
    u[3 * n] = 0.1 * x[0] + 0.5 * y;
    u[3 * n + 1] = -0.3 * y;
    u[3 * n + 2] = 0.05 * x[2];
  }
  const auto state = vectorOf(problem, u);
  const PointValues seen = problem.term(0).observe(field(*state), 0);
  ASSERT_EQ(seen.names, (std::vector<std::string>{"trace", "scale"}));
  ASSERT_EQ(seen.values.size(), 2u * points.numPoints());
  const Numbers scale = unevenScale(points, 11);
  for (int p = 0; p < points.numPoints(); ++p) {
    EXPECT_NEAR(seen.values[2 * p], -0.15, 1e-13);  // rounding of ten terms of size one
    EXPECT_EQ(seen.values[2 * p + 1], scale[p]);
  }
  const PointValues places = problem.term(1).observe(field(*state), 0);
  ASSERT_EQ(places.values.size(), 3u * faces.numPoints());
  for (int p = 0; p < faces.numPoints(); ++p)  // x + u of a linear field, rounding of six terms
    EXPECT_NEAR(places.values[3 * p + 1], 0.7 * faces.positions[3 * p + 1], 1e-14);
}

// As an empty block of a mesh makes them.
TEST(FeProblem, TermsMayHaveNoEntities) {
  const Mesh mesh = box(Topology::Hex8, {2, 1, 1});
  Block none = mesh.blocks[0];
  none.nodes.clear();
  const Numbers u = randomNumbers(3 * mesh.numNodes(), 0.02, 12);
  const auto along = [&](bool withEmptyTerm) {
    FeModel model = busyModel(mesh);
    if (withEmptyTerm)
      model.terms.push_back(lawTerm(pointLaw(ExponentialSolid{}),
                                    volumePoints(mesh, none, tabulate(Topology::Hex8)), Numbers{}));
    FeProblem problem(std::move(model));
    return std::pair(residual(problem, u, 0.4).r, tangent(problem, u, 0.4).value);
  };
  EXPECT_EQ(along(true), along(false));
}

TEST(FeProblem, MistakesAreNamed) {
  const Mesh mesh = box(Topology::Hex8, {1, 1, 1});
  const PointSet gradients = volumePoints(mesh, mesh.blocks[0], tabulate(Topology::Hex8));
  const PointSet values = volumeValuePoints(mesh, mesh.blocks[0], tabulate(Topology::Hex8));
  const auto solid = [] { return pointLaw(ExponentialSolid{}); };
  EXPECT_THROW(lawTerm(solid(), values, unevenScale(values, 1)), std::logic_error);
  EXPECT_THROW(lawTerm(solid(), gradients), std::logic_error);
  const PointSet many = volumePoints(mesh, mesh.blocks[0], tabulate(Topology::Hex8, 9));  // 125 points
  EXPECT_THROW(lawTerm(solid(), many, unevenScale(many, 1)), std::invalid_argument);

  FeModel model = busyModel(mesh);
  model.supports.prescribe(model.dofs.numDofs(), 0, 0);
  EXPECT_THROW(FeProblem{std::move(model)}, std::logic_error);

  FeModel lost = busyModel(mixedMesh());  // a force at a node that nothing carries
  lost.load.back() = 1.0;
  EXPECT_THROW(FeProblem{std::move(lost)}, std::invalid_argument);
}
