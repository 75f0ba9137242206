// Metals with a smoothed yield surface along paths: uniaxial tension, there and back, against an integration
// of the law under uniaxial stress; what the width is; a thick sphere against Hill, with steps that do not
// grow with the mesh; bars against the law in space.
#include <gtest/gtest.h>

#include <Sacado.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "HillSphere.hpp"
#include "MetalBar.hpp"
#include "MetalPath.hpp"
#include "atrapos/solid/FiniteVonMises.hpp"
#include "atrapos/solid/ThinStages.hpp"
#include "atrapos/solid/VonMises.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::solid::test;

namespace {

/// The law under uniaxial stress (docs/theory/plasticity.md), integrated by Runge and Kutta in steps of the
/// strain; what moves against the stress is elastic.
struct Integration {
  Metal m;
  double strain = 0, stress = 0, gamma = 0, back = 0;

  std::array<double, 3> rates(const std::array<double, 3>& y, double sense) const {
    const double R = m.strength(y[1]), xi = y[0] - y[2], s = xi * xi / (R * R);
    const double G = xi * sense > 0 ? std::exp((s - 1) / (2 * m.width)) : 0;
    // p' = xi/R K with K D = 3 mu G xi/R (sigma'/(3 mu) + p')
    const double D = 3 * m.mu + m.kinematicModulus + m.hardening(y[1]) - m.recall * y[2] * xi / R;
    const double K = G * xi / R * E * sense / (D - (3 * m.mu - E) * G * s);
    const double plastic = xi / R * K, grown = s * K;
    return {E * (sense - plastic), grown, m.kinematicModulus * plastic - m.recall * y[2] * grown};
  }
  void to(double next) {
    const double sense = next > strain ? 1 : -1;
    const double longest = m.width * m.yieldStress / E / 100;  // what changes the share of flow, by a hundred
    const int count = std::max(1, static_cast<int>(std::ceil(std::abs(next - strain) / longest)));
    const double h = std::abs(next - strain) / count;
    std::array<double, 3> y{stress, gamma, back};
    const auto moved = [](std::array<double, 3> a, double by, const std::array<double, 3>& rate) {
      for (int i = 0; i < 3; ++i) a[i] += by * rate[i];
      return a;
    };
    for (int i = 0; i < count; ++i) {
      const auto a = rates(y, sense), b = rates(moved(y, h / 2, a), sense),
                 c = rates(moved(y, h / 2, b), sense), d = rates(moved(y, h, c), sense);
      for (int j = 0; j < 3; ++j) y[j] += h / 6 * (a[j] + 2 * b[j] + 2 * c[j] + d[j]);
    }
    strain = next;
    stress = y[0];
    gamma = y[1];
    back = y[2];
  }
};

void expectIntegrated(const fem::FeProblem& problem, const Steps& steps, Integration& exact) {
  for (std::size_t s = 0; s < steps.reports.size(); ++s)
    for (int i = 1; i <= 4; ++i) {
      const path::State state = steps.series[s].state(steps.reports[s].length * i / 4);
      exact.to(state.lambda + 0.5 * state.lambda * state.lambda);
      // Series of an accuracy of 1e-9 of forces; some dozens of steps.
      EXPECT_NEAR(secondPiolaOfBar(problem, state), exact.stress, 1e-7 * yield) << "step " << s;
      // What flows where flow is negligible (fem::EventTerm::negligibleFall), besides.
      EXPECT_NEAR(problem.observe(0, state).values.at(6), exact.gamma, 1e-6 * yield / E) << "step " << s;
    }
}

/// Out to 1 %, back and into compression: no event but where the sense of flow changes.
template <bool kinematic>
void thereAndBack(const Metal& m) {
  fem::FeProblem problem = bar(VonMises<kinematic>{m});
  Integration exact{m};
  const Followed out(problem, {problem.initialState(0), 0.0}, 0.01);
  ASSERT_EQ(out.outcome.reason, path::EndReason::stopReached) << out.outcome.text;
  EXPECT_EQ(out.outcome.events, 0);
  expectIntegrated(problem, out.steps, exact);

  const Followed back(problem, out.outcome.final, -0.005, -1);
  ASSERT_EQ(back.outcome.reason, path::EndReason::stopReached) << back.outcome.text;
  EXPECT_EQ(back.outcome.events, 2);  // unloading, and flow the other way
  expectIntegrated(problem, back.steps, exact);
}

}  // namespace

TEST(SmoothedYield, PerfectlyPlasticBar) { thereAndBack<false>(smoothed(metal(0, 0, 0, 0, 0), 0.05)); }
TEST(SmoothedYield, BarWithVoceHardening) { thereAndBack<false>(smoothed(metal(500, 120, 300, 0, 0), 0.02)); }
TEST(SmoothedYield, BarWithKinematicHardening) { thereAndBack<true>(smoothed(metal(0, 0, 0, 20e3, 0), 0.1)); }
TEST(SmoothedYield, BarWithBoth) { thereAndBack<true>(smoothed(metal(300, 60, 150, 30e3, 250), 0.05)); }

