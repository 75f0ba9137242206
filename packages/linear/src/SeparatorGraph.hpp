#pragma once

#include <metis.h>

#include <array>
#include <vector>

namespace atrapos::linear {

/// A graph as METIS takes it, without loops; its vertices stand for rows or for groups of rows.
struct SeparatorGraph {
  std::vector<idx_t> start{0};    ///< [vertex] of `neighbours`, and its end
  std::vector<idx_t> neighbours;  ///< ascending in each vertex
  std::vector<idx_t> weights;     ///< rows of each vertex
  std::vector<int> numbers;       ///< of the vertices in the graph that they came from
  int size() const { return static_cast<int>(numbers.size()); }
};

/// The graph of A + A^T of n rows, each a vertex. rows and columns are the entries' indices, from 1; entries
/// of one triangle are enough, duplicates do no harm. Throws SolverError where METIS' indices are too short.
SeparatorGraph rowGraph(int n, const std::vector<int>& rows, const std::vector<int>& columns);

/// Groups of rows with equal neighbours, themselves included, as those of a node are.
struct EqualRows {
  std::vector<std::vector<int>> rows;  ///< [group][row], ascending
  SeparatorGraph graph;                ///< its vertices are the groups
};

EqualRows groupEqual(const SeparatorGraph& rows);

/// A separator and the two halves that no edge joins without it; a half may be empty.
struct Separated {
  std::array<SeparatorGraph, 2> halves;
  std::vector<int> separator;  ///< by `numbers`
};

/// METIS' vertex separator, without the vertices that have neighbours in one half only. The graph stays as it
/// is (METIS takes no constants).
Separated separate(SeparatorGraph& graph);

}  // namespace atrapos::linear
