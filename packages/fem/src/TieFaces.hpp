#pragma once

#include <array>
#include <vector>

#include "Vec3.hpp"
#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/ReferenceCell.hpp"

namespace atrapos::fem::detail {

/// A face of a solid or an edge of a plane cell, with coordinates in its plane: along `axes`, from `centre`.
struct TieFace {
  Side side;
  Face shape = Face::Tri3;
  int block = 0, element = 0;  ///< fem::addressOf
  std::vector<int> nodes;
  std::vector<Vec3> places;
  Vec3 centre{}, normal{};     ///< outwards
  std::array<Vec3, 2> axes{};  ///< the first one alone of an edge
  double size = 0;             ///< length, square root of the area
  Vec3 low{}, high{};          ///< box around it

  int dim() const { return isLine(shape) ? 1 : 2; }
  double along(int axis, const Vec3& x) const;  ///< a coordinate of a place
  double above(const Vec3& x) const;            ///< its distance from the plane
};

/// Throws std::invalid_argument for sides of other cells.
std::vector<TieFace> tieFaces(const Mesh& mesh, const SideSet& set);

/// Finds faces whose boxes are near: they are sorted along the axis that they extend most along.
class NearFaces {
 public:
  explicit NearFaces(const std::vector<TieFace>& faces);

  /// Numbers, ascending, of faces whose box is within `reach` times the larger of `size` and their own of the
  /// box from low to high.
  std::vector<int> of(const Vec3& low, const Vec3& high, double size, double reach) const;

 private:
  const std::vector<TieFace>& faces_;
  int axis_ = 0;
  double widest_ = 0, largest_ = 0;  ///< along the axis; size
  std::vector<int> order_;           ///< by `low` along the axis
};

/// A piece of a face that is opposite of a face of the other surface: a triangle, or two ends of a piece of
/// an edge, in the face's coordinates.
struct TieSegment {
  int own = 0, other = 0;
  std::array<std::array<double, 2>, 3> corners{};
  double size = 0;  ///< area or length in the plane
  double gap = 0;
};

/// All pieces of one face, number `own`; `near`: of the other ones.
std::vector<TieSegment> tieSegments(const std::vector<TieFace>& faces, int own,
                                    const std::vector<TieFace>& others, const NearFaces& near, double reach);

}  // namespace atrapos::fem::detail
