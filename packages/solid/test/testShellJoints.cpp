// Rigid joints of shells: what they keep and what they leave free.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "ShellChecks.hpp"
#include "ShellPath.hpp"
#include "atrapos/fem/EnhancedTerm.hpp"
#include "atrapos/fem/RigidBody.hpp"
#include "atrapos/fem/ShellJoints.hpp"
#include "support/Meshes.hpp"
#include "support/Profile.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::solid::test;
using namespace atrapos::fem::test;

namespace {

using Point = std::array<double, 2>;
constexpr double degree = M_PI / 180;

Point polar(double radius, double angle) {
  return {radius * std::cos(angle * degree), radius * std::sin(angle * degree)};
}

/// Walls with lines along z, of Saint Venant-Kirchhoff; width 1 along z and one element (triangles: square)
/// there, unless told.
struct Walls {
  fem::Mesh mesh;
  fem::ShellGeometry shells;
  fem::FeModel model;
  fem::ShellJoints joints;
  double E;

  Walls(const std::vector<Wall>& walls, double thickness, double modulus, double nu, double length = 1,
        int along = 1, fem::Topology cell = fem::Topology::Shell8)
      : mesh(profileMesh(walls, length, along, cell)), E(modulus) {
    std::vector<fem::ShellSection> sections;
    for (std::size_t w = 0; w < walls.size(); ++w) sections.push_back({static_cast<int>(w), thickness});
    shells = fem::shellGeometry(mesh, sections);
    model.dofs = fem::DofMap::displacements(shells.numNodes());
    const auto law = SaintVenantKirchhoff::fromYoung(E, nu);
    const Shear shear = cell == fem::Topology::Shell3   ? Shear::mitc3
                        : cell == fem::Topology::Shell6 ? Shear::mitc6
                                                        : Shear::compatible;
    for (std::size_t w = 0; w < walls.size(); ++w)
      model.terms.push_back(shellTerm(elements(static_cast<int>(w)), law, {}, shear));
    model.constantLoad.assign(model.dofs.numDofs(), 0.0);
    model.load.assign(model.dofs.numDofs(), 0.0);
  }
  ShellElements elements(int wall) const {
    const fem::ShellBlock& b = shells.blocks[wall];
    return {b.nodes, b.midsurface, b.directors, b.directorScale, b.nodesPerElement};
  }

  void join(const std::vector<int>& hinges = {}) {
    joints = fem::joinShells(model, mesh, shells, E, hinges);
    model.constantLoad.resize(model.dofs.numDofs(), 0.0);
    model.load.resize(model.dofs.numDofs(), 0.0);
  }
  void clampLine(const Point& p) {
    for (int n : nodesAbove(mesh, p)) {
      hold(model, {n}, "xyz");
      hold(model, shells.directorNodes(n), "xyz");
    }
  }
  /// A moment about z per length, on the only director of the line's nodes; lengths of one element.
  void turnLine(const Point& p, double moment) {
    const auto nodes = nodesAbove(mesh, p);
    const Numbers part = nodes.size() == 3 ? Numbers{1 / 6., 4 / 6., 1 / 6.} : Numbers{0.5, 0.5};
    ASSERT_EQ(nodes.size(), part.size());
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const int d = shells.firstDirector[nodes[k]], dof = 3 * (shells.numMeshNodes + d);
      const double* D = &shells.directors[3 * d];
      const double square = D[0] * D[0] + D[1] * D[1] + D[2] * D[2];
      model.load[dof] += part[k] * moment * -D[1] / square;
      model.load[dof + 1] += part[k] * moment * D[0] / square;
    }
  }
  void pushLine(const Point& p, const Point& perLength) {
    const double part[3] = {1 / 6., 4 / 6., 1 / 6.};
    const auto nodes = nodesAbove(mesh, p);
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 2; ++i) model.load[3 * nodes[k] + i] += part[k] * perLength[i];
  }
  int first(const Point& p) const { return nodesAbove(mesh, p).front(); }
};

