#pragma once

#include <algorithm>

namespace atrapos::path {

/// When the rational form is tried again: the longer it has not helped, the longer it rests.
struct PadePatience {
  int failures = 0;  ///< steps in a row that it did not lengthen
  int wait = 0;      ///< steps until it is tried again

  /// Whether it rests at this step, which is one less to wait.
  bool rests() {
    if (wait == 0) return false;
    --wait;
    return true;
  }
  void helped() { failures = 0; }
  void failed() {
    failures = std::min(failures + 1, 4);
    wait = (1 << failures) - 2;
  }
};

}  // namespace atrapos::path
