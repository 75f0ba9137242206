// Hard contact at points and over faces, and contact with patches, shared out over ranks is that of one rank:
// every rank compares with a whole problem of its own.
#include <gtest/gtest.h>
#include <mpi.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <algorithm>
#include <string>

#include "atrapos/contact/MovingTool.hpp"
#include "support/ContactModel.hpp"
#include "support/PatchSurfaces.hpp"

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

/// A plate that turns up into an arc at x = border, with a common tangent but not the same curvature.
PatchSearch<PatchTool> plateAndArc(double border) {
  BezierPatch plate, arc;
  plate.points = {{-1, -1, -0.05}, {-1, 2, -0.05}, {border, -1, -0.05}, {border, 2, -0.05}};
  arc.degree = {2, 1};
  arc.points = {{border, -1, -0.05}, {border, 2, -0.05}, {1.7, -1, -0.05},
                {1.7, 2, -0.05},     {2.4, -1, 0},       {2.4, 2, 0}};
  return searchOf({plate, arc});
}

enum class Kind { points, faces, patches, patchFaces, softPatches };

/// A block over a tool whose upper face is pushed down and along; no symmetry, so that points close one by
/// one.
fem::FeModel block(Kind kind, bool alone) {
  const fem::Mesh body = mesh();
  fem::FeModel model = solidModel(body, 10, 0.3);
  const auto nodes = contactPoints(body, "z_min", Where::Nodes),
             faces = contactPoints(body, "z_min", Where::Quadrature, 2);
  switch (kind) {
    case Kind::points:
      addHardContact(model, nodes, turning());
      break;
    case Kind::faces:
      addHardFaceContact(model, faces, turning());
      break;
    case Kind::patches:
      addHardContact(model, nodes, plateAndArc(1.05));  // nodes at 1.0 come over it
      break;
    case Kind::patchFaces:
      addHardFaceContact(model, faces, plateAndArc(0.95));  // points at 0.93 do
      break;
    case Kind::softPatches:
      addPatchContact(model, faces, plateAndArc(0.95), {1e-3, 1e-2}, 1e-3);  // points at 0.93 do
  }
  for (int n : fem::test::nodesOfSet(body, "z_max"))
    for (int i = 0; i < 3; ++i) model.prescribe(n, i, 0, i == 2 ? -1.0 : 0.3);
  if (alone) model.comm = linear::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF));
  return model;
}

struct Both {
  fem::FeProblem shared, whole;
  explicit Both(Kind kind) : shared(block(kind, false)), whole(block(kind, true)) {}
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

class HardRanks : public testing::TestWithParam<Kind> {};
const auto kindName = [](const testing::TestParamInfo<Kind>& info) {
  const char* const names[] = {"points", "faces", "patches", "patchFaces", "softPatches"};
  return std::string(names[static_cast<int>(info.param)]);
};
INSTANTIATE_TEST_SUITE_P(All, HardRanks,
                         testing::Values(Kind::points, Kind::faces, Kind::patches, Kind::patchFaces,
                                         Kind::softPatches),
                         kindName);

TEST_P(HardRanks, SumsAndEventFunctionsAreThoseOfOneRank) {
  Both both(GetParam());
  ASSERT_EQ(both.shared.eventCount(), both.whole.eventCount());
  auto conditions = both.whole.conditionsAt({});  // events, then pieces
  const auto active = someActive(both.whole.eventCount());
  std::copy(active.begin(), active.end(), conditions.begin());
  const auto memory = both.shared.memoryOf(conditions);

  const double lambda = 0.03;
  const Numbers start = fem::FeProblem::values(*both.whole.initialState(lambda));
  const Numbers u = fem::test::sum(start, 1, fem::test::randomNumbers(start.size(), 0.01, 5));
  const Numbers x = fem::test::randomNumbers(start.size(), 1, 6);
  expectEqual(fem::test::residual(both.shared, u, lambda, memory).r,
              fem::test::residual(both.whole, u, lambda, memory).r, "residual");
  const auto K = fem::test::tangentTimes(both.shared, u, lambda, x, memory),
             K1 = fem::test::tangentTimes(both.whole, u, lambda, x, memory);
  expectEqual(K.Kx, K1.Kx, "tangent");
  expectEqual(K.F, K1.F, "load direction");
  EXPECT_EQ(both.shared.constraintPivots(), both.whole.constraintPivots());

  const int order = 6;
  both.shared.beginSeries({fem::test::vectorOf(both.shared, u), lambda, memory}, order);
  both.whole.beginSeries({fem::test::vectorOf(both.whole, u), lambda, memory}, order);
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
  const auto seen = both.shared.observe(1, {fem::test::vectorOf(both.shared, u), lambda, memory}),
             seen1 = both.whole.observe(1, {fem::test::vectorOf(both.whole, u), lambda, memory});
  EXPECT_EQ(seen.names, seen1.names);
  expectEqual(seen.values, seen1.values, "gaps and pressures");
}

TEST_P(HardRanks, SameEventsAlongThePath) {
  Both both(GetParam());
  Events shared, whole;
  const auto options = tightOptions(1e-9);
  // Over the plate until points, and their forces, come to the arc.
  const bool patches = GetParam() != Kind::points && GetParam() != Kind::faces;
  const double to = patches ? 0.25 : 0.05;
  const auto end = follow(both.shared, {both.shared.initialState(0), 0.0}, to, shared, options);
  const auto end1 = follow(both.whole, {both.whole.initialState(0), 0.0}, to, whole, options);
  EXPECT_GE(end1.events, GetParam() == Kind::softPatches ? 1 : 5);
  if (patches) {
    int breaks = 0;
    for (const auto& events : whole.ofSteps)
      breaks +=
          std::any_of(events.begin(), events.end(), [&](int i) { return i >= both.whole.eventCount(); });
    EXPECT_GT(breaks, 0);
  }
  EXPECT_EQ(shared.ofSteps, whole.ofSteps);
  EXPECT_EQ(both.shared.conditionsAt(end.final), both.whole.conditionsAt(end1.final));
  EXPECT_EQ(both.shared.constraintPivots(), both.whole.constraintPivots());
  const Numbers u = fem::FeProblem::values(*end.final.u), u1 = fem::FeProblem::values(*end1.final.u);
  // What is asked of runs on several ranks; the conditioning is near 1e3.
  EXPECT_LE(fem::test::largest(fem::test::sum(u, -1, u1)), 1e-10 * fem::test::largest(u1));
}

TEST_P(HardRanks, PointInsideTheToolIsNamedOnAll) {
  if (GetParam() == Kind::softPatches) GTEST_SKIP() << "no condition that a start could violate";
  Both both(GetParam());
  const auto message = [](fem::FeProblem& problem, const Numbers& u) -> std::string {
    try {
      problem.eventsAt({fem::test::vectorOf(problem, u), 0});
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
