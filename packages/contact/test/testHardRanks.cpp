// Hard contact shared out over ranks is that of one rank: every rank compares with a whole problem of its
// own.
#include <gtest/gtest.h>
#include <mpi.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <algorithm>
#include <string>

#include "atrapos/contact/HardContact.hpp"
#include "atrapos/contact/MovingTool.hpp"
#include "support/ContactModel.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

/// A cylinder below that turns and rises.
MovingTool<Cylinder> turning() {
  MovingTool<Cylinder> tool;
  tool.tool = {{0.9, 0, -2.02}, {0.28, 0.96, 0}, 2.0};
  tool.motion.shift[1][2] = 0.3;
  tool.motion.angle[1] = 0.2;
  return tool;
}

fem::Mesh mesh() {
  return fem::test::distorted(fem::test::box(fem::Topology::Hex8, {6, 3, 2}, {2, 1, 1}), 0.01);
}

/// A block over it whose upper face is pushed down and along; no symmetry, so that points close one by one.
fem::FeModel block(bool alone) {
  const fem::Mesh body = mesh();
  fem::FeModel model = solidModel(body, 10, 0.3);
  addHardContact(model, contactPoints(body, "z_min", Where::Nodes), turning());
  for (int n : fem::test::nodesOfSet(body, "z_max"))
    for (int i = 0; i < 3; ++i) model.supports.prescribe(n, i, 0, i == 2 ? -1.0 : 0.3);
  if (alone) model.comm = linear::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF));
  return model;
}

struct Both {
  fem::FeProblem shared{block(false)}, whole{block(true)};
};

/// Every third point is active.
std::vector<int> someActive(int count) {
  std::vector<int> conditions(count, 0);
  for (int i = 0; i < count; i += 3) conditions[i] = 1;
  return conditions;
}

void expectEqual(const Numbers& a, const Numbers& b, const char* what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  // Sums at shared nodes come in another order: some roundings.
  EXPECT_LE(fem::test::largest(fem::test::sum(a, -1, b)), 1e-13 * fem::test::largest(b)) << what;
}

/// Events of a path: indices in ascending order, step by step.
struct Events final : path::Observer {
  std::vector<std::vector<int>> ofSteps;
  bool onStep(const path::StepReport& report, const path::Series&) override {
    ofSteps.push_back(report.events);
    std::sort(ofSteps.back().begin(), ofSteps.back().end());
    return true;
  }
};

}  // namespace

TEST(HardRanks, SumsAndEventFunctionsAreThoseOfOneRank) {
  Both both;
  ASSERT_EQ(both.shared.eventCount(), both.whole.eventCount());
  const auto conditions = someActive(both.whole.eventCount());
  both.shared.setConditions(conditions);
  both.whole.setConditions(conditions);
  EXPECT_EQ(both.shared.conditions(), conditions);
  EXPECT_EQ(both.shared.constraintPivots(), both.whole.constraintPivots());

  const double lambda = 0.03;
  const Numbers start = fem::FeProblem::values(*both.whole.initialState(lambda));
  const Numbers u = fem::test::sum(start, 1, fem::test::randomNumbers(start.size(), 0.01, 5));
  const Numbers x = fem::test::randomNumbers(start.size(), 1, 6);
  expectEqual(fem::test::residual(both.shared, u, lambda).r, fem::test::residual(both.whole, u, lambda).r,
              "residual");
  const auto K = fem::test::tangentTimes(both.shared, u, lambda, x),
             K1 = fem::test::tangentTimes(both.whole, u, lambda, x);
  expectEqual(K.Kx, K1.Kx, "tangent");
  expectEqual(K.F, K1.F, "load direction");

  const int order = 6;
  both.shared.beginSeries(*fem::test::vectorOf(both.shared, u), lambda, order);
  both.whole.beginSeries(*fem::test::vectorOf(both.whole, u), lambda, order);
  auto F = fem::test::zeroVector(both.shared), F1 = fem::test::zeroVector(both.whole);
  std::vector<double> g(both.shared.eventCount()), g1(g.size());
  both.shared.eventOrder(0, g);
  both.whole.eventOrder(0, g1);
  expectEqual(g, g1, "event functions");
  for (int k = 1; k <= order; ++k) {
    both.shared.orderRhs(k, *F);
    both.whole.orderRhs(k, *F1);
    if (k > 1) expectEqual(fem::FeProblem::values(*F), fem::FeProblem::values(*F1), "order");
    const Numbers Uk = fem::test::randomNumbers(start.size(), 0.1, 100 + k);
    both.shared.completeOrder(k, *fem::test::vectorOf(both.shared, Uk), 0.1 * k);
    both.whole.completeOrder(k, *fem::test::vectorOf(both.whole, Uk), 0.1 * k);
    both.shared.eventOrder(k, g);
    both.whole.eventOrder(k, g1);
    expectEqual(g, g1, "event functions");
  }
  const auto seen = both.shared.observe(1, *fem::test::vectorOf(both.shared, u), lambda),
             seen1 = both.whole.observe(1, *fem::test::vectorOf(both.whole, u), lambda);
  EXPECT_EQ(seen.names, seen1.names);
  expectEqual(seen.values, seen1.values, "gaps and pressures");
}

TEST(HardRanks, SameEventsAlongThePath) {
  Both both;
  Events shared, whole;
  const auto options = tightOptions(1e-9);
  const auto end = follow(both.shared, {both.shared.initialState(0), 0.0}, 0.05, shared, options);
  const auto end1 = follow(both.whole, {both.whole.initialState(0), 0.0}, 0.05, whole, options);
  EXPECT_GE(end1.events, 5);
  EXPECT_EQ(shared.ofSteps, whole.ofSteps);
  EXPECT_EQ(both.shared.conditions(), both.whole.conditions());
  EXPECT_EQ(both.shared.constraintPivots(), both.whole.constraintPivots());
  const Numbers u = fem::FeProblem::values(*end.final.u), u1 = fem::FeProblem::values(*end1.final.u);
  // What is asked of runs on several ranks; the conditioning is near 1e3.
  EXPECT_LE(fem::test::largest(fem::test::sum(u, -1, u1)), 1e-10 * fem::test::largest(u1));
}

TEST(HardRanks, PointInsideTheToolIsNamedOnAll) {
  Both both;
  const auto message = [](const fem::FeProblem& problem, const Numbers& u) -> std::string {
    try {
      problem.eventsAt(*fem::test::vectorOf(problem, u), 0);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "nothing";
  };
  const Numbers start = fem::FeProblem::values(*both.whole.initialState(0));
  EXPECT_EQ(message(both.shared, start), "nothing");
  for (const int n : fem::test::nodesOfSet(mesh(), "z_min")) {
    Numbers u = start;
    u[3 * n + 2] = -1;
    const std::string expected = message(both.whole, u);
    EXPECT_NE(expected, "nothing");
    EXPECT_EQ(message(both.shared, u), expected);
  }
}
