#include "NestedDissection.hpp"

#include <fmt/format.h>

#include <utility>

#include "MetisOptions.hpp"
#include "SeparatorGraph.hpp"
#include "atrapos/linear/Error.hpp"

namespace atrapos::linear {
namespace {

constexpr int fewVertices = 25;  // less fill than 50, and no more than 15 or 8

// Small graphs, and those that no separator cuts.
void appendOrdered(SeparatorGraph graph, std::vector<int>& sequence) {
  if (graph.neighbours.empty()) {  // METIS does not take a graph without edges
    sequence.insert(sequence.end(), graph.numbers.begin(), graph.numbers.end());
    return;
  }
  auto options = metisOptions();
  idx_t size = graph.size();
  std::vector<idx_t> order(size), inverse(size);
  const int status = METIS_NodeND(&size, graph.start.data(), graph.neighbours.data(), graph.weights.data(),
                                  options.data(), order.data(), inverse.data());
  if (status != METIS_OK)
    throw SolverError(fmt::format("METIS: ordering {} vertices failed (code {})", size, status));
  for (const idx_t v : order) sequence.push_back(graph.numbers[v]);
}

void dissect(SeparatorGraph graph, std::vector<int>& sequence) {
  if (graph.size() <= fewVertices || graph.neighbours.empty())
    return appendOrdered(std::move(graph), sequence);
  auto [halves, separator] = separate(graph);
  if (halves[0].size() == 0 || halves[1].size() == 0) return appendOrdered(std::move(graph), sequence);
  graph = {};  // its memory is wanted for the halves of the halves
  for (SeparatorGraph& half : halves) dissect(std::move(half), sequence);
  sequence.insert(sequence.end(), separator.begin(), separator.end());
}

}  // namespace

std::vector<int> nestedDissection(int n, const std::vector<int>& rows, const std::vector<int>& columns) {
  auto [groups, graph] = groupEqual(rowGraph(n, rows, columns));
  std::vector<int> sequence;
  dissect(std::move(graph), sequence);
  std::vector<int> place(n);
  int next = 0;
  for (const int group : sequence)
    for (const int row : groups[group]) place[row] = ++next;
  return place;
}

}  // namespace atrapos::linear
