// A problem shared out over ranks is the problem of one rank: every rank compares with a whole one of its
// own.
#include <gtest/gtest.h>
#include <mpi.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <Tpetra_Map.hpp>
#include <cmath>
#include <functional>

#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/PathFollower.hpp"
#include "support/Model.hpp"
#include "support/Vectors.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;
namespace path = atrapos::path;
namespace linear = atrapos::linear;

namespace {

// Sums at shared nodes come in another order: some roundings of numbers of order 1.
constexpr double rounding = 1e-13;

linear::RCP<const Teuchos::Comm<int>> selfComm() {
  return linear::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF));
}

/// The same model on all ranks together and on this one alone.
struct Both {
  FeProblem shared, whole;
  explicit Both(const std::function<FeModel()>& make) : shared(make()), whole(alone(make())) {}
  static FeModel alone(FeModel model) {
    model.comm = selfComm();
    return model;
  }
};

void expectEqual(const Numbers& a, const Numbers& b, const char* what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  EXPECT_LT(largest(sum(a, -1, b)), rounding * largest(b)) << what;
}

void compareEverything(const std::function<FeModel()>& make) {
  Both both(make);
  const int numDofs = static_cast<int>(FeProblem::values(*both.whole.initialState(0)).size());
  EXPECT_EQ(both.shared.numFreeDofs(), both.whole.numFreeDofs());
  EXPECT_EQ(both.shared.symmetric(), both.whole.symmetric());
  const double lambda = 0.4;
  const Numbers start = FeProblem::values(*both.whole.initialState(lambda));
  expectEqual(FeProblem::values(*both.shared.initialState(lambda)), start, "initial state");
  // Off the supports and couplings too, so that their rows count.
  const Numbers u = sum(start, 1, randomNumbers(numDofs, 0.01, 5)), x = randomNumbers(numDofs, 1, 6);

  const auto r = residual(both.shared, u, lambda), r1 = residual(both.whole, u, lambda);
  expectEqual(r.r, r1.r, "residual");
  EXPECT_NEAR(r.norm.scale, r1.norm.scale, rounding * r1.norm.scale);
  EXPECT_NEAR(r.norm.norm, r1.norm.norm, rounding * r1.norm.norm);
  const auto K = tangentTimes(both.shared, u, lambda, x), K1 = tangentTimes(both.whole, u, lambda, x);
  expectEqual(K.Kx, K1.Kx, "tangent");
  expectEqual(K.F, K1.F, "load direction");

  // Orders with any coefficients: no solver between them.
  const int order = 8;
  both.shared.beginSeries({vectorOf(both.shared, u), lambda}, order);
  both.whole.beginSeries({vectorOf(both.whole, u), lambda}, order);
  auto F = zeroVector(both.shared), F1 = zeroVector(both.whole);
  for (int k = 1; k <= order; ++k) {
    both.shared.orderRhs(k, *F);
    both.whole.orderRhs(k, *F1);
    if (k > 1) {
      expectEqual(FeProblem::values(*F), FeProblem::values(*F1), "order");
    }
    const Numbers Uk = randomNumbers(numDofs, 0.1, 100 + k);
    both.shared.completeOrder(k, *vectorOf(both.shared, Uk), 0.1 * k);
    both.whole.completeOrder(k, *vectorOf(both.whole, Uk), 0.1 * k);
  }

  const auto state = vectorOf(both.shared, u), state1 = vectorOf(both.whole, u);
  expectEqual(both.shared.reactions({state, lambda}), both.whole.reactions({state1, lambda}), "reactions");
  for (int t = 0; t < both.shared.numTerms(); ++t) {
    expectEqual(both.shared.forces(both.shared.term(t), {state, lambda}),
                both.whole.forces(both.whole.term(t), {state1, lambda}), "forces");
    const auto seen = both.shared.observe(t, {state, lambda}),
               seen1 = both.whole.observe(t, {state1, lambda});
    EXPECT_EQ(seen.names, seen1.names);
    if (!seen1.names.empty()) expectEqual(seen.values, seen1.values, "observed values");
  }
}

FeModel manyTerms(const Mesh& mesh, double strength = 1) {
  FeModel model = busyModel(mesh);
  for (const PointSet& p : facePoints(mesh, sideSet(mesh, "x_max"), 3)) {
    model.terms.push_back(lawTerm(pointLaw(CentralForce{0.5 * strength}), p));
    model.terms.push_back(lawTerm(pointLaw(Swirl{0.2 * strength}), p));
    model.terms.push_back(lawTerm(pointLaw(MovingPull{0.2 * strength}), p));
  }
  model.terms.push_back(lawTerm(pointLaw(CentralForce{0.7 * strength}), nodePoints(mesh, {3, 8, 50})));
  return model;
}

