// Couplings, rigid ends and joints of shells with solids.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "ShellChecks.hpp"
#include "ShellPath.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/RigidBody.hpp"
#include "support/Meshes.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::solid::test;
using namespace atrapos::fem::test;

namespace {

using Node = std::array<double, 3>;

/// A cantilever strip of length 10, width 1 along x, its free end attached to a rigid body at the end's
/// centre.
struct RigidEnd {
  ShellGrid grid;
  fem::FeModel model;
  fem::RigidBody body;

  RigidEnd(int n, double thickness, double E, double nu)
      : grid(shellGrid(n, 1, thickness, flat(10, 1))),
        model(modelOf(grid)),
        body(model, {10, 0.5, 0}, 1.0, E * thickness) {
    model.terms.push_back(shellTerm(grid.elements(), SaintVenantKirchhoff::fromYoung(E, nu)));
    model.constantLoad.assign(model.dofs.numDofs(), 0.0);
    model.load.assign(model.dofs.numDofs(), 0.0);
    clamp(model, grid, grid.lineI(0));
    for (int node : grid.lineI(2 * n)) {
      body.attach(model, node, grid.x[node]);
      body.attachDirector(model, grid.director(node), grid.D(node));
    }
  }
  static fem::FeModel modelOf(const ShellGrid& grid) {
    fem::FeModel model;
    model.dofs = fem::DofMap::displacements(2 * grid.numNodes());
    return model;
  }
};

double distance(const Numbers& u, const ShellGrid& grid, int a, int b) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += std::pow(grid.x[a][i] + u[3 * a + i] - grid.x[b][i] - u[3 * b + i], 2);
  return std::sqrt(sum);
}

/// turn(node, place or director) for all nodes of the strip and its rigid end.
template <class Turn>
void turnAll(const ShellGrid& grid, const fem::RigidBody& body, const Turn& turn) {
  for (int n = 0; n < grid.numNodes(); ++n) {
    turn(n, grid.x[n]);
    turn(grid.director(n), grid.D(n));
  }
  turn(body.originNode(), {10, 0.5, 0});
  turn(body.armNode(0), {11, 0.5, 0});
  turn(body.armNode(1), {10, 1.5, 0});
  turn(body.armNode(2), {10, 0.5, 1});
}

Numbers finalState(const ShellPath& path) { return fem::FeProblem::values(*path.outcome.final.u); }

}  // namespace

// An inclined plane at the end, driven along its normal, and a chain behind it.
TEST(ShellCouplings, TangentAndOrders) {
  const ShellGrid grid = shellGrid(3, 2, 0.2, cylinder(1, 0, 1.2, 0, 0.7));
  fem::FeModel model = shellModel(grid, SaintVenantKirchhoff::fromYoung(1, 0.3));
  clamp(model, grid, grid.lineI(0));
  model.load = randomNumbers(model.dofs.numDofs(), 0.002, 3);
  const auto end = grid.lineI(6);
  fem::couplePlane(model.couplings, model.dofs, end, {0.6, 0.1, -0.4});
  model.couplings.add({3 * end[0], {{3 * end[0] + 1, 0.3}}, 0.0, 0.05});  // the leader itself is a slave
  const Numbers u = randomState(model, 0.02, 17);
  Numbers direction = randomState(model, 0.02, 18);
  keepTo(model, 0, direction);
  fem::FeProblem problem(std::move(model));
  expectTangent(problem, u, direction, 0.3);
  expectOrders(problem, u, 0.3);
}

TEST(RigidEnd, TangentAndOrders) {
  RigidEnd strip(3, 0.2, 1, 0.3);
  EXPECT_EQ(expectSymmetricTangentAndOrders(std::move(strip.model)), 6);
}

// A rotation of everything costs nothing, and the six constraints see none.
TEST(RigidEnd, RotationCostsNoForce) {
  RigidEnd strip(3, 0.2, 1, 0.3);
  strip.model.supports = {};
  const fem::RigidBody body = strip.body;
  const ShellGrid grid = strip.grid;
  const int numNodes = strip.model.dofs.numNodes();
  fem::FeProblem problem(std::move(strip.model));
  for (double angle : {0.3, 2.5}) {
    const double c = std::cos(angle) - 1, s = std::sin(angle);
    Numbers u(3 * numNodes, 0.0);
    const auto turn = [&](int node, const Node& X) {  // about y
      u[3 * node] = c * X[0] + s * X[2];
      u[3 * node + 2] = -s * X[0] + c * X[2];
    };
    turnAll(grid, body, turn);
    // Rounding of positions of 10 in strains and gaps of stiffness 1.
    EXPECT_LT(largest(residual(problem, u, 0).r), 1e-13);
  }
}

