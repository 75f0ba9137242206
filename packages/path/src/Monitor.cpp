#include "atrapos/path/Monitor.hpp"

#include <stdexcept>

namespace atrapos::path {

void validate(const std::vector<Monitor>& monitors) {
  for (const Monitor& m : monitors)
    if (m.weights.is_null()) throw std::invalid_argument("path monitors: '" + m.name + "' has no weights");
}

}  // namespace atrapos::path
