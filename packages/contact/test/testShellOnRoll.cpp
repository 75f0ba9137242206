// The paper's first example (4.1) with shell elements: a strip pulled over a rigid roll, contact at the nodes
// of the mid-surface, against elastica computed elsewhere (data/README.md), nu = 0.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/StripOnRoll.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;
using solid::test::atLoad;
using solid::test::ShellPath;

namespace {

/// The strip with a law at every station, whose nodes share the force.
struct Strip : StripOnRoll {
  std::unique_ptr<fem::FeProblem> problem;

  Strip(const RegularisedPressure& law, int times) : StripOnRoll(times) {
    addContact(model, points, roll, law, 0);
    problem = std::make_unique<fem::FeProblem>(std::move(model));
  }

  ShellPath follow(double loadFactor) {
    path::Stops stops;
    stops.loadFactors = {loadFactor};
    ShellPath path = solid::test::followPath(*problem, stops);
    EXPECT_EQ(path.outcome.reason, path::EndReason::stopReached) << path.outcome.text;
    return path;
  }

  Numbers stationForces(const Numbers& u) const { return StripOnRoll::stationForces(*problem, u); }
};

struct Deviations {
  double tip = 0, tipWrapped = 0;      ///< mm, up to lambda = 0.25 and beyond
  double force = 0, forceWrapped = 0;  ///< of a station, in units of the sum of forces
};

/// From the reference with the same law at the same stations, up to lambda = 1.5, far into the wrapped
/// regime.
Deviations fromFortyOneStations(int refinement) {
  Strip strip({1e-3, 0.01}, refinement);
  const ShellPath path = strip.follow(1.5);
  std::vector<int> all(6 * strip.grid.numNodes());
  for (std::size_t d = 0; d < all.size(); ++d) all[d] = static_cast<int>(d);
  Deviations worst;
  int compared = 0;
  for (const auto& row :
       solid::test::table(ATRAPOS_CONTACT_TEST_DATA "/roll_41_stations_alpha1e3_eta1e-2.csv")) {
    const double lambda = row[0], total = row[4];
    if (lambda == 0) continue;
    const Numbers u = atLoad(path, lambda, all).u;
    double& tip = lambda <= 0.25 ? worst.tip : worst.tipWrapped;
    double& force = lambda <= 0.25 ? worst.force : worst.forceWrapped;
    for (int i : {0, 2}) tip = std::max(tip, std::abs(u[3 * strip.tip + i] - row[1 + i / 2]));
    const Numbers forces = strip.stationForces(u);
    for (int s = 18; s <= 27; ++s) force = std::max(force, std::abs(forces[s] - row[12 + s - 18]) / total);
    ++compared;
  }
  EXPECT_GT(compared, 50);
  return worst;
}

}  // namespace

// Twenty elements as in the paper, the stations at their nodes; one path with default settings.
TEST(ShellOnRoll, FortyOneStations) {
  const Deviations coarse = fromFortyOneStations(1);
  EXPECT_LT(coarse.tip, 0.02);  // mm of 158; the reference neglects 0.01 mm of stretch and shear
  EXPECT_LT(coarse.tipWrapped, 0.1);
  EXPECT_LT(coarse.force, 5e-3);
  // Wrapped, an element spans 0.4 rad of the roll with a station's force, and a kink in the curvature, at its
  // middle.
  EXPECT_LT(coarse.forceWrapped, 0.03);
}

// Two elements between stations: all kinks are at element edges.
TEST(ShellOnRoll, FortyOneStationsRefined) {
  const Deviations fine = fromFortyOneStations(2);
  EXPECT_LT(fine.tip, 0.005);
  EXPECT_LT(fine.tipWrapped, 0.02);
  EXPECT_LT(fine.force, 5e-4);
  EXPECT_LT(fine.forceWrapped, 2e-3);
}

// Where the contact point passes a station, hard contact at stations is hard contact everywhere. alpha and
// eta are near hard: eta = 1e-4 N adds an attraction of that size at each of 40 stations.
TEST(ShellOnRoll, NodeCrossings) {
  Strip strip({1e-5, 1e-4}, 1);
  const ShellPath path = strip.follow(0.25);
  int compared = 0;
  for (const auto& row : solid::test::table(ATRAPOS_CONTACT_TEST_DATA "/roll_node_crossing.csv")) {
    // x_roll, case (A), s_contact, lambda_beam, lambda_plate, ux_tip, uz_tip
    const double s = row[2], lambda = row[3];
    if (std::fmod(s, 10) != 0 || lambda > 0.25) continue;
    const auto u = atLoad(path, lambda, {3 * strip.tip, 3 * strip.tip + 2}).u;
    EXPECT_NEAR(u[0], row[5], 1e-3 * std::abs(row[6])) << "s = " << s;
    EXPECT_NEAR(u[1], row[6], 1e-3 * std::abs(row[6])) << "s = " << s;
    const Numbers forces = [&] {
      std::vector<int> all(6 * strip.grid.numNodes());
      for (std::size_t d = 0; d < all.size(); ++d) all[d] = static_cast<int>(d);
      return strip.stationForces(atLoad(path, lambda, all).u);
    }();
    EXPECT_NEAR(forces[static_cast<int>(s / 10)], row[8], 1e-3 * row[8]) << "s = " << s;
    ++compared;
  }
  EXPECT_EQ(compared, 3);
}
