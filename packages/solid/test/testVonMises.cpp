// Von Mises plasticity along paths: closed forms in uniaxial tension with all kinds of hardening, there and
// back; a thick sphere under pressure against Hill; derivatives.
#include <gtest/gtest.h>

#include <Sacado.hpp>
#include <Tpetra_Vector.hpp>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "HillSphere.hpp"
#include "MetalBar.hpp"
#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/solid/FiniteVonMises.hpp"
#include "atrapos/solid/VonMises.hpp"
#include "support/Checks.hpp"
#include "support/Meshes.hpp"
#include "support/Vectors.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::fem::test;
using namespace atrapos::solid::test;

namespace {

/// Along a monotonic path: S_xx and E_xx are those of the closed form at the point's gamma.
void expectUniaxial(const fem::FeProblem& problem, const Steps& steps, const Uniaxial& exact, double sense) {
  int yielding = 0;
  for (std::size_t s = 0; s < steps.reports.size(); ++s)
    for (int i = 1; i <= 4; ++i) {
      const path::State state = steps.series[s].state(steps.reports[s].length * i / 4);
      const double strain = state.lambda + 0.5 * state.lambda * state.lambda;
      const auto shown = problem.observe(0, state);
      const double gamma = shown.values.at(6);
      const double S = secondPiolaOfBar(problem, state);
      if (gamma <= exact.gamma + 1e-12) {
        EXPECT_NEAR(S, E * (strain - exact.plastic), 1e-6 * yield);
        continue;
      }
      ++yielding;
      // Series of an accuracy of 1e-9 of forces; a dozen of steps.
      EXPECT_NEAR(S, exact.stress(gamma, sense), 1e-7 * yield) << "step " << s << ", gamma " << gamma;
      EXPECT_NEAR(strain, exact.strain(gamma, sense), 1e-7 * yield / E)
          << "step " << s << ", gamma " << gamma;
    }
  EXPECT_GE(yielding, 4);
}

}  // namespace

// Out to 2 %, back and into compression: the yield stress there is the Bauschinger effect's.
template <bool kinematic>
void thereAndBack(const Metal& m) {
  fem::FeProblem problem = bar(VonMises<kinematic>{m});
  const Followed out(problem, {problem.initialState(0), 0.0}, 0.02);
  ASSERT_EQ(out.outcome.reason, path::EndReason::stopReached) << out.outcome.text;
  EXPECT_EQ(out.outcome.events, 1);  // all points at once
  Uniaxial exact{m};
  expectUniaxial(problem, out.steps, exact, 1);

  const Followed back(problem, out.outcome.final, -0.01, -1);
  ASSERT_EQ(back.outcome.reason, path::EndReason::stopReached) << back.outcome.text;
  EXPECT_EQ(back.outcome.events, 2);  // unloading, and yielding the other way
  const double gamma = problem.observe(0, out.outcome.final).values.at(6);
  exact.turnBack(gamma);
  expectUniaxial(problem, back.steps, exact, -1);
}

TEST(VonMises, BarWithVoceHardening) { thereAndBack<false>(metal(500, 120, 300, 0, 0)); }
TEST(VonMises, BarWithKinematicHardening) { thereAndBack<true>(metal(0, 0, 0, 20e3, 0)); }
TEST(VonMises, BarWithBoth) { thereAndBack<true>(metal(300, 60, 150, 30e3, 250)); }

