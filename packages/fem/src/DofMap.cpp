#include "atrapos/fem/DofMap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace atrapos::fem {

Field displacementField(int dimension) {
  if (dimension == 2) return {"displacement", {"x", "y"}, Role::primal, "forces"};
  return {"displacement", {"x", "y", "z"}, Role::primal, "forces"};
}

Field directorField() { return {"director's change", {"x", "y", "z"}, Role::primal, "forces"}; }

DofMap::DofMap(int numNodes, const std::vector<Located>& fields) {
  std::vector<std::vector<int>> of(numNodes);
  for (const Located& located : fields) {
    const int f = fieldNumber(located.field);
    if (located.nodes.empty())
      for (auto& list : of) list.push_back(f);
    for (const int n : located.nodes) of.at(n).push_back(f);
  }
  for (const auto& list : of) {
    layout_.push_back(layoutNumber(list));
    start_.push_back(start_.back() + sizeOf(layout_.back()));
  }
}

DofMap DofMap::displacements(int numNodes, int dimension) {
  return DofMap(numNodes, {{displacementField(dimension), {}}});
}

int DofMap::addNodes(int count, const Field& field) {
  const int first = numNodes(), layout = layoutNumber({fieldNumber(field)});
  for (int n = 0; n < count; ++n) {
    layout_.push_back(layout);
    start_.push_back(start_.back() + field.numComponents());
  }
  return first;
}

DofMap DofMap::part(const std::vector<int>& nodes) const {
  DofMap result = *this;
  result.layout_.clear();
  result.start_ = {0};
  for (const int n : nodes) {
    result.layout_.push_back(layout_[n]);
    result.start_.push_back(result.start_.back() + numDofs(n));
  }
  return result;
}

int DofMap::find(const std::string& name) const {
  const auto at =
      std::find_if(fields_.begin(), fields_.end(), [&](const Field& f) { return f.name == name; });
  return at == fields_.end() ? -1 : static_cast<int>(at - fields_.begin());
}

int DofMap::firstFieldSize(int node) const {
  const auto& fields = layouts_[layout_[node]];
  return fields.empty() ? 0 : fields_[fields.front()].numComponents();
}

DofMap::Address DofMap::addressOf(int dof) const {
  if (dof < 0 || dof >= numDofs())
    throw std::out_of_range(fmt::format("DofMap: there is no unknown {}", dof));
  const int node = static_cast<int>(std::upper_bound(start_.begin(), start_.end(), dof) - start_.begin()) - 1;
  int component = dof - start_[node];
  for (const int f : layouts_[layout_[node]]) {
    if (component < fields_[f].numComponents()) return {f, node, component};
    component -= fields_[f].numComponents();
  }
  throw std::logic_error("DofMap: an unknown without a field");
}

std::vector<int> DofMap::dofsWith(Role role) const {
  std::vector<int> dofs;
  for (int n = 0; n < numNodes(); ++n)
    for (const int f : layouts_[layout_[n]])
      if (fields_[f].role == role)
        for (int c = 0; c < fields_[f].numComponents(); ++c) dofs.push_back(dof(f, n, c));
  return dofs;
}

std::string DofMap::nameOf(int dof) const {
  const Address at = addressOf(dof);
  const Field& field = fields_[at.field];
  const std::string& component = field.components[at.component];
  return fmt::format("{}{}{} of node {}", field.name, component.empty() ? "" : " ", component, at.node + 1);
}

std::vector<double> DofMap::vectors(const std::vector<double>& dofs) const {
  std::vector<double> result(3 * static_cast<std::size_t>(numNodes()), 0.0);
  for (int n = 0; n < numNodes(); ++n)
    if (const int size = firstFieldSize(n); size > 1 && size <= 3)
      std::copy_n(&dofs[start_[n]], size, &result[3 * static_cast<std::size_t>(n)]);
  return result;
}

std::vector<double> DofMap::fromVectors(const std::vector<double>& vectors) const {
  std::vector<double> result(numDofs(), 0.0);
  for (int n = 0; n < numNodes() && 3 * static_cast<std::size_t>(n) < vectors.size(); ++n)
    if (const int size = firstFieldSize(n); size > 1 && size <= 3)
      std::copy_n(&vectors[3 * static_cast<std::size_t>(n)], size, &result[start_[n]]);
  return result;
}

int DofMap::fieldNumber(const Field& field) {
  const int known = find(field.name);
  if (known < 0) {
    fields_.push_back(field);
    for (auto& offsets : offsets_) offsets.push_back(-1);
    const std::string own = !field.balance.empty()                            ? field.balance
                            : field.role == Role::primal || balances_.empty() ? field.name
                                                                              : balances_.front();
    const auto at = std::find(balances_.begin(), balances_.end(), own);
    balanceOf_.push_back(static_cast<int>(at - balances_.begin()));
    if (at == balances_.end()) balances_.push_back(own);
    return static_cast<int>(fields_.size()) - 1;
  }
  if (fields_[known].components != field.components || fields_[known].role != field.role)
    throw std::logic_error(fmt::format("DofMap: two fields are called '{}'", field.name));
  return known;
}

int DofMap::layoutNumber(const std::vector<int>& fields) {
  const auto at = std::find(layouts_.begin(), layouts_.end(), fields);
  if (at != layouts_.end()) return static_cast<int>(at - layouts_.begin());
  layouts_.push_back(fields);
  offsets_.emplace_back(fields_.size(), -1);
  int offset = 0;
  for (const int f : fields) {
    offsets_.back()[f] = offset;
    offset += fields_[f].numComponents();
  }
  return static_cast<int>(layouts_.size()) - 1;
}

int DofMap::sizeOf(int layout) const {
  int size = 0;
  for (const int f : layouts_[layout]) size += fields_[f].numComponents();
  return size;
}

}  // namespace atrapos::fem
