#pragma once

#include <vector>

#include "atrapos/fem/FeModel.hpp"

namespace atrapos::fem::detail {

/// Which neighbours of a node are wanted.
enum class Rows : char {
  none,
  share,  ///< those by a rank's own entities and couplings
  all
};

/// What one rank works on.
struct Share {
  std::vector<std::vector<char>> ofTerm;  ///< [term][entity]
  std::vector<char> ofCouplings;          ///< [coupling]
};

/// The node graph of a model, rows sorted: all nodes that share an entity of any term, coupled nodes with
/// their masters, each node with itself. Rows that are not wanted are empty.
std::vector<std::vector<int>> nodeGraph(const FeModel& model, const std::vector<Coupling>& couplings,
                                        const std::vector<Rows>& wanted, const Share& share);

}  // namespace atrapos::fem::detail
