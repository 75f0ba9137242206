#include "atrapos/fem/FeModel.hpp"

#include <stdexcept>

namespace atrapos::fem {

namespace {

int dofOf(const DofMap& dofs, int node, int component, const std::string& field) {
  const int number = field.empty() ? -1 : dofs.find(field);
  const bool there = field.empty() ? component < dofs.firstFieldSize(node)
                                   : number >= 0 && dofs.dof(number, node, component) >= 0;
  if (!there || component < 0)
    throw std::invalid_argument("node " + std::to_string(node + 1) + " has no component " +
                                std::to_string(component + 1) + " of a field to prescribe");
  return field.empty() ? dofs.firstDof(node) + component : dofs.dof(number, node, component);
}

}  // namespace

void FeModel::prescribe(int node, int component, double value, double perLoadFactor,
                        const std::string& field) {
  supports.prescribe(dofOf(dofs, node, component, field), value, perLoadFactor);
}

void FeModel::release(int node, int component, const std::string& field) {
  supports.release(dofOf(dofs, node, component, field));
}

}  // namespace atrapos::fem
