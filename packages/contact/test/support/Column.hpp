#pragma once

#include "ContactModel.hpp"
#include "atrapos/fem/Loads.hpp"

namespace atrapos::contact::test {

/// One HEX8 of unit cross-section and length `length`, held at its top between planes of symmetry, its lower
/// face above the plane z = 0: a bar and a contact law in one unknown, the displacement w of the lower face
/// against z.
///
///     EA s (s^2 - 1)/2 + R(gap - w) = load,   s = 1 + (w - drive)/length
///
/// `load` is a dead force on the lower face towards the plane, `drive` the top's displacement towards it;
/// each grows with the load factor. compliance and eta are those of the whole face; at nodes each has a
/// quarter.
struct Column {
  double length = 4, gap = 1, E = 4;  ///< stiffness E/length = 1
  RegularisedPressure pressure;
  double loadRate = 1, driveRate = 0;
  fem::Mesh mesh;
  std::unique_ptr<fem::FeProblem> problem;

  Column(const RegularisedPressure& law, Where where, double loadPerFactor = 1, double drivePerFactor = 0)
      : pressure(law), loadRate(loadPerFactor), driveRate(drivePerFactor) {
    mesh = fem::test::box(fem::Topology::Hex8, {1, 1, 1}, {1, 1, length}, {0, 0, gap});
    fem::FeModel model = solidModel(mesh, E, 0);
    for (int n : fem::test::nodesOfSet(mesh, "x_min")) model.prescribe(n, 0, 0, 0);
    for (int n : fem::test::nodesOfSet(mesh, "y_min")) model.prescribe(n, 1, 0, 0);
    for (int n : fem::test::nodesOfSet(mesh, "z_max")) model.prescribe(n, 2, 0, -driveRate);
    if (loadRate != 0)
      fem::addSurfaceForce(mesh, fem::test::sideSet(mesh, "z_min"), {0, 0, -loadRate}, model.load);
    RegularisedPressure atPoint = pressure;
    if (where == Where::Nodes) {
      atPoint.compliance *= 4;
      atPoint.eta /= 4;
    }
    addContact(model, contactPoints(mesh, "z_min", where), Plane{}, atPoint, 0);
    problem = std::make_unique<fem::FeProblem>(std::move(model));
  }

  path::State start() const { return {problem->initialState(0), 0.0}; }
  int foot() const { return fem::test::nodesOfSet(mesh, "z_min").at(0); }
  double w(const path::Vector& u) const { return -fem::FeProblem::values(u)[3 * foot() + 2]; }

  double barForce(double w, double lambda) const {
    const double s = 1 + (w - lambda * driveRate) / length;
    return E * s * (s * s - 1) / 2;
  }
  /// The law's quadratic formula.
  double contactForce(double h) const {
    const double c = pressure.compliance, load = pressure.eta * (gap - h),
                 root = std::sqrt(h * h + 4 * c * load);
    return h > 0 ? 2 * load / (h + root) : (root - h) / (2 * c);
  }
  /// What is left of the closed form at a displacement and load factor.
  double imbalance(double w, double lambda) const {
    return barForce(w, lambda) + contactForce(gap - w) - lambda * loadRate;
  }
  /// Force of the plane on the column, from the assembled contact term (whose forces are minus those on the
  /// body).
  double assembledForce(const path::State& state) const {
    return -resultant(problem->forces(problem->term(1), state))[2];
  }
};

}  // namespace atrapos::contact::test
