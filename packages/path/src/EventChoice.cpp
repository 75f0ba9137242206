#include "EventChoice.hpp"

#include <algorithm>
#include <iterator>
#include <set>

#include <Tpetra_Vector.hpp>

#include "BehindEvents.hpp"
#include "EventSenses.hpp"
#include "Line.hpp"
#include "PathUnderWay.hpp"
#include "SeriesHere.hpp"

namespace atrapos::path {

namespace {

/// Those of two sorted sets that are in one of them only.
std::vector<int> difference(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> d;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(d));
  return d;
}

std::vector<int> together(const std::vector<int>& a, const std::vector<int>& b, const std::vector<int>& c) {
  std::set<int> all(a.begin(), a.end());
  all.insert(b.begin(), b.end());
  all.insert(c.begin(), c.end());
  return {all.begin(), all.end()};
}

}  // namespace

EventChoice::EventChoice(PathUnderWay& path, StepReport& report, Due due)
    : path_(path),
      report_(report),
      due_(takeDue()),
      // What grows may cease to behind any change.
      growing_(path.calls.problem().growingAt(path.here.state)),
      candidates_(together(path.here.applied, due_, growing_)),
      senses_(path.here.tangent ? 2 : 1) {
  // Behind the end of growth alone rates go on as they were: the functions that begin there have none yet,
  // but for what the series left out.
  smooth_ = due == Due::fellToZero && path.here.tangent &&
            std::includes(growing_.begin(), growing_.end(), due_.begin(), due_.end());
  // The old sense comes first where something grows: a body that yields can always unload the way it came.
  anySense_ = growing_.empty();
  countStanding();
}

std::vector<int> EventChoice::takeDue() {
  Position& here = path_.here;
  std::vector<int> due;
  std::swap(due, here.due);
  if (due.size() > 1 && !hasSize(path_, due[0])) {
    // Not quite together: where the state does not solve the changed Problem, the others come next.
    Calls& calls = path_.calls;
    const double residual = calls.residual(calls.afterEvent(due, here.state), *here.r).relative();
    if (!(residual <= std::max(path_.bound(), 2 * here.residual))) due.resize(1);
  }
  std::sort(due.begin(), due.end());
  return due;
}

void EventChoice::countStanding() {
  Position& here = path_.here;
  if (here.lastLength <= path_.options.minStep || !here.applied.empty())
    ++here.standing;
  else
    here.standing = 0;
  if (here.standing > 2 * path_.calls.problem().eventCount() + 4)
    throw PathError(EndReason::eventsCycle, line("at lambda = ", here.state.lambda, ": ", here.standing,
                                                 " events in a row without a step between them"));
}

/// No change at all is the way back, except where a path starts.
bool EventChoice::isAllowed(const std::vector<int>& chosen) const {
  return !chosen.empty() || !path_.here.tangent;
}

/// The Problem with these events applied, if that has not been looked at before. Where the path does not go
/// on with them all is as it was.
const EventChoice::Tried& EventChoice::attempt(const std::vector<int>& chosen) {
  const auto [at, isNew] = tried_.try_emplace(chosen);
  Tried& tried = at->second;
  if (!isNew) return tried;
  Position& here = path_.here;
  const State before = here.state;
  here.state = path_.calls.afterEvent(chosen, before);
  try {
    solveBehindEvents(path_, chosen);
    look(seriesHere(path_, {}, candidates_), chosen, tried);
  } catch (const PathError& error) {
    // A set of constraints that depend on each other, or a mechanism: another choice.
    if (error.reason() != EndReason::singularTangent) {
      here.state = before;
      here.due = due_;  // as the step left it, for who goes on from there
      throw;
    }
    tried.singular = true;
  }
  if (found_) {
    apply(chosen);
  } else {
    if (here.jump > 0 && path_.isBreak(chosen.back())) crease_ = path_.calls.breakText(chosen.back());
    ++path_.outcome.eventTrials;
    ++report_.restarts;
    here.state = before;
  }
  return tried;
}

