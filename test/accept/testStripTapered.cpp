// examples/strip_roll/tapered.yaml, and the same strip on a cylinder (paper 4.1, Figures 5 and 6), against
// solids on a meshed roll in CalculiX: the middle surface along both edges at load factor 0.25.
#include <gtest/gtest.h>

#include <cmath>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "support/StripRun.hpp"

namespace atrapos::test {
namespace {

const std::string kTapered =
    "{type: tapered_roll, center: [200, -10, -54], axis: [0, 1, 0], radius: 50, flat: 15,\n"
    "         angle: -5.729577951308232, smoothing: 0.04347826086956522, ends: one}";
const std::string kCylinder = "{type: cylinder, center: [200, 0, -54], axis: [0, 1, 0], radius: 50}";

/// Vertical displacements of the middle surface at the end of a run, by place.
class Deflection {
 public:
  explicit Deflection(const StripRun& run)
      : mesh_(exodus::readMesh((run.folder.path() / "strip_tapered.exo").string())) {
    // The result's first nodes are the mesh's; those of the shells' faces follow.
    const exodus::ResultReader results(run.folder.results("results.exo").string());
    uz_ = results.nodal(results.numSteps() - 1, "displ_z");
  }

  double at(double x, double y) const {
    for (int n = 0; n < mesh_.numNodes(); ++n)
      if (std::hypot(mesh_.coordinates[3 * n] - x, mesh_.coordinates[3 * n + 1] - y) < 1e-6)
        return uz_[static_cast<std::size_t>(n)];
    ADD_FAILURE() << "no node at " << x << ", " << y;
    return 0;
  }

 private:
  fem::Mesh mesh_;
  std::vector<double> uz_;
};

/// The same of a profile of CalculiX, whose nodes along the edges are 5 mm apart.
class Reference {
 public:
  explicit Reference(const std::string& roll)
      : table_(std::string(ATRAPOS_ACCEPT_DATA "/ccx_tapered_roll/") + roll + ".csv") {}

  double at(double x, double y) const {
    const auto load = table_.column("load_factor"), xs = table_.column("x"), ys = table_.column("y"),
               uz = table_.column("uz");
    for (std::size_t i = 0; i < uz.size(); ++i)
      if (load[i] == 0.25 && xs[i] == x && ys[i] == y) return uz[i];
    ADD_FAILURE() << "no node at " << x << ", " << y;
    return 0;
  }

 private:
  Table table_;
};

void compare(const Deflection& shell, const Reference& solid) {
  for (int x = 0; x <= 400; x += 10) {
    SCOPED_TRACE(x);
    for (double y : {-10.0, 10.0}) {
      // Over the roll, to the polygon of 20 elements there: measured 0.26 mm where the strip goes down by 40
      // mm. At the tip 0.87 of 157 mm: one element across is free to curl at its edges, the solids across are
      // stiffer by nu.
      const double tolerance = x <= 260 ? 0.4 : 0.4 + 0.8 * (x - 260) / 140;
      EXPECT_NEAR(shell.at(x, y), solid.at(x, y), tolerance) << y;
    }
    // How far the taper tilts the strip: 0.42 mm at the tip, 0.05 mm of which the one element across does not
    // see.
    EXPECT_NEAR(shell.at(x, 10) - shell.at(x, -10), solid.at(x, 10) - solid.at(x, -10), 0.075);
  }
}

TEST(StripTapered, ProfileOverTheTaper) {
  const StripRun run("tapered.yaml");
  const Deflection shell(run);
  const Reference solid("tapered");
  compare(shell, solid);
  EXPECT_GT(shell.at(400, 10) - shell.at(400, -10), 0.3);
}

TEST(StripTapered, ProfileOverTheCylinder) {
  const StripRun run("tapered.yaml", {{kTapered, kCylinder}});
  const Deflection shell(run);
  const Reference solid("cylinder");
  compare(shell, solid);
  EXPECT_LT(std::abs(shell.at(400, 10) - shell.at(400, -10)), 1e-3);  // by symmetry; 1e-4 is rounding
}

}  // namespace
}  // namespace atrapos::test
