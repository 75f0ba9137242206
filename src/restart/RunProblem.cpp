#include "restart/RunProblem.hpp"

#include <fmt/format.h>

#include "deck/ProblemLines.hpp"

namespace atrapos {
namespace {

std::uint64_t digest(std::uint64_t first, std::uint64_t second, double third) {
  Digest d;
  d.add(first);
  d.add(second);
  d.add(&third, 1);
  return d.value();
}

std::uint64_t setsOf(const fem::Mesh& mesh) {
  Digest all;
  for (const fem::NodeSet& set : mesh.nodeSets) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < set.nodes.size(); ++i)
      sum += digest(static_cast<std::uint64_t>(set.nodes[i]), 0, set.factors.empty() ? 1.0 : set.factors[i]);
    all.add(set.name);
    all.add(static_cast<std::uint64_t>(set.id));
    all.add(sum);
  }
  for (const fem::SideSet& set : mesh.sideSets) {
    std::uint64_t sum = 0;
    for (const fem::Side& side : set.sides)
      sum += digest(static_cast<std::uint64_t>(side.element), static_cast<std::uint64_t>(side.side), 0.0);
    all.add(set.name);
    all.add(static_cast<std::uint64_t>(set.id));
    all.add(sum);
  }
  return all.value();
}

std::uint64_t blocksOf(const fem::Mesh& mesh) {
  Digest all;
  for (const fem::Block& block : mesh.blocks) {
    all.add(block.name);
    all.add(static_cast<std::uint64_t>(block.id));
    all.add(fem::topologyName(block.topology));
    for (const int node : block.nodes) all.add(static_cast<std::uint64_t>(node));
    all.add(block.attributes);
  }
  return all.value();
}

}  // namespace

MeshDigest digestOf(const fem::Mesh& mesh) {
  Digest places;
  places.add(mesh.coordinates);
  return {static_cast<std::uint64_t>(mesh.numNodes()), static_cast<std::uint64_t>(mesh.numElements()),
          places.value(), blocksOf(mesh), setsOf(mesh)};
}

std::string firstDifference(const RunProblem& before, const RunProblem& now) {
  const MeshDigest &a = before.mesh, &b = now.mesh;
  if (a.nodes != b.nodes || a.elements != b.elements)
    return fmt::format("the mesh had {} nodes and {} elements and has {} and {} now", a.nodes, a.elements,
                       b.nodes, b.elements);
  const std::string inDeck = deck::firstDifference(before.deck, now.deck);
  if (!inDeck.empty()) return inDeck;
  if (a.places != b.places) return "the nodes of the mesh were in other places";
  if (a.blocks != b.blocks) return "the elements of the mesh had other nodes or attributes";
  if (a.sets != b.sets) return "the sets of the mesh were other ones";
  return {};
}

}  // namespace atrapos
