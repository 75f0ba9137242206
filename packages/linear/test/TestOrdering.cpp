// The fill-reducing ordering: a permutation for any graph, and fewer entries than METIS' own.
#include <gtest/gtest.h>
#include <metis.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "NestedDissection.hpp"

namespace atrapos::linear::test {
namespace {

/// Entries of a symmetric matrix, lower triangle, from 1.
struct Pattern {
  int n = 0;
  std::vector<int> rows, columns;
  void add(int row, int column) {
    rows.push_back(std::max(row, column) + 1);
    columns.push_back(std::min(row, column) + 1);
  }
};

/// Nodes of a grid with `each` rows, all joined that are neighbours along edges or diagonals.
Pattern grid(int width, int height, int each) {
  Pattern p;
  p.n = width * height * each;
  for (int v = 0; v < width * height; ++v)
    for (int w = 0; w <= v; ++w) {
      if (std::abs(v % width - w % width) > 1 || std::abs(v / width - w / width) > 1) continue;
      for (int i = 0; i < each; ++i)
        for (int j = 0; j < each; ++j)
          if (v != w || j <= i) p.add(v * each + i, w * each + j);
    }
  return p;
}

std::vector<std::vector<int>> neighbours(const Pattern& p) {
  std::vector<std::vector<int>> of(p.n);
  for (std::size_t e = 0; e < p.rows.size(); ++e)
    if (p.rows[e] != p.columns[e]) {
      of[p.rows[e] - 1].push_back(p.columns[e] - 1);
      of[p.columns[e] - 1].push_back(p.rows[e] - 1);
    }
  for (auto& list : of) std::sort(list.begin(), list.end());
  return of;
}

/// Entries below the diagonal of the factor: row i has those of the paths from its entries up the
/// elimination tree to i (Liu 1990).
long long fill(const Pattern& p, const std::vector<int>& place) {
  const auto of = neighbours(p);
  std::vector<int> sequence(p.n), parent(p.n, -1), seen(p.n, -1);
  for (int i = 0; i < p.n; ++i) sequence[place[i] - 1] = i;
  long long entries = 0;
  for (int i = 0; i < p.n; ++i) {
    seen[i] = i;
    for (const int neighbour : of[sequence[i]])
      for (int k = place[neighbour] - 1; k < i && seen[k] != i; k = parent[k]) {
        if (parent[k] < 0) parent[k] = i;
        seen[k] = i;
        ++entries;
      }
  }
  return entries;
}

/// METIS_NodeND with its defaults.
std::vector<int> ofMetis(const Pattern& p) {
  std::vector<idx_t> start{0}, adjacent;
  for (const auto& list : neighbours(p)) {
    adjacent.insert(adjacent.end(), list.begin(), list.end());
    start.push_back(static_cast<idx_t>(adjacent.size()));
  }
  idx_t options[METIS_NOPTIONS], n = p.n;
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  std::vector<idx_t> sequence(n), place(n);
  EXPECT_EQ(METIS_NodeND(&n, start.data(), adjacent.data(), nullptr, options, sequence.data(), place.data()),
            METIS_OK);
  std::vector<int> result(place.begin(), place.end());
  for (int& i : result) ++i;
  return result;
}

void expectPermutation(const Pattern& p) {
  auto place = nestedDissection(p.n, p.rows, p.columns);
  std::sort(place.begin(), place.end());
  std::vector<int> all(p.n);
  std::iota(all.begin(), all.end(), 1);
  EXPECT_EQ(place, all);
}

TEST(Ordering, IsAPermutationOfAnyGraph) {
  expectPermutation(grid(1, 1, 1));
  expectPermutation(grid(40, 30, 1));
  expectPermutation(grid(23, 17, 3));
  Pattern diagonal{70, {}, {}};
  expectPermutation(diagonal);
  Pattern dense{80, {}, {}};
  for (int i = 0; i < 80; ++i)
    for (int j = 0; j <= i; ++j) dense.add(i, j);
  expectPermutation(dense);
  Pattern apart = grid(12, 12, 2);  // twice, and rows without entries
  const auto rows = apart.rows, columns = apart.columns;
  for (std::size_t e = 0; e < rows.size(); ++e) apart.add(rows[e] - 1 + apart.n, columns[e] - 1 + apart.n);
  apart.n = 2 * apart.n + 5;
  expectPermutation(apart);
  Pattern star{400, {}, {}};  // a multiplier that sees everything
  for (int i = 1; i < 400; ++i) star.add(i, 0);
  expectPermutation(star);
}

TEST(Ordering, DuplicatesAndTheOtherTriangleDoNoHarm) {
  const Pattern p = grid(15, 15, 2);
  auto rows = p.rows, columns = p.columns;
  rows.insert(rows.end(), p.columns.begin(), p.columns.end());
  columns.insert(columns.end(), p.rows.begin(), p.rows.end());
  EXPECT_EQ(nestedDissection(p.n, rows, columns), nestedDissection(p.n, p.rows, p.columns));
}

TEST(Ordering, FillsLessThanMetis) {
  // Six rows a node, as shells have, is where METIS stops dissecting early.
  const Pattern shell = grid(50, 50, 6);
  const auto own = nestedDissection(shell.n, shell.rows, shell.columns);
  EXPECT_LT(static_cast<double>(fill(shell, own)), 0.95 * static_cast<double>(fill(shell, ofMetis(shell))));
  // With one row a node there is little to gain: not worse.
  const Pattern plane = grid(70, 70, 1);
  EXPECT_LT(static_cast<double>(fill(plane, nestedDissection(plane.n, plane.rows, plane.columns))),
            1.02 * static_cast<double>(fill(plane, ofMetis(plane))));
}

TEST(Ordering, RowsOfANodeStayTogether) {
  const Pattern p = grid(20, 20, 6);
  const auto place = nestedDissection(p.n, p.rows, p.columns);
  for (int node = 0; node < 400; ++node)
    for (int i = 1; i < 6; ++i) EXPECT_EQ(place[6 * node + i], place[6 * node] + i);
}

}  // namespace
}  // namespace atrapos::linear::test
