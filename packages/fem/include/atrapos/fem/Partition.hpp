#pragma once

#include <vector>

#include "atrapos/fem/FeModel.hpp"
#include "atrapos/fem/Mesh.hpp"

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
///
/// Where the model gives ranks to its elements (FeModel::ranks) these are kept instead, but for elements at a
/// coupling's slave, which go to the rank of the first of them; an element without a rank, as those of the
/// load factor's own node, goes to the rank of a neighbour.
Partition partition(const FeModel& model, const std::vector<Coupling>& couplings, int numRanks);

/// A mesh in parts, for all that may be done with it: [element over all blocks] part. METIS cuts the graph of
/// the elements, which weigh as many as they have nodes, edges as many nodes as two elements share. As above,
/// the same mesh gives the same parts, and some may be empty. Throws std::runtime_error where METIS fails.
std::vector<int> partition(const Mesh& mesh, int numParts);

}  // namespace atrapos::fem
