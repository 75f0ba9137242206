#pragma once

#include <optional>
#include <string>

#include "atrapos/fem/Mesh.hpp"

namespace atrapos::exodus {

/// The topology that an Exodus element type means, judged by the beginning of its name and its node count;
/// nothing where it is not supported. In three dimensions QUAD is a shell.
std::optional<fem::Topology> topologyOf(const std::string& elementType, int nodesPerElement, int dimensions);

/// What a file calls cells: as Topology's names, but for SHELL3 and SHELL6, which Exodus has as TRISHELL3 and
/// TRISHELL6.
const char* elementType(fem::Topology topology);

/// Whether an element type is one of lines or points: BAR, BEAM, TRUSS, EDGE, LINE, SPHERE, POINT, ...
bool isLower(const std::string& elementType);

/// Position of an element type's first side among those of its topology: 2 for QUAD in three dimensions,
/// whose sides are the four edges, where those of SHELL are two faces and four edges; 0 for all others.
int firstSide(const std::string& elementType, int dimensions);

/// The element types that topologyOf knows, for messages.
const char* acceptedElementTypes(int dimensions);

/// Number of sides of an element; of a shell two faces and its edges.
int numSides(fem::Topology topology);

}  // namespace atrapos::exodus
