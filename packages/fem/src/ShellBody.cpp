#include "atrapos/fem/ShellBody.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "atrapos/fem/PointSet.hpp"

namespace atrapos::fem {
namespace {

/// Node of a solid: level (bottom, middle, top) and node of the shell cell.
struct Place {
  int level, node;
};
enum { bottom, middle, top };

/// Nodes of HEX27 in Exodus' order; HEX8 and HEX20 have the first of them.
constexpr std::array<Place, 27> kPlaces{
    {{bottom, 0}, {bottom, 1}, {bottom, 2}, {bottom, 3}, {top, 0},    {top, 1},    {top, 2},
     {top, 3},    {bottom, 4}, {bottom, 5}, {bottom, 6}, {bottom, 7}, {middle, 0}, {middle, 1},
     {middle, 2}, {middle, 3}, {top, 4},    {top, 5},    {top, 6},    {top, 7},    {middle, 8},
     {bottom, 8}, {top, 8},    {middle, 7}, {middle, 5}, {middle, 4}, {middle, 6}}};

/// Nodes of WEDGE15; WEDGE6 has the first of them.
constexpr std::array<Place, 15> kWedge{{{bottom, 0},
                                        {bottom, 1},
                                        {bottom, 2},
                                        {top, 0},
                                        {top, 1},
                                        {top, 2},
                                        {bottom, 3},
                                        {bottom, 4},
                                        {bottom, 5},
                                        {middle, 0},
                                        {middle, 1},
                                        {middle, 2},
                                        {top, 3},
                                        {top, 4},
                                        {top, 5}}};

/// Sides of a shell (top, bottom, edges) as sides of the solid, 0-based.
constexpr std::array<int, 6> kSides{5, 4, 0, 1, 2, 3};
constexpr std::array<int, 5> kSidesOfWedge{4, 3, 0, 1, 2};

int sideOf(Topology shell, int side) { return shellCorners(shell) == 3 ? kSidesOfWedge[side] : kSides[side]; }

Topology solidOf(Topology shell) {
  return shell == Topology::Shell3   ? Topology::Wedge6
         : shell == Topology::Shell4 ? Topology::Hex8
         : shell == Topology::Shell6 ? Topology::Wedge15
         : shell == Topology::Shell8 ? Topology::Hex20
                                     : Topology::Hex27;
}

}  // namespace

ShellBody shellBody(const Mesh& mesh, const ShellGeometry& shells) {
  if (shells.numMeshNodes != mesh.numNodes())
    throw std::invalid_argument("shell body: the shell geometry belongs to another mesh");
  ShellBody body;
  body.mesh = mesh;
  body.numMeshNodes = mesh.numNodes();
  for (int d = 0; d < shells.numDirectors(); ++d)
    for (double zeta : {-1.0, 1.0})
      for (int i = 0; i < 3; ++i)
        body.mesh.coordinates.push_back(
            mesh.coordinates[3 * static_cast<std::size_t>(shells.meshNode[d]) + i] +
            zeta * shells.directors[3 * static_cast<std::size_t>(d) + i]);
  if (!mesh.nodeIds.empty()) {
    long long largest = 0;
    for (long long id : mesh.nodeIds) largest = std::max(largest, id);
    while (body.mesh.nodeIds.size() < body.mesh.coordinates.size() / 3)
      body.mesh.nodeIds.push_back(++largest);
  }
  for (const ShellBlock& s : shells.blocks) {
    Block& block = body.mesh.blocks[s.block];
    block.topology = solidOf(block.topology);
    block.nodes.clear();
    const int N = s.nodesPerElement;
    const bool wedge = block.topology == Topology::Wedge6 || block.topology == Topology::Wedge15;
    for (int e = 0; e < s.numElements(); ++e) {
      const int* v = &s.nodes[2 * static_cast<std::size_t>(N) * e];
      for (int n = 0; n < nodesPerElement(block.topology); ++n) {
        const auto [level, local] = wedge ? kWedge[n] : kPlaces[n];
        const int director = v[N + local] - shells.numMeshNodes;
        block.nodes.push_back(level == middle ? v[local] : body.numMeshNodes + 2 * director + (level == top));
      }
    }
  }
  for (SideSet& set : body.mesh.sideSets)
    for (Side& side : set.sides)
      if (const Block& block = mesh.blocks[addressOf(mesh, side.element).block]; isShell(block))
        side.side = sideOf(block.topology, side.side);
  return body;
}

std::vector<double> ShellBody::displacements(const ShellGeometry& shells,
                                             const std::vector<double>& u) const {
  const std::size_t meshDofs = 3 * static_cast<std::size_t>(numMeshNodes);
  std::vector<double> result(u.begin(), u.begin() + static_cast<long>(meshDofs));
  for (int d = 0; d < shells.numDirectors(); ++d)
    for (double zeta : {-1.0, 1.0})
      for (int i = 0; i < 3; ++i)
        result.push_back(u[3 * static_cast<std::size_t>(shells.meshNode[d]) + i] +
                         zeta * u[meshDofs + 3 * static_cast<std::size_t>(d) + i]);
  return result;
}

std::vector<double> ShellBody::forces(const ShellGeometry& shells, const std::vector<double>& f) const {
  const std::size_t meshDofs = 3 * static_cast<std::size_t>(numMeshNodes);
  std::vector<double> result(f.begin(), f.begin() + static_cast<long>(meshDofs));
  for (int d = 0; d < shells.numDirectors(); ++d)
    for (double zeta : {-1.0, 1.0})
      for (int i = 0; i < 3; ++i)
        result.push_back(0.5 * zeta * f[meshDofs + 3 * static_cast<std::size_t>(d) + i]);
  return result;
}

}  // namespace atrapos::fem
