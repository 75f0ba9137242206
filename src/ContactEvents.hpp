#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "Scene.hpp"
#include "atrapos/path/Series.hpp"

namespace atrapos {

/// A contact point that closes or opens: its gap falls or rises through ContactPoints::closedGaps.
struct ContactEvent {
  double a = 0;  ///< on the step's series
  double loadFactor = 0;
  bool closes = false;
  int contact = 0;              ///< of Scene::contacts
  int point = 0;                ///< among the contact's points, from 0
  int node = 0;                 ///< that of the point, or the nearest one of its face, from 0
  double place[3] = {0, 0, 0};  ///< where the point is then
  double force = 0;             ///< weight times pressure there
};

/// Finds the events of every step on its series and writes them to events.csv.
///
/// The gap of a point is projected at 17 places of the step; between two with different signs its root is
/// found on the series to rounding. Two events of one point within a sixteenth of a step are not seen. Points
/// whose way in the step is shorter than their distance from closing are passed over.
class ContactEvents {
 public:
  /// Throws std::runtime_error where the file cannot be written.
  ContactEvents(const Scene& scene, const std::string& file);

  /// The step's events, ascending in a, written to the file.
  std::vector<ContactEvent> onStep(int step, double pathLengthStart, double length,
                                   const path::Series& series);

  int count() const { return count_; }

 private:
  const Scene& scene_;
  std::string file_;
  std::ofstream out_;
  std::vector<std::vector<char>> closed_;  ///< [contact][point] at the end of the last step; empty: none yet
  int count_ = 0;
};

}  // namespace atrapos
