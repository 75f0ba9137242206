#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/Term.hpp"
#include "atrapos/solid/PlaneBody.hpp"

namespace atrapos::physics {

/// Steady flow of an incompressible Newtonian fluid (docs/theory/flow.md): components of the velocity and the
/// pressure are scalar fields.
struct Flow {
  std::vector<std::string> velocity;  ///< x, y and in space z
  std::string pressure;
  double viscosity = 0;  ///< dynamic, pressure times time, > 0
  double density = 0;    ///< mass per volume, >= 0
};

/// Taylor-Hood: velocities at all nodes of cells of degree 2 (solid::hasPressures), pressures at their
/// corners. `plane`: of plane cells, strain (a flow that does not depend on z) or axisymmetric without swirl.
/// Throws std::invalid_argument for other cells or numbers of components, std::runtime_error as the points
/// do.
std::unique_ptr<fem::Term> flowTerm(const fem::Mesh& mesh, const fem::Block& block, const Flow& flow,
                                    const std::optional<solid::PlaneSection>& plane);

}  // namespace atrapos::physics
