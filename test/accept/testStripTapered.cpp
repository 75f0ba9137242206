// The strip over a cylinder and over a tapered roll (paper 4.1, Figures 5 and 6) against solids on a meshed roll in
// CalculiX: profiles of the middle surface at load factor 0.25.
#include <gtest/gtest.h>

#include <cmath>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "support/StripRun.hpp"

namespace atrapos::test {
namespace {

/// The strip's width costs a shell element with one quadratic across its stiffness there (docs/strip_roll.md):
/// four across, and elements short enough that the polygon they make on the roll is not seen.
const std::string kDivisions = "divisions: [20, 1]";

/// Vertical displacements at the end of the path, at the nodes of the middle surface.
class Profile {
 public:
  explicit Profile(const StripRun& run)
      : mesh_(exodus::readMesh((run.folder.path() / "strip_tapered.exo").string())) {
    const exodus::ResultReader results(run.folder.results("results.exo").string());
    uz_ = results.nodal(results.numSteps() - 1, "displ_z");
  }

  /// NaN where no node is.
  double at(double x, double y) const {
    for (int n = 0; n < mesh_.numNodes(); ++n)
      if (std::hypot(mesh_.coordinates[3 * n] - x, mesh_.coordinates[3 * n + 1] - y) < 1e-6)
        return uz_[static_cast<std::size_t>(n)];
    return std::nan("");
  }

 private:
  fem::Mesh mesh_;
  std::vector<double> uz_;
};

}  // namespace
}  // namespace atrapos::test
