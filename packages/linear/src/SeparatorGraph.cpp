#include "SeparatorGraph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "MetisOptions.hpp"
#include "atrapos/linear/Error.hpp"

namespace atrapos::linear {
namespace {

constexpr int onSeparator = 2;  // METIS' part number; the halves are 0 and 1

const idx_t* beginOf(const SeparatorGraph& g, int v) { return g.neighbours.data() + g.start[v]; }
const idx_t* endOf(const SeparatorGraph& g, int v) { return g.neighbours.data() + g.start[v + 1]; }

// Whether neighbours v and w have the same neighbours but for each other.
bool equal(const SeparatorGraph& g, int v, int w) {
  const idx_t *a = beginOf(g, v), *b = beginOf(g, w);
  for (;; ++a, ++b) {
    if (a != endOf(g, v) && *a == w) ++a;
    if (b != endOf(g, w) && *b == v) ++b;
    if (a == endOf(g, v) || b == endOf(g, w)) return a == endOf(g, v) && b == endOf(g, w);
    if (*a != *b) return false;
  }
}

SeparatorGraph half(const SeparatorGraph& g, const std::vector<idx_t>& part, idx_t which) {
  SeparatorGraph result;
  std::vector<idx_t> place(g.size(), -1);
  for (int v = 0; v < g.size(); ++v)
    if (part[v] == which) {
      place[v] = static_cast<idx_t>(result.size());
      result.numbers.push_back(g.numbers[v]);
      result.weights.push_back(g.weights[v]);
    }
  for (int v = 0; v < g.size(); ++v) {
    if (part[v] != which) continue;
    for (const idx_t* w = beginOf(g, v); w != endOf(g, v); ++w)
      if (place[*w] >= 0) result.neighbours.push_back(place[*w]);
    result.start.push_back(static_cast<idx_t>(result.neighbours.size()));
  }
  return result;
}

// Moves vertices of the separator that separate nothing into the half that they belong to.
void thin(const SeparatorGraph& g, std::vector<idx_t>& part) {
  for (bool moved = true; moved;) {
    moved = false;
    for (int v = 0; v < g.size(); ++v) {
      if (part[v] != onSeparator) continue;
      bool beside[3] = {};
      for (const idx_t* w = beginOf(g, v); w != endOf(g, v); ++w) beside[part[*w]] = true;
      if (beside[0] && beside[1]) continue;
      part[v] = beside[0] ? 0 : 1;
      moved = true;
    }
  }
}

}  // namespace

SeparatorGraph rowGraph(int n, const std::vector<int>& rows, const std::vector<int>& columns) {
  std::vector<std::size_t> start(n + 1, 0);
  for (std::size_t e = 0; e < rows.size(); ++e)
    if (rows[e] != columns[e]) {
      ++start[rows[e]];
      ++start[columns[e]];
    }
  for (int i = 0; i < n; ++i) start[i + 1] += start[i];
  if (start[n] > static_cast<std::size_t>(std::numeric_limits<idx_t>::max()))
    throw SolverError(fmt::format("METIS: {} edges are more than its indices can count", start[n]));
  SeparatorGraph graph;
  graph.neighbours.resize(start[n]);
  auto next = start;
  for (std::size_t e = 0; e < rows.size(); ++e)
    if (rows[e] != columns[e]) {
      graph.neighbours[next[rows[e] - 1]++] = columns[e] - 1;
      graph.neighbours[next[columns[e] - 1]++] = rows[e] - 1;
    }
  std::size_t used = 0;
  for (int i = 0; i < n; ++i) {
    const auto begin = graph.neighbours.begin() + start[i], end = graph.neighbours.begin() + start[i + 1];
    std::sort(begin, end);
    const auto last = std::unique(begin, end);
    std::copy(begin, last, graph.neighbours.begin() + used);  // never overtakes what is still to be read
    used += last - begin;
    graph.start.push_back(static_cast<idx_t>(used));
    graph.numbers.push_back(i);
  }
  graph.neighbours.resize(used);
  graph.weights.assign(n, 1);
  return graph;
}

EqualRows groupEqual(const SeparatorGraph& rows) {
  EqualRows result;
  auto& [groups, graph] = result;
  std::vector<int> groupOf(rows.size());
  for (int v = 0; v < rows.size(); ++v) {
    // Equal rows are neighbours: the first of the group, if there is one, is among v's.
    int group = -1;
    for (const idx_t* w = beginOf(rows, v); w != endOf(rows, v) && *w < v && group < 0; ++w)
      if (groups[groupOf[*w]].front() == *w && equal(rows, v, *w)) group = groupOf[*w];
    if (group < 0) {
      group = static_cast<int>(groups.size());
      groups.emplace_back();
    }
    groupOf[v] = group;
    groups[group].push_back(v);
  }
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const int first = groups[g].front();
    for (const idx_t* w = beginOf(rows, first); w != endOf(rows, first); ++w)
      if (const int other = groupOf[*w]; groups[other].front() == *w && other != static_cast<int>(g))
        graph.neighbours.push_back(other);  // ascending, as groups are numbered by their first rows
    graph.start.push_back(static_cast<idx_t>(graph.neighbours.size()));
    graph.weights.push_back(static_cast<idx_t>(groups[g].size()));
    graph.numbers.push_back(static_cast<int>(g));
  }
  return result;
}

Separated separate(SeparatorGraph& graph) {
  auto options = metisOptions();
  idx_t size = graph.size(), weight = 0;
  std::vector<idx_t> part(graph.size());
  const int status = METIS_ComputeVertexSeparator(&size, graph.start.data(), graph.neighbours.data(),
                                                  graph.weights.data(), options.data(), &weight, part.data());
  if (status != METIS_OK)
    throw SolverError(fmt::format("METIS: separating {} vertices failed (code {})", size, status));
  thin(graph, part);
  Separated result;
  for (int v = 0; v < graph.size(); ++v)
    if (part[v] == onSeparator) result.separator.push_back(graph.numbers[v]);
  for (const idx_t side : {0, 1}) result.halves[side] = half(graph, part, side);
  return result;
}

}  // namespace atrapos::linear
