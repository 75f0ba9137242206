#pragma once

#include <array>
#include <vector>

#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/PointSet.hpp"

namespace atrapos::fem {

/// Dead loads as nodal forces, [3 node + component]; each function adds to `force`. Forces are per reference
/// area or volume and keep their direction.

/// The same force at every node of a list.
void addNodalLoad(const std::vector<int>& nodes, const std::array<double, 3>& perNode,
                  std::vector<double>& force);

/// A traction per reference area over a side set.
void addTraction(const Mesh& mesh, const SideSet& set, const std::array<double, 3>& traction,
                 std::vector<double>& force);

/// Cubature degree of the loads on faces: exact for quadratic shape functions on plane faces with straight
/// edges.
constexpr int loadDegree = 4;

/// The same over faces given by their points (facePoints, shellFacePoints), and a pressure against their
/// normals.
void addTraction(const std::vector<PointSet>& faces, const std::array<double, 3>& traction,
                 std::vector<double>& force);
void addPressure(const std::vector<PointSet>& faces, double pressure, std::vector<double>& force);

/// Area of faces.
double areaOf(const std::vector<PointSet>& faces);

/// A total force spread evenly over the reference area of a side set.
void addSurfaceForce(const Mesh& mesh, const SideSet& set, const std::array<double, 3>& total,
                     std::vector<double>& force);

/// A pressure along the inward reference normal of a side set.
void addPressure(const Mesh& mesh, const SideSet& set, double pressure, std::vector<double>& force);

/// A force per reference volume over a block.
void addBodyForce(const Mesh& mesh, const Block& block, const std::array<double, 3>& perVolume,
                  std::vector<double>& force);

/// Reference area of a side set.
double areaOf(const Mesh& mesh, const SideSet& set);

}  // namespace atrapos::fem
