#pragma once

#include <array>
#include <string>

#include "atrapos/fem/FineEnd.hpp"
#include "atrapos/fem/Mesh.hpp"

namespace atrapos::fem {

/// A rectangle along the axes, the cross-section of a plane body. Sets are named as those of a shell plate
/// (StructuredShell.hpp): side sets and node sets x_min, x_max, y_min, y_max, node sets of corners
/// (x_max_y_min) and of the lines halfway (x_mid, y_mid). Triangles halve the quadrilaterals along the
/// diagonal from x_min_y_min.
struct RectangleOptions {
  std::array<double, 2> lengths{1.0, 1.0};
  std::array<double, 2> origin{0.0, 0.0};  ///< corner x_min_y_min
  /// p >= 1: distances from the nearer edge grow like the power p of the number of elements; 1: equal
  /// elements.
  double grading = 1.0;
  std::array<int, 2> divisions{1, 1};
  Topology topology = Topology::Quad8;
  std::string blockName = "body";
  std::array<FineEnd, 2> fine{};  ///< along x, y; not with grading
};

/// Throws std::invalid_argument, one line, for divisions below 1, lengths not above 0, fine ends that do not
/// fit, and cells that are no plane ones.
Mesh rectangleMesh(const RectangleOptions& options);

/// A quadrilateral with straight edges, mapped bilinearly. Sets are named as those of a rectangle: y_min is
/// the edge from the first corner to the second, x_max the next one.
struct QuadrilateralOptions {
  std::array<double, 8> corners{0, 0, 1, 0, 1, 1, 0, 1};  ///< x and y of four, counter-clockwise
  std::array<int, 2> divisions{1, 1};                     ///< along the first edge, along the second
  Topology topology = Topology::Quad8;
  std::string blockName = "body";
};

/// Throws std::invalid_argument, one line, for divisions below 1, corners of a quadrilateral that is not
/// convex or runs clockwise, and cells that are no plane ones.
Mesh quadrilateralMesh(const QuadrilateralOptions& options);

/// A part of an annulus about the origin, angles from x to y: the cross-section of a tube, and of a hollow
/// sphere where x is a radius. Sets are named as those of a shell annulus: side sets and node sets inner,
/// outer, angle_min, angle_max (360 degrees close it: then without the last two), node sets of corners and of
/// the lines halfway (radius_mid, angle_mid). Triangles as in a rectangle.
struct AnnulusOptions {
  double innerRadius = 1.0;
  double outerRadius = 2.0;
  double angleMin = 0.0;               ///< degrees
  double angleMax = 90.0;              ///< degrees
  std::array<int, 2> divisions{1, 4};  ///< along radius, angle
  Topology topology = Topology::Quad8;
  std::string blockName = "body";
};

/// Throws std::invalid_argument, one line, for divisions below 1, radii that do not ascend from above 0,
/// angles that do not ascend or span more than 360 degrees, and cells that are no plane ones.
Mesh annulusMesh(const AnnulusOptions& options);

}  // namespace atrapos::fem
