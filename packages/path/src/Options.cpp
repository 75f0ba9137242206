#include "atrapos/path/Options.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace atrapos::path {

namespace {
void require(bool good, const char* name, double value, const char* accepted) {
  if (good) return;
  std::ostringstream text;
  text << "path options: " << name << " = " << value << ", must be " << accepted;
  throw std::invalid_argument(text.str());
}
}  // namespace

void Options::validate() const {
  const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
  require(order >= 1, "order", order, ">= 1");
  require(delta > 0 && delta < 1, "delta", delta, "in (0, 1)");
  require(direction == 1 || direction == -1, "direction", direction, "+1 or -1");
  if (weight) require(positive(*weight), "weight", *weight, "positive and finite");
  require(positive(residualBound), "residualBound", residualBound, "positive and finite");
  require(jumpBound >= 0 && jumpBound < 1, "jumpBound", jumpBound, "in [0, 1)");
  require(correctAbove > 0 && correctAbove <= 1, "correctAbove", correctAbove, "in (0, 1]");
  require(maxCorrections >= 0, "maxCorrections", maxCorrections, ">= 0");
  require(maxStartIterations >= 0, "maxStartIterations", maxStartIterations, ">= 0");
  require(minCosine >= 0 && minCosine < 1, "minCosine", minCosine, "in [0, 1)");
  require(watchedModes >= 0, "watchedModes", watchedModes, ">= 0");
  require(hopfEigenvalues >= 0, "hopfEigenvalues", hopfEigenvalues, ">= 0");
  if (maxStep) require(positive(*maxStep), "maxStep", *maxStep, "positive and finite");
  require(positive(firstStep), "firstStep", firstStep, "positive and finite");
  require(positive(minStep) && (!maxStep || minStep < *maxStep), "minStep", minStep,
          "positive and less than maxStep");
  require(maxCutBacks >= 0, "maxCutBacks", maxCutBacks, ">= 0");
  require(maxSteps >= 0, "maxSteps", maxSteps, ">= 0");
}

}  // namespace atrapos::path
