#include "atrapos/path/Report.hpp"

#include <algorithm>
#include <cstdlib>

namespace atrapos::path {

const char* toString(CriticalKind kind) {
  switch (kind) {
    case CriticalKind::transcritical:
      return "transcritical";
    case CriticalKind::pitchfork:
      return "pitchfork";
    case CriticalKind::hilltop:
      return "hilltop";
    case CriticalKind::multiple:
      return "multiple";
  }
  return "unknown";
}

std::optional<long long> StepReport::negativeAt(double a) const {
  // Newton steps that go on with a path know the count at their end first.
  if (!inertia && inertiaEnd && a >= length) return inertiaEnd->negative;
  if (!inertia) return std::nullopt;
  // Where it changes: bifurcation points, whose change is known, and limit points, one each of unknown sign.
  struct Mark {
    double a;
    int change;
    bool known;
  };
  std::vector<Mark> marks;
  long long rest = inertiaEnd ? inertiaEnd->negative - inertia->negative : 0;
  for (const auto& p : criticalPoints) {
    marks.push_back({p.a, p.negativeChange, true});
    rest -= p.negativeChange;
  }
  for (const auto& p : hopfPoints) {
    marks.push_back({p.a, p.negativeChange, true});
    rest -= p.negativeChange;
  }
  std::size_t limits = 0;
  for (const auto& p : limitPoints)
    if (p.smooth) {
      marks.push_back({p.a, 0, false});
      ++limits;
    }
  std::sort(marks.begin(), marks.end(), [](const Mark& x, const Mark& y) { return x.a < y.a; });
  // All limit points change it the same way, or there are two and the first can only lose stability.
  const bool oneWay = inertiaEnd && static_cast<std::size_t>(std::llabs(rest)) == limits;
  const bool thereAndBack = inertiaEnd && limits == 2 && rest == 0 && criticalPoints.empty() &&
                            hopfPoints.empty() && inertia->negative == 0;
  long long n = inertia->negative;
  std::size_t passed = 0, limitsPassed = 0;
  for (const Mark& m : marks) {
    if (m.a > a) break;
    ++passed;
    n += m.change;
    if (!m.known) {
      n += oneWay ? (rest > 0 ? 1 : -1) : limitsPassed == 0 ? 1 : -1;
      ++limitsPassed;
    }
  }
  if (a <= 0) return inertia->negative;
  if (a >= length && inertiaEnd) return inertiaEnd->negative;
  if (uncounted) return std::nullopt;
  // What no mark explains has changed somewhere inside.
  if (unexplained > 0 || (limits == 0 && rest != 0)) return std::nullopt;
  if (passed == 0) return n;
  if (!inertiaEnd) return std::nullopt;
  if (passed == marks.size()) return inertiaEnd->negative;
  if (limitsPassed > 0 && !oneWay && !thereAndBack) return std::nullopt;
  return n;
}

const char* toString(EndReason reason) {
  switch (reason) {
    case EndReason::stopReached:
      return "stopReached";
    case EndReason::stepLimit:
      return "stepLimit";
    case EndReason::observerStopped:
      return "observerStopped";
    case EndReason::startNotInEquilibrium:
      return "startNotInEquilibrium";
    case EndReason::singularTangent:
      return "singularTangent";
    case EndReason::solverFailed:
      return "solverFailed";
    case EndReason::loadWithoutEffect:
      return "loadWithoutEffect";
    case EndReason::notFinite:
      return "notFinite";
    case EndReason::noAdmissibleDirection:
      return "noAdmissibleDirection";
    case EndReason::eventsCycle:
      return "eventsCycle";
    case EndReason::directionLost:
      return "directionLost";
    case EndReason::stepTooSmall:
      return "stepTooSmall";
    case EndReason::problemFailed:
      return "problemFailed";
    case EndReason::pathClosed:
      return "pathClosed";
  }
  return "unknown";
}

}  // namespace atrapos::path
