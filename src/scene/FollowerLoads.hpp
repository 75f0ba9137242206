#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "atrapos/fem/FeModel.hpp"
#include "atrapos/solid/PlaneBody.hpp"
#include "scene/Shells.hpp"

/// Loads of the deck whose nodal forces depend on the displacements: terms of the problem. Those are
/// pressures that follow, forces that follow an edge, and moments on edges, also dead ones.
namespace atrapos::followers {

bool isFollower(const deck::Load& load);

/// What such a load acts on.
struct Body {
  const fem::Mesh& mesh;
  const SceneShells& shells;
  const std::optional<solid::PlaneSection>& plane;
  const fem::FeModel& model;  ///< with its supports
};

/// The terms of such a load, for each block of shells, and each shape of face of solids or of edge of plane
/// bodies, that it acts on. Throws std::invalid_argument, one line, for moments about the director, and for
/// pressures in plane stress.
std::vector<std::unique_ptr<fem::Term>> terms(const deck::Load& load, const Body& body);

}  // namespace atrapos::followers