/// Walls from the joint at the origin to points above the x axis, and to it from the others: opposite ones
/// continue each other.
std::vector<Wall> star(const std::vector<Point>& ends, int divisions) {
  std::vector<Wall> walls;
  for (const Point& end : ends)
    walls.push_back(end[1] > 1e-9 ? Wall{{0, 0}, end, divisions} : Wall{end, {0, 0}, divisions});
  return walls;
}

/// Three plates at 120 degrees: three directors in one plane, three conditions at every joint node.
std::vector<Wall> threeWays() { return star({polar(1, 180), polar(1, 60), polar(1, -60)}, 2); }

}  // namespace

TEST(ShellJoints, TangentAndOrders) {
  for (const auto& walls : {star({polar(1, 180), polar(1, 55)}, 2), threeWays(),
                            star({polar(1, 180), polar(1, 60), polar(1, -30), polar(1, -90)}, 2)}) {
    Walls w(walls, 0.2, 1, 0.3);
    w.clampLine({-1, 0});
    w.join();
    w.model.load = randomNumbers(w.model.dofs.numDofs(), 0.002, 3);
    const Numbers u = randomState(w.model, 0.02, 17);  // multipliers too
    const Numbers direction = randomState(w.model, 0.02, 18);
    const int conditions = 2 * static_cast<int>(walls.size()) - 3;
    fem::FeProblem problem(std::move(w.model));
    EXPECT_TRUE(problem.symmetric());
    EXPECT_EQ(problem.constraintPivots(), 3 * conditions);
    expectTangent(problem, u, direction, 0);
    expectOrders(problem, u, 0.4);
  }
}

// A rotation of everything, and lengths of directors of their own at every joint, fulfil the conditions.
TEST(ShellJoints, RotationsAndLengthsAreFree) {
  Walls w(star({polar(1, 180), polar(1, 60), polar(1, -30), polar(1, -90)}, 1), 0.2, 1, 0.3);
  const fem::ShellGeometry shells = w.shells;
  const int numNodes = w.model.dofs.numNodes();
  w.model.terms.clear();  // the joints alone
  w.join();
  ASSERT_EQ(w.joints.rigid.size(), 3u);
  fem::FeProblem problem(std::move(w.model));
  Numbers u(problem.model().dofs.numDofs(), 0.0);
  for (std::size_t m = 3 * static_cast<std::size_t>(numNodes); m < u.size(); ++m) u[m] = 0.7;
  // Rodrigues' formula about (1, 2, -2)/3.
  const double n[3] = {1 / 3., 2 / 3., -2 / 3.}, angle = 2.5, c = std::cos(angle), s = std::sin(angle);
  const auto turned = [&](const double* D, double stretch, double* w3) {
    const double along = n[0] * D[0] + n[1] * D[1] + n[2] * D[2];
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      w3[i] = stretch * (c * D[i] + s * (n[j] * D[k] - n[k] * D[j]) + (1 - c) * along * n[i]) - D[i];
    }
  };
  for (int d = 0; d < shells.numDirectors(); ++d)
    turned(&shells.directors[3 * d], 1 + 0.1 * (d % 5), &u[3 * (shells.numMeshNodes + d)]);
  const Numbers r = residual(problem, u, 0).r;
  double conditions = 0, forces = 0;
  for (std::size_t i = 0; i < r.size(); ++i)
    (i < 3 * static_cast<std::size_t>(numNodes) ? forces : conditions) += std::abs(r[i]);
  EXPECT_LT(conditions, 1e-15);  // rounding of numbers of size one times weights of 2e-3
  EXPECT_GT(forces, 1e-3);       // the multipliers are moments
}

