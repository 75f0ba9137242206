// examples/strip_roll/solid.yaml as shipped against the elastica on a rigid roll, and what the run leaves on
// disk.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <sstream>

#include "atrapos/exodus/ResultReader.hpp"
#include "support/Elastica.hpp"
#include "support/StripRun.hpp"

namespace atrapos::test {
namespace {

/// One run for all tests. Two monitors are added, which do not change the path.
class StripOnRoll : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const std::string last = "component: normal}   # total on the roll\n";
    run_ = std::make_unique<StripRun>(
        "solid.yaml",
        Edits{{last, last + "    contact_x: {type: contact_force, contact: lower, component: x}\n"
                            "    contact_z: {type: contact_force, contact: lower, component: z}\n"}});
  }
  static void TearDownTestSuite() { run_.reset(); }

  void SetUp() override { ASSERT_TRUE(run_) << "the run failed"; }

  static std::vector<double> column(const std::string& name) { return run_->path->column(name); }
  static exodus::ResultReader results() {
    return exodus::ResultReader(run_->folder.results("results.exo").string());
  }
  static int steps() { return run_->summary.at("steps"); }

  static std::unique_ptr<StripRun> run_;
};
std::unique_ptr<StripRun> StripOnRoll::run_;

TEST_F(StripOnRoll, FollowsTheElasticaOverTheWholePath) {
  const Elastica elastica;
  const auto load = column("load_factor"), ux = column("tip_ux"), uz = column("tip_uz"),
             force = column("contact_force");
  ASSERT_DOUBLE_EQ(load.front(), 0.0);
  ASSERT_DOUBLE_EQ(load.back(), 0.25);
  double sum = 0;
  for (std::size_t i = 0; i < load.size(); ++i) {
    SCOPED_TRACE(load[i]);
    const StripState exact = elastica.beam(load[i]);
    // 10 mm cells touch the roll like a polygon: 0.45 mm measured, up and down with each cell that the
    // contact passes. Contact at nodes 10 mm apart alone would cost 1.93 mm.
    ASSERT_NEAR(uz[i], exact.uz, 0.6);
    ASSERT_NEAR(ux[i], exact.ux, 0.6);  // 0.48 mm measured
    // 0.12 N of 41 N measured, growing with the force; 0.007 N before the touch, from the regularisation.
    ASSERT_NEAR(force[i], exact.force, 0.03 + 0.003 * exact.force);
    sum += uz[i] - exact.uz;
  }
  // The polygon's error has no preferred sign: 0.01 mm measured. A wrong stiffness would shift the whole
  // curve.
  EXPECT_LT(std::abs(sum / static_cast<double>(load.size())), 0.05);
}

TEST_F(StripOnRoll, IsAccurateWhereTheContactPassesANode) {
  const Table crossing(ATRAPOS_ACCEPT_DATA "/r1_x200_B_node_crossing.csv");
  const auto load = crossing.column("lambda_beam"), ux = crossing.column("ux_tip"),
             uz = crossing.column("uz_tip"), force = crossing.column("N_beam"),
             s = crossing.column("s_contact");
  const auto path = column("load_factor"), pathUx = column("tip_ux"), pathUz = column("tip_uz"),
             pathForce = column("contact_force");
  int compared = 0;
  for (std::size_t i = 0; i < load.size(); ++i) {
    if (load[i] > path.back()) continue;
    SCOPED_TRACE(s[i]);
    // The polygon touches the roll's true surface there: no more than 0.006 mm, 0.008 mm and 0.005 N are
    // left, of which 0.01 mm could be the elastica's missing axial and shear flexibility.
    EXPECT_NEAR(interpolate(path, pathUz, load[i]), uz[i], 0.02);
    EXPECT_NEAR(interpolate(path, pathUx, load[i]), ux[i], 0.02);
    EXPECT_NEAR(interpolate(path, pathForce, load[i]), force[i], 0.01);
    ++compared;
  }
  EXPECT_EQ(compared, 8);
}

TEST_F(StripOnRoll, KeepsTheResidualUnderItsBoundAlsoInsideSteps) {
  const double bound = run_->summary.at("residual_bound");
  ASSERT_EQ(bound, 1e-6);
  double worst = 0;
  for (double r : column("residual")) {
    ASSERT_TRUE(r >= 0 && r <= bound) << r;
    worst = std::max(worst, r);
  }
  // Four digits are printed in the table.
  EXPECT_NEAR(worst, run_->summary.at("worst_residual"), 1e-3 * worst);
  EXPECT_GT(worst, 0.0);
}

