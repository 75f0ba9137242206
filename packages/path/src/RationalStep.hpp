#pragma once

#include <optional>
#include <vector>

#include "Modes.hpp"
#include "PadeFit.hpp"
#include "PadePatience.hpp"
#include "Trial.hpp"

namespace atrapos::path {

/// How far a step goes along the rational form of its series.
class RationalStep {
 public:
  RationalStep(const PathUnderWay& path, Series& series, StepReport& report)
      : path_(path), series_(series), report_(report) {}

  /// The end of the step by the rational form, which the series then has, where that goes further than the
  /// polynomial and its residual passes, at the end and inside; or by the polynomial, where that reaches a
  /// stop or an event. Empty: neither. `modes` are the eigenvalues followed at the step's start.
  std::optional<Trial> trial(const std::vector<Mode>& modes, PadePatience& patience) const;

 private:
  bool isTried() const;
  PadeFit fit(const std::vector<Mode>& modes, double polynomial) const;
  std::optional<Trial> alongFit(double range, double shortest, double least) const;
  bool polynomialReaches(double a) const;

  const PathUnderWay& path_;
  Series& series_;
  StepReport& report_;
};

}  // namespace atrapos::path