namespace {

/// Pulled and sheared by its end: u = (x, 2 x) times the load factor, homogeneous, free across the plane.
template <class Law>
fem::FeProblem sheared(const Law& material, const fem::Mesh& mesh, const fem::PointSet& points) {
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(mesh.numNodes());
  auto law = fem::pointLaw(material);
  const auto data = virgin(points, *law);
  model.terms.push_back(fem::lawTerm(std::move(law), points, data));
  for (int n = 0; n < mesh.numNodes(); ++n) {
    const double* x = &mesh.coordinates[3 * static_cast<std::size_t>(n)];
    model.prescribe(n, 0, 0, x[0]);
    model.prescribe(n, 1, 0, 2 * x[0]);
    if (x[2] == 0) model.prescribe(n, 2, 0, 0);
  }
  return fem::FeProblem(std::move(model));
}

/// Both forces at the end x = 1.
std::array<double, 2> forcesOfEnd(const fem::FeProblem& problem, const fem::Mesh& mesh,
                                  const path::State& state) {
  const auto r = problem.reactions(state);
  std::array<double, 2> sum{0, 0};
  for (int n = 0; n < mesh.numNodes(); ++n)
    for (int i = 0; mesh.coordinates[3 * static_cast<std::size_t>(n)] == 1 && i < 2; ++i)
      sum[i] += r[problem.model().dofs.firstDof(n) + i];
  return sum;
}

}  // namespace

// Perfectly plastic: no equilibrium beyond the yield stress, but a driven bar goes on.
TEST(VonMises, PerfectlyPlasticBar) {
  fem::FeProblem problem = bar(VonMises<false>{metal(0, 0, 0, 0, 0)});
  const Followed out(problem, {problem.initialState(0), 0.0}, 0.02);
  ASSERT_EQ(out.outcome.reason, path::EndReason::stopReached) << out.outcome.text;
  expectUniaxial(problem, out.steps, {metal(0, 0, 0, 0, 0)}, 1);
}

namespace {

// Bent over by its end: points yield one after the other. The tangent behind all of these events is the
// derivative along a chord that goes on: an error of first order.
void tangentAlongThePath(const Metal& metal, int leastEvents, int mostEvents) {
  const fem::Mesh mesh = box(fem::Topology::Hex8, {6, 2, 2}, {4, 1, 1});
  const fem::PointSet points = fem::volumePoints(mesh, mesh.blocks[0], fem::tabulate(fem::Topology::Hex8));
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(mesh.numNodes());
  auto law = fem::pointLaw(VonMises<true>{metal});
  const auto data = virgin(points, *law);
  model.terms.push_back(fem::lawTerm(std::move(law), points, data));
  for (const int n : nodesOfSet(mesh, "x_min"))
    for (int i = 0; i < 3; ++i) model.prescribe(n, i, 0, 0);
  for (const int n : nodesOfSet(mesh, "x_max")) model.prescribe(n, 2, 0, 1);
  fem::FeProblem problem(std::move(model));
  const Followed out(problem, {problem.initialState(0), 0.0}, 0.04);
  ASSERT_EQ(out.outcome.reason, path::EndReason::stopReached) << out.outcome.text;
  EXPECT_GE(out.outcome.events, leastEvents);
  EXPECT_LE(out.outcome.events, mostEvents);
  const auto& last = out.steps.series.back();
  const path::State at = out.outcome.final;
  const Tangent K = tangent(problem, fem::FeProblem::values(*at.u), at.lambda, at.memory);
  // Along the path, where points that yield go on to do so.
  const auto rate = last.tangent(out.steps.reports.back().length);
  const Numbers d = fem::FeProblem::values(*rate.x.u), u = fem::FeProblem::values(*at.u);
  const Numbers exact = sum(K.times(d), -rate.lambda, K.F);
  double before = 0;
  const double scale = norm(K.F) * std::abs(rate.lambda);
  for (double h = 1e-4; h > 1e-5; h /= 2) {
    const Numbers plus = residual(problem, sum(u, h, d), at.lambda + h * rate.lambda, at.memory).r,
                  zero = residual(problem, u, at.lambda, at.memory).r;
    Numbers error = sum(plus, -1, zero);
    for (std::size_t i = 0; i < error.size(); ++i) error[i] = error[i] / h - exact[i];
    const double now = norm(error);
    if (before > 0) {
      EXPECT_NEAR(before / now, 2, 0.1) << h;
    }
    before = now;
  }
  EXPECT_LT(before, 1e-2 * scale);
}

}  // namespace

