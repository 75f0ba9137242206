#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "atrapos/fem/PointLaw.hpp"

namespace atrapos::fem {

/// A law that reads numbers of a point, called wires: the inputs of the whole law come first, then the
/// outputs of the stages in their order.
struct LawStage {
  std::unique_ptr<PointLaw> law;  ///< of a law with `static constexpr bool stage = true`
  std::vector<int> inputs;        ///< [input] its wire
  std::vector<int> data;          ///< [datum] the whole law's; -1: zero
};

/// A law made of others, one behind the other: y = f(x), out = g(x, y). One of them may have internal
/// variables, and events; its state is then the first datum of the whole, and its variables are the last data
/// and outputs.
struct StagedPlan {
  int inputs = 0, data = 0;
  std::vector<LawStage> stages;
  std::vector<int> outputs;  ///< [output] its wire
  bool symmetric = false;
  struct Shown {
    std::string name;
    int wire = 0;
    double absent = 0;  ///< shown where the law does not exist
  };
  std::vector<Shown> observed;
  /// What is shown instead where it takes more than wires: names, and their values from a point's wires and
  /// data.
  std::vector<std::string> names;
  std::function<void(const double* wires, const double* data, double* values)> show;
  int existence = -1;  ///< the datum that is negative where there is nothing to act on; -1: none
};

/// One compiled kernel for each stage serves all laws that have it (docs/theory/taylor.md, Stages).
/// Throws std::logic_error where wires or data are not there.
std::unique_ptr<PointLaw> stagedLaw(StagedPlan plan);

}  // namespace atrapos::fem
