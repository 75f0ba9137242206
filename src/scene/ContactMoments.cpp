#include "scene/ContactMoments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace atrapos {
namespace {

/// Columns of what terms observe at their points (fem::zoneTerm has all of them, others the first two).
enum Column { gap, pressure, part, peak, placeOfForce, squares = placeOfForce + 3 };

using Place = std::array<double, 3>;

/// A point of a contact in the deformed body.
Place placeOf(const fem::PointSet& points, int p, const std::vector<double>& displacements) {
  const int N = points.nodesPerEntity;
  const double* shape = &points.shape[static_cast<std::size_t>(p) * N];
  const int* nodes = &points.nodes[static_cast<std::size_t>(p / points.pointsPerEntity) * N];
  Place x;
  for (int i = 0; i < 3; ++i) {
    x[i] = points.positions[3 * static_cast<std::size_t>(p) + i];
    for (int n = 0; n < N; ++n) x[i] += shape[n] * displacements[3 * static_cast<std::size_t>(nodes[n]) + i];
  }
  return x;
}

/// What presses on a part of the surface.
struct Share {
  double force;
  Place place, squares;  ///< where; mean squares of the distances from there
};

}  // namespace

bool isClosed(const ContactPoints& contact, std::size_t term, int point, const double* observed) {
  if (!contact.lines.empty()) return observed[part] > 0;
  // Around an active corner the mean gap vanishes, and the gaps of its points have both signs.
  return contact.hardFaces ? observed[pressure] > 0 : observed[gap] <= contact.closedGaps[term][point];
}

ContactMoments contactMoments(const ContactPoints& contact, const SceneState& state, bool ring,
                              const std::optional<Place>& about) {
  std::vector<Share> shares;
  ContactMoments result;
  double smallest = std::numeric_limits<double>::infinity();
  const std::vector<double>& displacements = state.displacements();
  for (std::size_t t = 0; t < contact.terms.size(); ++t) {
    const fem::PointSet& points = contact.points[t];
    const fem::PointValues& observed = state.observed(contact.terms[t]);
    const std::size_t M = observed.names.size();
    for (int p = 0; p < points.numPoints(); ++p) {
      const double* at = &observed.values[static_cast<std::size_t>(p) * M];
      const double force = at[pressure] * points.weights[p];
      const bool zones = !contact.lines.empty();
      if (at[gap] < smallest && shares.empty()) {
        smallest = at[gap];
        result.center = placeOf(points, p, displacements);
      }
      if (!(force > 0) || !isClosed(contact, t, p, at)) continue;
      Share share{force, {}, {}};
      if (zones) {
        std::copy_n(&at[placeOfForce], 3, share.place.begin());
        std::copy_n(&at[squares], 3, share.squares.begin());
      } else {
        share.place = placeOf(points, p, displacements);
      }
      shares.push_back(share);
    }
  }
  double all = 0;
  Place sum{0, 0, 0};
  for (const Share& share : shares) {
    all += share.force;
    for (int i = 0; i < 3; ++i) sum[i] += share.force * share.place[i];
  }
  if (all > 0)
    for (int i = 0; i < 3; ++i) result.center[i] = sum[i] / all;
  if (ring) result.center[0] = result.center[2] = 0;
  Place from = about ? *about : result.center;
  if (ring) from[0] = from[2] = 0;
  for (const Share& share : shares)
    for (int i = 0; i < 3; ++i) {
      const double way = share.place[i] - from[i];
      result.squares[i] += share.force / all * (share.squares[i] + way * way);
    }
  return result;
}

double largestPressure(const ContactPoints& contact, const SceneState& state) {
  double largest = 0;
  for (std::size_t t = 0; t < contact.terms.size(); ++t) {
    const fem::PointValues& observed = state.observed(contact.terms[t]);
    const std::size_t M = observed.names.size();
    for (std::size_t i = contact.lines.empty() ? pressure : peak; i < observed.values.size(); i += M)
      largest = std::max(largest, observed.values[i]);
  }
  return largest;
}

double pressureAt(const ContactPoints& contact, std::size_t term, int point, const SceneState& state) {
  const fem::PointValues& observed = state.observed(contact.terms[term]);
  const double* at = &observed.values[static_cast<std::size_t>(point) * observed.names.size()];
  if (contact.lines.empty()) return at[pressure];
  // What points show of zones is force over area; the law gives what is at the point itself.
  const contact::Overclosure& law = *contact.pressure.overclosure;
  return law.stiffness * std::pow(std::max(-at[gap], 0.0), law.exponent);
}

}  // namespace atrapos
