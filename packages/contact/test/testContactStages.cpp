// Contact laws put together of stages beside the same laws written as one template each: values, tangents,
// orders to 20, what they show.
#include <gtest/gtest.h>

#include "support/StageChecks.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

TEST(ContactStages, ToolsAtRestAndMoving) {
  Random random(71);
  const Cylinder cylinder = random.cylinder();
  const auto places = placesAbout(cylinder, random);
  compareAll(stagesOf(AnyTool(cylinder)), cylinder, places, {});
  for (const bool turns : {false, true}) {
    const Motion motion = someMotion(random, turns);
    compareAll(stagesOf(AnyTool(cylinder), motion), MovingTool<Cylinder>{cylinder, motion}, places, {});
  }
}

TEST(ContactStages, EveryToolAndPressure) {
  Random random(73);
  Plane plane;
  Sphere sphere;
  sphere.radius = 2;
  Cone cone;
  cone.halfAngle = 0.4;
  Torus torus;
  torus.radius = 3;
  torus.tubeRadius = 1;
  const std::vector<Vector3> places = [&] {
    std::vector<Vector3> all;
    for (int p = 0; p < Q * lanes; ++p)
      all.push_back({random.between(2, 2.5), random.between(0.1, 0.5), random.between(0.5, 0.9)});
    return all;
  }();
  const auto x = numbers(3, [&](int p, int m) { return places[p][m]; });
  const auto data = numbers(1, [](int, int) { return 3.0; });
  unsigned seed = 5;
  for (const AnyTool& tool : {AnyTool(plane), AnyTool(sphere), AnyTool(cone), AnyTool(torus)})
    for (const AnyPressure& pressure :
         {AnyPressure(regularised), AnyPressure(PowerBarrier{0.01, 0.002, 2.5}),
          AnyPressure(ExponentialPressure{0.1, 0.5}), AnyPressure(SmoothedPenalty{10, 0.5})})
      compare(*stagedContact(stagesOf(tool), pressure),
              *fem::pointLaw(ContactLaw<AnyTool, AnyPressure>{tool, pressure}), x, data, seed++);
}

}  // namespace
