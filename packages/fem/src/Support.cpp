#include "atrapos/fem/Support.hpp"

#include <fmt/format.h>

#include <Teuchos_LAPACK.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <stdexcept>

namespace atrapos::fem {

void Supports::prescribe(int dof, double value, double perLoadFactor) {
  if (dof < 0) throw std::invalid_argument("a support of a field that the node does not have");
  const auto [at, added] = prescribed_.insert({dof, {value, perLoadFactor}});
  if (!added && (at->second.value != value || at->second.rate != perLoadFactor))
    throw std::invalid_argument(fmt::format("unknown {} is prescribed twice with different values", dof));
}

bool Supports::driven() const {
  return std::any_of(prescribed_.begin(), prescribed_.end(),
                     [](const auto& p) { return p.second.rate != 0; });
}

namespace {

/// Six rigid motions at a point, as columns of the three displacement components; lengths scaled to order 1.
std::array<std::array<double, 6>, 3> rigidMotions(const double* x, const double* centre, double size) {
  const double a = (x[0] - centre[0]) / size, b = (x[1] - centre[1]) / size, c = (x[2] - centre[2]) / size;
  return {{{1, 0, 0, 0, c, -b}, {0, 1, 0, -c, 0, a}, {0, 0, 1, b, -a, 0}}};
}

int rank(std::array<double, 36> gram) {
  std::array<double, 6> eigenvalues{};
  std::array<double, 64> work{};
  int info = 0;
  Teuchos::LAPACK<int, double>().SYEV('N', 'U', 6, gram.data(), 6, eigenvalues.data(), work.data(), 64,
                                      &info);
  // Motions are scaled to order 1, so eigenvalues of held motions are of the order of the number of held dofs
  // times a shape factor (a thin clamped face: thickness over size, squared); 1e-12 is far below any of these
  // and far above rounding.
  return static_cast<int>(std::count_if(eigenvalues.begin(), eigenvalues.end(),
                                        [&](double e) { return e > 1e-12 * std::max(1.0, eigenvalues[5]); }));
}

}  // namespace

std::vector<FreeBody> freeBodies(const Mesh& mesh, const DofMap& dofs, const Supports& supports,
                                 const std::vector<HeldDirection>& held, const ShellGeometry* shells,
                                 const std::vector<std::pair<int, int>>& joined) {
  const int numNodes = mesh.numNodes();
  std::vector<int> parent(numNodes);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int n) {
    while (parent[n] != n) n = parent[n] = parent[parent[n]];
    return n;
  };
  std::map<int, std::string> bodies;  // root -> first block
  for (const Block& block : mesh.blocks) {
    const int N = nodesPerElement(block.topology);
    for (std::size_t i = 0; i < block.nodes.size(); ++i)
      parent[root(block.nodes[i])] = root(block.nodes[i - i % N]);
  }
  for (const auto& [a, b] : joined) parent[root(a)] = root(b);
  const std::string displacement = displacementField().name;
  const int field = dofs.find(displacement);
  const auto moves = [&](int n) { return field >= 0 && dofs.dof(field, n, 0) >= 0; };
  for (const Block& block : mesh.blocks)
    for (int n : block.nodes)
      if (moves(n)) bodies.emplace(root(n), block.name);

  // Scale by the whole mesh: bodies much smaller than it would need their own, none of 1e-6 of it is meant.
  double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300}, centre[3], size = 0;
  for (int n = 0; n < numNodes; ++n)
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], mesh.coordinates[3 * n + i]);
      high[i] = std::max(high[i], mesh.coordinates[3 * n + i]);
    }
  for (int i = 0; i < 3; ++i) {
    centre[i] = 0.5 * (low[i] + high[i]);
    size = std::max(size, high[i] - low[i]);
  }

  using Gram = std::array<double, 36>;
  std::map<int, Gram> gram, ofAll;  // of what is held, and of all displacements
  for (const auto& body : bodies) {
    gram[body.first].fill(0.0);
    ofAll[body.first].fill(0.0);
  }
  const auto addTo = [&](std::map<int, Gram>& grams, int node, const std::array<double, 6>& row) {
    const auto found = grams.find(root(node));
    if (found == grams.end()) return;
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) found->second[6 * j + i] += row[i] * row[j];
  };
  const auto hold = [&](int node, const std::array<double, 6>& row) { addTo(gram, node, row); };
  for (int n = 0; n < numNodes; ++n) {
    const auto motions = rigidMotions(&mesh.coordinates[3 * n], centre, size);
    for (int i = 0; moves(n) && i < mesh.dimension; ++i) {
      addTo(ofAll, n, motions[i]);
      if (supports.fixed(dofs.dof(field, n, i))) hold(n, motions[i]);
    }
    if (mesh.dimension == 2)  // no motion leaves the plane
      for (const int motion : {2, 3, 4}) {
        std::array<double, 6> row{};
        row[motion] = 1;
        addTo(ofAll, n, row);
        hold(n, row);
      }
  }
  // omega x D / |D|: of order 1 however thin the shell is.
  for (int d = 0; shells != nullptr && d < shells->numDirectors(); ++d) {
    const double* D = &shells->directors[3 * static_cast<std::size_t>(d)];
    const double origin[3] = {0, 0, 0}, length = std::sqrt(D[0] * D[0] + D[1] * D[1] + D[2] * D[2]);
    auto motions = rigidMotions(D, origin, length);
    for (int i = 0; i < 3; ++i) {
      if (!supports.fixed(dofs.firstDof(numNodes + d) + i)) continue;
      motions[i][0] = motions[i][1] = motions[i][2] = 0;
      hold(shells->meshNode[d], motions[i]);
    }
  }
  for (const HeldDirection& h : held) {
    const auto motions = rigidMotions(&mesh.coordinates[3 * h.node], centre, size);
    std::array<double, 6> row{};
    for (int i = 0; i < 3; ++i) {
      for (int m = 0; m < 6 && !h.turn; ++m) row[m] += h.direction[i] * motions[i][m];
      if (h.turn) row[3 + i] = h.direction[i];
    }
    hold(h.node, row);
  }
  std::vector<FreeBody> result;
  for (const auto& [r, block] : bodies) {
    // Bars on one line do not feel a rotation about it.
    const int motions = rank(ofAll[r]) - rank(gram[r]);
    if (motions > 0) result.push_back({block, motions});
  }
  return result;
}

}  // namespace atrapos::fem
