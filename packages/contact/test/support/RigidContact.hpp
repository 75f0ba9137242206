#pragma once

#include <memory>
#include <vector>

#include "atrapos/contact/PatchSearch.hpp"
#include "atrapos/contact/RigidTool.hpp"

/// Contact of points with tools of the package by the laws that it has compiled.
namespace atrapos::contact::test {

template <class Tool>
std::unique_ptr<RigidTool> rigid(const Tool& tool) {
  return rigidTool(AnyTool(tool));
}
template <class Tool>
std::unique_ptr<RigidTool> rigid(const MovingTool<Tool>& tool) {
  return rigidTool(AnyTool(tool.tool), tool.motion);
}
inline std::unique_ptr<RigidTool> rigid(const PatchSearch<PatchTool>& search) {
  return rigidTool(search.set);
}
inline std::unique_ptr<RigidTool> rigid(const PatchSearch<MovingTool<PatchTool>>& search) {
  return rigidTool(search.set, search.tool.motion);
}

template <class Tool>
void addHardContact(fem::FeModel& model, const fem::PointSet& points, const Tool& tool) {
  rigid(tool)->addHard(model, points);
}

template <class Tool>
void addHardFaceContact(fem::FeModel& model, const fem::PointSet& faces, const Tool& tool) {
  rigid(tool)->addHardFaces(model, faces);
}

template <class Tool>
void addCurveContact(fem::FeModel& model, const fem::PointSet& points, const Tool& tool,
                     const RegularisedPressure& pressure, const std::vector<double>& gaps) {
  rigid(tool)->addCurve(model, pressure, points, gaps);
}

}  // namespace atrapos::contact::test