// Cylindrical bending leaves the end straight anyway: the elastica, to 0.1 %, with the force at the body's
// origin; and the attached nodes keep their distances.
TEST(RigidEnd, CantileverIsTheElastica) {
  RigidEnd strip(16, 0.1, 1.2e6, 0);
  const int origin = strip.body.originNode();
  strip.model.load[3 * origin + 2] = 4;
  const auto end = strip.grid.lineI(32);
  const ShellGrid grid = strip.grid;
  fem::FeProblem problem(std::move(strip.model));
  path::Stops stops;
  stops.loadFactors = {1.0};
  const ShellPath path = followPath(problem, stops);
  ASSERT_EQ(path.outcome.reason, path::EndReason::stopReached) << path.outcome.text;
  int compared = 0;
  for (const auto& row : table("elastica_cantilever_end_load.csv")) {
    if (row[0] > 4) continue;
    const PathPoint p = atLoad(path, row[0] / 4, {3 * origin, 3 * origin + 2});
    EXPECT_NEAR(p.u[1] / 10, row[1], 1e-3);
    EXPECT_NEAR(-p.u[0] / 10, row[2], 1e-3);
    ++compared;
  }
  EXPECT_GT(compared, 20);
  const Numbers u = finalState(path);
  EXPECT_NEAR(distance(u, grid, end.front(), end.back()), 1, 1e-6);  // the path's residual bound
}

// With nu = 0.3 the end of a strip under a transverse force wants to curl; the rigid end does not, while a
// twist about the strip's axis stays free: held there only by the strip.
TEST(RigidEnd, KeepsTheSectionOfATwistedStrip) {
  RigidEnd strip(8, 0.2, 1e5, 0.3);
  const fem::RigidBody body = strip.body;
  // A couple about x: opposite forces at the arm along y and at the origin.
  strip.model.load[3 * body.armNode(1) + 2] = 60;
  strip.model.load[3 * body.originNode() + 2] = -60;
  const auto end = strip.grid.lineI(16);
  const ShellGrid grid = strip.grid;
  fem::FeProblem problem(std::move(strip.model));
  path::Stops stops;
  stops.loadFactors = {1.0};
  const ShellPath path = followPath(problem, stops);
  ASSERT_EQ(path.outcome.reason, path::EndReason::stopReached) << path.outcome.text;
  const Numbers u = finalState(path);
  // A large turn, and still a straight edge of length 1 with directors of half the thickness.
  EXPECT_GT(u[3 * end.back() + 2] - u[3 * end.front() + 2], 0.5);
  EXPECT_NEAR(distance(u, grid, end[0], end[1]), 0.5, 1e-6);  // the path's residual bound
  EXPECT_NEAR(distance(u, grid, end[0], end[2]), 1.0, 1e-6);
  for (int node : end) {
    double size = 0;
    for (int i = 0; i < 3; ++i) size += std::pow(grid.D(node)[i] + u[3 * grid.director(node) + i], 2);
    EXPECT_NEAR(std::sqrt(size), 0.1, 1e-7);
  }
}

// A column pressed at its rigid end: six negative pivots belong to the constraints, a seventh comes with
// Euler's load pi^2 EI/(4 L^2).
TEST(RigidEnd, InertiaCountsConstraintsAndBuckling) {
  const double E = 1.2e6, h = 0.1, EI = E * h * h * h / 12, critical = M_PI * M_PI * EI / 400;
  for (double part : {0.98, 1.02}) {
    RigidEnd strip(8, h, E, 0);
    strip.model.load[3 * strip.body.originNode()] = -critical;
    fem::FeProblem problem(std::move(strip.model));
    const auto state = equilibrium(problem, part, fem::FeProblem::values(*problem.initialState(0)));
    ASSERT_TRUE(state.inertia);
    EXPECT_EQ(state.inertia->negative - problem.constraintPivots(), part > 1 ? 1 : 0) << part;
  }
}

namespace {

/// A strip of length 10, width 1: a solid of HEX20 up to x = 5, a shell from there, joined by couplings.
struct HalfAndHalf {
  fem::Mesh solid;
  ShellGrid grid;
  fem::FeModel model;

  int tip() const { return grid.node(2 * grid.nu, 1); }

