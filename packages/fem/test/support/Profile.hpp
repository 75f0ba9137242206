#pragma once

#include <array>
#include <vector>

#include "atrapos/fem/Mesh.hpp"

namespace atrapos::fem::test {

/// A wall of a thin-walled section in the x-y plane, from one point to another; the normal of its shells is
/// on the right of its direction.
struct Wall {
  std::array<double, 2> from, to;
  int divisions = 1;
};

/// A block of shells for every wall, along z from 0 to `length`; nodes at the same place are one, where walls
/// meet at their ends. Node sets: foot (z = 0), head (z = length).
Mesh profileMesh(const std::vector<Wall>& walls, double length, int divisionsAlong,
                 Topology cell = Topology::Shell8);

/// The nodes above a point of the section, ascending in z.
std::vector<int> nodesAbove(const Mesh& mesh, const std::array<double, 2>& point);

}  // namespace atrapos::fem::test
