#pragma once

#include <string>
#include <vector>

#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/StructuredMesh.hpp"

namespace atrapos::fem::test {

const std::vector<Topology>& allCells();
bool isQuadratic(Topology topology);

/// A box of this cell type; 3 x 3 x 2 divisions give numbers of elements that are no multiple of the lanes.
Mesh box(Topology topology, std::array<int, 3> divisions = {3, 3, 2},
         std::array<double, 3> lengths = {1, 1, 1}, std::array<double, 3> origin = {0, 0, 0});

/// Every node moved by up to `amount` in each direction, the same at every run.
Mesh distorted(Mesh mesh, double amount, unsigned seed = 1);

/// All blocks in one mesh, nodes at the same place made one. The sets are those of the first mesh.
Mesh glued(const std::vector<Mesh>& meshes);

/// All seven cells in one distorted mesh of three bodies and two pairs glued at a face, with two loose nodes.
Mesh mixedMesh();

/// Numbers in [-amplitude, amplitude], the same at every run.
std::vector<double> randomNumbers(std::size_t count, double amplitude, unsigned seed);

std::vector<int> nodesOfSet(const Mesh& mesh, const std::string& name);
const SideSet& sideSet(const Mesh& mesh, const std::string& name);

}  // namespace atrapos::fem::test
