#pragma once

#include <array>
#include <memory>
#include <vector>

#include "atrapos/fem/Support.hpp"
#include "atrapos/solid/ShellLoadLaws.hpp"
#include "atrapos/solid/ShellPoints.hpp"

/// Loads of shells: dead ones as nodal forces, followers as terms (docs/theory/shell.md, "Loads").
namespace atrapos::solid {

/// Surfaces of a shell by their zeta.
constexpr double bottomSurface = -1, midSurface = 0, topSurface = 1;

/// Edge 0..3 (triangles: 0..2) of an element (counted from 0): between the corners edge and edge + 1.
struct ShellEdge {
  int element = 0, edge = 0;
};

// ---- dead: each function adds to `force`, [3 node + component], nodes as in ShellElements

/// A force per undeformed area of a surface, over all elements.
void addShellAreaForce(const ShellElements& elements, double zeta, const std::array<double, 3>& perArea,
                       std::vector<double>& force);

/// A force per undeformed volume, over all elements.
void addShellBodyForce(const ShellElements& elements, const std::array<double, 3>& perVolume,
                       std::vector<double>& force);

/// A pressure against the undeformed normal of a surface: -pressure n per undeformed area.
void addShellPressure(const ShellElements& elements, double zeta, double pressure,
                      std::vector<double>& force);

/// A force per undeformed length of edges of the mid-surface.
void addShellEdgeForce(const ShellElements& elements, const std::vector<ShellEdge>& edges,
                       const std::array<double, 3>& perLength, std::vector<double>& force);

/// Undeformed length of edges of the mid-surface.
double lengthOf(const ShellElements& elements, const std::vector<ShellEdge>& edges);

// ---- followers: terms that see the load factor

/// A pressure on the deformed surface of some elements.
std::unique_ptr<fem::Term> followerPressure(const ShellElements& elements, const std::vector<int>& loaded,
                                            double zeta, LoadAmount pressure);

/// Forces and a moment that turn with the edges.
std::unique_ptr<fem::Term> followerEdgeLoad(const ShellElements& elements,
                                            const std::vector<ShellEdge>& edges,
                                            const FollowerEdgeLoad& load);

/// A moment vector that keeps its direction. Throws std::invalid_argument naming the element where the
/// moment has a part about the undeformed director: shells take no drilling moments.
std::unique_ptr<fem::Term> deadEdgeMoment(const ShellElements& elements, const std::vector<ShellEdge>& edges,
                                          const DeadEdgeMoment& load);

}  // namespace atrapos::solid
