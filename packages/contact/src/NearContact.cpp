#include "atrapos/contact/NearContact.hpp"

#include <algorithm>

#include "atrapos/fem/PointPieces.hpp"
#include "atrapos/fem/Rows.hpp"

namespace atrapos::contact {

NearContact::NearContact(const RigidTool& tool, const AnyPressure& pressure, const fem::PointSet& points,
                         const std::vector<double>& referenceGaps)
    : tool_(tool),
      pressure_(pressure),
      points_(points),
      referenceGaps_(referenceGaps),
      all_(tool.term(pressure, points, referenceGaps)),
      carried_(points.numEntities, 0) {}

int NearContact::numCarried() const {
  return points_.pointsPerEntity * static_cast<int>(std::count(carried_.begin(), carried_.end(), 1));
}

void NearContact::keep(const fem::TermPart& part) {
  referenceGaps_ = fem::rowsOf(referenceGaps_, part.entities, points_.pointsPerEntity);
  points_ = pointsOf(part.entities);
  points_.nodes = part.nodes;
  carried_.assign(part.entities.size(), 0);
  all_->keep(part);
}

fem::PointSet NearContact::pointsOf(const std::vector<int>& entities) const {
  const std::size_t N = points_.nodesPerEntity, Q = points_.pointsPerEntity;
  fem::PointSet part;
  part.numEntities = static_cast<int>(entities.size());
  part.nodesPerEntity = points_.nodesPerEntity;
  part.pointsPerEntity = points_.pointsPerEntity;
  part.shapeComponents = points_.shapeComponents;
  part.components = points_.components;
  part.nodes = fem::rowsOf(points_.nodes, entities, N);
  part.shape = fem::rowsOf(points_.shape, entities, Q * N);
  part.weights = fem::rowsOf(points_.weights, entities, Q);
  part.positions = fem::rowsOf(points_.positions, entities, 3 * Q);
  part.normals = fem::rowsOf(points_.normals, entities, 3 * Q);
  return part;
}

void NearContact::connect(const fem::DofMap& dofs, const std::vector<int>& positions) {
  all_->connect(dofs, positions);
  dofs_ = dofs;
  positions_ = positions;
  make();
}

/// The term of the entities that are carried.
void NearContact::make() {
  near_.reset();
  carriedPoints_.clear();
  const std::size_t N = points_.nodesPerEntity, Q = points_.pointsPerEntity;
  std::vector<int> carried;
  for (std::size_t e = 0; e < carried_.size(); ++e)
    if (carried_[e]) carried.push_back(static_cast<int>(e));
  if (carried.empty()) return;
  carriedPoints_ = fem::pointsOf(carried, points_.pointsPerEntity);
  near_ = tool_.term(pressure_, pointsOf(carried), fem::rowsOf(referenceGaps_, carried, Q));
  if (!positions_.empty()) near_->connect(dofs_, fem::rowsOf(positions_, carried, N * N));
}

bool NearContact::search(const fem::ConstDofView& u, double lambda, std::vector<char>* joining) const {
  const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), u);
  const int N = points_.nodesPerEntity, Q = points_.pointsPerEntity;
  bool found = false;
  for (std::size_t e = 0; e < carried_.size(); ++e) {
    if (carried_[e]) continue;
    for (int q = 0; q < Q; ++q) {
      const std::size_t p = e * Q + q;
      double place[4] = {points_.positions[3 * p], points_.positions[3 * p + 1], points_.positions[3 * p + 2],
                         lambda};
      for (int n = 0; n < N; ++n) {
        const int first = dofs_.firstDof(points_.nodes[e * N + n]);
        for (int i = 0; i < points_.components; ++i) place[i] += points_.shape[p * N + n] * host(first + i);
      }
      const ToolProjection over = tool_.project(place);
      // Over no part of the tool the distance tells how soon it may be; also where it is not a number.
      const double distance = over.gap < 0 ? over.gap : over.distance;
      if (distance > 0.5 * referenceGaps_[p]) continue;
      found = true;
      if (joining == nullptr) return true;
      (*joining)[e] = 1;
      break;
    }
  }
  return found;
}

void NearContact::grow(const fem::ConstDofView& u, double lambda) {
  std::vector<char> joining = carried_;
  if (!search(u, lambda, &joining)) return;
  carried_ = joining;
  make();
}

/// The law's pieces are those of all points.
void NearContact::lendPieces() const {
  if (all_->pieces()) all_->pieces()->lend(carriedPoints_, *near_->pieces());
}

std::vector<double> NearContact::places(const fem::ConstDofView& u, double lambda) const {
  return all_->places(u, lambda);
}

fem::OwnForces NearContact::addResidual(const fem::ConstDofView& u, double lambda,
                                        const fem::DofView& f) const {
  if (!near_) return {};
  lendPieces();
  return near_->addResidual(u, lambda, f);
}

void NearContact::addTangent(const fem::ConstDofView& u, double lambda, const fem::TangentSink& sink) const {
  if (!near_) return;
  lendPieces();
  near_->addTangent(u, lambda, sink);
}

void NearContact::beginSeries(const fem::ConstDofView& u, double lambda, int maxOrder) {
  if (near_) {
    lendPieces();
    near_->beginSeries(u, lambda, maxOrder);
  }
  if (pieces()) pieces()->beginSeriesOf(carriedPoints_, near_ ? near_->pieces() : nullptr);
}

void NearContact::addOrder(int k, const fem::ConstDofView& last, double lastLambda, const fem::DofView& f) {
  if (near_) near_->addOrder(k, last, lastLambda, f);
}

fem::PointValues NearContact::observe(const fem::ConstDofView& u, double lambda) const {
  return all_->observe(u, lambda);
}

std::size_t NearContact::historyBytes(int maxOrder) const { return all_->historyBytes(maxOrder); }

}  // namespace atrapos::contact
