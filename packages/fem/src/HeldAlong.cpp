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

/// a . u = value + lambda rate at a node, in the making. Row r comes of the r-th condition that stays, of
/// unit vector d_r: a = sum of A_r d_r.
struct HeldRow {
  int condition = 0;
  Vec3 a{}, A{};
  double value = 0, rate = 0;
  int pivot = -1;

  void subtract(double factor, const HeldRow& other) {
    add(-factor, other.a, a);
    add(-factor, other.A, A);
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
    HeldRow row{condition, scaled(1 / length, held.direction), {}, held.value, held.perLoadFactor};
    if (rows_.size() < 3) row.A[rows_.size()] = 1;  // a fourth follows from the others
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
    // Forces mu_r along the d_r make the slaves' f_p = sum_r mu_r d_r,p at the pivots p. Each row is 1 at its
    // own pivot and 0 at the others': mu_r = sum over rows of f_p A_r.
    for (const HeldRow& row : rows_)
      for (std::size_t r = 0; r < rows_.size(); ++r)
        if (row.A[r] != 0) forces[rows_[r].condition].push_back({dof(row.pivot), row.A[r]});
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

  FeModel& model_;
  int node_, size_;
  std::vector<HeldRow> rows_;
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
