#pragma once

#include <array>
#include <map>

#include "import/InpModel.hpp"

namespace atrapos::importer {

/// Axes of nodes by *TRANSFORM, in which their supports and forces are meant.
class InpTransforms {
 public:
  using Vector = std::array<double, 3>;
  using Axes = std::array<Vector, 3>;  ///< orthonormal

  /// Throws Error for axes that are none.
  explicit InpTransforms(const InpModel& model);

  /// Null where the node has those of the model.
  const Axes* find(int node) const {
    const auto at = axes_.find(node);
    return at == axes_.end() ? nullptr : &at->second;
  }
  /// A vector of the node's axes in those of the model.
  Vector inModel(int node, const Vector& v) const;

 private:
  void add(const InpModel& model, const InpCard& card);

  std::map<int, Axes> axes_;
};

}  // namespace atrapos::importer
