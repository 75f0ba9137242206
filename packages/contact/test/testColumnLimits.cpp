// How fast regularised contact tends to hard contact, on a bar pulled on to a plane by a load.
//
// With k the bar's stiffness where it touches, at load P = lambda and the load P_c that closes the gap:
//   pressed, P > P_c:    R -> P - P_c; (15) gives  h = (eta Delta - R^2/alpha)/(R + eta) = O(eta) +
//   O(1/alpha) open,    P < P_c:    h -> h* > 0;  (15) gives  R = eta (Delta - h)/h + ...          = O(eta)
//   touching, P = P_c:   R = k h, so   k (k/alpha + 1) h^2 = eta (Delta - h)             = O(sqrt(eta))
#include <gtest/gtest.h>

#include "support/Column.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

constexpr double barLength = 4, barGap = 1, barE = 4;

double barForce(double w) {
  const double s = 1 + w / barLength;
  return barE * s * (s * s - 1) / 2;
}
double stiffness(double w) {
  const double s = 1 + w / barLength;
  return barE * (3 * s * s - 1) / (2 * barLength);
}

struct Contact {
  double h, R;
};

/// Gap and force at a load, by path following in the body.
Contact contactAt(double load, double compliance, double eta) {
  Column column({compliance, eta}, Where::Quadrature);
  const auto outcome = follow(*column.problem, column.start(), load, tightOptions(1e-11));
  return {observed(*column.problem, 1, outcome.final, "contact_gap")[0],
          column.assembledForce(outcome.final)};
}

/// log10 of the ratio of errors one decade of the parameter apart.
double rate(double coarse, double fine) { return std::log10(std::abs(coarse / fine)); }

TEST(RegularisationLimit, PressedGapIsProportionalToEta) {
  const double load = barForce(barGap) + 2;  // hard contact: R = 2, h = 0
  double before = 0;
  for (const double eta : {1e-2, 1e-3, 1e-4}) {
    const Contact c = contactAt(load, 0, eta);
    // h = eta Delta/(R + eta), R = 2 + k h + ...: the constant holds up to O(eta).
    EXPECT_NEAR(c.h / (eta * barGap / 2), 1.0, 2 * eta);
    EXPECT_NEAR((c.R - 2) / (stiffness(barGap) * c.h), 1.0, 2 * eta);
    if (before > 0) {
      EXPECT_NEAR(rate(before, c.h), 1.0, 0.01);
    }  // O(eta) of the constant above
    before = c.h;
  }
}

TEST(RegularisationLimit, OpenForceIsProportionalToEta) {
  const double w = 0.5 * barGap, load = barForce(w);  // hard contact: h = gap/2, R = 0
  double before = 0;
  for (const double eta : {1e-2, 1e-3, 1e-4}) {
    const Contact c = contactAt(load, 1e-6, eta);
    // R = eta (Delta - h)/h = eta at h = Delta/2; the gap grows by R/k, which takes (1 + 4/k) R off that.
    EXPECT_NEAR(c.R / eta, 1.0, 6 * eta);
    EXPECT_NEAR((c.h - 0.5 * barGap) * stiffness(w) / c.R, 1.0, 2 * eta);
    if (before > 0) {
      EXPECT_NEAR(rate(before, c.R), 1.0, 0.02);
    }  // 6 eta/ln 10 at 1e-2
    before = c.R;
  }
}

TEST(RegularisationLimit, TouchingErrorFallsAsTheSquareRootOfEta) {
  const double load = barForce(barGap), k = stiffness(barGap);  // hard contact: h = 0, R = 0
  double before = 0;
  for (const double compliance : {0.0, 0.1}) {
    before = 0;
    for (const double eta : {1e-4, 1e-6, 1e-8}) {
      const Contact c = contactAt(load, compliance, eta);
      const double expected = std::sqrt(eta * barGap / (k * (1 + k * compliance)));
      // The next term is of relative order h: eta (Delta - h), and the bar's curvature.
      EXPECT_NEAR(c.h / expected, 1.0, 2 * expected) << compliance << ' ' << eta;
      EXPECT_NEAR(c.R / (k * c.h), 1.0, 2 * expected) << compliance << ' ' << eta;
      if (before > 0) {
        EXPECT_NEAR(rate(before, c.h) / 2, 0.5, 0.01);
      }  // 2 h/ln 100 at eta = 1e-4
      before = c.h;
    }
  }
}

TEST(RegularisationLimit, StiffnessErrorIsProportionalToCompliance) {
  const double load = barForce(barGap) + 2, eta = 1e-4;
  const double barrier = contactAt(load, 0, eta).h;
  double before = 0;
  for (const double compliance : {1e-2, 1e-3, 1e-4}) {
    const Contact c = contactAt(load, compliance, eta);
    // h = (eta Delta - R^2/alpha)/(R + eta): penetration R/alpha. R itself falls by k R/alpha.
    EXPECT_NEAR((barrier - c.h) / (2 * compliance), 1.0, 2 * compliance * stiffness(barGap) + 2 * eta);
    if (before > 0) {
      EXPECT_NEAR(rate(before, barrier - c.h), 1.0, 0.01);
    }
    before = barrier - c.h;
  }
}

// At R^2 = alpha eta Delta the two errors cancel: there the surface is where hard contact has it.
TEST(RegularisationLimit, ErrorsCancelAtTheForceSqrtOfAlphaEtaDelta) {
  const double eta = 1e-4, compliance = eta * barGap / (2.0 * 2.0);
  const Contact c = contactAt(barForce(barGap) + 2, compliance, eta);
  EXPECT_NEAR(c.h, 0.0, 1e-10);  // residual 1e-11 of forces of about 5, over the stiffness 1/compliance and k
  EXPECT_NEAR(c.R, 2.0, 1e-10);
}

}  // namespace
