#include "atrapos/fem/Partition.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "GraphCut.hpp"

namespace atrapos::fem {
namespace {

/// A node of more elements (the load factor's own, a rigid body's) says nothing about neighbourhood.
constexpr std::size_t mostNeighbours = 64;

struct Entity {
  int term = 0, number = 0;
};

const int* nodesOf(const FeModel& model, const Entity& e) {
  const Term& term = *model.terms[e.term];
  return term.nodes().data() + static_cast<std::size_t>(e.number) * term.nodesPerEntity();
}

/// The elements of a model: entities whose nodes no other one has, with what goes with them.
struct Elements {
  std::vector<Entity> entity;              ///< [element]
  std::vector<double> cost;                ///< [element] with its faces and points
  std::vector<std::vector<int>> at;        ///< [node] elements
  std::vector<std::vector<int>> ofEntity;  ///< [term][entity] element
};

/// The element that has all these nodes, or -1.
int hostOf(const FeModel& model, const Elements& elements, const int* nodes, int count) {
  const int* rarest = std::min_element(
      nodes, nodes + count, [&](int a, int b) { return elements.at[a].size() < elements.at[b].size(); });
  for (const int h : elements.at[*rarest]) {
    const int* own = nodesOf(model, elements.entity[h]);
    const int size = model.terms[elements.entity[h].term]->nodesPerEntity();
    if (std::all_of(nodes, nodes + count, [&](int n) { return std::find(own, own + size, n) != own + size; }))
      return h;
  }
  return -1;
}

Elements elementsOf(const FeModel& model) {
  Elements elements;
  elements.at.resize(model.dofs.numNodes());
  elements.ofEntity.resize(model.terms.size());
  std::vector<int> order(model.terms.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return model.terms[a]->nodesPerEntity() > model.terms[b]->nodesPerEntity();
  });
  constexpr int usualOrder = 20;
  for (const int t : order) {
    const Term& term = *model.terms[t];
    const double cost =
        term.numEntities() > 0 ? static_cast<double>(term.historyBytes(usualOrder)) / term.numEntities() : 0;
    for (int e = 0; e < term.numEntities(); ++e) {
      const int* nodes = nodesOf(model, {t, e});
      int host = hostOf(model, elements, nodes, term.nodesPerEntity());
      if (host < 0) {
        host = static_cast<int>(elements.entity.size());
        elements.entity.push_back({t, e});
        elements.cost.push_back(0);
        for (int n = 0; n < term.nodesPerEntity(); ++n) elements.at[nodes[n]].push_back(host);
      }
      elements.cost[host] += cost;
      elements.ofEntity[t].push_back(host);
    }
  }
  return elements;
}

/// Groups of elements that stay together: [element] number of its group, groups numbered by their first one.
std::vector<int> groupsOf(const Elements& elements, const DofMap& dofs,
                          const std::vector<Coupling>& couplings, int& count) {
  std::vector<int> parent(elements.entity.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int e) {
    while (parent[e] != e) e = parent[e] = parent[parent[e]];
    return e;
  };
  for (const Coupling& c : couplings)
    for (const int e : elements.at[dofs.nodeOf(c.dof)]) {
      const int a = root(e), b = root(elements.at[dofs.nodeOf(c.dof)].front());
      parent[std::max(a, b)] = std::min(a, b);
    }
  std::vector<int> group(parent.size(), -1);
  count = 0;
  for (std::size_t e = 0; e < group.size(); ++e) {
    const int r = root(static_cast<int>(e));
    group[e] = r == static_cast<int>(e) ? count++ : group[r];
  }
  return group;
}

/// [group] rank, by METIS.
std::vector<int> cut(const FeModel& model, const Elements& elements, const std::vector<int>& group,
                     int numGroups, int numRanks) {
  detail::WeightedGraph graph;
  graph.neighbours.resize(numGroups);
  graph.cost.assign(numGroups, 0.0);
  // Edges weigh as many nodes as they share.
  for (std::size_t e = 0; e < group.size(); ++e) {
    graph.cost[group[e]] += elements.cost[e];
    const int* nodes = nodesOf(model, elements.entity[e]);
    for (int n = 0; n < model.terms[elements.entity[e].term]->nodesPerEntity(); ++n) {
      if (elements.at[nodes[n]].size() > mostNeighbours) continue;
      for (const int other : elements.at[nodes[n]])
        if (group[other] != group[e]) graph.neighbours[group[e]].push_back(group[other]);
    }
  }
  return detail::cut(std::move(graph), numRanks);
}

/// [group] rank that the model gives to its first element that has one, or the rank of a neighbour.
std::vector<int> given(const FeModel& model, const Elements& elements, const std::vector<int>& group,
                       int numGroups, int numRanks) {
  const auto rankOf = [&](int e) {
    const Entity& entity = elements.entity[e];
    const auto term = static_cast<std::size_t>(entity.term);
    if (term >= model.ranks.size() || model.ranks[term].empty()) return -1;
    if (model.ranks[term].size() != static_cast<std::size_t>(model.terms[term]->numEntities()))
      throw std::invalid_argument("FeModel: not every entity of a term has a rank");
    const int rank = model.ranks[term][entity.number];
    if (rank < 0 || rank >= numRanks)
      throw std::invalid_argument("FeModel: an element is given to rank " + std::to_string(rank) + " of " +
                                  std::to_string(numRanks));
    return rank;
  };
  std::vector<int> rank(numGroups, -1);
  for (std::size_t e = 0; e < group.size(); ++e)
    if (rank[group[e]] < 0) rank[group[e]] = rankOf(static_cast<int>(e));
  for (std::size_t e = 0; e < group.size(); ++e) {
    if (rank[group[e]] >= 0) continue;
    const int* nodes = nodesOf(model, elements.entity[e]);
    for (int n = 0; n < model.terms[elements.entity[e].term]->nodesPerEntity(); ++n)
      for (const int other : elements.at[nodes[n]])
        if (rank[group[e]] < 0) rank[group[e]] = rankOf(other);
  }
  for (int& r : rank) r = std::max(r, 0);
  return rank;
}

}  // namespace

