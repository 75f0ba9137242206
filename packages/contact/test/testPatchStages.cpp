// The same as testContactStages.cpp with patches, at rest and moving; some points are over nothing.
#include <gtest/gtest.h>

#include "support/StageChecks.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

TEST(PatchStages, AreTheLawsOfPatches) {
  Random random(72);
  const Cylinder cylinder = random.cylinder();
  const auto places = placesAbout(cylinder, random);
  const PatchSet set(bezierCylinder(cylinder, 2, 4));
  for (const bool moves : {false, true}) {
    const Motion motion = someMotion(random, true);
    const MovingTool<PatchTool> moving{set.tool(), motion};
    std::vector<std::array<double, 3>> toolData;
    for (const Vector3& x : places) {
      double X[3] = {x[0], x[1], x[2]}, place[4] = {x[0], x[1], x[2], loadFactor};
      if (moves) moving.toToolFrame(place, X);
      const auto found = set.locate(X);
      toolData.push_back({found[0], found[1], found[2]});
    }
    toolData[1] = toolData[7] = {-1, 0, 0};  // over nothing
    if (moves)
      compareAll(stagesOf(set.tool(), motion), moving, places, toolData);
    else
      compareAll(stagesOf(set.tool()), set.tool(), places, toolData);
  }
}

}  // namespace
