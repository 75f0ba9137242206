#pragma once

#include <string>
#include <vector>

#include "atrapos/linear/Types.hpp"

namespace atrapos::path {

/// A linear functional of the unknowns that is watched along a path, weights . U: a displacement, a mean.
struct Monitor {
  std::string name;                           ///< for reports
  linear::RCP<const linear::Vector> weights;  ///< on the Problem's map
};

/// Throws std::invalid_argument, one line, on a monitor without weights.
void validate(const std::vector<Monitor>& monitors);

}  // namespace atrapos::path