TEST_F(StripOnRoll, PaysOneFactorizationAStep) {
  const auto& s = run_->summary;
  const int expected = s.at("steps").get<int>() + s.at("corrections").get<int>() +
                       s.at("start_iterations").get<int>() + s.at("restarts").get<int>() +
                       s.at("retreats").get<int>() + s.at("closings").get<int>() +
                       s.at("critical_factorizations").get<int>();
  EXPECT_EQ(s.at("factorizations"), expected);
  // Where steps shrink suddenly two more series are spent on the suspicion of a bifurcation point.
  // Eigenvalues that may vanish soon want eight orders more each, and in longer steps more of them may: 10 %
  // here.
  EXPECT_GE(s.at("orders_computed"), 20 * steps());
  EXPECT_LE(s.at("orders_computed"), 1.15 * 20 * steps());
  EXPECT_TRUE(s.at("reached_stop"));
  // 187 measured (286 with polynomials alone); a law or a radius that went wrong shows first in the number of
  // steps.
  EXPECT_LT(steps(), 240);
  EXPECT_LE(s.at("corrections").get<int>(), 0.02 * steps());
}

TEST_F(StripOnRoll, TableHasEveryStepWithItsPoints) {
  const auto step = column("step"), length = column("path_length");
  ASSERT_EQ(run_->path->numRows(), 1 + 5 * steps());
  for (std::size_t i = 0; i < step.size(); ++i) {
    ASSERT_EQ(step[i], static_cast<double>((i + 4) / 5));
    ASSERT_GT(length[i], i > 0 ? length[i - 1] : -1.0);
  }
}

TEST_F(StripOnRoll, ResultFileHoldsEveryStep) {
  const auto r = results();
  ASSERT_EQ(r.numSteps(), steps() + 1);
  const std::vector<std::string> globals{"load_factor",   "path_parameter",  "series_radius",
                                         "series_order",  "negative_pivots", "active_contacts",
                                         "residual_norm", "branch"};
  EXPECT_EQ(r.globalNames(), globals);
  const std::vector<std::string> nodal{
      "displ_x",         "displ_y",         "displ_z",          "reaction_x",      "reaction_y",
      "reaction_z",      "contact_gap",     "contact_pressure", "nodal_stress_xx", "nodal_stress_yy",
      "nodal_stress_zz", "nodal_stress_xy", "nodal_stress_yz",  "nodal_stress_zx"};
  EXPECT_EQ(r.nodalNames(), nodal);
  const std::vector<std::string> element{"stress_xx", "stress_yy", "stress_zz",
                                         "stress_xy", "stress_yz", "stress_zx"};
  EXPECT_EQ(r.elementNames(), element);

  const auto times = r.times(), length = column("path_length"), load = column("load_factor");
  double highest = 0;
  for (int s = 0; s <= steps(); ++s) {
    ASSERT_GT(times[s], s > 0 ? times[s - 1] : -1.0);
    // The last row of a step is the state in the result file, to the digit.
    ASSERT_EQ(times[s], length[5 * s]);
    ASSERT_EQ(r.global(s, "load_factor"), load[5 * s]);
    ASSERT_EQ(r.global(s, "path_parameter"), times[s]);
    const double order = r.global(s, "series_order");
    highest = std::max(highest, order);
    ASSERT_GE(order, s > 0 ? 1 : 0);  // fewer than asked for where the stop or an event is near
  }
  EXPECT_EQ(highest, 20);
  EXPECT_EQ(r.global(steps(), "negative_pivots"), 0);  // the path is stable
  EXPECT_GT(r.global(steps(), "active_contacts"), 0);
}

TEST_F(StripOnRoll, ResultFileCarriesTheDeck) {
  std::string text;
  for (const std::string& line : results().info()) text += line + "\n";
  // Exodus drops blanks at the ends of lines; the deck has none.
  EXPECT_EQ(text, readFile(run_->folder.deck()));
}

TEST_F(StripOnRoll, SupportRollAndLoadAreInBalance) {
  const auto r = results();
  const auto sum = [&](const char* name) {
    const auto values = r.nodal(steps(), name);
    return std::accumulate(values.begin(), values.end(), 0.0);
  };
  const double load = -100 * 0.25, tolerance = 1e-6 * 25;
  const double contactX = column("contact_x").back(), contactZ = column("contact_z").back();
  // The sum of the free nodes' residuals: 4e-7 N measured; a part of the load no larger than the residual's
  // bound.
  EXPECT_NEAR(sum("reaction_z") + contactZ + load, 0.0, tolerance);
  EXPECT_NEAR(sum("reaction_x") + contactX, 0.0, tolerance);
  EXPECT_GT(contactZ, -load) << "the clamp pulls down, the roll carries more than the load";
  // On a frictionless roll the resultant is not larger than the sum of the normal forces.
  EXPECT_LT(std::hypot(contactX, contactZ), column("contact_force").back());
}

}  // namespace
}  // namespace atrapos::test