// What the width is: where the stress of elasticity is the yield stress, a share of the width is missing of
// it.
TEST(SmoothedYield, DefectIsOfFirstOrderInTheWidth) {
  double before = 0;
  for (const double width : {0.04, 0.02, 0.01, 0.005}) {
    const Metal m = smoothed(metal(0, 0, 0, 0, 0), width);
    fem::FeProblem problem = bar(VonMises<false>{m});
    const double strain = yield / E;
    const Followed out(problem, {problem.initialState(0), 0.0}, std::sqrt(1 + 2 * strain) - 1);
    ASSERT_EQ(out.outcome.reason, path::EndReason::stopReached) << out.outcome.text;
    const double defect = 1 - secondPiolaOfBar(problem, out.outcome.final) / yield;
    EXPECT_GT(defect, 0.3 * width);
    EXPECT_LT(defect, width);
    if (before > 0) {
      EXPECT_NEAR(before / defect, 2, 0.1) << width;
    }
    before = defect;
  }
}

// At small strains finite ones are the same, by terms of their size.
TEST(SmoothedYield, FiniteStrainsAreTheSameWhereSmall) {
  double difference[2];
  for (int half = 0; half < 2; ++half) {
    Metal m = metal(500, 120, 300, 0, 0);
    m.yieldStress *= half == 0 ? 1 : 0.5;
    m.saturation *= half == 0 ? 1 : 0.5;
    m.width = 0.05;
    const double to = half == 0 ? 0.004 : 0.002;
    fem::FeProblem finite = bar(FiniteVonMises{m}), small = bar(VonMises<false>{m});
    const Followed a(finite, {finite.initialState(0), 0.0}, to), b(small, {small.initialState(0), 0.0}, to);
    ASSERT_EQ(a.outcome.reason, path::EndReason::stopReached) << a.outcome.text;
    EXPECT_EQ(a.outcome.events, 0);
    const double S = secondPiolaOfBar(finite, a.outcome.final), T = secondPiolaOfBar(small, b.outcome.final);
    difference[half] = std::abs(S - T) / T;
  }
  EXPECT_LT(difference[0], 0.02);
  EXPECT_LT(difference[1], 0.7 * difference[0]);
}

// A bar's law is the one in space where nothing presses across: rates, by Fad with the strains across put in.
TEST(SmoothedYield, BarsAreFreeAcross) {
  const Metal m = smoothed(metal(300, 60, 150, 30e3, 250), 0.05);
  using Fad = Sacado::Fad::SFad<double, 3>;
  const double gamma = 0.003, plastic = 0.0028, chi = 60;
  for (const double elastic : {-0.001, 0.0005, 0.0014})
    for (const double elasticOnly : {0.0, 1.0}) {
      const double strain = plastic + elastic, across = -plastic / 2 - nu * elastic;
      const double inBar[] = {elasticOnly, gamma, plastic, chi};
      Fad E1[6], bar[BarMetalStage<true>::numOutputs];
      E1[0] = Fad(3, 0, strain);
      for (int i = 1; i < 6; ++i) E1[i] = Fad(3, 0.0);
      BarMetalStage<true>{m}(E1, inBar, bar);

      const double inSpace[] = {elasticOnly, gamma, plastic,     -plastic / 2, -plastic / 2, 0,
                                0,           0,     2 * chi / 3, -chi / 3,     -chi / 3,     0,
                                0,           0};
      Fad H[9], out[VonMises<true>::numOutputs];
      for (int i = 0; i < 3; ++i)  // derivatives by the strains
        for (int j = 0; j < 3; ++j) {
          const double F = std::sqrt(1 + 2 * (i == 0 ? strain : across));
          H[3 * i + j] = Fad(3, i == j ? F - 1 : 0.0);
          if (i == j) H[3 * i + j].fastAccessDx(i) = 1 / F;
        }
      VonMises<true>{m}(H, inSpace, out);
      const auto S = [&](int i) { return Fad(out[4 * i] / (1.0 + H[4 * i])); };
      EXPECT_NEAR(S(0).val(), bar[0].val(), 1e-10 * yield);
      EXPECT_NEAR(S(1).val(), 0, 1e-10 * yield);
      const double slope = -S(1).dx(0) / (S(1).dx(1) + S(1).dx(2));  // across by along
      EXPECT_NEAR(S(0).dx(0) + slope * (S(0).dx(1) + S(0).dx(2)), bar[0].dx(0), 1e-9 * ::E);
      EXPECT_NEAR(out[9].val(), bar[6].val(), 1e-10 * std::abs(bar[6].val()));
      for (int v = 0; v < 2; ++v)  // gamma, p
        EXPECT_NEAR(out[10 + v].dx(0) + slope * (out[10 + v].dx(1) + out[10 + v].dx(2)), bar[7 + v].dx(0),
                    1e-10);
    }
}

// Hill's sphere: steps that do not grow with the mesh (a sharp surface has one for each ring of points), an
// error that falls with the width to that of the mesh.
TEST(SmoothedYield, ThickSphereAgainstHill) {
  const Sphere coarse(12, 0.05), fine(48, 0.05), wide(12, 0.1), narrow(12, 0.02);
  const double error = coarse.largestError(1.8);
  fine.largestError(1.8);
  EXPECT_LE(fine.steps, 1.2 * coarse.steps);
  EXPECT_LT(error, 5e-3);
  EXPECT_LT(2.5 * error, wide.largestError(1.8));
  EXPECT_LT(narrow.largestError(1.8), 2e-3);
  RecordProperty("steps", fine.steps);
}
