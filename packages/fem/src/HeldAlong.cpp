#include "atrapos/fem/HeldAlong.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "Vec3.hpp"

namespace atrapos::fem {
namespace {

/// Directions at a node are the same, or across what is supported, where sines are below this.
constexpr double parallel = 1e-9;

/// a . u = value + lambda rate at a node, in the making.
struct HeldRow {
  int condition = 0;
  Vec3 a{};
  double value = 0, rate = 0;
  int pivot = -1;

  void subtract(double factor, const HeldRow& other) {
    add(-factor, other.a, a);
    value -= factor * other.value;
    rate -= factor * other.rate;
  }
};

class HeldNode {
 public:
  HeldNode(FeModel& model, int node) : model_(model), node_(node), size_(model.dofs.firstFieldSize(node)) {}

  void hold(int condition, const HeldAlong& held) {
    const double length = norm(held.direction);
    if (!(length > 0) || !std::isfinite(length))
      throw std::invalid_argument("a direction that is held needs a finite length");
    HeldRow row{condition, scaled(1 / length, held.direction), held.value, held.perLoadFactor};
    directions_[condition] = row.a;
    for (const HeldRow& other : rows_) {
      row.subtract(row.a[other.pivot], other);
      row.a[other.pivot] = 0;
    }
    for (int i = 0; i < size_; ++i)
      if (!model_.supports.fixed(dof(i)) && std::abs(row.a[i]) > parallel &&
          (row.pivot < 0 || std::abs(row.a[i]) > std::abs(row.a[row.pivot])))
        row.pivot = i;
    if (row.pivot < 0) return requireSame(row);
    const double pivot = row.a[row.pivot];
    row.subtract(1 - 1 / pivot, HeldRow(row));
    row.a[row.pivot] = 1;
    for (HeldRow& other : rows_) {
      other.subtract(other.a[row.pivot], row);
      other.a[row.pivot] = 0;
    }
    rows_.push_back(row);
  }

  void couple(std::vector<ForceAlong>& forces) const {
    for (const HeldRow& row : rows_) {
      Coupling c{dof(row.pivot), {}, row.value, row.rate};
      for (int i = 0; i < size_; ++i)
        if (i != row.pivot && std::abs(row.a[i]) > parallel) c.masters.push_back({dof(i), -row.a[i]});
      model_.couplings.add(std::move(c));
    }
    // Forces mu_k along the directions d_k make the slaves' f_j = sum_k mu_k d_k,j. The rows are combinations
    // of the directions, row_j = sum_k A_jk d_k with row_j,p = delta_jp at the pivots p: mu_k = sum_j f_j
    // A_jk.
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const std::vector<double> A = combination(rows_[k]);
      for (std::size_t j = 0; j < rows_.size(); ++j)
        if (A[j] != 0) forces[rows_[j].condition].push_back({dof(rows_[k].pivot), A[j]});
    }
  }

 private:
  int dof(int component) const { return model_.dofs.firstDof(node_) + component; }

  /// What other supports hold already must be the same.
  void requireSame(const HeldRow& row) const {
    double value = row.value, rate = row.rate, size = std::abs(value) + std::abs(rate);
    for (int i = 0; i < size_; ++i)
      if (model_.supports.fixed(dof(i))) {
        const double own = model_.supports.value(dof(i)), change = model_.supports.perLoadFactor(dof(i));
        value -= row.a[i] * own;
        rate -= row.a[i] * change;
        size += std::abs(row.a[i]) * (std::abs(own) + std::abs(change));
      }
    if (std::abs(value) + std::abs(rate) > 1e-9 * size)
      throw std::invalid_argument(
          fmt::format("{} is held along a direction and by other supports with different values",
                      model_.dofs.nameOf(dof(0))));
  }

  /// A_jk of a row: by the pivots, at which the directions are a square matrix of at most three rows.
  std::vector<double> combination(const HeldRow& row) const {
    const std::size_t n = rows_.size();
    // sum_k A_k d_k,p = delta at all pivots p: Gauss-Jordan.
    std::vector<std::vector<double>> m(n, std::vector<double>(n + 1));
    for (std::size_t p = 0; p < n; ++p) {
      for (std::size_t k = 0; k < n; ++k) m[p][k] = directions_.at(rows_[k].condition)[rows_[p].pivot];
      m[p][n] = rows_[p].pivot == row.pivot ? 1 : 0;
    }
    for (std::size_t c = 0; c < n; ++c) {
      std::size_t best = c;
      for (std::size_t p = c + 1; p < n; ++p)
        if (std::abs(m[p][c]) > std::abs(m[best][c])) best = p;
      std::swap(m[c], m[best]);
      for (std::size_t p = 0; p < n; ++p) {
        if (p == c) continue;
        const double factor = m[p][c] / m[c][c];
        for (std::size_t q = c; q <= n; ++q) m[p][q] -= factor * m[c][q];
      }
    }
    std::vector<double> A(n);
    for (std::size_t c = 0; c < n; ++c) A[c] = m[c][n] / m[c][c];
    return A;
  }

  FeModel& model_;
  int node_, size_;
  std::vector<HeldRow> rows_;
  std::map<int, Vec3> directions_;  ///< unit vectors, by condition
};

}  // namespace

std::vector<ForceAlong> holdAlong(FeModel& model, const std::vector<HeldAlong>& conditions) {
  std::map<int, HeldNode> nodes;
  for (std::size_t c = 0; c < conditions.size(); ++c)
    nodes.try_emplace(conditions[c].node, model, conditions[c].node)
        .first->second.hold(static_cast<int>(c), conditions[c]);
  std::vector<ForceAlong> forces(conditions.size());
  for (const auto& entry : nodes) entry.second.couple(forces);
  return forces;
}

}  // namespace atrapos::fem