  HalfAndHalf(int nSolid, int nShell, double h, double E, double nu) {
    solid = fem::test::box(fem::Topology::Hex20, {nSolid, 1, 1}, {5, 1, h}, {0, 0, -h / 2});
    grid = shellGrid(nShell, 1, h, [](double s, double t) {
      return SurfacePoint{{5 + 5 * s, t, 0}, {0, 0, 1}};
    });
    const int shift = 2 * grid.numNodes();  // first node of the solid
    model.dofs = fem::DofMap::displacements(shift + solid.numNodes());
    const auto material = SaintVenantKirchhoff::fromYoung(E, nu);
    model.terms.push_back(shellTerm(grid.elements(), material));
    // Full cubature: a row one cell wide and thick has hourglass modes with less.
    fem::PointSet points = fem::volumePoints(solid, solid.blocks[0], fem::tabulate(fem::Topology::Hex20, 5));
    for (int& n : points.nodes) n += shift;
    model.terms.push_back(fem::lawTerm(fem::pointLaw(material), points));
    model.load.assign(model.dofs.numDofs(), 0.0);
    for (int n : grid.lineI(0)) {
      int top = -1, bottom = -1, middle = -1;
      for (int m = 0; m < solid.numNodes(); ++m) {
        const double* X = &solid.coordinates[3 * m];
        if (std::abs(X[0] - 5) > 1e-9 || std::abs(X[1] - grid.x[n][1]) > 1e-9) continue;
        if (std::abs(X[2] - h / 2) < 1e-9) top = shift + m;
        if (std::abs(X[2] + h / 2) < 1e-9) bottom = shift + m;
        if (std::abs(X[2]) < 1e-9) middle = shift + m;
      }
      fem::coupleShellToSolid(model.couplings, model.dofs, n, grid.director(n), top, bottom);
      if (middle >= 0) fem::coupleNode(model.couplings, model.dofs, middle, {{top, 0.5}, {bottom, 0.5}});
    }
    for (int m = 0; m < solid.numNodes(); ++m)
      for (int i = 0; i < 3 && solid.coordinates[3 * m] < 1e-9; ++i) model.prescribe(shift + m, i, 0, 0);
  }

  /// A line load per length at the free end, on v or w.
  void loadEnd(bool director, const Node& perLength) {
    const auto end = grid.lineI(2 * grid.nu);
    const double part[3] = {1 / 6., 4 / 6., 1 / 6.};
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i)
        model.load[3 * (director ? grid.director(end[k]) : end[k]) + i] += part[k] * perLength[i];
  }
};

}  // namespace

// The patch tests of the joint: constant curvature and constant stretch go through it unchanged.
TEST(ShellOnSolid, BendingAndTensionPass) {
  const double h = 0.25, E = 1e4, M = 1.0, EI = E * h * h * h / 12;
  HalfAndHalf bent(3, 2, h, E, 0);
  bent.loadEnd(true, {-M / (h / 2), 0, 0});  // a couple about -y: m = D x f
  const int tip = bent.tip();
  fem::FeProblem bending(std::move(bent.model));
  // Rounding times the condition of a thin mesh, (L/h)^2 a few nodes.
  EXPECT_NEAR(linearSolution(bending)[3 * tip + 2] / (M * 100 / (2 * EI)), 1, 1e-9);
  HalfAndHalf pulled(3, 2, h, E, 0);
  pulled.loadEnd(false, {2.5, 0, 0});
  fem::FeProblem tension(std::move(pulled.model));
  EXPECT_NEAR(linearSolution(tension)[3 * tip] / (2.5 * 10 / (E * h)), 1, 1e-9);
}

// An end force: the beam's deflection, and its error falls with the order of the elements.
TEST(ShellOnSolid, CantileverConverges) {
  const double h = 0.1, E = 1.2e6, EI = E * h * h * h / 12, P = 1e-3;
  const auto deflection = [&](int n) {
    HalfAndHalf strip(2 * n, n, h, E, 0);
    strip.loadEnd(false, {0, 0, P});
    const int tip = strip.tip();
    fem::FeProblem problem(std::move(strip.model));
    return linearSolution(problem)[3 * tip + 2] / (P * 1000 / (3 * EI));
  };
  const double w1 = deflection(1), w2 = deflection(2), w4 = deflection(4), w8 = deflection(8);
  EXPECT_NEAR(w8, 1, 2e-4);  // shear adds 3 EI/(GA L^2) = 5e-5
  EXPECT_GT(std::log2((w2 - w1) / (w4 - w2)), 2);
  EXPECT_LT(w1, w2);
}

