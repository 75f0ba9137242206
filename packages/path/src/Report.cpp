#include "atrapos/path/Report.hpp"

namespace atrapos::path {

const char* toString(CriticalKind kind) {
  switch (kind) {
    case CriticalKind::transcritical:
      return "transcritical";
    case CriticalKind::pitchfork:
      return "pitchfork";
    case CriticalKind::multiple:
      return "multiple";
  }
  return "unknown";
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
  }
  return "unknown";
}

}  // namespace atrapos::path
