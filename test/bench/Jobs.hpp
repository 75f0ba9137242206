#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "Table.hpp"

namespace atrapos::bench {

/// What to measure.
struct Selection {
  std::vector<std::string> laws, methods;  ///< empty: all
  std::vector<int> orders;
  std::vector<std::size_t> points;  ///< of atrapos and hand; multiples of 8
  std::size_t peerBytes = 0;        ///< the peers get as many points as make their input series this large
};

/// One measurement: `row` lacks its time only; `run` computes all orders at all points once.
struct Job {
  Row row;
  std::size_t doubles = 0;  ///< arena it needs
  bool slow = false;        ///< a peer that is run once
  std::function<void(double* memory)> run;
};

/// Names of all methods that this build has.
std::vector<std::string> methodNames();
std::vector<std::string> lawNames();

/// Sacado first within a law and order, so that ratios are known when the others are done.
std::vector<Job> makeJobs(const Selection& selection);

}  // namespace atrapos::bench
