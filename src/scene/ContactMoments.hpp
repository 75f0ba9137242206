#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "scene/SceneModel.hpp"
#include "scene/SceneState.hpp"

namespace atrapos {

/// How a contact's pressure is spread out in space, of the deformed body. Of points those count that are
/// closed (isClosed): laws that never quite vanish would add a moment of their far tails.
struct ContactMoments {
  /// The normal forces' centre; where nothing is pressed the point with the smallest gap. Around an axis x
  /// and z are 0.
  std::array<double, 3> center{0, 0, 0};
  /// Mean squares, weighted by normal force, of the distances along x, y, z from the centre, or from `about`;
  /// around an axis that along x is of the distance from the axis. 0 where nothing is pressed.
  std::array<double, 3> squares{0, 0, 0};
};

/// `ring`: a plane body stands for one around the axis x = 0, from which distances along x are measured then.
/// Collective.
ContactMoments contactMoments(const ContactPoints& contact, const SceneState& state, bool ring,
                              const std::optional<std::array<double, 3>>& about = {});

/// The largest pressure of a contact over faces or edges, >= 0: over its points, of zones anywhere on their
/// lines. Collective.
double largestPressure(const ContactPoints& contact, const SceneState& state);

/// The pressure at one point of a contact over faces or edges. Collective.
double pressureAt(const ContactPoints& contact, std::size_t term, int point, const SceneState& state);

/// Whether a point is closed (ContactState::active), given what its term observes there.
bool isClosed(const ContactPoints& contact, std::size_t term, int point, const double* observed);

}  // namespace atrapos
