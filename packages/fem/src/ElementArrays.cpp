#include "ElementArrays.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "Upload.hpp"

namespace atrapos::fem {

static_assert(Kokkos::SpaceAccessibility<Kokkos::HostSpace, Memory>::accessible,
              "element loops call laws in batches on the host: Kokkos' default space must be one");

namespace {

bool allEqual(const std::vector<double>& items, std::size_t size) {
  for (std::size_t i = size; i < items.size(); i += size)
    if (!std::equal(items.begin(), items.begin() + size, items.begin() + i)) return false;
  return true;
}

}  // namespace

ElementArrays::ElementArrays(const PointSet& p)
    : components_(p.shapeComponents),
      entityNodes_(p.nodes),
      batches_(makeBatches(kLanes, p.numEntities, p.nodesPerEntity, p.nodes)),
      kernels_(elementKernels(p.shapeComponents)) {
  if (p.nodesPerEntity > kMaxNodes || p.pointsPerEntity > kMaxPoints)
    throw std::invalid_argument(
        "an element or face has more than 27 nodes or 64 points: lower the cubature degree");
  view_.numEntities = p.numEntities;
  view_.N = p.nodesPerEntity;
  view_.Q = p.pointsPerEntity;
  view_.mapped = !p.maps.empty();
  const std::size_t Q = view_.Q, size = Q * view_.N * components_;
  if (p.shape.size() != (view_.mapped ? size : view_.numEntities * size) ||
      p.maps.size() != (view_.mapped ? static_cast<std::size_t>(p.numPoints()) * 9 : 0))
    throw std::logic_error("ElementArrays: wrong number of shape functions or maps");
  view_.shared = view_.mapped || (view_.numEntities > 0 && allEqual(p.shape, size));
  nodes_ = upload("nodes", padded(p.nodes, view_.N));
  weight_ = upload("weight", withoutPadding(packed(p.weights, Q)));
  shape_ = upload("shape", view_.shared ? std::vector<double>(p.shape.begin(), p.shape.begin() + size)
                                        : packed(p.shape, size));
  if (view_.mapped) map_ = upload("map", packed(p.maps, Q * 9));
  if (components_ == 1) offset_ = upload("offset", packed(p.positions, Q * 3));
  setView();
}

void ElementArrays::setView() {
  view_.nodes = nodes_.data();
  view_.positions = positions_.data();
  view_.shape = shape_.data();
  view_.map = map_.data();
  view_.weight = weight_.data();
}

void ElementArrays::keep(const TermPart& part) {
  const std::size_t Q = view_.Q;
  auto weights = packedOf(part, weight_.data(), Q);
  if (!view_.shared) shape_ = upload("shape", packedOf(part, shape_.data(), Q * view_.N * components_));
  if (view_.mapped) map_ = upload("map", packedOf(part, map_.data(), Q * 9));
  if (components_ == 1) offset_ = upload("offset", packedOf(part, offset_.data(), Q * 3));
  view_.numEntities = static_cast<int>(part.entities.size());
  entityNodes_ = part.nodes;
  kept_ = part.entities;
  batches_ = makeBatches(kLanes, view_.numEntities, view_.N, part.nodes);
  weight_ = upload("weight", withoutPadding(std::move(weights)));
  nodes_ = upload("nodes", padded(part.nodes, view_.N));
  setView();
}

void ElementArrays::setPositions(const std::vector<int>& of) {
  const std::size_t each = static_cast<std::size_t>(view_.N) * view_.N;
  std::vector<int> all(static_cast<std::size_t>(batches_.count) * kLanes * each, 0);
  std::copy_n(of.begin(), view_.numEntities * each, all.begin());
  positions_ = upload("positions", all);
  setView();
}

void ElementArrays::addOffset(int b, int stride, double* in) const {
  if (components_ != 1) return;
  const double* x = offset_.data() + static_cast<std::size_t>(b) * view_.Q * 3 * kLanes;
  for (int q = 0; q < view_.Q; ++q)
    for (int i = 0; i < 3 * kLanes; ++i) in[q * stride * kLanes + i] += x[q * 3 * kLanes + i];
}

double ElementArrays::squares(int b, int count, const double* force) const {
  const int lanes = view_.lanesIn(b);
  double sum = 0;
  for (int n = 0; n < count; ++n)
    for (int lane = 0; lane < lanes; ++lane) sum += force[n * kLanes + lane] * force[n * kLanes + lane];
  return sum;
}

std::vector<double> ElementArrays::packed(const std::vector<double>& from, std::size_t count) const {
  std::vector<double> to(static_cast<std::size_t>(batches_.count) * kLanes * count);
  for (std::size_t i = 0; i < static_cast<std::size_t>(batches_.count) * kLanes; ++i) {
    const double* own = &from[std::min<std::size_t>(i, view_.numEntities - 1) * count];
    for (std::size_t m = 0; m < count; ++m) to[(i / kLanes * count + m) * kLanes + i % kLanes] = own[m];
  }
  return to;
}

std::vector<double> ElementArrays::packedOf(const TermPart& part, const double* from, std::size_t count) {
  const std::size_t batches = (part.entities.size() + kLanes - 1) / kLanes;
  std::vector<double> to(batches * count * kLanes);
  for (std::size_t i = 0; i < batches * kLanes; ++i) {
    const std::size_t e = part.entities[std::min(i, part.entities.size() - 1)];
    for (std::size_t m = 0; m < count; ++m)
      to[(i / kLanes * count + m) * kLanes + i % kLanes] =
          from[(e / kLanes * count + m) * kLanes + e % kLanes];
  }
  return to;
}

// [entity][node]; entities that fill up the last batch copy the last one.
std::vector<int> ElementArrays::padded(const std::vector<int>& of, int count) const {
  std::vector<int> to(static_cast<std::size_t>(batches_.count) * kLanes * count);
  for (std::size_t i = 0; i < static_cast<std::size_t>(batches_.count) * kLanes; ++i)
    std::copy_n(&of[std::min<std::size_t>(i, view_.numEntities - 1) * count], count, &to[i * count]);
  return to;
}

// Copies that fill up the last batch weigh nothing.
std::vector<double> ElementArrays::withoutPadding(std::vector<double> weights) const {
  const std::size_t Q = view_.Q;
  for (std::size_t i = view_.numEntities; i * Q < weights.size(); ++i)
    for (std::size_t q = 0; q < Q; ++q) weights[(i / kLanes * Q + q) * kLanes + i % kLanes] = 0;
  return weights;
}

}  // namespace atrapos::fem
