#pragma once

#include "Trial.hpp"

namespace atrapos::path {

/// How far a step goes along the polynomial of its series.
class PolynomialStep {
 public:
  PolynomialStep(const PathUnderWay& path, const Series& series, StepReport& report)
      : path_(path), series_(series), report_(report) {}

  /// An end whose residual is below the bound: from the radius, a stop or an event backwards. Throws
  /// PathError, stepTooSmall, where there is none.
  Trial trial() const;

 private:
  bool endAtBreak(Trial& trial) const;
  const char* whyNotFalling(double residual, double ofLonger) const;

  const PathUnderWay& path_;
  const Series& series_;
  StepReport& report_;
};

}  // namespace atrapos::path