TEST(VonMises, TangentAlongThePath) { tangentAlongThePath(metal(300, 60, 150, 30e3, 250), 11, 1000); }
TEST(VonMises, TangentAlongThePathOfASmoothedSurface) {
  tangentAlongThePath(smoothed(metal(300, 60, 150, 30e3, 250), 0.03), 0, 0);
}

// Hill's solution of the thick sphere. First yield at (2/3)(1 - a^3/b^3) of the yield stress; the strains are
// 1e-4, which is what finite strains change.
TEST(VonMises, ThickSphereAgainstHill) {
  const Sphere coarse(6), fine(12);
  const double one = coarse.largestError(1.8), two = fine.largestError(1.8);
  EXPECT_LT(two, 1e-3);
  EXPECT_LT(two, 0.3 * one);  // second order in the size of the cells, whose points yield one after the other
  RecordProperty("steps", fine.steps);
}

namespace {

/// A bar of FiniteVonMises that is pulled along: with F = F_e F_p and F_p = exp(gamma) along the bar, q =
/// R(gamma).
struct FiniteBar {
  Metal m;
  /// The elastic stretch along it at a Kirchhoff stress q, free across.
  double elastic(double q) const {
    const double half = 0.5 * (m.lambda + 2 * m.mu / 3);
    double a = 1, b = 1;  // along and across
    for (int i = 0; i < 100; ++i) {
      const double J = a * b * b;
      // m (a^2 - b^2) = q, -q/3 + kappa/2 (J^2 - 1) = 0
      const double volume = std::sqrt(1 + q / (3 * half));
      a = std::sqrt(b * b + q / (m.mu * std::pow(J, -2.0 / 3)));
      b = std::sqrt(volume / a);
    }
    return a;
  }
  double stretch(double gamma) const { return elastic(m.strength(gamma)) * std::exp(gamma); }
};

}  // namespace

// To twice its length: stretch and Cauchy stress are those of the closed form at the point's gamma.
TEST(FiniteVonMises, BarToTwiceItsLength) {
  const Metal m = metal(500, 120, 8, 0, 0);
  fem::FeProblem problem = bar(FiniteVonMises{m});
  const Followed out(problem, {problem.initialState(0), 0.0}, 1);
  ASSERT_EQ(out.outcome.reason, path::EndReason::stopReached) << out.outcome.text;
  const FiniteBar exact{m};
  int yielding = 0;
  for (std::size_t s = 0; s < out.steps.reports.size(); ++s)
    for (int i = 1; i <= 4; ++i) {
      const path::State state = out.steps.series[s].state(out.steps.reports[s].length * i / 4);
      const auto shown = problem.observe(0, state);
      const double gamma = shown.values.at(6);
      if (gamma == 0) continue;
      ++yielding;
      // Series of an accuracy of 1e-9, a dozen of steps.
      EXPECT_NEAR(1 + state.lambda, exact.stretch(gamma), 1e-7) << "step " << s;
      const double q = m.strength(gamma), half = 0.5 * (m.lambda + 2 * m.mu / 3);
      EXPECT_NEAR(shown.values.at(0), q / std::sqrt(1 + q / (3 * half)), 1e-7 * yield) << "step " << s;
    }
  EXPECT_GE(yielding, 8);
}

