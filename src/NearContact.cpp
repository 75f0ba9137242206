#include "NearContact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace atrapos {
namespace {

template <class T>
void appendRows(const std::vector<T>& from, std::size_t row, std::size_t length, std::vector<T>& to) {
  if (from.empty()) return;
  to.insert(to.end(), from.begin() + row * length, from.begin() + (row + 1) * length);
}

}  // namespace

NearContact::NearContact(const RigidTool& tool, const contact::AnyPressure& pressure,
                         const fem::PointSet& points, const std::vector<double>& referenceGaps, bool all)
    : tool_(tool),
      pressure_(pressure),
      points_(points),
      referenceGaps_(referenceGaps),
      all_(tool.term(pressure, points, referenceGaps)),
      carried_(points.numEntities, all ? 1 : 0) {
  const int N = points_.nodesPerEntity;
  for (int p = 0; p < points_.numPoints(); ++p) {
    double sum = 0;
    for (int n = 0; n < N; ++n) sum += std::abs(points_.shape[static_cast<std::size_t>(p) * N + n]);
    largestShapeSum_ = std::max(largestShapeSum_, sum);
  }
  make();
}

int NearContact::numCarried() const {
  return points_.pointsPerEntity * static_cast<int>(std::count(carried_.begin(), carried_.end(), 1));
}

void NearContact::setPositions(const std::vector<int>& positions) {
  all_->setPositions(positions);
  positions_ = positions;
  make();
}

/// The term of the entities that are carried.
void NearContact::make() const {
  near_.reset();
  const std::size_t N = points_.nodesPerEntity, Q = points_.pointsPerEntity;
  fem::PointSet part;
  part.nodesPerEntity = points_.nodesPerEntity;
  part.pointsPerEntity = points_.pointsPerEntity;
  part.shapeComponents = points_.shapeComponents;
  std::vector<double> gaps;
  std::vector<int> positions;
  for (std::size_t e = 0; e < carried_.size(); ++e) {
    if (!carried_[e]) continue;
    ++part.numEntities;
    appendRows(points_.nodes, e, N, part.nodes);
    appendRows(points_.shape, e, Q * N, part.shape);
    appendRows(points_.weights, e, Q, part.weights);
    appendRows(points_.positions, e, 3 * Q, part.positions);
    appendRows(points_.normals, e, 3 * Q, part.normals);
    appendRows(referenceGaps_, e, Q, gaps);
    appendRows(positions_, e, N * N, positions);
  }
  if (part.numEntities == 0) return;
  near_ = tool_.term(pressure_, part, gaps);
  if (!positions_.empty()) near_->setPositions(positions);
}

void NearContact::grow(const fem::ConstField& u, double lambda) const {
  const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), u);
  const auto& nodes = points_.nodes;
  double moved = std::numeric_limits<double>::infinity();
  if (!searchedAt_.empty() && !tool_.moves()) {
    double square = 0;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      double sum = 0;
      for (int i = 0; i < 3; ++i) {
        const double d = host(3 * static_cast<std::size_t>(nodes[n]) + i) - searchedAt_[3 * n + i];
        sum += d * d;
      }
      if (!(sum <= square)) square = sum;  // also where it is not a number
    }
    moved = largestShapeSum_ * std::sqrt(square);
  }
  if (moved < slack_) return;
  const int N = points_.nodesPerEntity, Q = points_.pointsPerEntity;
  slack_ = std::numeric_limits<double>::infinity();
  bool grown = false;
  for (std::size_t e = 0; e < carried_.size(); ++e) {
    if (carried_[e]) continue;
    for (int q = 0; q < Q && !carried_[e]; ++q) {
      const std::size_t p = e * Q + q;
      double place[4] = {points_.positions[3 * p], points_.positions[3 * p + 1], points_.positions[3 * p + 2],
                         lambda};
      for (int n = 0; n < N; ++n)
        for (int i = 0; i < 3; ++i)
          place[i] += points_.shape[p * N + n] * host(3 * static_cast<std::size_t>(nodes[e * N + n]) + i);
      const ToolProjection over = tool_.project(place);
      const double room = over.gap < 0 ? -1 : over.distance - 0.5 * referenceGaps_[p];
      if (!(room > 0)) carried_[e] = grown = true;
      slack_ = std::min(slack_, room);
    }
  }
  searchedAt_.resize(3 * nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (int i = 0; i < 3; ++i) searchedAt_[3 * n + i] = host(3 * static_cast<std::size_t>(nodes[n]) + i);
  if (!grown) return;
  slack_ = -1;  // of the entities that joined; the others' is found at the next evaluation
  make();
}

double NearContact::addResidual(const fem::ConstField& u, double lambda, const fem::Field& f) const {
  grow(u, lambda);
  return near_ ? near_->addResidual(u, lambda, f) : 0;
}

void NearContact::addTangent(const fem::ConstField& u, double lambda, const fem::TangentSink& sink) const {
  grow(u, lambda);
  if (near_) near_->addTangent(u, lambda, sink);
}

void NearContact::beginSeries(const fem::ConstField& u, double lambda, int maxOrder) {
  grow(u, lambda);
  series_ = near_;
  if (series_) series_->beginSeries(u, lambda, maxOrder);
}

void NearContact::addOrder(int k, const fem::ConstField& last, double lastLambda, const fem::Field& f) {
  if (series_) series_->addOrder(k, last, lastLambda, f);
}

fem::PointValues NearContact::observe(const fem::ConstField& u, double lambda) const {
  return all_->observe(u, lambda);
}

std::size_t NearContact::historyBytes(int maxOrder) const { return all_->historyBytes(maxOrder); }

}  // namespace atrapos