// A moment at the end of an arm goes through the joint into the arm that is held, and bends both to
// parabolas.
void expectConstantMomentsPass(fem::Topology cell) {
  const double h = 0.25, E = 1e4, EI = E * h * h * h / 12, L = 3;
  for (const auto& ends :
       std::vector<std::vector<Point>>{{polar(L, 180), polar(L, 70)},
                                       {polar(L, 180), polar(L, 160)},
                                       {polar(L, 180), polar(L, 90), polar(L, -90)},
                                       {polar(L, 180), polar(L, 60), polar(L, -60)},
                                       {polar(L, 180), polar(L, 50), polar(L, -35), polar(L, -130)}}) {
    Walls w(star(ends, 2), h, E, 0, 1, 1, cell);
    w.clampLine(ends[0]);
    w.join();
    double total = 0;
    for (std::size_t e = 1; e < ends.size(); ++e) {
      w.turnLine(ends[e], 1.0 + 0.5 * static_cast<double>(e));
      total += 1.0 + 0.5 * static_cast<double>(e);
    }
    std::vector<int> tips;
    for (const Point& p : ends) tips.push_back(w.first(p));
    fem::FeProblem problem(std::move(w.model));
    const Numbers u = linearSolution(problem);
    const double turn = total * L / EI, rise = total * L * L / (2 * EI);
    for (std::size_t e = 1; e < ends.size(); ++e) {
      const double M = 1.0 + 0.5 * static_cast<double>(e);
      const double across = turn * L + M * L * L / (2 * EI);  // of the arm, on its left
      const double x = -across * ends[e][1] / L, y = rise + across * ends[e][0] / L;
      // Rounding times the condition of a thin mesh, (L/h)^2 a few nodes.
      EXPECT_NEAR(u[3 * tips[e]], x, 1e-9 * std::abs(across));
      EXPECT_NEAR(u[3 * tips[e] + 1], y, 1e-9 * std::abs(across));
    }
  }
}

TEST(ShellJoints, ConstantMomentsPass) { expectConstantMomentsPass(fem::Topology::Shell8); }
TEST(ShellJoints, ConstantMomentsPassTriangles) {
  expectConstantMomentsPass(fem::Topology::Shell6);
  expectConstantMomentsPass(fem::Topology::Shell3);
}

// A stress along the line of the joint thins every shell as if it were alone.
TEST(ShellJoints, ConstantStretchPasses) {
  const double E = 1e4, nu = 0.3, stress = 5, length = 2;
  Walls w(threeWays(), 0.2, E, nu, length, 1);
  for (int n : nodesOfSet(w.mesh, "foot")) {
    hold(w.model, {n}, "z");
    hold(w.model, w.shells.directorNodes(n), "z");
  }
  for (int n : nodesOfSet(w.mesh, "head")) w.model.prescribe(n, 2, 0, stress / E * length);
  const int centre = w.first({0, 0}), side = w.first({-1, 0});
  hold(w.model, {centre}, "xy");
  hold(w.model, {side}, "y");
  w.join();
  const fem::Mesh mesh = w.mesh;
  const fem::ShellGeometry shells = w.shells;
  fem::FeProblem problem(std::move(w.model));
  const Numbers u = equilibrium(problem, 1e-3, Numbers(problem.model().dofs.numDofs(), 0.0)).u;
  const double strain = 1e-3 * stress / E;
  for (int n = 0; n < mesh.numNodes(); ++n)
    for (int i = 0; i < 2; ++i)
      // 1e-3 of the load: what is not linear is 1e-6 of it.
      EXPECT_NEAR(u[3 * n + i], -nu * strain * mesh.coordinates[3 * n + i], 2e-6 * strain);
  for (int d = 0; d < shells.numDirectors(); ++d)
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(u[3 * (shells.numMeshNodes + d) + i], -nu * strain * shells.directors[3 * d + i],
                  2e-6 * strain);
}

