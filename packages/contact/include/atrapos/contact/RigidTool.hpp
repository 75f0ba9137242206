#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "atrapos/contact/ContactStages.hpp"
#include "atrapos/contact/MovingTool.hpp"
#include "atrapos/contact/OneOf.hpp"
#include "atrapos/contact/Overclosure.hpp"
#include "atrapos/contact/PatchSet.hpp"
#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/Term.hpp"
#include "atrapos/fem/ZoneTerm.hpp"

namespace atrapos::contact {

/// Where a place is over a tool.
struct ToolProjection {
  double gap = std::numeric_limits<double>::infinity();  ///< infinity: over no part of the tool
  std::array<double, 3> normal{0, 0, 0};                 ///< from the tool; zero where the gap is infinity
  double distance = 0;                                   ///< to the nearest point of the tool, >= 0
};

/// A rigid tool, whatever its kind. Places are (x, y, z, load factor). Points may be those of a plane body
/// (x, y): the tool is then met in z = 0, and its forces along z are none of the body's.
class RigidTool {
 public:
  virtual ~RigidTool() = default;

  virtual bool moves() const = 0;

  /// Why the place has no unique projection, as the end of "the point ..."; empty where it has one.
  virtual std::string ambiguity(const double* place) const = 0;

  /// A gap that is not a number where there is none.
  virtual ToolProjection project(const double* place) const = 0;

  /// The term of a contact at face or node points; referenceGaps is [point], > 0.
  virtual std::unique_ptr<fem::Term> term(const AnyPressure& pressure, const fem::PointSet& points,
                                          const std::vector<double>& referenceGaps) const = 0;

  /// What flows through such a contact: the points have fields, one component each, behind their places.
  virtual std::unique_ptr<fem::Term> passage(const AnyPressure& pressure, const fem::PointSet& points,
                                             const std::vector<double>& referenceGaps,
                                             Passage passage) const = 0;

  /// Adds hard contact of these points to the model: its last term, and a node behind the others for the
  /// multiplier of each.
  virtual void addHard(fem::FeModel& model, const fem::PointSet& points) const = 0;

  /// The same of faces, with a node for the multiplier of each corner.
  virtual void addHardFaces(fem::FeModel& model, const fem::PointSet& faces) const = 0;

  /// Adds contact by law (15) with the place on its curve as unknown: the model's last term, and a node
  /// behind the others for each point. Throws std::invalid_argument, one line, for gaps the law cannot have.
  virtual void addCurve(fem::FeModel& model, const RegularisedPressure& pressure, const fem::PointSet& points,
                        const std::vector<double>& referenceGaps) const = 0;

  /// Contact of lines of a body, integrated over the zones where they are in the tool. Throws
  /// std::invalid_argument, one line, where n is not the gradient of the gap.
  virtual std::unique_ptr<fem::Term> zones(const Overclosure& pressure, const fem::LineSet& lines,
                                           fem::ZoneOptions options = {}) const = 0;

  /// The contact with law (15) where eta falls to eta exp(-s), s what the term sees as the load factor, and
  /// the tool stands where it is at `loadFactor`.
  virtual std::unique_ptr<fem::Term> sharpened(const RegularisedPressure& pressure,
                                               const fem::PointSet& points,
                                               const std::vector<double>& referenceGaps,
                                               double loadFactor) const = 0;
};

/// Tools of the package, at rest or moving, whose contact laws are put together of stages. Throws
/// std::invalid_argument, one line, where the numbers of tool or motion make no surface.
std::unique_ptr<RigidTool> rigidTool(const AnyTool& tool, const std::optional<Motion>& motion = {});
std::unique_ptr<RigidTool> rigidTool(std::shared_ptr<const PatchSet> set,
                                     const std::optional<Motion>& motion = {});

}  // namespace atrapos::contact
