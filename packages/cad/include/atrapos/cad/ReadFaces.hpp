#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "atrapos/contact/BezierPatch.hpp"

namespace atrapos::cad {

/// A file that cannot be used; one line, the file first.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One face of a STEP or IGES file as a B-spline surface; S_1 x S_2 points out of the body.
struct Face {
  int number = 0;    ///< from 1, in the order of the file
  std::string kind;  ///< what the file has: plane, cylinder, cone, sphere, torus, spline, swept, revolved,
                     ///< offset, other
  /// Its edges leave the rectangle of parameters, which `surface` covers whole.
  bool trimmed = false;
  std::array<std::array<double, 3>, 2> box{};  ///< lowest and highest coordinates of the control points
  contact::NurbsSurface surface;
};

/// The faces of a STEP (.step, .stp) or IGES (.iges, .igs) file by OpenCASCADE, which turns what is no spline
/// into one: exactly (conics become rational splines) but for offset surfaces (1e-7 of the file's length
/// unit, mm). Coordinates are millimetres times `scale`, whatever unit the file is written in. Throws
/// std::invalid_argument for another ending or a scale that is not positive, Error for a file that is not
/// there, cannot be understood or has no face.
std::vector<Face> readFaces(const std::string& file, double scale = 1);

}  // namespace atrapos::cad
