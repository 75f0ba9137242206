#include "commands/GrowingPath.hpp"

#include <algorithm>

namespace atrapos {

path::Outcome sumOf(const path::Outcome& first, path::Outcome last) {
  last.factorizations += first.factorizations;
  last.events += first.events;
  last.eventTrials += first.eventTrials;
  last.solves += first.solves;
  last.orders += first.orders;
  last.startIterations += first.startIterations;
  last.corrections += first.corrections;
  last.restarts += first.restarts;
  last.retreats += first.retreats;
  last.criticalFactorizations += first.criticalFactorizations;
  last.hopfFactorizations += first.hopfFactorizations;
  last.closings += first.closings;
  last.cutBacks += first.cutBacks;
  last.jumps += first.jumps;
  last.worstResidual = std::max(last.worstResidual, first.worstResidual);
  last.worstJump = std::max(last.worstJump, first.worstJump);
  last.seconds.tangent += first.seconds.tangent;
  last.seconds.analysis += first.seconds.analysis;
  last.seconds.factor += first.seconds.factor;
  last.seconds.solve += first.seconds.solve;
  last.seconds.orderRhs += first.seconds.orderRhs;
  last.seconds.residual += first.seconds.residual;
  last.seconds.total += first.seconds.total;
  return last;
}

bool GrowingPath::onStep(const path::StepReport& report, const path::Series& series) {
  changed_ = case_.changedOn(report.length, series);
  if (changed_) return false;
  next_ = report.next;
  return observer_.onStep(report, series);
}

}  // namespace atrapos