/// Takes the series of a choice in a sense that is admissible.
void EventChoice::look(const Series& series, const std::vector<int>& chosen, Tried& tried) {
  const std::vector<int> flat = smooth_ && chosen == due_ ? due_ : std::vector<int>{};
  for (int s = 0; s < senses_ && !found_; ++s) {
    tried.falls[s] = falling(path_, series, candidates_, s == 0 ? 1 : -1, flat);
    if (!tried.falls[s].empty()) continue;
    if (s == 0 || anySense_)
      found_ = s == 0 ? series : series.reversed();
    else if (!turned_)
      turned_ = chosen;
  }
}

/// The path goes on with these events applied.
void EventChoice::apply(const std::vector<int>& chosen) {
  Position& here = path_.here;
  Outcome& outcome = path_.outcome;
  here.applied = candidates_;
  const bool turns = here.tangent && (here.tangent->lambda > 0) != (found_->lambdaCoefficient(1) > 0);
  if (!chosen.empty()) ++outcome.events;
  if (here.jump > 0) ++outcome.jumps;
  outcome.worstJump = std::max(outcome.worstJump, here.jump);
  report_.limitPoints.clear();
  if (!path_.pending) {  // the step that led here was seen before the path was interrupted
    if (turns) report_.limitPoints.push_back({0, here.state.lambda, here.tangent->lambda > 0, false});
    return;
  }
  here.turned = turns;
  path_.pending->jump = here.jump;
  path_.pending->events = difference(path_.pending->events, chosen);
}

/// Principal pivoting: all that fall change sides, or the last of them where that would go in a circle.
void EventChoice::pivot(int sense) {
  const int mostTrials = 3 * static_cast<int>(candidates_.size());
  std::set<std::vector<int>> seen;
  std::vector<int> chosen = due_;
  for (int trial = 0; trial < mostTrials && isAllowed(chosen) && seen.insert(chosen).second; ++trial) {
    const Tried& tried = attempt(chosen);
    const auto& falls = tried.falls[sense];
    if (found_ || tried.singular || falls.empty()) return;
    std::vector<int> next = difference(chosen, falls);
    if (seen.count(next)) next = difference(chosen, {falls.back()});
    chosen = next;
  }
}

/// All choices, where the candidates are few: the bits of `left` are those not applied.
void EventChoice::tryAll() {
  constexpr int mostTogether = 6;
  const int count = static_cast<int>(candidates_.size());
  for (unsigned left = 0; !found_ && count <= mostTogether && left < (1u << count); ++left) {
    std::vector<int> chosen;
    for (int i = 0; i < count; ++i)
      if (!(left & (1u << i))) chosen.push_back(candidates_[i]);
    if (isAllowed(chosen)) attempt(chosen);
  }
}

Series EventChoice::series() {
  pivot(0);
  if (!found_ && senses_ == 2) {
    anySense_ = true;
    if (turned_) {
      tried_.erase(*turned_);
      attempt(*turned_);
    }
    if (!found_) pivot(1);
  }
  if (!found_) tryAll();
  if (found_) return *found_;
  const double lambda = path_.here.state.lambda;
  path_.here.due = due_;
  if (!crease_.empty())
    throw PathError(EndReason::problemFailed, line("at lambda = ", lambda, ": ", crease_));
  throw PathError(EndReason::noAdmissibleDirection,
                  line("at lambda = ", lambda, ": no choice among the ", candidates_.size(),
                       " event(s) there lets the path go on"));
}

Series seriesAfterRestart(PathUnderWay& path) {
  const auto& applied = path.here.applied;
  solveBehindEvents(path, {});
  Series series = seriesHere(path, {}, applied);
  return falling(path, series, applied, 1).empty() ? series : series.reversed();
}

}  // namespace atrapos::path
