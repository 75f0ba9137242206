#include "scene/Sets.hpp"

#include "atrapos/fem/PointSet.hpp"

namespace atrapos {

std::vector<int> nodesOf(const fem::Mesh& mesh, const std::string& set) {
  const int n = fem::findNodeSet(mesh, set);
  if (n >= 0) return mesh.nodeSets[n].nodes;
  return fem::nodesOf(mesh, sidesOf(mesh, set));
}

const fem::SideSet& sidesOf(const fem::Mesh& mesh, const std::string& set) {
  return mesh.sideSets.at(fem::findSideSet(mesh, set));
}

}  // namespace atrapos
