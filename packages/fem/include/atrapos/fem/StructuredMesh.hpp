#pragma once

#include <array>
#include <string>

#include "atrapos/fem/FineEnd.hpp"
#include "atrapos/fem/Mesh.hpp"

namespace atrapos::fem {

// Structured meshes of simple bodies. Every body is the image of a lattice of cells with three
// directions a, b, c, where c is the thickness; (a, b, c) is right-handed. Hexes fill the cells;
// wedges split each cell in two (triangles seen along c), tets in six, conforming across cells.
// Nodes between corners lie on the true geometry, not on chords.
//
// Each mesh has one block (id 1) and sets named after the six faces, three names per direction:
//
//   body            a: min, max                       b: min, max                     c: min, max
//   box             x_min x_max                       y_min y_max                     z_min z_max
//   strip           x_min x_max                       y_min y_max                     bottom top
//   cylinder panel  theta_min theta_max               y_min y_max                     inner outer
//   sphere panel    longitude_min longitude_max       latitude_min latitude_max       inner outer
//
// Side sets: the six faces (ids 1..6 in this order). Node sets: the faces, the twelve edges and the eight
// corners, named by joining face names in the order a, b, c with `_` (x_max_z_min, x_min_y_max_top), and,
// where there are nodes halfway through the thickness, these with `mid` in place of c's name:
// mid (the mid-surface), x_max_mid (the mid-thickness line of an end), x_max_y_min_mid (one node).
//
// Nodes and cells are numbered with the most divided direction outermost, which keeps the bandwidth
// of the tangent near the number of nodes of the smallest cross-section.
//
// Errors: std::invalid_argument, one line, for divisions below 1, lengths not above 0, and the like.

/// A box along the axes.
struct BoxOptions {
  std::array<double, 3> lengths{1.0, 1.0, 1.0};
  std::array<double, 3> origin{0.0, 0.0, 0.0};  ///< corner with the least x, y and z
  std::array<int, 3> divisions{1, 1, 1};        ///< along x, y, z
  Topology topology = Topology::Hex8;
  std::string blockName = "body";
  std::array<FineEnd, 3> fine{};  ///< along x, y, z
};
Mesh boxMesh(const BoxOptions& options);

/// A thin box: length along x, width along y, thickness along z from `bottom` to `top`.
struct StripOptions {
  double length = 1.0;
  double width = 1.0;
  double thickness = 1.0;
  std::array<double, 3> origin{0.0, 0.0, 0.0};  ///< corner with the least x, y and z
  std::array<int, 3> divisions{1, 1, 1};        ///< along length, width, thickness
  Topology topology = Topology::Hex20;
  std::string blockName = "strip";
};
Mesh stripMesh(const StripOptions& options);

/// A panel of a circular cylinder about the y axis: (x, z) = r (sin theta, cos theta), so that theta = 0
/// is the crown of a roof with z upwards. At most 90 degrees per cell, less than 360 in all.
struct CylinderPanelOptions {
  double midRadius = 1.0;
  double thickness = 0.1;
  double thetaMin = 0.0;   ///< degrees
  double thetaMax = 90.0;  ///< degrees
  double length = 1.0;     ///< along y, from yMin
  double yMin = 0.0;
  std::array<int, 3> divisions{1, 1, 1};  ///< along theta, y, thickness
  Topology topology = Topology::Hex20;
  std::string blockName = "shell";
};
Mesh cylinderPanelMesh(const CylinderPanelOptions& options);

/// A panel of a sphere about the origin: (x, y, z) = r (cos lat cos lon, cos lat sin lon, sin lat). The
/// latitudes stay strictly between -90 and 90 degrees, where cells would collapse; at most 90 degrees per
/// cell, less than 360 in all.
struct SpherePanelOptions {
  double midRadius = 1.0;
  double thickness = 0.1;
  double longitudeMin = 0.0;              ///< degrees, from x towards y
  double longitudeMax = 90.0;             ///< degrees
  double latitudeMin = 0.0;               ///< degrees, from the x-y plane towards z
  double latitudeMax = 72.0;              ///< degrees
  std::array<int, 3> divisions{1, 1, 1};  ///< along longitude, latitude, thickness
  Topology topology = Topology::Hex20;
  std::string blockName = "shell";
};
Mesh spherePanelMesh(const SpherePanelOptions& options);

}  // namespace atrapos::fem
