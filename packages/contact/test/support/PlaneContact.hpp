#pragma once

#include <cmath>
#include <string>

#include "atrapos/contact/RigidTool.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/fem/StructuredPlane.hpp"
#include "atrapos/solid/PlaneBody.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"
#include "support/Meshes.hpp"
#include "support/Vectors.hpp"

namespace atrapos::contact::test {

/// Cells of a plane body, all of them and in this order: elements with straight and with curved edges.
inline const std::vector<fem::Topology>& planeCells() {
  static const std::vector<fem::Topology> cells{fem::Topology::Quad4, fem::Topology::Quad8,
                                                fem::Topology::Quad9, fem::Topology::Tri3,
                                                fem::Topology::Tri6};
  return cells;
}

inline fem::Mesh planeMesh(fem::Topology cell, std::array<int, 2> divisions, std::array<double, 2> lengths,
                           std::array<double, 2> origin = {0, 0}) {
  fem::RectangleOptions options;
  options.topology = cell;
  options.divisions = divisions;
  options.lengths = lengths;
  options.origin = origin;
  return fem::rectangleMesh(options);
}

/// Saint Venant-Kirchhoff; no supports, loads or contact yet.
inline fem::FeModel planeModel(const fem::Mesh& mesh, const solid::PlaneSection& section, double E,
                               double nu) {
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(mesh.numNodes(), 2);
  const fem::Block& block = mesh.blocks[0];
  model.terms.push_back(fem::lawTerm(
      solid::planeLaw(fem::pointLaw(solid::SaintVenantKirchhoff::fromYoung(E, nu)), section.kind),
      solid::planePoints(mesh, block, fem::tabulate(block.topology), section)));
  model.load.assign(2 * mesh.numNodes(), 0.0);
  model.constantLoad.assign(2 * mesh.numNodes(), 0.0);
  return model;
}

/// Adds contact of the lower edges with a tool, integrated over zones.
inline fem::LineSet addZones(fem::FeModel& model, const fem::Mesh& mesh, const solid::PlaneSection& section,
                             const RigidTool& tool, const Overclosure& law,
                             const std::string& set = "y_min") {
  const auto lines = solid::planeEdgeLines(mesh, fem::test::sideSet(mesh, set), section, 4);
  model.terms.push_back(tool.zones(law, lines.at(0)));
  return lines.at(0);
}

}  // namespace atrapos::contact::test
