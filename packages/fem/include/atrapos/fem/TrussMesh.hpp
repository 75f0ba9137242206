#pragma once

#include <array>
#include <string>
#include <vector>

#include "atrapos/fem/Mesh.hpp"

namespace atrapos::fem {

/// A truss by its nodes and bars.
struct TrussOptions {
  struct Set {
    std::string name;
    std::vector<int> nodes;  ///< from 1
  };
  std::vector<std::array<double, 3>> nodes;
  std::vector<std::array<int, 2>> bars;  ///< nodes at their ends, from 1
  std::vector<Set> sets;                 ///< named sets of nodes
  std::string blockName = "bars";
};

/// One block of BAR2 (id 1) and the node sets. Throws std::invalid_argument, one line, for nodes that are not
/// there, bars without length, two of the same bar, nodes without a bar.
Mesh trussMesh(const TrussOptions& options);

}  // namespace atrapos::fem
