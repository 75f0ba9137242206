#pragma once

#include <vector>

#include "atrapos/path/PathFollower.hpp"

namespace atrapos::fem::test {

/// Keeps all that a path tells.
struct Steps final : path::Observer {
  std::vector<path::StepReport> reports;
  std::vector<path::Series> series;
  bool onStep(const path::StepReport& report, const path::Series& s) override {
    reports.push_back(report);
    series.push_back(s);
    return true;
  }
};

}  // namespace atrapos::fem::test
