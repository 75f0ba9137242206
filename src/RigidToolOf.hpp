#pragma once

#include <cmath>
#include <memory>

#include "RigidTool.hpp"
#include "atrapos/contact/ContactLaw.hpp"
#include "atrapos/contact/CurveContact.hpp"
#include "atrapos/contact/HardContact.hpp"
#include "atrapos/contact/MovingTool.hpp"
#include "atrapos/contact/PatchSearch.hpp"
#include "atrapos/contact/SharpenedContact.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/PointLawOf.hpp"

namespace atrapos {

// One compiled contact law each; every one is compiled in a file of its own.
std::unique_ptr<RigidTool> rigidTool(const contact::AnyTool& tool);
std::unique_ptr<RigidTool> rigidTool(const contact::MovingTool<contact::AnyTool>& tool);
std::unique_ptr<RigidTool> patchTool(std::shared_ptr<const contact::PatchSet> set);
std::unique_ptr<RigidTool> patchTool(std::shared_ptr<const contact::PatchSet> set,
                                     const contact::Motion& motion);

/// A tool of the package behind the interface. `Tool` has the inputs x or (x, load factor); with patches
/// `set` is theirs.
template <class Tool>
class RigidToolOf final : public RigidTool {
  static constexpr int inputs = contact::detail::PlaceInputs<Tool>::value;
  static constexpr int toolData = contact::detail::ToolData<Tool>::value;
  static constexpr int unknowns = Tool::numUnknowns;
  static constexpr bool patches = toolData > 0;

 public:
  explicit RigidToolOf(const Tool& tool, std::shared_ptr<const contact::PatchSet> set = nullptr)
      : tool_(tool), set_(std::move(set)) {
    tool_.validate();
  }

  bool moves() const override { return inputs == 4; }

  std::string ambiguity(const double* place) const override {
    if constexpr (patches) {
      double X[3];
      toTool(place, X);
      return set_->ambiguity(X);
    } else {
      return tool_.ambiguity(place);
    }
  }

  ToolProjection project(const double* place) const override {
    ToolProjection result;
    double y[unknowns];
    if constexpr (patches) {
      double X[3];
      toTool(place, X);
      const auto data = set_->locate(X);
      result.distance = set_->nearest(X).distance;
      if (data[0] < 0) return result;
      taylor::solveImplicit<inputs, unknowns, toolData>(tool_, place, data.data(), y);
    } else {
      taylor::solveImplicit<inputs, unknowns>(tool_, place, y);
      result.distance = std::abs(y[0]);
    }
    result.gap = y[0];
    result.normal = {y[1], y[2], y[3]};
    return result;
  }

  std::unique_ptr<fem::Term> term(const contact::AnyPressure& pressure, const fem::PointSet& points,
                                  const std::vector<double>& referenceGaps) const override {
    using Law = contact::ContactLaw<Tool, contact::AnyPressure>;
    if constexpr (patches) {
      std::vector<double> data;
      for (const double Delta : referenceGaps) data.insert(data.end(), {Delta, -1, 0, 0});
      return fem::lawTerm(fem::pointLaw(Law{tool_, pressure}), points, data,
                          contact::PatchSearch<Tool>{set_, tool_}.pieces(1));
    } else {
      return fem::lawTerm(fem::pointLaw(Law{tool_, pressure}), points, referenceGaps);
    }
  }

  void addHard(fem::FeModel& model, const fem::PointSet& points) const override {
    if constexpr (patches)
      contact::addHardContact(model, points, contact::PatchSearch<Tool>{set_, tool_});
    else
      contact::addHardContact(model, points, tool_);
  }

  void addHardFaces(fem::FeModel& model, const fem::PointSet& faces) const override {
    if constexpr (patches)
      contact::addHardFaceContact(model, faces, contact::PatchSearch<Tool>{set_, tool_});
    else
      contact::addHardFaceContact(model, faces, tool_);
  }

  void addCurve(fem::FeModel& model, const contact::RegularisedPressure& pressure,
                const fem::PointSet& points, const std::vector<double>& referenceGaps) const override {
    if constexpr (patches)
      contact::addCurveContact(model, points, contact::PatchSearch<Tool>{set_, tool_}, pressure,
                               referenceGaps);
    else
      contact::addCurveContact(model, points, tool_, pressure, referenceGaps);
  }

  std::unique_ptr<fem::Term> sharpened(const contact::RegularisedPressure& pressure,
                                       const fem::PointSet& points, const std::vector<double>& referenceGaps,
                                       double loadFactor) const override {
    using Law = contact::SharpenedContact<Tool>;
    const Law law{tool_, {pressure.compliance, pressure.eta}, loadFactor};
    if constexpr (patches) {
      std::vector<double> data;
      for (const double Delta : referenceGaps) data.insert(data.end(), {Delta, -1, 0, 0});
      const contact::PatchSearch<Tool> search{set_, tool_};
      const auto update = [=](int numPoints, const double* in, double* data) {
        std::vector<double> places;
        for (int p = 0; p < numPoints; ++p) {
          places.insert(places.end(), in + 4 * p, in + 4 * p + 3);
          if (inputs == 4) places.push_back(loadFactor);
        }
        search(numPoints, places.data(), data);
      };
      return fem::lawTerm(fem::pointLaw(law), points, data, update);
    } else {
      return fem::lawTerm(fem::pointLaw(law), points, referenceGaps);
    }
  }

 private:
  void toTool(const double* place, double* X) const {
    if constexpr (inputs == 4)
      tool_.toToolFrame(place, X);
    else
      std::copy_n(place, 3, X);
  }

  Tool tool_;
  std::shared_ptr<const contact::PatchSet> set_;
};

}  // namespace atrapos
