#pragma once

#include <array>
#include <string>

#include "atrapos/fem/FineEnd.hpp"
#include "atrapos/fem/Mesh.hpp"

namespace atrapos::fem {

// Structured meshes of shells: middle surfaces with two directions a, b; the normal of the node order, to the
// top face, is that of a cross b. All nodes lie on the true surface, not on chords.
//
// Each mesh has one block (id 1) and sets named after the edges and faces:
//
//   surface   a: min, max, mid                  b: min, max, mid               faces
//   plate     x_min x_max x_mid                 y_min y_max y_mid              top bottom
//   cylinder  theta_min theta_max theta_mid     y_min y_max y_mid              outer inner
//   annulus   inner outer radius_mid            angle_min angle_max angle_mid  top bottom
//   sphere    longitude_min _max _mid           latitude_min _max _mid         outer inner
//
// Side sets: the edges (ids 1..4 in this order; shell sides 3 to 6), then the faces (ids 5, 6; sides 1 and
// 2). A direction that closes on itself has no edges. Node sets: the edges, the corners, named by joining a's
// and b's name with `_` (x_max_y_min), and, where nodes are there, the lines halfway, named mid,
// and their points (x_mid, x_max_y_mid; x_mid_y_mid is the centre). Of a closed direction the min
// line, where the angle begins, is a node set too.
//
// Each has a thickness: above 0 it becomes the block's attribute `thickness`; 0 leaves that to the deck.
//
// Nodes and cells are numbered with the more divided direction outermost.
//
// Errors: std::invalid_argument, one line, for divisions below 1, lengths not above 0, and the like.

/// A plane parallelogram in z = origin z: the first edge along x, the second at `angle` to it.
struct ShellPlateOptions {
  double length = 1.0;  ///< of the edges along x
  double width = 1.0;   ///< of the other two
  double angle = 90.0;  ///< degrees, in (0, 180): 90 a strip or plate, 30 Morley's skew plate
  std::array<double, 3> origin{0.0, 0.0, 0.0};  ///< corner where x_min and y_min meet
  /// p >= 1: distances from the nearer edge grow like the power p of the number of elements; 1: equal
  /// elements.
  double grading = 1.0;
  double thickness = 0.0;
  std::array<int, 2> divisions{1, 1};  ///< along length, width
  Topology topology = Topology::Shell8;
  std::string blockName = "shell";
  std::array<FineEnd, 2> fine{};  ///< along length, width; not with grading
};
Mesh shellPlateMesh(const ShellPlateOptions& options);

/// A circular cylinder about the y axis, (x, z) = r (sin theta, cos theta): theta = 0 is the crown of a roof
/// with z upwards. The normal points outwards. At most 90 degrees a cell; 360 degrees close the cylinder.
/// With a `tangent` it goes on at thetaMax as a plane, tangent to it, up to theta_max: a strip that leaves a
/// roll.
struct ShellCylinderOptions {
  double radius = 1.0;
  double thetaMin = 0.0;   ///< degrees
  double thetaMax = 90.0;  ///< degrees
  double length = 1.0;     ///< along y, from yMin
  double yMin = 0.0;
  bool slit = false;         ///< 360 degrees stay open: two edges at the same place
  double tangent = 0.0;      ///< length of the plane, at least 0
  int tangentDivisions = 0;  ///< along it, besides those along theta
  double thickness = 0.0;
  std::array<int, 2> divisions{1, 1};  ///< along theta, y
  Topology topology = Topology::Shell8;
  std::string blockName = "shell";
};
Mesh shellCylinderMesh(const ShellCylinderOptions& options);

/// A plane annulus about the z axis in z = 0, angles from x to y, the normal along z.
struct ShellAnnulusOptions {
  double innerRadius = 1.0;
  double outerRadius = 2.0;
  double angleMin = 0.0;    ///< degrees
  double angleMax = 360.0;  ///< degrees
  bool slit = true;         ///< 360 degrees stay open: two edges at the same place
  double thickness = 0.0;
  std::array<int, 2> divisions{1, 4};  ///< along radius, angle
  Topology topology = Topology::Shell8;
  std::string blockName = "shell";
};
Mesh shellAnnulusMesh(const ShellAnnulusOptions& options);

/// A part of a sphere about the origin, (x, y, z) = r (cos lat cos lon, cos lat sin lon, sin lat), the normal
/// outwards. The latitudes stay strictly between -90 and 90 degrees. The default is a quarter of the
/// hemisphere with an 18 degree hole.
struct ShellSphereOptions {
  double radius = 1.0;
  double longitudeMin = 0.0;   ///< degrees, from x towards y
  double longitudeMax = 90.0;  ///< degrees
  double latitudeMin = 0.0;    ///< degrees, from the x-y plane towards z
  double latitudeMax = 72.0;   ///< degrees
  bool slit = false;           ///< 360 degrees stay open: two edges at the same place
  double thickness = 0.0;
  std::array<int, 2> divisions{1, 1};  ///< along longitude, latitude
  Topology topology = Topology::Shell8;
  std::string blockName = "shell";
};
Mesh shellSphereMesh(const ShellSphereOptions& options);

}  // namespace atrapos::fem
