#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "atrapos/contact/MovingTool.hpp"
#include "atrapos/contact/OneOf.hpp"
#include "atrapos/contact/PatchTool.hpp"
#include "atrapos/contact/RegularisedPressure.hpp"
#include "atrapos/fem/PointLaw.hpp"

/// Contact laws put together of stages when the program runs: where the point is for the tool, projection,
/// normal, pressure. They are to rounding the laws ContactLaw, HardContactLaw, CurveContactLaw and
/// SharpenedContact of the same tool, which are one template each, with the same inputs, data and outputs.
namespace atrapos::contact {

/// A tool as stages see it.
struct ToolStages {
  std::function<std::unique_ptr<fem::PointLaw>()> projection;  ///< ProjectionStage of the tool at rest
  bool patches = false;
  bool symmetric = true;         ///< n is the gradient of h
  std::optional<Motion> motion;  ///< none: at rest
};

/// Of a tool of the package, of patches, and of any tool whose ProjectionStage is compiled
/// (ATRAPOS_POINT_LAW).
ToolStages stagesOf(const AnyTool& tool, const std::optional<Motion>& motion = {});
ToolStages stagesOf(const PatchTool& tool, const std::optional<Motion>& motion = {});

std::unique_ptr<fem::PointLaw> stagedContact(const ToolStages& tool, const AnyPressure& pressure);
std::unique_ptr<fem::PointLaw> stagedHardContact(const ToolStages& tool);
std::unique_ptr<fem::PointLaw> stagedCurveContact(const ToolStages& tool,
                                                  const RegularisedPressure& pressure);

/// What flows into a body through its contact with a tool (docs/theory/balance.md, Through contacts).
struct Passage {
  /// A stage: values of fields, the load factor, R, h -> -q, per area; data: the undeformed place.
  std::unique_ptr<fem::PointLaw> amount;
  int into = 0;  ///< which of the fields q flows of
};
/// x, values of so many fields (what the amount has inputs for besides is not read), load factor -> no force,
/// -q in the place of its field; data: the undeformed place, Delta.
std::unique_ptr<fem::PointLaw> stagedPassage(const ToolStages& tool, const AnyPressure& pressure,
                                             Passage passage, int fields);

/// Place (and load factor) -> h, n: the projection alone; of patches with the point's data, and its foot's
/// t1, t2 behind n.
std::unique_ptr<fem::PointLaw> stagedProjection(const ToolStages& tool);
/// The tool stands where it is at `loadFactor`.
std::unique_ptr<fem::PointLaw> stagedSharpenedContact(const ToolStages& tool,
                                                      const RegularisedPressure& pressure, double loadFactor);

}  // namespace atrapos::contact
