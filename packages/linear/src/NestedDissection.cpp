#include "NestedDissection.hpp"

#include <fmt/format.h>
#include <metis.h>

#include <algorithm>
#include <limits>

#include "atrapos/linear/Error.hpp"

namespace atrapos::linear {

std::vector<int> nestedDissection(int n, const std::vector<int>& rows, const std::vector<int>& columns) {
  // Graph of the pattern of A + A^T without the diagonal: both directions of every entry, then sorted,
  // unique.
  std::vector<std::size_t> start(n + 1, 0);
  for (std::size_t e = 0; e < rows.size(); ++e)
    if (rows[e] != columns[e]) {
      ++start[rows[e]];
      ++start[columns[e]];
    }
  for (int i = 0; i < n; ++i) start[i + 1] += start[i];
  if (start[n] > static_cast<std::size_t>(std::numeric_limits<idx_t>::max()))
    throw SolverError(fmt::format("METIS: {} edges are more than its indices can count", start[n]));
  std::vector<idx_t> neighbours(start[n]);
  auto next = start;
  for (std::size_t e = 0; e < rows.size(); ++e)
    if (rows[e] != columns[e]) {
      neighbours[next[rows[e] - 1]++] = columns[e] - 1;
      neighbours[next[columns[e] - 1]++] = rows[e] - 1;
    }
  std::vector<idx_t> offsets(n + 1, 0);
  std::size_t used = 0;
  for (int i = 0; i < n; ++i) {
    const auto begin = neighbours.begin() + start[i], end = neighbours.begin() + start[i + 1];
    std::sort(begin, end);
    const auto last = std::unique(begin, end);
    std::copy(begin, last, neighbours.begin() + used);  // never overtakes what is still to be read
    used += last - begin;
    offsets[i + 1] = static_cast<idx_t>(used);
  }
  neighbours.resize(used);

  std::vector<int> place(n);
  if (neighbours.empty()) {  // METIS does not take a graph without edges
    for (int i = 0; i < n; ++i) place[i] = i + 1;
    return place;
  }
  idx_t options[METIS_NOPTIONS], size = n;
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_NUMBERING] = 0;
  options[METIS_OPTION_SEED] = 1;
  std::vector<idx_t> sequence(n), inverse(n);
  const int status = METIS_NodeND(&size, offsets.data(), neighbours.data(), nullptr, options, sequence.data(),
                                  inverse.data());
  if (status != METIS_OK)
    throw SolverError(fmt::format("METIS: ordering {} rows failed (code {})", n, status));
  for (int i = 0; i < n; ++i) place[i] = static_cast<int>(inverse[i]) + 1;
  return place;
}

}  // namespace atrapos::linear
