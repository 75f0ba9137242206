#pragma once

#include <optional>
#include <vector>

#include "Newton.hpp"
#include "atrapos/path/Stops.hpp"

namespace atrapos::path {

struct PathUnderWay;

/// The end of a step under trial.
struct Trial {
  double a = 0;
  State state;
  RCP<Vector> r;        ///< R there
  double residual = 0;  ///< its relative norm
  std::optional<StopHit> stop;
  std::vector<int> events;  ///< event functions that are zero there, and breaks
};

/// Shortens a trial to the first stop or event of the series; those just behind its end are taken now, not by
/// a tiny next step. The functions `zero` are zero at the series' start.
void limit(const PathUnderWay& path, const Series& series, Trial& trial, const std::vector<int>& zero);
/// The same behind the events applied where the path is.
void limit(const PathUnderWay& path, const Series& series, Trial& trial);

/// State and residual at a trial's a.
void evaluate(const PathUnderWay& path, const Series& series, Trial& trial);

/// Whether event functions at a trial's end are those of another piece than the state lies on.
bool astray(const PathUnderWay& path, const Trial& trial);

/// Newton corrections of a trial's end until its residual is `above`, as far as they help; the report counts
/// them.
void correct(const PathUnderWay& path, const Series& series, Trial& trial, StepReport& report, double above);

/// What a correction of the end of a step keeps.
Border borderAt(const PathUnderWay& path, const Series& series, double a, const std::optional<StopHit>& stop);

}  // namespace atrapos::path
