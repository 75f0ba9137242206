// Metals in plane stress and in shells: the law in space with the strain across eliminated, closed forms of
// bars and of bent strips.
#include <gtest/gtest.h>

#include <Sacado.hpp>
#include <Tpetra_Vector.hpp>
#include <array>
#include <cmath>

#include "MetalPath.hpp"
#include "ShellModel.hpp"
#include "WholeMetal.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/fem/StructuredPlane.hpp"
#include "atrapos/solid/PlaneBody.hpp"
#include "atrapos/solid/ShellResults.hpp"
#include "atrapos/solid/ShellTerms.hpp"
#include "atrapos/solid/VonMises.hpp"
#include "support/Meshes.hpp"
#include "support/Vectors.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::fem::test;
using namespace atrapos::solid::test;

namespace {

using Fad = Sacado::Fad::SFad<double, 9>;

/// Values and derivatives by the nine entries of H.
template <class Law>
std::array<Fad, Law::numOutputs> derivatives(const Law& law, const double* H, const double* data) {
  std::array<Fad, 9> in;
  for (int i = 0; i < 9; ++i) in[i] = Fad(9, i, H[i]);
  std::array<Fad, Law::numOutputs> out;
  law(in.data(), data, out.data());
  return out;
}

const Metal hardening = metal(300, 60, 150, 30e3, 250);

/// A state in the plane that yields or not: H, and data for VonMises.
struct InPlane {
  double H[9] = {0.002, 0.0007, 0, -0.0004, -0.0011, 0, 0, 0, 0};
  double data[14] = {1, 0.003, 0.0012, -0.0017, 0.0005, 0.0004, 0, 0, 10, -15, 5, 6, 0, 0};
  explicit InPlane(double active) { data[0] = active; }
};

}  // namespace

namespace {

/// The law in plane stress is the one in space with S_zz = 0: stress, rates and event functions, by Fad.
void expectPlaneStress(const Metal& metal) {
  const VonMises<true> inSpace{metal};
  const VonMises<true, true> plane{metal};
  for (const double active : {1.0, 0.0}) {
    InPlane at(active);
    const auto p = derivatives(plane, at.H, at.data);
    double E[6];
    greenLagrange(taylor::Matrix3<double>(at.H)).store(E);
    const double zz = detail::FlowRule<true, true>{metal}.across(E, at.data + 1);
    at.H[8] = std::sqrt(1 + 2 * zz) - 1;
    const auto s = derivatives(inSpace, at.H, at.data);
    EXPECT_NEAR(s[8].val(), 0, 1e-12 * ::E);  // sums of E times strains
    for (int o = 0; o < VonMises<true>::numOutputs; ++o) {
      if (o == 8) continue;
      const double scale = o < 9 || o > 16 ? ::E : o == 9 ? 1e3 : 1;  // stresses, event, strains
      EXPECT_NEAR(p[o].val(), s[o].val(), 1e-12 * scale) << o;
      for (const int j : {0, 1, 3, 4}) {
        const double across = -s[8].dx(j) / s[8].dx(8);
        EXPECT_NEAR(p[o].dx(j), s[o].dx(j) + s[o].dx(8) * across, 1e-11 * scale) << o << ' ' << j;
      }
    }
  }
}

}  // namespace

TEST(ThinMetal, PlaneStressIsTheLawInSpaceFreeAcross) {
  expectPlaneStress(hardening);
  expectPlaneStress(smoothed(hardening, 0.05));
}