// Plastic flow keeps the volume: det G = 1 after any path; and where strains are small it is the other law.
TEST(FiniteVonMises, ShearKeepsThePlasticVolume) {
  const fem::Mesh cube = box(fem::Topology::Hex8, {1, 1, 1});
  const auto points = fem::volumePoints(cube, cube.blocks[0], fem::tabulate(fem::Topology::Hex8));
  const Metal m = metal(500, 120, 8, 0, 0);
  auto problem = sheared(FiniteVonMises{m}, cube, points);
  const Followed out(problem, {problem.initialState(0), 0.0}, 0.5);
  ASSERT_EQ(out.outcome.reason, path::EndReason::stopReached) << out.outcome.text;
  const auto& z = out.outcome.final.memory->variables;
  ASSERT_GT(z.at(0), 0.3);
  const double xx = 1 + z.at(1), yy = 1 + z.at(2), zz = 1 + z.at(3), xy = z.at(4), yz = z.at(5), zx = z.at(6);
  EXPECT_NEAR(xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx), 1, 1e-8);

  auto finite = sheared(FiniteVonMises{m}, cube, points), small = sheared(VonMises<false>{m}, cube, points);
  double difference[2];
  for (int half = 0; half < 2; ++half) {
    const double to = half == 0 ? 0.004 : 0.002;
    const Followed a(finite, {finite.initialState(0), 0.0}, to), b(small, {small.initialState(0), 0.0}, to);
    const auto f = forcesOfEnd(finite, cube, a.outcome.final), g = forcesOfEnd(small, cube, b.outcome.final);
    difference[half] = std::hypot(f[0] - g[0], f[1] - g[1]) / std::hypot(f[0], f[1]);
  }
  EXPECT_LT(difference[0], 0.02);
  EXPECT_LT(difference[1], 0.7 * difference[0]);  // of the order of the strain
}

// Forces do not see a rotation, the tangent is symmetric, Fad and differences agree.
TEST(FiniteVonMises, ObjectiveWithASymmetricTangent) {
  const FiniteVonMises law{metal(500, 120, 8, 0, 0)};
  double data[FiniteVonMises::numData] = {1, 0.1, 0.2, -0.12, -0.05, 0.07, -0.04, 0.03};
  const double angle = 0.7, c = std::cos(angle), s = std::sin(angle);
  const double Q[9] = {c, -s, 0, s, c, 0, 0, 0, 1};
  const double F[9] = {0.97, 0.1, -0.05, 0.2, 1.05, 0.03, 0.02, -0.04, 1.01};
  double H[9], turned[9], P[FiniteVonMises::numOutputs], R[FiniteVonMises::numOutputs];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      H[3 * i + j] = F[3 * i + j] - (i == j);
      turned[3 * i + j] = -(i == j);
      for (int k = 0; k < 3; ++k) turned[3 * i + j] += Q[3 * i + k] * F[3 * k + j];
    }
  law(H, data, P);
  law(turned, data, R);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double expected = 0;
      for (int k = 0; k < 3; ++k) expected += Q[3 * i + k] * P[3 * k + j];
      EXPECT_NEAR(R[3 * i + j], expected, 1e-10 * std::abs(E));
    }
  using Fad = Sacado::Fad::SFad<double, 9>;
  Fad in[9], out[FiniteVonMises::numOutputs];
  for (int i = 0; i < 9; ++i) in[i] = Fad(9, i, H[i]);
  law(in, data, out);
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j < i; ++j) EXPECT_NEAR(out[i].dx(j), out[j].dx(i), 1e-9 * E) << i << ' ' << j;
}

TEST(VonMises, BadMetalsAreRefused) {
  Metal m;
  m.yieldStress = yield;
  for (auto change : {+[](Metal& x) { x.yieldStress = 0; }, +[](Metal& x) { x.modulus = -1; },
                      +[](Metal& x) {
                        x.saturation = -300;
                        x.exponent = 1;
                      },
                      +[](Metal& x) { x.recall = -1; }, +[](Metal& x) { x.width = 0.6; },
                      +[](Metal& x) { x.modulus = std::numeric_limits<double>::infinity(); }}) {
    Metal bad = m;
    change(bad);
    EXPECT_THROW(metalFromYoung(E, nu, bad), std::invalid_argument);
  }
  EXPECT_THROW(metalFromYoung(-1, nu, m), std::invalid_argument);
}
