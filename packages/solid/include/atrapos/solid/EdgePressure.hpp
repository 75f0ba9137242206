#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "atrapos/fem/DofMap.hpp"
#include "atrapos/fem/Support.hpp"
#include "atrapos/fem/Term.hpp"
#include "atrapos/solid/EdgePressureLaws.hpp"
#include "atrapos/solid/PlaneBody.hpp"

namespace atrapos::solid {

/// The c with which pressure times int (x - c) dy, of rings int (x^2 - c^2)/2 dy, is a potential of a
/// pressure that follows the edges of a set: each of their ends has y held, or x held at the same place c
/// whatever the load factor. Closed lines have no ends. None: the pressure works at an end that is free.
std::optional<double> potentialOrigin(const fem::Mesh& mesh, const fem::SideSet& set, const fem::DofMap& dofs,
                                      const fem::Supports& supports);

/// A pressure on the deformed edges of a plane body, -amount times the outward normal: a term for each shape
/// of edge, integrated exactly. Symmetric with the c of its potential, otherwise not. Throws
/// std::invalid_argument in plane stress, where the thickness of a deformed edge is not known, and for sides
/// of other cells.
std::vector<std::unique_ptr<fem::Term>> followerPressure(const fem::Mesh& mesh, const fem::SideSet& set,
                                                         const PlaneSection& section, LoadAmount pressure,
                                                         std::optional<double> potentialOrigin);

}  // namespace atrapos::solid
