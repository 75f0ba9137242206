#pragma once

#include <vector>

namespace atrapos::fem::detail {

/// What is to be shared out.
struct WeightedGraph {
  /// [vertex] its neighbours, each as often as the edge weighs, in both directions.
  std::vector<std::vector<int>> neighbours;
  std::vector<double> cost;  ///< [vertex]
};

/// [vertex] part, by METIS: parts of about the same cost with light edges between them. The same graph gives
/// the same parts on every machine with the same METIS; where there are fewer vertices than parts some stay
/// empty. Throws std::runtime_error where METIS fails.
std::vector<int> cut(WeightedGraph graph, int parts);

}  // namespace atrapos::fem::detail