// In a shell the axes are the point's own: turned ones, with the variables in them, give the same stress.
TEST(ThinMetal, ShellLawInAnyAxes) {
  const WholeMetal<PlainShell> shell{hardening};
  const VonMises<true, true> plane{hardening};
  const InPlane at(1);
  const auto p = derivatives(plane, at.H, at.data);
  // Axes turned in the plane by an angle, then all of space by a rotation R: H -> R H R^T.
  const double a = 0.4, c = std::cos(a), s = std::sin(a);
  const double R[9] = {0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6};
  const double T[9] = {c, -s, 0, s, c, 0, 0, 0, 1};
  double data[WholeMetal<PlainShell>::numData] = {1};
  double H[9];
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      data[1 + 3 * i + k] = 0;
      H[3 * i + k] = 0;
      for (int m = 0; m < 3; ++m) {
        data[1 + 3 * i + k] += R[3 * i + m] * T[3 * m + k];
        for (int n = 0; n < 3; ++n) H[3 * i + k] += R[3 * i + m] * at.H[3 * m + n] * R[3 * k + n];
      }
    }
  const auto turned = [&](const double* from, double* to) {  // T^T v T
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) {
        double& sum = to[taylor::symmetricIndex(i, j)] = 0;
        for (int m = 0; m < 3; ++m)
          for (int n = 0; n < 3; ++n) sum += T[3 * m + i] * from[taylor::symmetricIndex(m, n)] * T[3 * n + j];
      }
  };
  data[10] = at.data[1];
  turned(at.data + 2, data + 11);
  turned(at.data + 8, data + 17);
  const auto q = derivatives(shell, H, data);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double expected = 0;
      for (int m = 0; m < 3; ++m)
        for (int n = 0; n < 3; ++n) expected += R[3 * i + m] * p[3 * m + n].val() * R[3 * j + n];
      EXPECT_NEAR(q[3 * i + j].val(), expected, 1e-11 * yield);
    }
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < i; ++j) EXPECT_NEAR(q[i].dx(j), q[j].dx(i), 1e-11 * ::E);
  constexpr int lanes = fem::kLanes;
  const auto law = shellMetalLaw(hardening, ShellStrains::compatible, 8);
  Numbers inLanes(9 * lanes), dataInLanes(std::size(data) * lanes), shown(7 * lanes),
      memory(law->historyDoubles(0));
  for (std::size_t i = 0; i < inLanes.size(); ++i) inLanes[i] = H[i / lanes];
  for (std::size_t i = 0; i < dataInLanes.size(); ++i) dataInLanes[i] = data[i / lanes];
  law->observe({1, 1, dataInLanes.data(), memory.data()}, inLanes.data(), shown.data());
  double expected[7];
  plane.observe(at.H, at.data, expected);
  EXPECT_NEAR(shown[0] + shown[lanes] + shown[2 * lanes], expected[0] + expected[1] + expected[2],
              1e-11 * yield);
  EXPECT_EQ(shown[6 * lanes], expected[6]);
}

namespace {

/// A unit square of two QUAD8 in plane stress that is pulled along x by the load factor, free across.
fem::FeProblem square(const Metal& m) {
  fem::RectangleOptions options;
  options.topology = fem::Topology::Quad8;
  options.divisions = {2, 1};
  const fem::Mesh mesh = fem::rectangleMesh(options);
  const PlaneSection section{PlaneSection::Kind::stress, 1};
  const auto points = planePoints(mesh, mesh.blocks[0], fem::tabulate(fem::Topology::Quad8), section);
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(mesh.numNodes(), 2);
  auto law = planeLaw(fem::pointLaw(VonMises<true, true>{m}), PlaneSection::Kind::strain);
  const auto data = virgin(points, *law);
  model.terms.push_back(fem::lawTerm(std::move(law), points, data));
  for (const int n : nodesOfSet(mesh, "x_min")) model.prescribe(n, 0, 0, 0);
  for (const int n : nodesOfSet(mesh, "y_min")) model.prescribe(n, 1, 0, 0);
  for (const int n : nodesOfSet(mesh, "x_max")) model.prescribe(n, 0, 0, 1);
  return fem::FeProblem(std::move(model));
}

/// The term of a metal in a shell.
std::unique_ptr<fem::Term> metalTerm(const ShellGrid& grid, const Metal& m, int layers, Shear shear) {
  const ShellCubature cubature{2, layers};
  return shellMetalTerm(m, grid.elements(),
                        shear == Shear::assumed ? ShellStrains::assumedShear : ShellStrains::compatible,
                        cubature);
}

}  // namespace

