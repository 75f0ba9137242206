#include "ShellGrid.hpp"

#include "support/Meshes.hpp"

namespace atrapos::solid::test {

Vec3 ShellGrid::D(int n) const {
  const double h = thickness / 2;
  return {h * normal[n][0], h * normal[n][1], h * normal[n][2]};
}

std::vector<int> ShellGrid::lineI(int i) const {
  std::vector<int> nodes;
  for (int j = 0; j <= 2 * nv; ++j)
    if (node(i, j) >= 0) nodes.push_back(node(i, j));
  return nodes;
}

std::vector<int> ShellGrid::lineJ(int j) const {
  std::vector<int> nodes;
  for (int i = 0; i <= 2 * nu; ++i)
    if (node(i, j) >= 0) nodes.push_back(node(i, j));
  return nodes;
}

ShellElements ShellGrid::elements() const {
  constexpr int di[9] = {0, 2, 2, 0, 1, 2, 1, 0, 1}, dj[9] = {0, 0, 2, 2, 0, 1, 2, 1, 1};
  ShellElements result;
  result.nodesPerElement = nodesPerElement;
  // Triangles of a square by its nodes, for either diagonal.
  constexpr int triangles[2][2][6] = {{{0, 1, 2, 4, 5, 8}, {0, 2, 3, 8, 6, 7}},
                                      {{0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 6, 8}}};
  std::vector<std::vector<int>> cells;
  for (int ej = 0; ej < nv; ++ej)
    for (int ei = 0; ei < nu; ++ei) {
      const auto at = [&](int a) { return node(2 * ei + di[a], 2 * ej + dj[a]); };
      if (isTriangle(nodesPerElement)) {
        for (const auto& nodes : triangles[(ei + ej) % 2]) {
          cells.push_back({});
          for (int a = 0; a < nodesPerElement; ++a)
            cells.back().push_back(at(nodes[a / 3 * 3 + (a + turn) % 3]));
        }
        continue;
      }
      cells.push_back({});
      for (int a = 0; a < nodesPerElement; ++a) cells.back().push_back(at(a));
    }
  for (const std::vector<int>& nodes : cells) {
    for (int n : nodes) result.nodes.push_back(n);
    for (int n : nodes) result.nodes.push_back(director(n));
    for (int n : nodes) {
      const Vec3 d = D(n);
      result.midsurface.insert(result.midsurface.end(), x[n].begin(), x[n].end());
      result.directors.insert(result.directors.end(), d.begin(), d.end());
    }
  }
  return result;
}

ShellGrid shellGrid(int nu, int nv, double thickness, const Surface& surface, const Distortion& distortion,
                    int nodesPerElement) {
  ShellGrid grid;
  grid.nu = nu;
  grid.nv = nv;
  grid.thickness = thickness;
  grid.nodesPerElement = nodesPerElement;
  for (int j = 0; j <= 2 * nv; ++j)
    for (int i = 0; i <= 2 * nu; ++i) {
      const int odd = i % 2 + j % 2;
      const bool exists = odd <= (nodesPerElement == 6 ? 2 : nodesPerElement == 8 ? 1 : 0);
      grid.lattice.push_back(exists ? grid.numNodes() : -1);
      if (!exists) continue;
      const auto [s, t] = distortion(i / (2.0 * nu), j / (2.0 * nv));
      const SurfacePoint p = surface(s, t);
      grid.x.push_back(p.x);
      grid.normal.push_back(p.normal);
    }
  return grid;
}

std::vector<ShellEdge> ShellGrid::side(int number) const {
  std::vector<ShellEdge> edges;
  const int count = number % 2 == 0 ? nu : nv;
  for (int k = 0; k < count; ++k) {
    const int i = number == 1 ? nu - 1 : number == 3 ? 0 : k, j = number == 2 ? nv - 1 : number == 0 ? 0 : k;
    if (isTriangle(nodesPerElement)) {  // triangle of the square and its edge, by diagonal and side
      constexpr int places[2][4][2] = {{{0, 0}, {0, 1}, {1, 1}, {1, 2}}, {{0, 0}, {1, 0}, {1, 1}, {0, 2}}};
      const auto& place = places[(i + j) % 2][number];
      edges.push_back({2 * (j * nu + i) + place[0], (place[1] + 3 - turn) % 3});
    } else {
      edges.push_back({j * nu + i, number});
    }
  }
  return edges;
}

ShellGrid shaken(ShellGrid grid, double amount, unsigned seed) {
  const auto moves = fem::test::randomNumbers(2 * grid.numNodes(), amount, seed);
  for (int j = 2; j < 2 * grid.nv; j += 2)
    for (int i = 2; i < 2 * grid.nu; i += 2) {
      const int n = grid.node(i, j);
      grid.x[n][0] += moves[2 * n];
      grid.x[n][1] += moves[2 * n + 1];
    }
  for (int j = 0; j <= 2 * grid.nv; ++j)
    for (int i = 0; i <= 2 * grid.nu; ++i) {
      const int n = grid.node(i, j);
      if (n < 0 || (i % 2 == 0 && j % 2 == 0)) continue;
      const int di = i % 2, rising = (i / 2 + j / 2) % 2 == 0 ? 1 : -1, dj = j % 2 * (di == 1 ? rising : 1);
      const int a = grid.node(i - di, j - dj), b = grid.node(i + di, j + dj);
      for (int c = 0; c < 3; ++c) grid.x[n][c] = 0.5 * (grid.x[a][c] + grid.x[b][c]);
    }
  return grid;
}

}  // namespace atrapos::solid::test
