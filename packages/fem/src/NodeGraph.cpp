#include "NodeGraph.hpp"

#include <algorithm>

namespace atrapos::fem::detail {
namespace {

void sortUnique(std::vector<int>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

std::vector<std::vector<int>> nodeGraph(const FeModel& model, const std::vector<Coupling>& couplings,
                                        const std::vector<Rows>& wanted, const Share& share) {
  std::vector<std::vector<int>> rows(model.dofs.numNodes()), masters(rows.size());
  std::vector<char> shared(rows.size(), 0);  // whether the couplings of a slave's node are
  for (std::size_t c = 0; c < couplings.size(); ++c) {
    const int slave = model.dofs.nodeOf(couplings[c].dof);
    for (const CoupledDof& m : couplings[c].masters) masters[slave].push_back(model.dofs.nodeOf(m.dof));
    shared[slave] = !share.ofCouplings.empty() && share.ofCouplings[c];
  }
  for (auto& nodes : masters) sortUnique(nodes);
  const auto connect = [&](const std::vector<int>& group, bool own) {
    for (int a : group)
      if (wanted[a] == Rows::all || (own && wanted[a] == Rows::share))
        rows[a].insert(rows[a].end(), group.begin(), group.end());
  };
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    const Term& term = *model.terms[t];
    const int N = term.nodesPerEntity();
    const std::vector<int>& nodes = term.nodes();
    for (int e = 0; e < term.numEntities(); ++e) {
      std::vector<int> group(nodes.begin() + e * N, nodes.begin() + (e + 1) * N);
      for (int a = 0; a < N; ++a) {
        const auto& more = masters[nodes[e * N + a]];
        group.insert(group.end(), more.begin(), more.end());
      }
      connect(group, !share.ofTerm.empty() && share.ofTerm[t][e]);
    }
  }
  for (int n = 0; n < model.dofs.numNodes(); ++n) {
    if (masters[n].empty()) continue;
    std::vector<int> group = masters[n];
    group.push_back(n);
    connect(group, shared[n]);
  }
  for (int n = 0; n < model.dofs.numNodes(); ++n) {
    if (wanted[n] == Rows::none) continue;
    auto& row = rows[n];
    row.push_back(n);
    sortUnique(row);
    row.shrink_to_fit();
  }
  return rows;
}

}  // namespace atrapos::fem::detail