TEST(ThinMetal, BarsAreUniaxial) {
  const Metal m = metal(300, 60, 150, 30e3, 250);
  {
    fem::FeProblem problem = square(m);
    const Followed out(problem, {problem.initialState(0), 0.0}, 0.02);
    ASSERT_EQ(out.outcome.reason, path::EndReason::stopReached) << out.outcome.text;
    EXPECT_EQ(out.outcome.events, 1);  // all points at once
    expectBar(problem, out.steps, {m}, 1, [](const path::State&, double, std::size_t) {});
  }
  for (const Shear shear : {Shear::compatible, Shear::assumed, Shear::mitc4, Shear::mitc3, Shear::mitc6}) {
    const ShellGrid grid = shellGrid(2, 1, 0.1, flat(1, 1), undistorted, nodesOf(shear));
    fem::FeModel model;
    model.dofs = fem::DofMap::displacements(2 * grid.numNodes());
    model.terms.push_back(metalTerm(grid, m, 3, shear));
    hold(model, grid.lineI(0), "x");
    hold(model, grid.lineJ(0), "y");
    for (int n = 0; n < grid.numNodes(); ++n) {
      hold(model, {n}, "z");
      holdDirector(model, grid, {n}, "xy");
    }
    for (const int n : grid.lineI(4)) model.prescribe(n, 0, 0, 1);
    fem::FeProblem problem(std::move(model));
    const Followed out(problem, {problem.initialState(0), 0.0}, 0.02);
    ASSERT_EQ(out.outcome.reason, path::EndReason::stopReached) << out.outcome.text;
    EXPECT_EQ(out.outcome.events, 1);
    expectBar(problem, out.steps, {m}, 1, [](const path::State&, double, std::size_t) {});
  }
}

namespace {

/// A strip in pure bending by the turning of its end's director; with nu = 1/2 all but the stress along it is
/// zero at any curvature, so that stresses are those of a beam's fibres at the cubature points.
struct BentStrip {
  static constexpr double length = 10, width = 1, thickness = 0.2;
  static constexpr int layers = 6;
  Metal m;
  ShellGrid grid = shellGrid(2, 1, thickness, flat(length, width));
  std::unique_ptr<fem::FeProblem> problem;

  BentStrip(const Metal& plastic, Shear shear) : m(metalFromYoung(E, 0.499999, plastic)) {
    fem::FeModel model;
    model.dofs = fem::DofMap::displacements(2 * grid.numNodes());
    model.terms.push_back(metalTerm(grid, m, layers, shear));
    hold(model, grid.lineI(0), "x");
    holdDirector(model, grid, grid.lineI(0), "x");
    symmetric(model, grid, grid.lineJ(0), 'y');
    hold(model, {grid.node(0, 0)}, "z");
    for (const int n : grid.lineI(4)) model.prescribe(grid.director(n), 0, 0, thickness / 2 * length);
    problem = std::make_unique<fem::FeProblem>(std::move(model));
  }

  /// By the strip's width.
  double moment(const path::State& state) const {
    const auto r = problem->reactions(state);
    double sum = 0;
    for (const int n : grid.lineI(4)) sum += r[problem->model().dofs.firstDof(grid.director(n))];
    return sum * thickness / 2 / width;
  }
};

/// The moment of fibres at Gauss points, each elastic and then with linear kinematic hardening, bent to the
/// curvatures one after the other.
struct Fibres {
  std::vector<double> x, w, stress;
  double hardening, half, limit, curvature = 0;
  std::vector<double> back;
  Fibres(const Metal& m, double thickness, int points)
      : hardening(m.kinematicModulus), half(thickness / 2), limit(m.yieldStress) {
    const fem::Tabulation line = fem::tabulateFace(fem::Face::Line2, 2 * points - 1);
    x = line.points;
    w = line.weights;
    stress.assign(x.size(), 0.0);
    back.assign(x.size(), 0.0);
  }
  double to(double next) {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double strain = x[i] * half * (next - curvature);
      const double trial = stress[i] + E * strain, beyond = std::abs(trial - back[i]) - limit;
      if (beyond > 0) {
        const double plastic = std::copysign(beyond / (E + hardening), trial - back[i]);
        stress[i] = trial - E * plastic;
        back[i] += hardening * plastic;
      } else {
        stress[i] = trial;
      }
      sum += w[i] * half * x[i] * half * stress[i];
    }
    curvature = next;
    return sum;
  }
};

}  // namespace

