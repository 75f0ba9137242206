#pragma once

#include <memory>
#include <vector>

#include "atrapos/fem/PointLaw.hpp"

namespace atrapos::fem {

/// How a law of many inputs is one of few: which of its inputs are given, vanish, or follow from outputs that
/// vanish.
struct Reduction {
  std::vector<int> inputs;   ///< [input of the law] that of the reduced law; -1: zero
  std::vector<int> outputs;  ///< [output of the reduced law] that of the law; -1: zero
  int numInputs = 0;         ///< of the reduced law
  /// An input h of the law, a stretch less 1 and so above -1, that is such that the output of the same number
  /// vanishes; -1: none. Its entry in `inputs` is -1.
  int condensed = -1;
};

/// The law under a reduction: plane strain, plane stress and axisymmetry of a material in space, tools in
/// space for points in a plane. All orders of a condensed input cost one division; it starts from Newton's
/// method in each lane, with the law's own tangent (docs/theory/solid.md, "Plane bodies"). Where that finds
/// nothing the outputs are NaN and a series does not start.
/// Internal variables and event functions of the law are those of the reduced one; with them no input can be
/// condensed. Throws std::logic_error where the reduction does not fit the law.
std::unique_ptr<PointLaw> reducedLaw(std::unique_ptr<PointLaw> law, Reduction reduction);

}  // namespace atrapos::fem