// Both legs of an angle bend to arcs of one curvature under an end moment, and the angle stays while all
// turns by 115 degrees.
TEST(ShellJoints, AngleUnderAnEndMomentBendsToArcs) {
  const double h = 0.05, E = 1.2e6, EI = E * h * h * h / 12, L = 10, curvature = 0.1;
  Walls w({{{0, 0}, {L, 0}, 16}, {{L, 0}, {L, L}, 16}}, h, E, 0);
  w.clampLine({0, 0});
  w.join();
  FollowerEdgeLoad load;
  // Tension on top, which is on the right of the leg: it turns to the left.
  load.moment = {0, EI * curvature};
  std::vector<ShellEdge> last;
  const ShellElements leg = w.elements(1);
  const int tip = w.first({L, L});
  for (int e = 0; e < static_cast<int>(leg.nodes.size() / 16); ++e)
    for (int k = 0; k < 4; ++k) {
      const double* a = &leg.midsurface[3 * (8 * e + k)];
      const double* b = &leg.midsurface[3 * (8 * e + (k + 1) % 4)];
      if (a[1] > L - 1e-9 && b[1] > L - 1e-9) last.push_back({e, k});
    }
  ASSERT_EQ(last.size(), 1u);
  w.model.terms.push_back(followerEdgeLoad(leg, last, load));
  fem::FeProblem problem(std::move(w.model));
  path::Stops stops;
  stops.loadFactors = {1.0};
  const ShellPath path = followPath(problem, stops);
  ASSERT_EQ(path.outcome.reason, path::EndReason::stopReached) << path.outcome.text;
  for (const double part : {0.25, 0.5, 0.75, 1.0}) {
    const PathPoint p = atLoad(path, part, {3 * tip, 3 * tip + 1});
    const double k = part * curvature, turn = k * L;
    const double cornerX = std::sin(turn) / k, cornerY = (1 - std::cos(turn)) / k;
    const double x = cornerX + (std::cos(2 * turn) - std::cos(turn)) / k,
                 y = cornerY + (std::sin(2 * turn) - std::sin(turn)) / k;
    // (k h)^2 is 2.5e-5; 16 elements a leg are better than that.
    EXPECT_NEAR(p.u[0], x - L, 1e-4 * L) << part;
    EXPECT_NEAR(p.u[1], y - L, 1e-4 * L) << part;
  }
}

// A clamped column with a beam of its length on a roller sways where tan a = -a/3, P = a^2 EI/L^2; with a
// hinge at the corner it is a cantilever. The others of the negative pivots are those of the conditions.
TEST(ShellJoints, InertiaCountsConditionsAndBuckling) {
  const double h = 0.05, E = 1.2e6, EI = E * h * h * h / 12, L = 10;
  double a = 2.4;
  for (int i = 0; i < 50; ++i) a = M_PI - std::atan(a / 3);
  for (const bool hinged : {false, true}) {
    const double critical = (hinged ? M_PI * M_PI / 4 : a * a) * EI / (L * L);
    for (const double part : {0.99, 1.01}) {
      Walls w({{{0, 0}, {0, L}, 8}, {{0, L}, {L, L}, 8}}, h, E, 0);
      w.clampLine({0, 0});
      hold(w.model, nodesAbove(w.mesh, {L, L}), "y");
      w.join(hinged ? nodesAbove(w.mesh, {0, L}) : std::vector<int>{});
      w.pushLine({0, L}, {0, -critical});
      fem::FeProblem problem(std::move(w.model));
      EXPECT_EQ(problem.constraintPivots(), hinged ? 0 : 3);
      const auto state = equilibrium(problem, part, fem::FeProblem::values(*problem.initialState(0)));
      ASSERT_TRUE(state.inertia);
      EXPECT_EQ(state.inertia->negative - problem.constraintPivots(), part > 1 ? 1 : 0)
          << part << (hinged ? " hinged" : " rigid");
    }
  }
}

namespace {

/// Moment per turn of both long edges of a strip of thin plate, width b, D = 1, under the thrust N per length
/// along them, that buckles in half-waves pi/k with edges that stay straight: w = f(y) sin(k z), f = cosh(p
/// y)/cosh(p b/2) - cos(q y)/cos(q b/2).
double edgeStiffness(double b, double k, double N) {
  const double p = std::sqrt(k * (k + std::sqrt(N))), q = std::sqrt(k * (std::sqrt(N) - k));
  return (p * p + q * q) / (p * std::tanh(p * b / 2) + q * std::tan(q * b / 2));
}

}  // namespace

