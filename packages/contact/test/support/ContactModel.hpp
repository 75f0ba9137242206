#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "RigidContact.hpp"
#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/PathFollower.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"
#include "support/Meshes.hpp"
#include "support/Vectors.hpp"

namespace atrapos::contact::test {

using fem::test::Numbers;

enum class Where { Nodes, Quadrature };

/// Saint Venant-Kirchhoff everywhere; no supports, loads or contact yet.
inline fem::FeModel solidModel(const fem::Mesh& mesh, double E, double nu,
                               const fem::Tabulation* cell = nullptr) {
  const auto law = solid::SaintVenantKirchhoff::fromYoung(E, nu);
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(mesh.numNodes());
  for (const fem::Block& block : mesh.blocks)
    model.terms.push_back(fem::lawTerm(
        fem::pointLaw(law), fem::volumePoints(mesh, block, cell ? *cell : fem::tabulate(block.topology))));
  model.constantLoad.assign(3 * mesh.numNodes(), 0.0);
  model.load.assign(3 * mesh.numNodes(), 0.0);
  return model;
}

/// The points of a side set, its nodes or its cubature points.
inline fem::PointSet contactPoints(const fem::Mesh& mesh, const std::string& set, Where where,
                                   int degree = 4) {
  const auto& sides = fem::test::sideSet(mesh, set);
  if (where == Where::Nodes) return fem::nodePoints(mesh, fem::nodesOf(mesh, sides));
  auto points = fem::facePoints(mesh, sides, degree);
  if (points.size() != 1) throw std::logic_error("contactPoints: faces of more than one shape");
  return points[0];
}

/// Adds contact of these points; the reference gap is each point's own, but at least `least`.
template <class Tool, class Pressure = RegularisedPressure>
void addContact(fem::FeModel& model, const fem::PointSet& points, const Tool& tool, const Pressure& pressure,
                double least) {
  std::vector<double> gaps;
  for (int p = 0; p < points.numPoints(); ++p) {
    double y[Tool::numUnknowns];
    if (!taylor::solveImplicit<3, Tool::numUnknowns>(tool, &points.positions[3 * p], y))
      throw std::logic_error("addContact: no projection");
    gaps.push_back(std::max(y[0], least));
  }
  model.terms.push_back(rigid(tool)->term(AnyPressure(pressure), points, gaps));
}

/// Bounds so tight that the equilibrium errors of tests stay near rounding.
inline path::Options tightOptions(double bound = 1e-10) {
  path::Options options;
  options.delta = options.residualBound = bound;
  return options;
}

/// Looks at no step.
struct NoObserver final : path::Observer {
  bool onStep(const path::StepReport&, const path::Series&) override { return true; }
};

/// Follows from a state to a load factor; throws where it is not reached.
inline path::Outcome follow(path::Problem& problem, const path::State& start, double loadFactor,
                            path::Observer& observer, path::Options options = tightOptions()) {
  const auto solver = linear::makeTangentSolver();
  path::Stops stops;
  stops.loadFactors = {loadFactor};
  options.direction = loadFactor > start.lambda ? 1 : -1;
  path::PathFollower follower(problem, *solver, options, stops);
  const auto outcome = follower.run(start, observer);
  if (outcome.reason != path::EndReason::stopReached) throw std::runtime_error(outcome.text);
  return outcome;
}
inline path::Outcome follow(path::Problem& problem, const path::State& start, double loadFactor,
                            path::Options options = tightOptions()) {
  NoObserver observer;
  return follow(problem, start, loadFactor, observer, options);
}

/// Sum of nodal forces [3 node + component].
inline std::array<double, 3> resultant(const Numbers& forces) {
  std::array<double, 3> sum{};
  for (std::size_t d = 0; d < forces.size(); ++d) sum[d % 3] += forces[d];
  return sum;
}

/// Their moment about the origin in the displaced configuration.
inline std::array<double, 3> moment(const fem::Mesh& mesh, const Numbers& u, const Numbers& forces) {
  std::array<double, 3> sum{};
  for (std::size_t n = 0; n < forces.size() / 3; ++n)
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      sum[i] += (mesh.coordinates[3 * n + j] + u[3 * n + j]) * forces[3 * n + k] -
                (mesh.coordinates[3 * n + k] + u[3 * n + k]) * forces[3 * n + j];
    }
  return sum;
}

/// Column `name` of a term's point values, in the order of the points.
inline Numbers observed(const fem::FeProblem& problem, int term, const path::State& state,
                        const std::string& name) {
  const fem::PointValues values = problem.observe(term, state);
  const auto at = std::find(values.names.begin(), values.names.end(), name);
  if (at == values.names.end()) throw std::logic_error("observed: no " + name);
  Numbers column;
  for (std::size_t i = at - values.names.begin(); i < values.values.size(); i += values.names.size())
    column.push_back(values.values[i]);
  return column;
}

}  // namespace atrapos::contact::test
