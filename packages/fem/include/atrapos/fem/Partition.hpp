#pragma once

#include <vector>

#include "atrapos/fem/FeProblem.hpp"

namespace atrapos::fem {

/// Which rank works on what (docs/theory/parallel.md).
struct Partition {
  std::vector<std::vector<int>> entities;  ///< [term][entity] rank that runs the law there
  std::vector<int> couplings;              ///< [coupling] rank that eliminates it: the owner of its slave
  std::vector<int> nodes;                  ///< [node] rank that owns the rows of its dofs
};

/// Shares a model out over ranks. METIS cuts the graph of the elements, joined where they share nodes, so
/// that all ranks have about the same to do and few nodes are shared; an entity counts by the bytes of its
/// histories, which are what a step's orders read. Faces and points go with an element that has their nodes;
/// all elements at a coupling's slave stay together. A node belongs to the rank that has most entities there,
/// the lowest of equals; a node without an entity to rank 0.
///
/// The same model gives the same partition on every machine with the same METIS. A rank may be left without
/// anything where there are few elements. `couplings`: resolved. Throws std::runtime_error where METIS fails.
Partition partition(const FeModel& model, const std::vector<Coupling>& couplings, int numRanks);

}  // namespace atrapos::fem
