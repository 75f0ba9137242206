#include "ElementArrays.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include "Upload.hpp"
#include "atrapos/fem/Rows.hpp"

namespace atrapos::fem {

static_assert(Kokkos::SpaceAccessibility<Kokkos::HostSpace, Memory>::accessible,
              "element loops call laws in batches on the host: Kokkos' default space must be one");

namespace {

bool allEqual(const std::vector<double>& items, std::size_t size) {
  for (std::size_t i = size; i < items.size(); i += size)
    if (!std::equal(items.begin(), items.begin() + size, items.begin() + i)) return false;
  return true;
}

/// `more` nodes of every entity behind those it has.
std::vector<int> joined(const std::vector<int>& nodes, int each, const std::vector<int>& more, int eachMore,
                        int numEntities) {
  std::vector<int> all;
  for (int e = 0; e < numEntities; ++e) {
    all.insert(all.end(), nodes.begin() + e * each, nodes.begin() + (e + 1) * each);
    all.insert(all.end(), more.begin() + e * eachMore, more.begin() + (e + 1) * eachMore);
  }
  return all;
}

/// The derivatives of outputs from `row` on by inputs from `column` on, of [q][output][input][lane].
const double* subBlock(const double* jacobian, int inputs, int row, int column) {
  return jacobian + (row * inputs + column) * kLanes;
}

}  // namespace

ElementArrays::ElementArrays(const PointSet& p) : numEntities_(p.numEntities), Q_(p.pointsPerEntity) {
  if (Q_ > kMaxPoints)
    throw std::invalid_argument("an element or face has more than 64 points: lower the cubature degree");
  batches_.lanes = kLanes;
  batches_.count = (numEntities_ + kLanes - 1) / kLanes;
  weight_ = upload("weight", withoutPadding(packed(p.weights, Q_)));
  addPart(p);
  for (const Interpolation& other : p.more) addPart(other);
  batches_ = makeBatches(kLanes, numEntities_, P_, entityNodes_);
  if (p.shapeComponents == 1 && p.ofPlaces) {
    // X, of as many coordinates as the field has components.
    std::vector<double> X;
    for (std::size_t point = 0; point < p.positions.size() / 3; ++point)
      X.insert(X.end(), &p.positions[3 * point], &p.positions[3 * point] + std::min(3, p.components));
    if (p.components == 2 || p.components == 3)
      offset_ = upload("offset", packed(X, static_cast<std::size_t>(Q_) * p.components));
  }
  setViews();
}

void ElementArrays::addPart(const Interpolation& of) {
  if (of.nodesPerEntity > kMaxNodes) throw std::invalid_argument("an element or face has more than 27 nodes");
  Part part;
  part.field = of.field;
  part.components = of.components;
  part.shapeComponents = of.shapeComponents;
  part.kernels = elementKernels(of.components, of.shapeComponents);
  part.firstInput = inputs_;
  part.firstDof = localDofs_;
  inputs_ += part.inputs();
  localDofs_ += of.components * of.nodesPerEntity;
  // Fields that have the nodes of the first one share its rows.
  if (!parts_.empty() && of.nodesPerEntity == parts_.front().view.N && P_ == of.nodesPerEntity &&
      of.nodes == entityNodes_) {
    part.firstNode = 0;
  } else {
    part.firstNode = P_;
    entityNodes_ = joined(entityNodes_, P_, of.nodes, of.nodesPerEntity, numEntities_);
    P_ += of.nodesPerEntity;
  }
  ElementView& view = part.view;
  view.numEntities = numEntities_;
  view.N = of.nodesPerEntity;
  view.Q = Q_;
  view.mapped = !of.maps.empty();
  const std::size_t C = of.shapeComponents, size = static_cast<std::size_t>(Q_) * view.N * C;
  if (of.shape.size() != (view.mapped ? size : numEntities_ * size) ||
      of.maps.size() != (view.mapped ? static_cast<std::size_t>(numEntities_) * Q_ * C * C : 0))
    throw std::logic_error("ElementArrays: wrong number of shape functions or maps");
  if (view.mapped && C != 2 && C != 3)
    throw std::logic_error("ElementArrays: maps of lines or of more than a cell");
  view.shared = view.mapped || (numEntities_ > 0 && allEqual(of.shape, size));
  part.shape = upload("shape", view.shared ? std::vector<double>(of.shape.begin(), of.shape.begin() + size)
                                           : packed(of.shape, size));
  if (view.mapped) part.map = upload("map", packed(of.maps, Q_ * C * C));
  parts_.push_back(std::move(part));
}

void ElementArrays::setViews() {
  for (Part& part : parts_) {
    ElementView& view = part.view;
    view.numEntities = numEntities_;
    view.weight = weight_.data();
    view.shape = part.shape.data();
    view.map = part.map.data();
    view.dofs = part.dofs.data();
    if (part.columnOffsets.empty()) {
      view.P = stride_;
      view.positions = positions_.data() + static_cast<std::ptrdiff_t>(part.firstNode) * (stride_ + 1);
    } else {
      view.P = view.N;
      view.positions = part.positions.data();
    }
  }
}

void ElementArrays::keep(const TermPart& part) {
  const std::size_t Q = Q_;
  auto weights = packedOf(part, weight_.data(), Q);
  for (Part& p : parts_) {
    const std::size_t C = p.shapeComponents;
    if (!p.view.shared) p.shape = upload("shape", packedOf(part, p.shape.data(), Q * p.view.N * C));
    if (p.view.mapped) p.map = upload("map", packedOf(part, p.map.data(), Q * C * C));
  }
  if (offset_.size() > 0)
    offset_ = upload("offset", packedOf(part, offset_.data(), Q * parts_.front().components));
  numEntities_ = static_cast<int>(part.entities.size());
  entityNodes_ = part.nodes;
  kept_ = part.entities;
  batches_ = makeBatches(kLanes, numEntities_, P_, part.nodes);
  weight_ = upload("weight", withoutPadding(std::move(weights)));
  setViews();
}

int ElementArrays::fieldAt(const Part& part, const DofMap& dofs, int node) const {
  if (part.field.empty()) {
    if (dofs.firstFieldSize(node) < part.components)
      throw std::logic_error("a term needs a field with " + std::to_string(part.components) +
                             " components at node " + std::to_string(node + 1) + ", which has " +
                             std::to_string(dofs.firstFieldSize(node)));
    return dofs.firstDof(node);
  }
  const int field = dofs.find(part.field);
  const int dof = field < 0 ? -1 : dofs.dof(field, node, 0);
  if (dof < 0 || dofs.fields()[field].numComponents() != part.components)
    throw std::logic_error("a term needs a field '" + part.field + "' with " +
                           std::to_string(part.components) + " components at node " +
                           std::to_string(node + 1));
  return dof;
}

/// Of the field that the part has at a node.
int ElementArrays::balanceAt(const Part& part, const DofMap& dofs, int node) const {
  return dofs.balanceOf(dofs.addressOf(fieldAt(part, dofs, node)).field);
}

void ElementArrays::connect(const DofMap& dofs, const std::vector<int>& positions, int stride) {
  stride_ = stride;
  const std::size_t each = static_cast<std::size_t>(stride) * stride;
  std::vector<int> all(static_cast<std::size_t>(batches_.count) * kLanes * each, 0);
  std::copy_n(positions.begin(), numEntities_ * each, all.begin());
  positions_ = upload("positions", all);
  numBalances_ = 1;
  for (Part& part : parts_) {
    const int N = part.view.N;
    if (numEntities_ > 0) part.balance = balanceAt(part, dofs, entityNodes_[part.firstNode]);
    numBalances_ = std::max(numBalances_, part.balance + 1);
    std::vector<int> first, offsets;
    for (int e = 0; e < numEntities_; ++e)
      for (int n = 0; n < N; ++n) {
        const int node = entityNodes_[static_cast<std::size_t>(e) * P_ + part.firstNode + n];
        first.push_back(fieldAt(part, dofs, node));
        offsets.push_back(first.back() - dofs.firstDof(node));
      }
    part.dofs = upload("dofs", padded(first, N));
    part.columnOffsets.clear();
    if (std::all_of(offsets.begin(), offsets.end(), [](int o) { return o == 0; })) continue;
    std::vector<int> own(static_cast<std::size_t>(batches_.count) * kLanes * N * N, 0);
    for (int e = 0; e < numEntities_; ++e)
      for (int a = 0; a < N; ++a)
        for (int c = 0; c < N; ++c)
          own[(static_cast<std::size_t>(e) * N + a) * N + c] =
              all[e * each + static_cast<std::size_t>(part.firstNode + a) * stride + part.firstNode + c] +
              offsets[static_cast<std::size_t>(e) * N + c];
    part.positions = upload("positions", own);
    part.columnOffsets = std::move(offsets);
  }
  setViews();
}

void ElementArrays::gather(int b, const double* u, int stride, double* in) const {
  for (const Part& part : parts_) part.kernels.inputs(part.view, b, u, stride, in + part.firstInput * kLanes);
}

void ElementArrays::addOffset(int b, int stride, double* in) const {
  if (offset_.size() == 0) return;
  const int D = parts_.front().components;
  const double* x = offset_.data() + static_cast<std::size_t>(b) * Q_ * D * kLanes;
  for (int q = 0; q < Q_; ++q)
    for (int i = 0; i < D * kLanes; ++i) in[q * stride * kLanes + i] += x[q * D * kLanes + i];
}

void ElementArrays::addForces(int b, const double* out, int stride, bool weighted, double* force) const {
  for (const Part& part : parts_)
    part.kernels.forces(part.view, b, out + part.firstInput * kLanes, stride, weighted,
                        force + part.firstDof * kLanes);
}

void ElementArrays::scatter(int b, const double* force, double* f) const {
  for (const Part& part : parts_) part.kernels.scatter(part.view, b, force + part.firstDof * kLanes, f);
}

void ElementArrays::addBlocks(int b, const double* jacobian, int outputs, int inputs, bool symmetric,
                              const BlockCorrection& correction, const TangentSink& sink,
                              double* moduli) const {
  const BlockSink blocks{sink.rowStart.data(), sink.values.data()};
  for (std::size_t r = 0; r < parts_.size(); ++r) {
    const Part& row = parts_[r];
    for (std::size_t c = symmetric ? r + 1 : 0; c < parts_.size(); ++c) {
      if (c == r) continue;
      addMixedBlocks(b, row, parts_[c], jacobian, outputs, inputs, false, correction, sink);
      if (symmetric) addMixedBlocks(b, row, parts_[c], jacobian, outputs, inputs, true, correction, sink);
    }
  }
  for (const Part& part : parts_) {
    part.kernels.moduli(part.view, b, subBlock(jacobian, inputs, part.firstInput, part.firstInput), outputs,
                        inputs, moduli);
    part.kernels.blocks(part.view, b, moduli, symmetric, ofPart(correction, part), blocks);
  }
}

BlockCorrection ElementArrays::ofPart(const BlockCorrection& correction, const Part& part) {
  if (correction.rank == 0) return {};
  const std::size_t first = static_cast<std::size_t>(part.firstDof) * correction.rank * kLanes;
  return {correction.rank, correction.left + first, correction.right + first};
}

void ElementArrays::squares(int b, const double* force, double* sums) const {
  const int lanes = lanesIn(b);
  std::fill_n(sums, numBalances_, 0.0);
  for (const Part& part : parts_)
    for (int n = part.firstDof; n < part.firstDof + part.components * part.view.N; ++n)
      for (int lane = 0; lane < lanes; ++lane)
        sums[part.balance] += force[n * kLanes + lane] * force[n * kLanes + lane];
}

double ElementArrays::shapeAt(const Part& part, int b, int q, int n, int c, int lane) const {
  const ElementView& v = part.view;
  const std::size_t C = part.shapeComponents, node = static_cast<std::size_t>(q) * v.N + n;
  if (!v.shared) return v.shape[((static_cast<std::size_t>(b) * v.Q * v.N + node) * C + c) * kLanes + lane];
  if (!v.mapped) return v.shape[node * C + c];
  double sum = 0;
  for (std::size_t d = 0; d < C; ++d)
    sum += v.shape[node * C + d] *
           v.map[(((static_cast<std::size_t>(b) * v.Q + q) * C + d) * C + c) * kLanes + lane];
  return sum;
}

const double* ElementArrays::shapesAt(const Part& part, int b, std::vector<double>& room) const {
  const ElementView& v = part.view;
  const std::size_t C = part.shapeComponents, each = static_cast<std::size_t>(v.N) * C * kLanes;
  if (!v.shared) return v.shape + static_cast<std::size_t>(b) * v.Q * each;
  if (room.size() < v.Q * each) room.resize(v.Q * each);
  double* to = room.data();
  for (int q = 0; q < v.Q; ++q)
    for (int n = 0; n < v.N; ++n)
      for (std::size_t c = 0; c < C; ++c)
        for (int lane = 0; lane < kLanes; ++lane) *to++ = shapeAt(part, b, q, n, static_cast<int>(c), lane);
  return room.data();
}

bool ElementArrays::vanishes(const Part& row, const Part& column, const double* jacobian, int outputs,
                             int inputs) const {
  for (int q = 0; q < Q_; ++q)
    for (int m = 0; m < row.inputs(); ++m) {
      const double* from = jacobian + ((static_cast<std::size_t>(q) * outputs + row.firstInput + m) * inputs +
                                       column.firstInput) *
                                          kLanes;
      for (int i = 0; i < column.inputs() * kLanes; ++i)
        if (from[i] != 0) return false;
    }
  return true;
}

// Blocks between two fields, or between values and gradients of one; any numbers of components: no kernels
// are compiled for all the pairs, so the lanes are what the compiler finds to vectorise.
void ElementArrays::addMixedBlocks(int b, const Part& row, const Part& column, const double* jacobian,
                                   int outputs, int inputs, bool transposed,
                                   const BlockCorrection& correction, const TangentSink& sink) const {
  const int Dr = row.components, Dc = column.components, Cr = row.shapeComponents,
            Cc = column.shapeComponents, Ir = row.inputs(), rank = correction.rank;
  const double *left = ofPart(correction, row).left, *right = ofPart(correction, column).right;
  const bool corrected =
      rank > 0 && std::any_of(left, left + static_cast<std::size_t>(row.view.N) * Dr * rank * kLanes,
                              [](double value) { return value != 0; });
  // As between a flux and the value beside a constant conductivity.
  if (!corrected && vanishes(row, column, jacobian, outputs, inputs)) return;
  static thread_local std::vector<double> rowRoom, columnRoom, products;
  const double *rows = shapesAt(row, b, rowRoom), *columns = shapesAt(column, b, columnRoom), *w = weights(b);
  products.resize(static_cast<std::size_t>(Q_) * Ir * Dc * kLanes);
  const std::size_t stride = stride_;
  const int lanes = lanesIn(b);
  for (int nc = 0; nc < column.view.N; ++nc) {
    // weight jacobian times the shape of a column's node
    for (int q = 0; q < Q_; ++q)
      for (int m = 0; m < Ir; ++m)
        for (int j = 0; j < Dc; ++j) {
          const double* from =
              jacobian + ((static_cast<std::size_t>(q) * outputs + row.firstInput + m) * inputs +
                          column.firstInput + j * Cc) *
                             kLanes;
          const double* shape = columns + (static_cast<std::size_t>(q) * column.view.N + nc) * Cc * kLanes;
          double sum[kLanes] = {};
          for (int c = 0; c < Cc; ++c)
            for (int lane = 0; lane < kLanes; ++lane)
              sum[lane] += from[c * kLanes + lane] * shape[c * kLanes + lane];
          double* to = &products[((static_cast<std::size_t>(q) * Ir + m) * Dc + j) * kLanes];
          for (int lane = 0; lane < kLanes; ++lane) to[lane] = w[q * kLanes + lane] * sum[lane];
        }
    for (int nr = 0; nr < row.view.N; ++nr)
      for (int i = 0; i < Dr; ++i)
        for (int j = 0; j < Dc; ++j) {
          double sum[kLanes] = {};
          for (int q = 0; q < Q_; ++q) {
            const double* shape = rows + (static_cast<std::size_t>(q) * row.view.N + nr) * Cr * kLanes;
            for (int k = 0; k < Cr; ++k) {
              const double* by =
                  &products[((static_cast<std::size_t>(q) * Ir + i * Cr + k) * Dc + j) * kLanes];
              for (int lane = 0; lane < kLanes; ++lane) sum[lane] += shape[k * kLanes + lane] * by[lane];
            }
          }
          for (int k = 0; corrected && k < rank; ++k) {
            const double *l = left + ((nr * Dr + i) * rank + k) * kLanes,
                         *r = right + ((nc * Dc + j) * rank + k) * kLanes;
            for (int lane = 0; lane < kLanes; ++lane) sum[lane] += l[lane] * r[lane];
          }
          for (int lane = 0; lane < lanes; ++lane) {
            const std::size_t entity = static_cast<std::size_t>(b) * kLanes + lane;
            const std::size_t a = row.firstNode + nr, c = column.firstNode + nc;
            const std::size_t position =
                positions_((entity * stride + (transposed ? c : a)) * stride + (transposed ? a : c)) +
                (transposed ? row.columnOffset(entity, nr) : column.columnOffset(entity, nc));
            if (transposed)
              sink.values(sink.rowStart(column.dofs(entity * column.view.N + nc) + j) + position + i) +=
                  sum[lane];
            else
              sink.values(sink.rowStart(row.dofs(entity * row.view.N + nr) + i) + position + j) += sum[lane];
          }
        }
  }
}

std::vector<double> ElementArrays::packed(const std::vector<double>& from, std::size_t count) const {
  std::vector<double> to(static_cast<std::size_t>(batches_.count) * kLanes * count);
  for (std::size_t i = 0; i < static_cast<std::size_t>(batches_.count) * kLanes; ++i) {
    const double* own = &from[std::min<std::size_t>(i, numEntities_ - 1) * count];
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
    std::copy_n(&of[std::min<std::size_t>(i, numEntities_ - 1) * count], count, &to[i * count]);
  return to;
}

// Copies that fill up the last batch weigh nothing.
std::vector<double> ElementArrays::withoutPadding(std::vector<double> weights) const {
  const std::size_t Q = Q_;
  for (std::size_t i = numEntities_; i * Q < weights.size(); ++i)
    for (std::size_t q = 0; q < Q; ++q) weights[(i / kLanes * Q + q) * kLanes + i % kLanes] = 0;
  return weights;
}

}  // namespace atrapos::fem
