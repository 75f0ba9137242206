// A bar stretched or driven on to a plane: Saint Venant-Kirchhoff's closed form and law (15) in one unknown.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "support/Column.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

struct Row {
  double u, h, R, lambda;
};

/// Rows of the reference by (alpha, eta).
std::map<std::pair<double, double>, std::vector<Row>> referenceRows() {
  std::ifstream file(ATRAPOS_CONTACT_TEST_DATA "/contact_regularized_1dof.csv");
  std::map<std::pair<double, double>, std::vector<Row>> rows;
  for (std::string text; std::getline(file, text);) {
    std::replace(text.begin(), text.end(), ',', ' ');
    std::istringstream in(text);
    double alpha, eta;
    Row row{};
    if (in >> alpha >> eta >> row.u >> row.h >> row.R >> row.lambda) rows[{alpha, eta}].push_back(row);
  }
  return rows;
}

/// Finds the table's displacements on the series of every step, and looks at ten places inside each step.
class Watch : public path::Observer {
 public:
  Watch(const Column& column, const std::vector<Row>& rows) : column_(column), rows_(rows) {
    Numbers weights(column.mesh.coordinates.size(), 0.0);
    weights[3 * column.foot() + 2] = -1;
    foot_ = fem::test::vectorOf(*column.problem, weights);
  }

  bool onStep(const path::StepReport& report, const path::Series& series) override {
    const auto w = series.functional(*foot_);
    for (const Row& row : rows_)
      for (const double a : w.minus(row.u).roots(report.length)) compare(row, series.state(a));
    for (int i = 1; i <= 10; ++i) {
      const path::State at = series.state(0.1 * i * report.length);
      const double size = 1 + std::abs(at.lambda);
      worst = std::max(worst, std::abs(column_.imbalance(column_.w(*at.u), at.lambda)) / size);
    }
    return true;
  }

  int compared = 0;
  double worst = 0;  ///< imbalance of the closed form, relative to 1 + |lambda|

 private:
  void compare(const Row& row, const path::State& at) {
    const double lambda = at.lambda;
    // The table's spring is linear, k = 1; the bar is not: the difference is known.
    const double expected = row.lambda - row.u + column_.barForce(row.u, lambda);
    // The residual bound 1e-10 is relative to about 2 lambda; the table has 12 digits.
    EXPECT_NEAR(lambda, expected, 1e-9 * (1 + expected)) << row.u;
    // Rounding of the gap, 2e-16, times the law's slope, which is below alpha = 1e6.
    EXPECT_NEAR(column_.assembledForce(at), row.R, 1e-9 * (1 + row.R)) << row.u;
    const Numbers gaps = observed(*column_.problem, 1, at, "contact_gap");
    for (const double h : gaps) EXPECT_NEAR(h, row.h, 1e-12) << row.u;  // flat: every point has the same gap
    ++compared;
  }

  const Column& column_;
  const std::vector<Row>& rows_;
  linear::RCP<path::Vector> foot_;
};

class OnPlane : public testing::TestWithParam<Where> {};

// 36 rows of alpha from 1e3 to 1e6, eta from 1e-1 to 1e-3, from open to pressed in.
TEST_P(OnPlane, AgreesWithTheTable) {
  int compared = 0;
  std::size_t expected = 0;
  for (const auto& [law, rows] : referenceRows()) {
    Column column({1 / law.first, law.second}, GetParam());
    Watch watch(column, rows);
    const Row& last = rows.back();
    follow(*column.problem, column.start(), 1.001 * (last.lambda - last.u + column.barForce(last.u, 0)),
           watch);
    EXPECT_LT(watch.worst, 1e-9) << law.first << ' ' << law.second;  // as above, everywhere inside the steps
    compared += watch.compared;
    expected += rows.size() - 1;  // the first row is the start
  }
  EXPECT_EQ(expected, 36u);
  EXPECT_EQ(compared, 36);
}

/// The state wherever a path passes the load factor 0 of a driven column.
class Unloaded : public path::Observer {
 public:
  explicit Unloaded(const Column& column) : column_(column) {}
  bool onStep(const path::StepReport& report, const path::Series& series) override {
    for (const double a : series.lambdaFunction().roots(report.length)) {
      const path::State at = series.state(a);
      EXPECT_NEAR(column_.w(*at.u), 0.0, 1e-9);
      EXPECT_NEAR(column_.assembledForce(at), 0.0, 1e-9);
      ++passages;
    }
    return true;
  }
  int passages = 0;

 private:
  const Column& column_;
};

// The top comes down, the foot closes, is pressed, opens again when the top goes back, and moves on beyond
// the reference gap.
TEST_P(OnPlane, OpensAgainWithoutAForceLeft) {
  for (const RegularisedPressure& law : {RegularisedPressure{1e-4, 1e-3}, RegularisedPressure{0, 1e-2}}) {
    Column column(law, GetParam(), 0, 1);
    Unloaded watch(column);
    const auto closed = follow(*column.problem, column.start(), 1.5, watch);
    const double pressed = column.assembledForce(closed.final);
    EXPECT_GT(pressed, 0.4);  // about (1.5 - 1) times a stiffness just below 1

    // Back through the start: w = 0, R = 0. The residual bound 1e-10 of the forces at the ends of that step,
    // about 1e-2 and more, over the stiffness 1.
    const auto far = follow(*column.problem, closed.final, -3.0, watch);
    ASSERT_EQ(watch.passages, 1);

    // Farther than at the start: the law's far field, between -eta and 0, and nothing else.
    const double w = column.w(*far.final.u), force = column.assembledForce(far.final);
    EXPECT_GT(column.gap - w, 3.0);
    EXPECT_LT(force, 0.0);
    EXPECT_GT(force, -law.eta);
    EXPECT_NEAR(force, column.contactForce(column.gap - w), 1e-12 * law.eta);  // rounding of gaps of 4
  }
}

// The plane's force, the support's and the load balance; the support alone carries what the plane does not.
TEST_P(OnPlane, ReactionPlusLoadEqualsContactForce) {
  Column column({1e-5, 1e-3}, GetParam());
  const auto outcome = follow(*column.problem, column.start(), 3.0);
  const auto& u = *outcome.final.u;
  const double reaction = resultant(column.problem->reactions(outcome.final))[2];
  // 1e-10 of forces of about 5, over 8 nodes.
  EXPECT_NEAR(reaction + column.assembledForce(outcome.final) - 3.0, 0.0, 5e-9);
  EXPECT_NEAR(reaction, column.barForce(column.w(u), 3.0), 5e-9);
  EXPECT_GT(column.assembledForce(outcome.final), 1.5);  // the bar holds about 1.2 when it touches
}

INSTANTIATE_TEST_SUITE_P(, OnPlane, testing::Values(Where::Nodes, Where::Quadrature), [](const auto& info) {
  return info.param == Where::Nodes ? "nodes" : "quadrature";
});

}  // namespace
