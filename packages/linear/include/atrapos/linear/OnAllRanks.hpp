#pragma once

#include <vector>

#include "atrapos/linear/Types.hpp"

namespace atrapos::linear {

/// The numbers that every rank has at its own entries of a map, as one list by global index on all of them.
/// Global indices are 0, 1, ... Collective.
std::vector<double> onAllRanks(const Map& map, const std::vector<double>& own);

/// The same of a vector's entries.
std::vector<double> onAllRanks(const Vector& x);

}  // namespace atrapos::linear
