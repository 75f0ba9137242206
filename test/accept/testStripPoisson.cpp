// examples/strip_roll/solid_nu03.yaml: with nu = 0.3 the strip bends between a beam and a plate.
#include <gtest/gtest.h>

#include <cmath>

#include "support/Elastica.hpp"
#include "support/StripRun.hpp"

namespace atrapos::test {
namespace {

TEST(StripPoisson, LiesBetweenBeamAndPlateNearCalculix) {
  const StripRun run("solid_nu03.yaml", {}, {"-t", "1"});  // why one thread: testStripFine
  const Elastica elastica;
  const auto load = run.path->column("load_factor"), ux = run.path->column("tip_ux"),
             uz = run.path->column("tip_uz"), force = run.path->column("contact_force");
  ASSERT_DOUBLE_EQ(load.back(), 0.25);

  for (double r : run.path->column("residual")) ASSERT_LE(r, 1e-6);

  double mean = 0;  // part of the way from beam to plate
  int counted = 0;
  for (std::size_t i = 0; i < load.size(); ++i) {
    SCOPED_TRACE(load[i]);
    const StripState beam = elastica.beam(load[i]), plate = elastica.plate(load[i]);
    // 0.6 mm either way for the polygon of 10 mm cells (see testStripOnRoll); 0.13 mm measured.
    ASSERT_GT(uz[i], beam.uz - 0.6);
    ASSERT_LT(uz[i], plate.uz + 0.6);
    // As in testStripOnRoll.
    const double slack = 0.03 + 0.003 * beam.force;
    ASSERT_GT(force[i], std::min(beam.force, plate.force) - slack);
    ASSERT_LT(force[i], std::max(beam.force, plate.force) + slack);
    if (load[i] < 0.01) continue;
    mean += (uz[i] - beam.uz) / (plate.uz - beam.uz);
    ++counted;
  }
  // A strip 20 mm wide is nearer to a beam: CalculiX goes from 0.02 to 0.34 of the way, 0.2 in the mean.
  // Exactly a beam (nu lost) would be 0 here, a plate (sides held) 1.
  mean /= counted;
  EXPECT_GT(mean, 0.1);
  EXPECT_LT(mean, 0.35);

  const Table calculix(ATRAPOS_ACCEPT_DATA "/ccx_x200_B_nu03.csv");
  const auto ccxLoad = calculix.column("lambda"), ccxUx = calculix.column("ux_tip_center"),
             ccxUz = calculix.column("uz_tip_center");
  int compared = 0;
  for (std::size_t i = 0; i < ccxLoad.size(); ++i) {
    if (ccxLoad[i] > 0.25) continue;
    SCOPED_TRACE(ccxLoad[i]);
    // The polygon again, and CalculiX' own 0.05 mm; 0.39 mm measured.
    EXPECT_NEAR(interpolate(load, uz, ccxLoad[i]), ccxUz[i], 0.6);
    EXPECT_NEAR(interpolate(load, ux, ccxLoad[i]), ccxUx[i], 0.6);
    ++compared;
  }
  EXPECT_EQ(compared, 14);
}

}  // namespace
}  // namespace atrapos::test
