#pragma once

#include <vector>

#include "MetalPath.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "support/Meshes.hpp"

namespace atrapos::solid::test {

/// A unit cube of two HEX8 that is pulled along x by the load factor, free across.
template <class Law>
fem::FeProblem bar(const Law& material) {
  const fem::Mesh mesh = fem::test::box(fem::Topology::Hex8, {2, 1, 1});
  const fem::PointSet points = fem::volumePoints(mesh, mesh.blocks[0], fem::tabulate(fem::Topology::Hex8));
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(mesh.numNodes());
  auto law = fem::pointLaw(material);
  const auto data = virgin(points, *law);
  model.terms.push_back(fem::lawTerm(std::move(law), points, data));
  for (const int n : fem::test::nodesOfSet(mesh, "x_min")) model.prescribe(n, 0, 0, 0);
  for (const int n : fem::test::nodesOfSet(mesh, "y_min")) model.prescribe(n, 1, 0, 0);
  for (const int n : fem::test::nodesOfSet(mesh, "z_min")) model.prescribe(n, 2, 0, 0);
  for (const int n : fem::test::nodesOfSet(mesh, "x_max")) model.prescribe(n, 0, 0, 1);
  return fem::FeProblem(std::move(model));
}

/// S_xx of such a bar at a state.
inline double secondPiolaOfBar(const fem::FeProblem& problem, const path::State& state) {
  const auto u = fem::FeProblem::values(*state.u);
  const double along = 1 + state.lambda, across = 1 + u.at(3 * (problem.model().dofs.numNodes() - 1) + 1);
  // F S F^T / J along x: what is wide across is not asked for.
  return problem.observe(0, state).values.at(0) * across * across / along;
}

}  // namespace atrapos::solid::test
