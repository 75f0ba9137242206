#pragma once

#include <vector>

#include "atrapos/linear/Types.hpp"

namespace atrapos::linear {

/// Rows numbered 0..n-1, rank after rank, whatever the row map's global indices are. Collective.
struct RowNumbering {
  explicit RowNumbering(const CrsMatrix& K);

  GlobalIndex first = 0;             ///< number of this rank's first row; the others follow
  std::vector<GlobalIndex> columns;  ///< numbers of the local columns
};

}  // namespace atrapos::linear
