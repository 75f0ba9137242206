#pragma once

#include <optional>
#include <set>
#include <unordered_map>

#include "import/InpModel.hpp"
#include "import/InpStep.hpp"

namespace atrapos::importer {

/// Rotations that are held at nodes of shells, as components of the directors' displacement w = theta x d
/// that are 0.
class ShellSupports {
 public:
  explicit ShellSupports(const InpModel& model);

  bool has(int node) const { return normalAxis_.count(node) > 0; }

  /// With all rotations held, all components. With the normal along an axis n, a turn about p (not n) moves
  /// the director along the third axis q alone; that about n does not move it. Else, with two rotations held,
  /// what is left turns about an axis a and moves nothing along a. Nothing where none of this is so.
  std::optional<std::set<int>> heldDirectors(int node, const InpSupport& support) const;

 private:
  std::unordered_map<int, int>
      normalAxis_;  ///< by node of a shell: 0 to 2, -1 where the normal is along no axis
};

}  // namespace atrapos::importer