// To three times the curvature of first yield, back, and beyond it the other way.
TEST(ThinMetal, BentStripIsABeamOfFibres) {
  Metal plastic;
  plastic.yieldStress = 1e-4 * E;  // strains so small that squares of them do not show
  plastic.kinematicModulus = 0.05 * E;
  for (const Shear shear : {Shear::compatible, Shear::assumed}) {
    BentStrip strip(plastic, shear);
    Fibres fibres(strip.m, BentStrip::thickness, BentStrip::layers);
    const double first = 1e-4 / (BentStrip::thickness / 2);
    const double scale = strip.m.yieldStress * BentStrip::thickness * BentStrip::thickness / 4;
    path::State at{strip.problem->initialState(0), 0.0};
    double sense = 1;
    for (const double next : {3 * first, 0.5 * first, -2 * first}) {
      const Followed way(*strip.problem, at, next, sense);
      ASSERT_EQ(way.outcome.reason, path::EndReason::stopReached) << way.outcome.text;
      at = way.outcome.final;
      // Green-Lagrange strains differ by their squares, the turning of the director by that of its angle
      // 3e-2.
      EXPECT_NEAR(strip.moment(at), fibres.to(next), 1e-3 * scale) << next / first;
      sense = -1;
      if (next < 3 * first) continue;
      // The fibres outside have all yielded: stress is linear there, tension on top.
      const auto stress = strip.problem->observe(0, at);
      const ShellCubature cubature{2, BentStrip::layers};
      const double slope = strip.m.kinematicModulus / (E + strip.m.kinematicModulus);
      const double surface = strip.m.yieldStress * (1 + 2 * slope);
      EXPECT_NEAR(surfaceStress(stress, cubature, 1).at(0), surface, 1e-3 * surface);
      EXPECT_NEAR(surfaceStress(stress, cubature, -1).at(0), -surface, 1e-3 * surface);
      const auto resultants = shellResultants(strip.grid.elements(), stress, fem::FeProblem::values(*at.u),
                                              {cubature, {1, 0, 0}});
      EXPECT_NEAR(resultants.values.at(3), strip.moment(at), 1e-3 * scale);
    }
  }
}

namespace {

/// Pulled and sheared, u = (x, 2 x) times the load factor, on all nodes but those inside the plane, which no
/// homogeneous state moves.
template <class Law>
fem::FeProblem driven(Law&& law, const fem::Mesh& mesh, const fem::PointSet& points, int components) {
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(mesh.numNodes(), components);
  const auto data = virgin(points, *law);
  model.terms.push_back(fem::lawTerm(std::forward<Law>(law), points, data));
  for (int n = 0; n < mesh.numNodes(); ++n) {
    const double* x = &mesh.coordinates[3 * static_cast<std::size_t>(n)];
    const auto edge = [&](int i) { return x[i] == 0 || x[i] == 1; };
    if (!edge(0) && !edge(1)) continue;
    model.prescribe(n, 0, 0, x[0]);
    model.prescribe(n, 1, 0, 2 * x[0]);
    if (components > 2 && x[2] == 0) model.prescribe(n, 2, 0, 0);
  }
  return fem::FeProblem(std::move(model));
}

}  // namespace

// A square whose only free node nothing moves: forces balance whatever the plastic strains are, and only
// their own series tell how far steps go. A cube that is free across is its judge, there and back.
TEST(ThinMetal, HomogeneousSquareIsTheCube) {
  const Metal m = metal(500, 120, 8, 0, 0);
  fem::RectangleOptions options;
  options.topology = fem::Topology::Quad8;
  options.divisions = {2, 2};
  const fem::Mesh square = fem::rectangleMesh(options), cube = box(fem::Topology::Hex8, {1, 1, 1});
  const PlaneSection section{PlaneSection::Kind::stress, 1};
  auto plane = driven(planeLaw(fem::pointLaw(VonMises<false, true>{m}), PlaneSection::Kind::strain), square,
                      planePoints(square, square.blocks[0], fem::tabulate(fem::Topology::Quad8), section), 2);
  auto space = driven(fem::pointLaw(VonMises<false>{m}), cube,
                      fem::volumePoints(cube, cube.blocks[0], fem::tabulate(fem::Topology::Hex8)), 3);
  path::State a{plane.initialState(0), 0.0}, b{space.initialState(0), 0.0};
  double sense = 1;
  for (const double to : {0.01, -0.005}) {
    const Followed p(plane, a, to, sense), s(space, b, to, sense);
    ASSERT_EQ(p.outcome.reason, path::EndReason::stopReached) << p.outcome.text;
    EXPECT_EQ(p.outcome.events, s.outcome.events);
    a = p.outcome.final;
    b = s.outcome.final;
    const auto inPlane = plane.observe(0, a), inSpace = space.observe(0, b);
    for (const int i : {0, 1, 3})
      EXPECT_NEAR(inPlane.values.at(i), inSpace.values.at(i), 1e-6 * yield) << to << ' ' << i;
    EXPECT_NEAR(inPlane.values.at(6), inSpace.values.at(6), 1e-8) << to;
    sense = -1;
  }
}
