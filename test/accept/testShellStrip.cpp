// examples/strip_roll/shell.yaml, the paper's first example with its 20 shell elements, against elastica with
// contact at the same 41 stations and everywhere along the strip.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "atrapos/exodus/ResultReader.hpp"
#include "support/StripRun.hpp"

namespace atrapos::test {
namespace {

const std::string kLastMonitor =
    "    force_220: {type: contact_force, contact: strip, near: [220, 10, 0], along: [0, 1, 0]}\n";

/// The elastica has no width: nu = 0. Forces of more stations.
Edits asBeam() {
  std::string monitors = kLastMonitor;
  for (int s : {180, 190, 230, 240, 250, 260, 270})
    monitors += "    force_" + std::to_string(s) + ": {type: contact_force, contact: strip, near: [" +
                std::to_string(s) + ", 10, 0], along: [0, 1, 0]}\n";
  return {{"poissons_ratio: 0.3", "poissons_ratio: 0"}, {kLastMonitor, monitors}};
}

/// The same with an element, instead of half of one, between stations.
Edits asRefinedBeam() {
  Edits edits = asBeam();
  edits.push_back({"divisions: [20, 1]", "divisions: [40, 1]"});
  edits.push_back({"set: y_lines", "set: y_edges"});
  return edits;
}

/// Nearly hard contact, elements of 400 mm / count, up to load factor 0.25.
Edits asHardBeam(int count) {
  return {{"poissons_ratio: 0.3", "poissons_ratio: 0"},
          {"divisions: [20, 1]", "divisions: [" + std::to_string(count) + ", 1]"},
          {"stiffness: 1000, regularisation: 0.01", "stiffness: 1.0e+5, regularisation: 1.0e-4"},
          {"stop: {load_factor: 2}", "stop: {load_factor: 0.25}"}};
}

TEST(ShellStrip, PointsComeIntoContactAndLeaveAgain) {
  const StripRun run("shell.yaml");
  const auto load = run.column("load_factor");
  EXPECT_EQ(load.back(), 2);
  for (const char* station : {"force_200", "force_210", "force_220"}) {
    SCOPED_TRACE(station);
    const auto force = run.column(station);
    const std::size_t wrapping =
        std::find_if(load.begin(), load.end(), [](double l) { return l > 1; }) - load.begin();
    const std::size_t top = std::max_element(force.begin(), force.begin() + wrapping) - force.begin();
    // 1.8, 9.4 and 20 N, which the next station takes over before load factor 0.25; what is left and was
    // there before is the law's tail, eta Delta / h. (Later the strip lies on an arc, to which 220 belongs
    // again.)
    EXPECT_GT(force[top], 1);
    EXPECT_LT(force.front(), 1e-10);
    EXPECT_LT(load[top], 0.25);
    double left = 0;
    for (std::size_t i = 0; i < load.size(); ++i)
      if (load[i] > 0.25 && load[i] < 1) left = std::max(left, force[i]);
    EXPECT_LT(left, 0.02 * force[top] + 0.05);
  }
  // Beyond load factor 1.18 the strip lies on an arc of the roll that grows both ways: more stations than the
  // one or two where it touches before.
  const exodus::ResultReader results(run.folder.results("results.exo").string());
  EXPECT_GE(results.global(results.numSteps() - 1, "active_contacts"), 6);
  // 51 measured (77 with polynomials alone); the paper has 95 up to its last load.
  EXPECT_LT(run.summary.at("steps"), 90);
}

/// Largest deviations from the elastica with the same law, alpha, eta and Delta at 41 stations.
struct Deviations {
  double tip = 0;                      ///< mm
  double sum = 0;                      ///< of the sum of those forces that push
  double force = 0, forceWrapped = 0;  ///< of a station's force in units of that sum, to 0.25 and beyond
};

Deviations fromFortyOneStations(const Edits& edits, const std::string& eta = "1e-2") {
  const StripRun run("shell.yaml", edits);
  const Table reference(ATRAPOS_CONTACT_DATA "/roll_41_stations_alpha1e3_eta" + eta + ".csv");
  const auto load = run.column("load_factor"), total = run.column("force"),
             lambda = reference.column("lambda"), sum = reference.column("R_sum_positive");
  Deviations worst;
  int compared = 0;
  for (std::size_t i = 0; i < lambda.size(); ++i) {
    if (lambda[i] == 0 || lambda[i] > 2) continue;
    const auto off = [&](const std::string& monitor, const std::string& column) {
      return std::abs(interpolate(load, run.column(monitor), lambda[i]) - reference.column(column)[i]);
    };
    worst.tip = std::max({worst.tip, off("tip_ux", "ux_tip"), off("tip_uz", "uz_tip")});
    worst.sum = std::max(worst.sum, off("force", "R_sum_signed") / sum[i]);
    double& force = lambda[i] <= 0.25 ? worst.force : worst.forceWrapped;
    for (int s = 180; s <= 270; s += 10)
      force = std::max(force, off("force_" + std::to_string(s), "R_s" + std::to_string(s)) / sum[i]);
    ++compared;
  }
  EXPECT_GT(compared, 50);
  return worst;
}

TEST(ShellStrip, FollowsTheElasticaWithFortyOneStations) {
  const Deviations coarse = fromFortyOneStations(asBeam());
  EXPECT_LT(coarse.tip, 0.06);    // measured 0.046 of 180; the reference neglects 0.01 of stretch and shear
  EXPECT_LT(coarse.sum, 1e-3);    // measured 6e-4, before the first touch, where the forces are tails
  EXPECT_LT(coarse.force, 5e-3);  // the limit asked for; measured 6e-4
  // Wrapped, an element spans 0.4 rad of the roll with a kink of the curvature at its middle: measured 0.025.
  EXPECT_LT(coarse.forceWrapped, 0.03);
}

TEST(ShellStrip, FollowsTheElasticaWithASofterLaw) {
  Edits edits = asBeam();
  edits.push_back({"regularisation: 0.01", "regularisation: 0.1"});
  const Deviations soft = fromFortyOneStations(edits, "1e-1");
  EXPECT_LT(soft.tip, 0.06);    // measured 0.031
  EXPECT_LT(soft.sum, 2e-3);    // measured 1e-3, of tails
  EXPECT_LT(soft.force, 5e-3);  // measured 7e-4
}

// Delta = 4 mm everywhere: stations farther off are attracted, and at the start, which Newton's method has to
// find, the tip is 5.7 mm down.
TEST(ShellStrip, FollowsTheElasticaThatIsAttracted) {
  Edits edits = asBeam();
  edits.push_back({"regularisation: 0.01", "regularisation: 0.01, reference_gap: 4"});
  const Deviations attracted = fromFortyOneStations(edits, "1e-2_uniform");
  EXPECT_LT(attracted.tip, 0.06);    // measured 0.052
  EXPECT_LT(attracted.force, 5e-3);  // measured 6e-4
}

TEST(ShellStrip, FollowsItCloserWithMoreElements) {
  const Deviations fine = fromFortyOneStations(asRefinedBeam());
  // All kinks are at edges of elements; measured 0.014, 6e-4, 4e-4 and 7e-4.
  EXPECT_LT(fine.tip, 0.02);
  EXPECT_LT(fine.sum, 1e-3);
  EXPECT_LT(fine.force, 6e-4);
  EXPECT_LT(fine.forceWrapped, 2e-3);
}

std::vector<double> totalForce(const ExampleRun& run) {
  auto sum = run.column("force_right");
  const auto left = run.column("force_left");
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += left[i];
  return sum;
}

// Hard contact by events, at the same stations as an elastica in hard contact.
TEST(ShellStrip, HardContactTakesAStepAnEvent) {
  const StripRun run("hard.yaml", {{"poissons_ratio: 0.3", "poissons_ratio: 0"},
                                   {"points_per_step: 10", "points_per_step: 100"}});
  EXPECT_LE(run.summary.at("steps"), 40);  // 9 measured
  EXPECT_LT(run.summary.at("worst_residual"), 1e-6);
  const Table reference(ATRAPOS_CONTACT_DATA "/roll_41_stations_hard.csv");
  const auto load = run.column("load_factor"), total = totalForce(run), lambda = reference.column("lambda"),
             uz = reference.column("uz_tip"), sum = reference.column("R_sum_signed");
  int compared = 0;
  for (std::size_t i = 0; i < lambda.size(); ++i) {
    // Before, the reference's barrier has tails only.
    if (lambda[i] < 0.0015 || lambda[i] > 0.245) continue;
    SCOPED_TRACE(lambda[i]);
    EXPECT_NEAR(interpolate(load, run.column("tip_uz"), lambda[i]), uz[i], 0.15);
    EXPECT_NEAR(interpolate(load, total, lambda[i]), sum[i], 2e-3 * sum[i] + 1e-3);
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

// Where the contact point of the elastica passes a station, hard contact at stations is hard contact
// everywhere; elsewhere the strip is a polygon on the roll: 1.93 mm by 10 mm between stations alone, half of
// it by 5 mm.
TEST(ShellStrip, IsAccurateWhereTheContactPassesAStation) {
  const Table crossing(ATRAPOS_ACCEPT_DATA "/r1_x200_A_node_crossing.csv"),
      everywhere(ATRAPOS_ACCEPT_DATA "/r1_x200_A.csv");
  double polygon = 2;
  for (int elements : {20, 40}) {
    SCOPED_TRACE(elements);
    const StripRun run("shell.yaml", asHardBeam(elements));
    const auto load = run.column("load_factor"), ux = run.column("tip_ux"), uz = run.column("tip_uz"),
               total = run.column("force"), lambda = crossing.column("lambda_beam");
    const double spacing = 200.0 / elements;
    int compared = 0;
    for (std::size_t i = 0; i < lambda.size(); ++i) {
      const double s = crossing.column("s_contact")[i];
      if (lambda[i] > 0.25 || std::fmod(s, spacing) != 0) continue;
      SCOPED_TRACE(s);
      // 0.1 %; measured 0.02 % of the deflection and 0.01 % of the force.
      EXPECT_NEAR(interpolate(load, ux, lambda[i]), crossing.column("ux_tip")[i], 1e-3 * 154);
      EXPECT_NEAR(interpolate(load, uz, lambda[i]), crossing.column("uz_tip")[i],
                  1e-3 * std::abs(crossing.column("uz_tip")[i]));
      EXPECT_NEAR(interpolate(load, total, lambda[i]), crossing.column("N_beam")[i],
                  1e-3 * crossing.column("N_beam")[i]);
      ++compared;
    }
    EXPECT_EQ(compared, elements == 20 ? 3 : 6);
    double worst = 0;
    const auto all = everywhere.column("lambda"), exact = everywhere.column("uz_tip");
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i] > 0.0012 && all[i] <= 0.25)
        worst = std::max(worst, std::abs(interpolate(load, uz, all[i]) - exact[i]));
    EXPECT_LT(worst, polygon);
    EXPECT_GT(worst, 0.4 * polygon);
    polygon = 0.5 * polygon;
  }
}

}  // namespace
}  // namespace atrapos::test
