#pragma once

#include <memory>
#include <vector>

#include "atrapos/fem/DofMap.hpp"
#include "atrapos/fem/Support.hpp"
#include "atrapos/fem/Term.hpp"
#include "atrapos/solid/EdgePressureLaws.hpp"
#include "atrapos/solid/PlaneBody.hpp"

namespace atrapos::solid {

/// Whether a pressure that follows the edges of a set has a potential, pressure times int (x - c) dy, of
/// rings int (x^2 - c^2)/2 dy: each of their ends has y held, or x held at the same place c whatever the load
/// factor. Closed lines have no ends. False: the pressure works at an end that is free.
bool hasPotential(const fem::Mesh& mesh, const fem::SideSet& set, const fem::DofMap& dofs,
                  const fem::Supports& supports);

/// A pressure on the deformed edges of a plane body, -amount times the outward normal: a term for each shape
/// of edge, integrated exactly. The tangent counts as symmetric where the pressure has a potential. Throws
/// std::invalid_argument in plane stress, where the thickness of a deformed edge is not known, and for sides
/// of other cells.
std::vector<std::unique_ptr<fem::Term>> followerPressure(const fem::Mesh& mesh, const fem::SideSet& set,
                                                         const PlaneSection& section, LoadAmount pressure,
                                                         bool hasPotential);

}  // namespace atrapos::solid
