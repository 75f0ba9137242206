#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "MetalPath.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/Loads.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/fem/StructuredPlane.hpp"
#include "atrapos/solid/PlaneBody.hpp"
#include "atrapos/solid/VonMises.hpp"
#include "support/Meshes.hpp"

namespace atrapos::solid::test {

/// A quarter of a sphere's section, inner radius 1, outer 2, QUAD8 cells, under an internal pressure of one
/// yield stress times the load factor; elastic-perfectly plastic, with a yield surface of this width.
struct Sphere {
  static constexpr double a = 1, b = 2;
  fem::Mesh mesh;
  std::unique_ptr<fem::FeProblem> problem;
  int outside = 0;  ///< a node on the outer surface and the plane of symmetry

  static constexpr double s = 1e-4 * E;  ///< the yield stress

  explicit Sphere(int radial, double width = 0) {
    fem::RectangleOptions options;
    options.topology = fem::Topology::Quad8;
    options.divisions = {radial, 3};
    options.lengths = {b - a, std::acos(0.0)};
    options.origin = {a, 0};
    mesh = fem::rectangleMesh(options);
    for (int n = 0; n < mesh.numNodes(); ++n) {
      double* x = &mesh.coordinates[3 * n];
      const double r = x[0], angle = x[1];
      x[0] = std::abs(r * std::cos(angle)) < 1e-14 ? 0 : r * std::cos(angle);
      x[1] = r * std::sin(angle);
      if (r == b && angle == 0) outside = n;
    }
    const PlaneSection section{PlaneSection::Kind::axisymmetric, 1};
    fem::FeModel model;
    model.dofs = fem::DofMap::displacements(mesh.numNodes(), 2);
    const auto points = planePoints(mesh, mesh.blocks[0], fem::tabulate(fem::Topology::Quad8), section);
    Metal m;
    m.yieldStress = s;
    m.width = width;
    auto law = planeLaw(fem::pointLaw(VonMises<false>{metalFromYoung(E, nu, m)}), section.kind);
    const auto data = virgin(points, *law);
    model.terms.push_back(fem::lawTerm(std::move(law), points, data));
    for (const int n : fem::test::nodesOfSet(mesh, "y_min")) model.prescribe(n, 1, 0, 0);
    for (const int n : fem::test::nodesOfSet(mesh, "y_max")) model.prescribe(n, 0, 0, 0);
    model.load.assign(model.dofs.numDofs(), 0.0);
    std::vector<double> inSpace(3 * static_cast<std::size_t>(mesh.numNodes()), 0.0);
    fem::addPressure(planeEdgePoints(mesh, fem::test::sideSet(mesh, "x_min"), section, 5), s, inSpace);
    for (int n = 0; n < mesh.numNodes(); ++n)
      for (int i = 0; i < 2; ++i) model.load[2 * n + i] = inSpace[3 * n + i];
    problem = std::make_unique<fem::FeProblem>(std::move(model));
  }

  /// Hill: pressure over yield stress with the plastic zone to c, and the displacement outside.
  static double pressure(double c) { return 2 * std::log(c / a) + 2.0 / 3 * (1 - c * c * c / (b * b * b)); }
  /// The largest relative error of the pressure at a displacement outside, up to this radius of the zone.
  double largestError(double upTo) const {
    Followed f(*problem, {problem->initialState(0), 0.0}, pressure(upTo));
    EXPECT_EQ(f.outcome.reason, path::EndReason::stopReached) << f.outcome.text;
    double worst = 0;
    for (std::size_t step = 0; step < f.steps.reports.size(); ++step) {
      const path::State state = f.steps.series[step].state(f.steps.reports[step].length);
      const double u = fem::FeProblem::values(*state.u)[2 * outside];
      const double c = std::cbrt(u * E * b * b / ((1 - nu) * s));
      if (c > a) worst = std::max(worst, std::abs(state.lambda - pressure(c)) / pressure(c));
    }
    steps = f.outcome.steps;
    return worst;
  }
  mutable int steps = 0;
};

}  // namespace atrapos::solid::test
