#include <cmath>

#include "ShellSurface.hpp"
#include "atrapos/solid/Mitc3Base.hpp"
#include "atrapos/solid/Mitc4Base.hpp"
#include "atrapos/solid/ShellPoints.hpp"

namespace atrapos::solid {

using detail::cross;
using detail::unit;
using detail::Vec3;

namespace {

/// Axes of which the third is along `normal`.
std::array<Vec3, 3> axesOf(const double* normal) {
  const Vec3 n = unit({normal[0], normal[1], normal[2]});
  int farthest = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(n[i]) < std::abs(n[farthest]) - 1e-6) farthest = i;  // the first of those that tie
  Vec3 along{0, 0, 0};
  along[farthest] = 1;
  const Vec3 second = unit(cross(n, along));
  return {cross(second, n), second, n};
}

/// geometry(data of a point of the enhanced element, axes, to): what stands before the variables.
template <class Geometry>
ShellMetalPoints pointsOf(fem::EnhancedPoints enhanced, int numData, const Geometry& geometry) {
  const std::size_t count = enhanced.points.numPoints(), before = enhanced.data.size() / count;
  ShellMetalPoints result{std::move(enhanced.points), std::vector<double>(count * numData)};
  for (std::size_t p = 0; p < count; ++p) {
    const double* from = &enhanced.data[p * before];
    geometry(from, axesOf(from + before - 3), &result.data[p * numData] + 1);
  }
  return result;
}

/// The contravariant base [component][i] in the axes, [axis][i].
void turnBase(const double* base, const std::array<Vec3, 3>& axes, double* to) {
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      to[3 * k + i] = axes[k][0] * base[i] + axes[k][1] * base[3 + i] + axes[k][2] * base[6 + i];
}

template <class Element>
ShellMetalPoints tiedPointsOf(fem::EnhancedPoints enhanced, int numData) {
  constexpr int before = 3 * Element::vectors + Element::template Place<double>::numData;
  return pointsOf(std::move(enhanced), numData,
                  [](const double* from, const std::array<Vec3, 3>& axes, double* to) {
                    std::copy_n(from, before, to);
                    turnBase(from + before, axes, to + before);
                  });
}

}  // namespace

ShellMetalPoints shellMetalPoints(const ShellElements& elements, const ShellCubature& cubature, int numData) {
  return pointsOf(shellPoints(elements, cubature), numData,
                  [](const double*, const std::array<Vec3, 3>& axes, double* to) {
                    for (int i = 0; i < 3; ++i)
                      for (int k = 0; k < 3; ++k) to[3 * i + k] = axes[k][i];
                  });
}

ShellMetalPoints assumedShearMetalPoints(const ShellElements& elements, const ShellCubature& cubature,
                                         int numData) {
  return pointsOf(assumedShearPoints(elements, cubature), numData,
                  [](const double* from, const std::array<Vec3, 3>& axes, double* to) {
                    std::copy_n(from, 12, to);
                    turnBase(from + 12, axes, to + 12);
                  });
}

ShellMetalPoints mitc4MetalPoints(const ShellElements& elements, double poissonRatio,
                                  const ShellCubature& cubature, int numData) {
  return tiedPointsOf<Mitc4>(mitc4Points(elements, poissonRatio, cubature), numData);
}

ShellMetalPoints mitc3MetalPoints(const ShellElements& elements, double poissonRatio,
                                  const ShellCubature& cubature, int numData) {
  return tiedPointsOf<Mitc3>(mitc3Points(elements, poissonRatio, cubature), numData);
}

}  // namespace atrapos::solid