// Large rotations: the coupling is linear in the displacements and holds at any angle.
TEST(ShellOnSolid, CantileverIsTheElastica) {
  HalfAndHalf strip(20, 8, 0.1, 1.2e6, 0);
  strip.loadEnd(false, {0, 0, 4});
  const int tip = strip.tip();
  fem::FeProblem problem(std::move(strip.model));
  path::Stops stops;
  stops.loadFactors = {1.0};
  const ShellPath path = followPath(problem, stops);
  ASSERT_EQ(path.outcome.reason, path::EndReason::stopReached) << path.outcome.text;
  for (const auto& row : table("elastica_cantilever_end_load.csv")) {
    if (row[0] > 4) continue;
    const PathPoint p = atLoad(path, row[0] / 4, {3 * tip, 3 * tip + 2});
    EXPECT_NEAR(p.u[1] / 10, row[1], 1.5e-3);  // twenty solids over half the length: 1e-3 of the deflection
    EXPECT_NEAR(-p.u[0] / 10, row[2], 1.5e-3);
  }
}

namespace {

/// The strip's end turns about `axis` alone; the node with its angle.
struct HingedEnd : RigidEnd {
  int angle;

  HingedEnd(int n, double thickness, double E, double nu, const Node& axis)
      : RigidEnd(n, thickness, E, nu), angle(body.hinge(model, axis)) {
    model.load.resize(model.dofs.numDofs(), 0.0);
  }
  int angleDof() const { return model.dofs.firstDof(angle); }
};

}  // namespace

TEST(HingedEnd, TangentAndOrders) {
  for (const Node& axis : {Node{0, 2, 0}, Node{0.2, 1, -0.3}, Node{-1, 1, 1}}) {
    HingedEnd strip(3, 0.2, 1, 0.3, axis);
    EXPECT_EQ(expectSymmetricTangentAndOrders(std::move(strip.model)), 7);
  }
}

// What turns about the axis by the unknown angle costs no force; the direction of the axis stays.
TEST(HingedEnd, RotationCostsNoForce) {
  const Node axis{2 / 3.0, -1 / 3.0, 2 / 3.0};
  HingedEnd strip(3, 0.2, 1, 0.3, {2, -1, 2});
  strip.model.supports = {};
  const fem::RigidBody body = strip.body;
  const ShellGrid grid = strip.grid;
  const int angleDof = strip.angleDof(), numDofs = strip.model.dofs.numDofs();
  fem::FeProblem problem(std::move(strip.model));
  for (double angle : {0.3, -2.5, 7.0}) {
    const double c = std::cos(angle), s = std::sin(angle);
    Numbers u(numDofs, 0.0);
    const auto turn = [&](int node, const Node& X) {  // Rodrigues
      double along = 0;
      for (int i = 0; i < 3; ++i) along += axis[i] * X[i];
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        u[3 * node + i] = c * X[i] + s * (axis[j] * X[k] - axis[k] * X[j]) + (1 - c) * along * axis[i] - X[i];
      }
    };
    turnAll(grid, body, turn);
    u[angleDof] = angle;
    EXPECT_LT(largest(residual(problem, u, 0).r), 5e-13);  // displacements of 20
  }
}

// A strip under a moment at its end is an arc of circle of curvature M/EI: 2 pi EI/L closes it. The moment
// and the angle that is driven say the same.
TEST(HingedEnd, MomentBendsAStripIntoACircle) {
  const double E = 1.2e6, h = 0.1, EI = E * h * h * h / 12, full = 2 * M_PI * EI / 10;
  for (const bool driven : {false, true}) {
    HingedEnd strip(16, h, E, 0, {0, 1, 0});
    const int dof = strip.angleDof(), origin = strip.body.originNode();
    if (driven)
      strip.model.supports.prescribe(dof, 0, -2 * M_PI);
    else
      strip.model.load[dof] = -full;
    fem::FeProblem problem(std::move(strip.model));
    path::Stops stops;
    stops.loadFactors = {1.0};
    const ShellPath path = followPath(problem, stops);
    ASSERT_EQ(path.outcome.reason, path::EndReason::stopReached) << path.outcome.text;
    const Numbers u = finalState(path);
    // The clamp is at x = 0; strains of 3 % at the surfaces make (h kappa)^2 of difference.
    const double small = std::pow(h * 2 * M_PI / 10, 2);
    EXPECT_NEAR(u[dof], -2 * M_PI, 2 * M_PI * small);
    EXPECT_NEAR(u[3 * origin], -10, 10 * small);
    EXPECT_NEAR(u[3 * origin + 2], 0, 10 * small);
    if (driven) {
      EXPECT_NEAR(problem.reactions({path.outcome.final.u, 1.0})[dof], -full, full * small);
    }
  }
}
