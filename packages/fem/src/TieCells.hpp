#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "TieFaces.hpp"

namespace atrapos::fem::detail {

/// A place in a cell, or near it.
struct InCell {
  std::vector<double> values;  ///< of the cell's shape functions
  std::vector<double> xi;      ///< reference coordinates; the first is NaN where there are none
};

/// The cells that faces are sides of.
class CellsBehind {
 public:
  CellsBehind(const Mesh& mesh, const std::vector<TieFace>& faces) : mesh_(mesh), faces_(faces) {}

  /// Places in or near the cells behind these faces.
  std::vector<InCell> find(const std::vector<std::pair<int, Vec3>>& places) const;

  /// How far a place is from a face, by its reference coordinates in the cell behind it; nothing where it is
  /// beside the face.
  std::optional<double> gapTo(const TieFace& face, const Vec3& place, const std::vector<double>& xi) const;

 private:
  const Mesh& mesh_;
  const std::vector<TieFace>& faces_;
};

}  // namespace atrapos::fem::detail
