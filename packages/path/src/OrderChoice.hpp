#pragma once

#include "atrapos/path/Calls.hpp"

namespace atrapos::path {

/// The order of series by what they have cost so far (Options::autoOrder).
class OrderChoice {
 public:
  /// A series of an accepted step.
  void add(const Series& series);

  /// The order of least cost, the same on all ranks; `present` where nothing has been measured.
  int best(const Calls& calls, double delta, int present) const;

 private:
  int orders_ = 0;  ///< of all series together
  int built_ = 0;   ///< how many
};

}  // namespace atrapos::path
