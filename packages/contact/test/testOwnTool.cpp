// The tool of docs/own_tool.md, compiled from the document: nearest surface, derivatives, orders to 20.
#include <Kokkos_Macros.hpp>
#include <cmath>

#include "OwnToolOfTheDocument.hpp"
#include "support/Surfaces.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

Parametrised surface(const Ellipsoid& t) {
  return {"ellipsoid",
          0.1,
          6.2,
          0.3,
          2.8,
          [=](double u, double v) {
            const double e[3] = {std::sin(v) * std::cos(u), std::sin(v) * std::sin(u), std::cos(v)};
            SurfacePlace place;
            for (int i = 0; i < 3; ++i) {
              place.point[i] = t.center[i] + t.half[i] * e[i];
              place.normal[i] = e[i] / t.half[i];
            }
            place.normal = unit(place.normal);
            return place;
          },
          0.5,
          3.0};  // inside: less than the smallest radius of curvature, 2 * 2/3
}

struct Checked : Ellipsoid {
  std::string ambiguity(const double*) const { return {}; }
};

TEST(OwnTool, DoesWhatToolsDo) {
  Random random(61);
  Checked tool;
  const Vector3 center = random.inCube(2);
  for (int i = 0; i < 3; ++i) tool.center[i] = center[i];
  tool.half[0] = 3;
  tool.half[1] = 2;
  tool.half[2] = 2.5;
  const Parametrised s = surface(tool);
  isTheNearestSurface(tool, s, random, 20);
  differentiates(tool, s, random, 0.02, 20);
  solvesItsEquationToOrder20(tool, s, random, 0.04);
}

// Equal half axes: a sphere.
TEST(OwnTool, IsASphereWithEqualHalfAxes) {
  Random random(62);
  Ellipsoid tool{{1, 2, 3}, {2, 2, 2}};
  const Sphere sphere{{1, 2, 3}, 2};
  for (int i = 0; i < 20; ++i) {
    const Vector3 x = sum({1, 2, 3}, random.between(1, 5), random.direction());
    const auto y = project(tool, x), exact = project(sphere, x);
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(y[c], exact[c], 100 * 10 * eps);  // coordinates up to 8
  }
}

}  // namespace
