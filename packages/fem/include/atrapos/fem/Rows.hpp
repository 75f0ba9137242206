#pragma once

#include <cstddef>
#include <vector>

namespace atrapos::fem {

/// The rows `rows`, of `length` entries each, of an array of such rows; nothing of an array that is empty.
template <class T>
std::vector<T> rowsOf(const std::vector<T>& all, const std::vector<int>& rows, std::size_t length) {
  std::vector<T> chosen;
  if (all.empty()) return chosen;
  chosen.reserve(rows.size() * length);
  for (const int row : rows)
    chosen.insert(chosen.end(), all.begin() + row * length, all.begin() + (row + 1) * length);
  return chosen;
}

/// The numbers of the points of these entities, `each` points an entity.
inline std::vector<int> pointsOf(const std::vector<int>& entities, int each) {
  std::vector<int> points;
  points.reserve(entities.size() * each);
  for (const int e : entities)
    for (int q = 0; q < each; ++q) points.push_back(e * each + q);
  return points;
}

}  // namespace atrapos::fem
