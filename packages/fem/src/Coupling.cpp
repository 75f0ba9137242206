#include "atrapos/fem/Coupling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace atrapos::fem {

bool Couplings::driven() const {
  return std::any_of(couplings_.begin(), couplings_.end(),
                     [](const Coupling& c) { return c.perLoadFactor != 0; });
}

std::vector<Coupling> Couplings::resolved(const DofMap& dofs, const Supports& supports) const {
  const auto nameOf = [&](int dof) { return dofs.nameOf(dof); };
  std::map<int, std::size_t> slaves;
  for (std::size_t c = 0; c < couplings_.size(); ++c) {
    const Coupling& coupling = couplings_[c];
    const auto inModel = [&](int dof) { return dof >= 0 && dof < dofs.numDofs(); };
    if (!inModel(coupling.dof))
      throw std::invalid_argument(
          fmt::format("a coupling is of unknown {}, which the model does not have", coupling.dof));
    for (const CoupledDof& m : coupling.masters) {
      if (!inModel(m.dof))
        throw std::invalid_argument(fmt::format(
            "a coupling of {} names an unknown that the model does not have", nameOf(coupling.dof)));
      if (m.dof == coupling.dof)
        throw std::invalid_argument(fmt::format("{} is coupled to itself", nameOf(coupling.dof)));
    }
    if (supports.fixed(coupling.dof))
      throw std::invalid_argument(
          fmt::format("{} is both supported and coupled: support its masters", nameOf(coupling.dof)));
    if (!slaves.insert({coupling.dof, c}).second)
      throw std::invalid_argument(fmt::format("{} is coupled twice", nameOf(coupling.dof)));
  }
  std::vector<Coupling> result;
  for (const Coupling& coupling : couplings_) {
    Coupling row{coupling.dof, {}, coupling.value, coupling.perLoadFactor};
    std::map<int, double> masters;
    std::vector<CoupledDof> open = coupling.masters;
    // A chain visits each coupling once; one that is longer comes back to a slave of its own.
    for (std::size_t depth = 0; !open.empty(); ++depth) {
      if (depth > couplings_.size())
        throw std::invalid_argument(fmt::format("{} depends on itself by its couplings", nameOf(row.dof)));
      std::vector<CoupledDof> next;
      for (const CoupledDof& m : open) {
        const auto slave = slaves.find(m.dof);
        if (slave == slaves.end()) {
          masters[m.dof] += m.factor;
          continue;
        }
        const Coupling& other = couplings_[slave->second];
        row.value += m.factor * other.value;
        row.perLoadFactor += m.factor * other.perLoadFactor;
        for (const CoupledDof& o : other.masters) next.push_back({o.dof, m.factor * o.factor});
      }
      open = std::move(next);
    }
    for (const auto& [dof, factor] : masters)
      if (factor != 0) row.masters.push_back({dof, factor});
    result.push_back(std::move(row));
  }
  return result;
}

void coupleNode(Couplings& couplings, const DofMap& dofs, int node, const std::vector<CoupledNode>& masters) {
  for (int i = 0; i < dofs.firstFieldSize(node); ++i) {
    Coupling c;
    c.dof = dofs.firstDof(node) + i;
    for (const CoupledNode& m : masters) c.masters.push_back({dofs.firstDof(m.node) + i, m.factor});
    couplings.add(std::move(c));
  }
}

void coupleEqual(Couplings& couplings, const DofMap& dofs, const std::vector<int>& nodes) {
  for (std::size_t n = 1; n < nodes.size(); ++n) coupleNode(couplings, dofs, nodes[n], {{nodes[0], 1}});
}

void couplePlane(Couplings& couplings, const DofMap& dofs, const std::vector<int>& nodes,
                 const std::array<double, 3>& normal) {
  // The slave is the component that the normal has most of: factors of at most 1.
  int pivot = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(normal[i]) > std::abs(normal[pivot])) pivot = i;
  if (!(std::abs(normal[pivot]) > 0) || !std::isfinite(normal[0] + normal[1] + normal[2]))
    throw std::invalid_argument("a coupled plane needs a normal of finite length");
  for (std::size_t n = 1; n < nodes.size(); ++n) {
    const int own = dofs.firstDof(nodes[n]), first = dofs.firstDof(nodes[0]);
    Coupling c;
    c.dof = own + pivot;
    for (int i = 0; i < dofs.firstFieldSize(nodes[n]); ++i) {
      const double factor = normal[i] / normal[pivot];
      if (factor == 0) continue;
      c.masters.push_back({first + i, factor});
      if (i != pivot) c.masters.push_back({own + i, -factor});
    }
    couplings.add(std::move(c));
  }
}

void coupleShellToSolid(Couplings& couplings, const DofMap& dofs, int shellNode, int directorNode, int top,
                        int bottom, bool joinMidsurface) {
  if (joinMidsurface) coupleNode(couplings, dofs, shellNode, {{top, 0.5}, {bottom, 0.5}});
  coupleNode(couplings, dofs, directorNode, {{top, 0.5}, {bottom, -0.5}});
}

}  // namespace atrapos::fem
