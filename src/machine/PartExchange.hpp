#pragma once

#include <string>

#include "atrapos/exodus/MeshPart.hpp"

namespace atrapos {

/// A part of a mesh as bytes, for other ranks of the same run.
std::string packed(const exodus::MeshPart& part);

exodus::MeshPart unpacked(const std::string& bytes);

}  // namespace atrapos
