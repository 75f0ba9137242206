#pragma once

#include <map>
#include <string>
#include <vector>

namespace atrapos::chart {

/// What a run took, and how far off it was.
struct Measured {
  std::string curve;
  int run = 1;                                  ///< of its curve, from 1
  std::string settings;                         ///< the deck's values that it was made with
  std::string outcome;                          ///< stop, or what ended it
  double error = 0, at = 0, worstResidual = 0;  ///< not numbers where the path did not come to a stop
  int steps = 0, factorizations = 0, orders = 0, solves = 0;
  double seconds = 0;
  std::string digest;  ///< of all that the row depends on
};

/// The header of chart.csv.
std::string chartHeader();
std::string rowOf(const Measured& measured);
/// Rows of a chart.csv by their digests; none where the file is not there. Throws std::invalid_argument.
std::map<std::string, Measured> readRows(const std::string& file);

}  // namespace atrapos::chart
