#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "atrapos/path/Report.hpp"

namespace atrapos::path {

struct PathUnderWay;

/// The Problem changes at the position. Of the functions that are zero there all that are due are applied;
/// where the path then has no admissible sense, other choices are tried. Admissible is the sense in which
/// every function that is zero here rises; it is not asked that the old direction is kept: where lambda then
/// goes the other way the path has a non-smooth limit point. A path that starts here keeps the direction that
/// is asked of it.
class EventChoice {
 public:
  /// How functions that are due came to be: at the end of a step, or by falling from the start of a series.
  enum class Due { fellToZero, fallFromHere };

  /// Takes over what is due at the position. Throws PathError, eventsCycle, where events follow one another
  /// for ever. The report counts what is tried in vain.
  EventChoice(PathUnderWay& path, StepReport& report, Due due = Due::fellToZero);

  /// The series behind the events, which are then applied. Throws PathError, noAdmissibleDirection and
  /// others, with the same due as before.
  Series series();

 private:
  /// What became of a choice.
  struct Tried {
    bool singular = false;
    std::vector<int> falls[2];  ///< functions that fall in the old sense, in the other one
  };

  std::vector<int> takeDue();
  void countStanding();
  bool isAllowed(const std::vector<int>& chosen) const;
  const Tried& attempt(const std::vector<int>& chosen);
  void look(const Series& series, const std::vector<int>& chosen, Tried& tried);
  void apply(const std::vector<int>& chosen);
  void pivot(int sense);
  void tryAll();

  PathUnderWay& path_;
  StepReport& report_;
  const std::vector<int> due_;         ///< applied first, ascending
  const std::vector<int> growing_;     ///< Problem::growingAt
  const std::vector<int> candidates_;  ///< all that are zero here, ascending
  const int senses_;                   ///< in which the path may go on
  bool smooth_ = false;                ///< nothing is due but the end of growth
  bool anySense_ = false;              ///< the sense that is not the old one is taken, too
  std::map<std::vector<int>, Tried> tried_;
  std::optional<std::vector<int>> turned_;  ///< a choice admissible in the sense that was not taken
  std::string crease_;                      ///< of a jump behind which no sense was admissible
  std::optional<Series> found_;
};

/// The series of a path that goes on from a position where events have been applied: in the sense in which
/// their functions rise.
Series seriesAfterRestart(PathUnderWay& path);

}  // namespace atrapos::path