/// The same on one body that the supports hold, with forces that it bears.
FeModel heldTerms() {
  FeModel model = manyTerms(distorted(box(Topology::Hex8, {5, 3, 2}), 0.03), 0.05);
  for (std::size_t d = 0; d < model.load.size(); ++d) {
    model.load[d] *= 0.1;
    model.constantLoad[d] *= 0.1;
  }
  return model;
}

/// A box whose far end stays a plane that is driven along; a node far from it follows two others.
FeModel coupledBox() {
  const Mesh mesh = distorted(box(Topology::Hex20, {4, 2, 2}, {2, 1, 1}), 0.02);
  FeModel model;
  model.dofs = DofMap::displacements(mesh.numNodes());
  model.terms = solidTerms(mesh);
  for (const int n : nodesOfSet(mesh, "x_min"))
    for (int i = 0; i < 3; ++i) model.prescribe(n, i, 0, 0);
  const auto end = nodesOfSet(mesh, "x_max");
  couplePlane(model.couplings, model.dofs, end, {1, 0.2, 0});
  Coupling driven;
  const auto nodeNear = [&](double x, double z) {
    int nearest = 0;
    const auto distance = [&](int n) {
      return std::hypot(mesh.coordinates[3 * n] - x, mesh.coordinates[3 * n + 2] - z);
    };
    for (int n = 1; n < mesh.numNodes(); ++n)
      if (distance(n) < distance(nearest)) nearest = n;
    return nearest;
  };
  driven.dof = 3 * nodeNear(0.5, 1) + 2;
  driven.masters = {{3 * nodeNear(1, 0), 0.3}, {3 * end[0] + 2, 0.4}};
  driven.value = 0.01;
  driven.perLoadFactor = 0.05;
  model.couplings.add(driven);
  model.load = randomNumbers(3 * mesh.numNodes(), 0.01, 22);
  return model;
}

}  // namespace

TEST(Ranks, AllCellsWithSupportsAndLoads) {
  compareEverything([] { return busyModel(mixedMesh()); });
}

TEST(Ranks, FacesAndPointsAndTermsThatSeeTheLoadFactor) {
  compareEverything([] { return manyTerms(mixedMesh()); });
}

TEST(Ranks, TwoFieldsOfWhichOneLivesAtCorners) {
  compareEverything([] { return heatedModel<2>(distorted(box(Topology::Hex20, {4, 3, 2}), 0.02)); });
}

TEST(Ranks, Couplings) { compareEverything(coupledBox); }

TEST(Ranks, FewerElementsThanRanks) {
  compareEverything([] { return busyModel(box(Topology::Hex20, {1, 1, 2})); });
}

TEST(Ranks, DataThatFollowTheState) {
  compareEverything([] {
    const Mesh mesh = box(Topology::Hex8, {5, 2, 1});
    FeModel model = busyModel(mesh);
    const PointSet points = volumePoints(mesh, mesh.blocks[0], tabulate(Topology::Hex8));
    const auto update = [](int numPoints, const double* in, double* data) {
      for (int p = 0; p < numPoints; ++p) data[p] += in[9 * p] * in[9 * p];
    };
    model.terms[0] = lawTerm(pointLaw(ExponentialSolid{}), points, unevenScale(points, 3), update);
    return model;
  });
}

namespace {

struct Ends final : path::Observer {
  std::vector<double> lambdas, lengths;
  std::vector<Numbers> states;
  bool onStep(const path::StepReport& report, const path::Series&) override {
    lambdas.push_back(report.end.lambda);
    lengths.push_back(report.length);
    states.push_back(FeProblem::values(*report.end.u));
    return true;
  }
};

Ends follow(FeProblem& problem, const std::string& solverType) {
  linear::TangentSolverOptions solverOptions;
  solverOptions.type = solverType;
  solverOptions.symmetric = problem.symmetric();
  const auto solver = linear::makeTangentSolver(solverOptions);
  path::Options options;
  options.order = 10;
  options.maxSteps = 6;  // enough for rounding to grow where it can
  path::Stops stops;
  stops.loadFactors = {0.5};
  path::PathFollower follower(problem, *solver, options, stops);
  Ends ends;
  const path::Outcome outcome = follower.run({problem.initialState(0), 0.0}, ends);
  EXPECT_TRUE(outcome.reason == path::EndReason::stopReached || outcome.reason == path::EndReason::stepLimit)
      << outcome.text;
  return ends;
}

}  // namespace

