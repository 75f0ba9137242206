#include "GraphCut.hpp"

#include <metis.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace atrapos::fem::detail {

std::vector<int> cut(WeightedGraph graph, int parts) {
  const int count = static_cast<int>(graph.neighbours.size());
  std::vector<idx_t> start{0}, adjacent, edgeWeight, weight(count, 1);
  for (auto& list : graph.neighbours) {
    std::sort(list.begin(), list.end());
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (i == 0 || list[i] != list[i - 1]) {
        adjacent.push_back(list[i]);
        edgeWeight.push_back(0);
      }
      ++edgeWeight.back();
    }
    start.push_back(static_cast<idx_t>(adjacent.size()));
    list = {};
  }
  const double largest = count > 0 ? *std::max_element(graph.cost.begin(), graph.cost.end()) : 0;
  // Whole numbers whose sum METIS' 32 bits can hold.
  const double scale = largest > 0 ? std::min(1000.0, 1e9 / count) / largest : 0;
  for (int v = 0; v < count; ++v) weight[v] += static_cast<idx_t>(scale * graph.cost[v]);

  std::vector<idx_t> part(count, 0);
  // METIS' bisection would number a single part 1.
  if (parts == 1) return {part.begin(), part.end()};
  // Nothing for METIS to decide.
  if (adjacent.empty() || count < parts) {
    for (int v = 0; v < count; ++v) part[v] = static_cast<idx_t>(static_cast<long long>(v) * parts / count);
    return {part.begin(), part.end()};
  }
  idx_t options[METIS_NOPTIONS], vertices = count, constraints = 1, numParts = parts, edgeCut = 0;
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_NUMBERING] = 0;
  options[METIS_OPTION_SEED] = 1;
  // METIS' manual: bisection for few parts, where it balances better.
  const auto method = parts <= 8 ? METIS_PartGraphRecursive : METIS_PartGraphKway;
  const int status = method(&vertices, &constraints, start.data(), adjacent.data(), weight.data(), nullptr,
                            edgeWeight.data(), &numParts, nullptr, nullptr, options, &edgeCut, part.data());
  if (status != METIS_OK)
    throw std::runtime_error("METIS: cutting " + std::to_string(count) + " elements into " +
                             std::to_string(parts) + " parts failed (code " + std::to_string(status) + ")");
  return {part.begin(), part.end()};
}

}  // namespace atrapos::fem::detail