// A tube of 2 x 1: the wide walls buckle and the narrow ones hold them by the corners, which keep their
// angles.
TEST(ShellJoints, RectangularTubeBucklesAsFoldedPlates) {
  const double E = 1e4, h = 0.01, length = 1.5, k = M_PI / length;
  // Both walls turn by one angle at the corner. Above its load with hinges the wide one pushes: S < 0.
  double low = M_PI * M_PI, high = 1.7 * M_PI * M_PI;
  for (int i = 0; i < 60; ++i) {
    const double N = 0.5 * (low + high);
    (edgeStiffness(2, k, N) + edgeStiffness(1, k, N) > 0 ? low : high) = N;
  }
  EXPECT_NEAR(low * 4 / (M_PI * M_PI), 5.2156, 1e-3);  // between 4, hinged, and 6.98, clamped
  const double critical = low * h * h / 12;            // strain
  const int n = 6;
  for (const double part : {0.985, 1.005}) {
    Walls w({{{0, 0}, {2, 0}, n}, {{2, 0}, {2, 1}, n}, {{2, 1}, {0, 1}, n}, {{0, 1}, {0, 0}, n}}, h, E, 0,
            length, n);
    hold(w.model, nodesOfSet(w.mesh, "foot"), "xyz");
    hold(w.model, nodesOfSet(w.mesh, "head"), "xy");
    for (int node : nodesOfSet(w.mesh, "head")) w.model.prescribe(node, 2, 0, -critical * length);
    w.join();
    fem::FeProblem problem(std::move(w.model));
    const auto state = equilibrium(problem, part, Numbers(problem.model().dofs.numDofs(), 0.0));
    ASSERT_TRUE(state.inertia);
    // Below: edges of shells with shear may twist, which is a layer of the thickness and 1 % here.
    EXPECT_EQ(state.inertia->negative - problem.constraintPivots(), part > 1 ? 1 : 0) << part;
  }
}

// Conditions that supports and couplings fulfil are left out: the tangent would be singular.
TEST(ShellJoints, SupportsAndCouplingsTakeConditions) {
  const auto pivots = [](const std::function<void(Walls&, const std::vector<int>&)>& condition) {
    Walls w(threeWays(), 0.2, 1, 0.3);
    w.clampLine({-1, 0});
    condition(w, nodesAbove(w.mesh, {0, 0}));
    w.join();
    EXPECT_EQ(w.joints.rigid.size(), 3u);
    fem::FeProblem problem(std::move(w.model));
    const auto state = equilibrium(problem, 0, fem::FeProblem::values(*problem.initialState(0)));
    EXPECT_EQ(state.inertia->negative, problem.constraintPivots());
    return problem.constraintPivots();
  };
  EXPECT_EQ(pivots([](Walls&, const auto&) {}), 9);
  EXPECT_EQ(pivots([](Walls& w, const auto& line) {  // one of three nodes held
              hold(w.model, w.shells.directorNodes(line[0]), "xyz");
            }),
            6);
  EXPECT_EQ(pivots([](Walls& w, const auto& line) {  // a plane of symmetry across the line: tilts are held
              hold(w.model, w.shells.directorNodes(line[0]), "z");
            }),
            8);
  EXPECT_EQ(pivots([](Walls& w, const auto& line) {  // the same as a coupling
              for (int d : w.shells.directorNodes(line[0])) {
                fem::Coupling c;
                c.dof = 3 * d + 2;
                w.model.couplings.add(c);
              }
            }),
            8);
  EXPECT_EQ(pivots([](Walls& w, const auto& line) {  // 6 of a rigid body that has one node
              const fem::RigidBody body(w.model, {0, 0, 0}, 0.1, 0.2);
              body.attach(w.model, line[0], {0, 0, 0});
              for (int d : w.shells.directorNodes(line[0])) {
                const double* D = &w.shells.directors[3 * (d - w.shells.numMeshNodes)];
                body.attachDirector(w.model, d, {D[0], D[1], D[2]});
              }
            }),
            6 + 6);
}

TEST(ShellJoints, FoldedOntoItselfIsNoJoint) {
  Walls w({{polar(1, 0), {0, 0}, 2}, {{0, 0}, polar(1, 0.3), 2}}, 0.001, 1, 0);
  try {
    w.join();
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_EQ(std::string(e.what()).find("node "), 0u) << e.what();
    EXPECT_NE(std::string(e.what()).find("folded onto each other"), std::string::npos) << e.what();
  }
}
