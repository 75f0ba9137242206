#pragma once

#include <Tpetra_CrsGraph.hpp>
#include <string>

#include "atrapos/linear/Types.hpp"

namespace atrapos::linear {

/// The graph that a solver has analysed, and the checks that matrices and vectors must pass against it.
/// All members are collective and throw SolverError on all ranks alike; `solver` names the caller in
/// messages.
class AnalysedGraph {
 public:
  /// K must be fill-complete and square with equal row, range and domain maps.
  AnalysedGraph(const std::string& solver, const CrsMatrix& K);

  /// K has the same maps and entries as the analysed one, and finite values.
  void checkMatrix(const CrsMatrix& K) const;

  /// K equals its transpose, up to 1e-10 of its size in a random bilinear form x.Ky - y.Kx (two products with
  /// K).
  void checkSymmetry(const CrsMatrix& K) const;

  /// x and b live on the row map and have equally many columns.
  void checkVectors(const MultiVector& b, const MultiVector& x) const;

  const RCP<const Map>& rowMap() const { return rowMap_; }

 private:
  std::string solver_;
  RCP<const Map> rowMap_, columnMap_;
  CrsGraph::local_graph_host_type entries_;  // shares storage; survives a resumeFill of the graph itself
};

}  // namespace atrapos::linear