TEST(Ranks, SamePath) {
  for (const auto& make : {std::function<FeModel()>(heldTerms), std::function<FeModel()>(coupledBox)}) {
    Both both(make);
    const Ends shared = follow(both.shared, "mumps"), whole = follow(both.whole, "mumps");
    ASSERT_EQ(shared.states.size(), whole.states.size());
    for (std::size_t s = 0; s < whole.states.size(); ++s) {
      // The aim of runs on several ranks; conditioning is near 1e3, rounding ten times and more below.
      EXPECT_NEAR(shared.lambdas[s], whole.lambdas[s], 1e-10);
      EXPECT_NEAR(shared.lengths[s], whole.lengths[s], 1e-10 * whole.lengths[s]);
      EXPECT_LT(largest(sum(shared.states[s], -1, whole.states[s])), 1e-10 * largest(whole.states[s]));
    }
  }
}

// Two communicators in one process, of several ranks each: the halves of the program follow two problems at
// the same time, then all of it a third, while the others' factors are still there.
TEST(Ranks, HalvesOfTheProgramWorkAtTheSameTime) {
  int rank = 0, size = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  const int half = rank < (size + 1) / 2 ? 0 : 1;
  MPI_Comm split;
  MPI_Comm_split(MPI_COMM_WORLD, half, rank, &split);
  const auto make = half == 0 ? heldTerms : coupledBox;
  const auto expectSame = [](const Ends& a, const Ends& b) {
    ASSERT_EQ(a.states.size(), b.states.size());
    for (std::size_t s = 0; s < b.states.size(); ++s)  // as in SamePath
      EXPECT_LT(largest(sum(a.states[s], -1, b.states[s])), 1e-10 * largest(b.states[s]));
  };
  {
    FeModel model = make();
    model.comm = linear::rcp(new Teuchos::MpiComm<int>(split));
    FeProblem ours(std::move(model)), all(heldTerms()), mine(Both::alone(make())),
        whole(Both::alone(heldTerms()));
    EXPECT_LE(ours.map()->getComm()->getSize(), (size + 1) / 2);
    const Ends first = follow(ours, "mumps"), together = follow(all, "mumps"), second = follow(ours, "mumps");
    expectSame(first, follow(mine, "mumps"));
    expectSame(second, first);
    expectSame(together, follow(whole, "mumps"));
  }
  MPI_Comm_free(&split);
}

// Nothing in the problem's sums depends on when messages arrive. (MUMPS' do on several ranks; KLU2 works on
// one.)
TEST(Ranks, SameBitsEveryTime) {
  FeProblem one(heldTerms()), two(heldTerms());
  const Ends a = follow(one, "amesos2:klu2"), b = follow(two, "amesos2:klu2");
  EXPECT_TRUE(a.lambdas == b.lambdas);
  EXPECT_TRUE(a.states == b.states);
}

namespace {

/// Fails where x exceeds 1.9 in the start of a series.
struct Fence {
  static constexpr int numInputs = 3, numOutputs = 3, numData = 0;
  static constexpr bool symmetric = true;
  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const atrapos::taylor::Passive<T>*, T* f) const {
    using std::sqrt;
    f[0] = sqrt(1.9 - x[0]);
    f[1] = f[2] = 0.0 * x[1];
  }
  static constexpr int numObserved = 0;
  static std::vector<std::string> observedNames() { return {}; }
  KOKKOS_INLINE_FUNCTION void observe(const double*, const double*, double*) const {}
};

std::string whatIsThrown(const std::function<void()>& f) {
  try {
    f();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "nothing";
}

}  // namespace

TEST(Ranks, ErrorOfOneIsThrownOnAll) {
  Both both([] {
    const Mesh mesh = box(Topology::Hex8, {8, 1, 1}, {2, 1, 1});
    FeModel model = busyModel(mesh);
    std::vector<int> nodes;
    for (int n = 0; n < mesh.numNodes(); ++n) nodes.push_back(n);
    model.terms.push_back(lawTerm(pointLaw(Fence{}), nodePoints(mesh, nodes)));
    return model;
  });
  const auto message = [](FeProblem& problem) {
    return whatIsThrown([&] { problem.beginSeries({problem.initialState(0), 0}, 5); });
  };
  const std::string expected = message(both.whole);
  EXPECT_NE(expected, "nothing");
  EXPECT_EQ(message(both.shared), expected);  // the point is named as in the whole term
}
