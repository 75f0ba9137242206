#pragma once

#include <string>
#include <vector>

#include "atrapos/path/Series.hpp"
#include "commands/PathCase.hpp"
#include "output/PathTable.hpp"
#include "scene/Scene.hpp"

namespace atrapos {

/// A contact point that closes or opens: its gap falls or rises through ContactPoints::closedGaps.
struct ContactEvent {
  double a = 0;  ///< on the step's series
  double loadFactor = 0;
  bool closes = false;
  int contact = 0;              ///< of Scene::contacts
  int point = 0;                ///< among the contact's points, or corners, from 0
  int node = 0;                 ///< that of the point or corner, or the nearest one of its face, from 0
  double place[3] = {0, 0, 0};  ///< where the point is then
  double force = 0;             ///< weight times pressure there
};

/// Finds the events of every step on its series and writes them to events.csv.
///
/// The gap of a point is projected at 17 places of the step; between two with different signs its root is
/// found on the series to rounding. Two events of one point within a sixteenth of a step are not seen. Points
/// whose way in the step is shorter than their distance from closing are passed over. Corners of hard contact
/// on faces, and the ends of zones, close and open at the ends of steps, where the set of active ones
/// changes.
class ContactEvents final : public StepWatch {
 public:
  /// Throws FileError where the file cannot be written.
  /// `append`: goes on with the file.
  ContactEvents(const Scene& scene, const std::string& file, bool append = false);

  void onStep(int branch, int step, double pathLengthStart, double length, const path::Series& series,
              const CaseState& end, const std::vector<int>& changes) override;
  void copyFrom(const std::string& file, const RestartPlace& last, const Mark& mark) override {
    table_.copyFrom(file, last, mark);
  }
  Mark mark() const override { return table_.mark(); }
  void sync() const override { table_.sync(); }
  void rename(const std::string& file) override { table_.rename(file); }
  int count() const override { return count_; }

 private:
  void findConditions(std::size_t c, const path::Series& series, double length,
                      const std::vector<int>& changes, std::vector<ContactEvent>& events) const;

  /// Gaps that have been evaluated at the end of the last step.
  struct KnownGaps {
    std::vector<double> u;  ///< of that state
    double lambda = 0;
    std::vector<std::vector<double>> gaps;  ///< [contact][point]
  };
  void remember(const CaseState& end);

  const Scene& scene_;
  Table table_;
  KnownGaps known_;
  int branch_ = 0;
  std::vector<std::vector<char>> closed_;  ///< [contact][point] at the end of the last step; empty: none yet
  int count_ = 0;
};

}  // namespace atrapos
