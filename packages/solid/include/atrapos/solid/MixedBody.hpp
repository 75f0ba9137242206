#pragma once

#include <functional>
#include <string>
#include <vector>

#include "atrapos/fem/DofMap.hpp"
#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/ReferenceCell.hpp"

/// Bodies with displacements and pressures (docs/theory/mixed.md): Taylor-Hood, displacements of degree 2 and
/// continuous pressures of degree 1 at the corners of cells. Pressures of a block are its own: across a
/// border of materials they jump.
namespace atrapos::solid {

/// Whether there are such spaces for a cell: not for those of degree 1, nor for shells.
bool hasPressures(fem::Topology cell);

/// The pressures of a block, with the role of multipliers: each owes the tangent a negative pivot.
fem::Field pressureField(const fem::Block& block);

/// The nodes that have them, ascending. This and withPressures throw std::invalid_argument where hasPressures
/// is false.
std::vector<int> pressureNodes(const fem::Block& block);

/// The cell with the cubature of mixed laws: full, also of Quad8 and Hex20.
fem::Tabulation mixedTabulation(fem::Topology cell);

/// The values of such a field at points of a block's cells.
fem::Interpolation pressureValues(const fem::Field& field, const fem::PointSet& points,
                                  const fem::Block& block, const fem::Tabulation& cell);

/// Those at all nodes of the cells, [cell][node], between the corners.
std::vector<double> pressuresAtNodes(const fem::Block& block, const std::function<double(int)>& atCorner);

/// Points of displacement gradients (volumePoints, planePoints) with the pressures at them as a further
/// field.
fem::PointSet withPressures(fem::PointSet points, const fem::Block& block, const fem::Tabulation& cell);

/// MixedLaw::scale of a block: its shear modulus by the mean length of its cells' first edges, with which
/// pressures are lengths and their rows forces, as those of displacements.
double pressureScale(const fem::Mesh& mesh, const fem::Block& block, double shearModulus);

}  // namespace atrapos::solid
