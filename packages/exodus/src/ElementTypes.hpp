#pragma once

#include <optional>
#include <string>

#include "atrapos/fem/Mesh.hpp"

namespace atrapos::exodus {

/// The topology that an Exodus element type means, judged by the beginning of its name and its node count;
/// nothing where it is not supported.
std::optional<fem::Topology> topologyOf(const std::string& elementType, int nodesPerElement);

/// The element types that topologyOf knows, for messages.
const char* acceptedElementTypes();

/// Number of sides of an element.
int numSides(fem::Topology topology);

}  // namespace atrapos::exodus