Partition partition(const FeModel& model, const std::vector<Coupling>& couplings, int numRanks) {
  const Elements elements = elementsOf(model);
  int numGroups = 0;
  const auto group = groupsOf(elements, model.dofs, couplings, numGroups);
  const auto rankOfGroup = model.ranks.empty() ? cut(model, elements, group, numGroups, numRanks)
                                               : given(model, elements, group, numGroups, numRanks);

  Partition result;
  std::vector<std::vector<std::pair<int, int>>> ranksAt(model.dofs.numNodes());  // rank, number of entities
  const auto count = [&](int node, int rank) {
    for (auto& entry : ranksAt[node])
      if (entry.first == rank) {
        ++entry.second;
        return;
      }
    ranksAt[node].push_back({rank, 1});
  };
  result.entities.resize(model.terms.size());
  for (std::size_t t = 0; t < model.terms.size(); ++t)
    for (int e = 0; e < model.terms[t]->numEntities(); ++e) {
      const int rank = rankOfGroup[group[elements.ofEntity[t][e]]];
      result.entities[t].push_back(rank);
      const int* nodes = nodesOf(model, {static_cast<int>(t), e});
      for (int n = 0; n < model.terms[t]->nodesPerEntity(); ++n) count(nodes[n], rank);
    }
  result.nodes.assign(model.dofs.numNodes(), 0);
  for (int n = 0; n < model.dofs.numNodes(); ++n) {
    int most = 0;
    for (const auto& [rank, entities] : ranksAt[n])
      if (entities > most || (entities == most && rank < result.nodes[n])) {
        most = entities;
        result.nodes[n] = rank;
      }
  }
  for (const Coupling& c : couplings) result.couplings.push_back(result.nodes[model.dofs.nodeOf(c.dof)]);
  return result;
}

std::vector<int> partition(const Mesh& mesh, int numParts) {
  std::vector<std::vector<int>> at(mesh.numNodes());  // [node] elements
  const auto forEachNode = [&](const auto& f) {
    int element = 0;
    for (const Block& block : mesh.blocks) {
      const int N = nodesPerElement(block.topology), count = static_cast<int>(block.nodes.size()) / N;
      for (int e = 0; e < count; ++e, ++element)
        for (int n = 0; n < N; ++n) f(element, block.nodes[static_cast<std::size_t>(e) * N + n]);
    }
  };
  detail::WeightedGraph graph;
  graph.neighbours.resize(mesh.numElements());
  graph.cost.assign(mesh.numElements(), 0.0);
  forEachNode([&](int e, int node) {
    at[node].push_back(e);
    graph.cost[e] += 1;
  });
  forEachNode([&](int e, int node) {
    for (const int other : at[node])
      if (other != e) graph.neighbours[e].push_back(other);
  });
  return detail::cut(std::move(graph), numParts);
}

}  // namespace atrapos::fem
