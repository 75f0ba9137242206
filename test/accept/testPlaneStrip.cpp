// examples/strip_roll/plane.yaml: a strip in plane stress is the strip in space where nu = 0.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "atrapos/exodus/ResultReader.hpp"
#include "support/Elastica.hpp"
#include "support/StripRun.hpp"

namespace atrapos::test {
namespace {

/// y(x) of a table with ascending x.
double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto above = std::lower_bound(x.begin(), x.end(), at);
  if (above == x.begin()) return y.front();
  const std::size_t i = std::min<std::size_t>(above - x.begin(), x.size() - 1);
  const double part = (at - x[i - 1]) / (x[i] - x[i - 1]);
  return (1 - part) * y[i - 1] + part * y[i];
}

}  // namespace

TEST(PlaneStrip, IsTheStripInSpaceAtAQuarterOfItsUnknowns) {
  const StripRun plane("plane.yaml"), space("solid.yaml");
  const auto load = plane.path->column("load_factor"), uy = plane.path->column("tip_uy"),
             force = plane.path->column("contact_force");
  const auto loads = space.path->column("load_factor"), uz = space.path->column("tip_uz"),
             forces = space.path->column("contact_force");
  ASSERT_DOUBLE_EQ(load.back(), 0.25);
  const Elastica elastica;
  double apart = 0, fromElastica = 0, forceApart = 0;
  for (std::size_t i = 0; i < load.size(); ++i) {
    apart = std::max(apart, std::abs(uy[i] - interpolated(loads, uz, load[i])));
    forceApart = std::max(forceApart, std::abs(force[i] - interpolated(loads, forces, load[i])));
    fromElastica = std::max(fromElastica, std::abs(uy[i] - elastica.beam(load[i]).uz));
  }
  // The same cells and, along the strip, the same points of contact; what is left is the interpolation
  // between rows of the two paths, 185 steps of five rows with kinks, and both residuals of 1e-6.
  EXPECT_LT(apart, 0.02);
  EXPECT_LT(forceApart, 0.02);
  EXPECT_LT(fromElastica, 0.6);  // as testStripOnRoll has it
  const auto nodes = [](const StripRun& run) {
    return exodus::ResultReader(run.folder.results("results.exo").string()).nodal(0, "displ_x").size();
  };
  EXPECT_LT(4 * 2 * nodes(plane), 3 * nodes(space));
}

}  // namespace atrapos::test
