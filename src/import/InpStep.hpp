#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "import/InpModel.hpp"

namespace atrapos::importer {

/// What a file says of one node's displacement (0 to 2) and rotation (3 to 5) components.
struct InpSupport {
  std::array<std::optional<double>, 6> value;
  InpPlace place;
};

/// *STATIC, *STATIC, RIKS or *BUCKLE with all that acts in it and before.
struct InpStep {
  enum class Procedure { statics, riks, buckle };
  Procedure procedure = Procedure::statics;
  InpPlace place;  ///< of the procedure
  bool nonlinearGeometry = false;
  int increments = 100;              ///< most of them
  std::optional<double> loadFactor;  ///< of *STATIC, RIKS: where it ends
  struct Target {
    int node, component;  ///< position, 0 to 2
    double value;
  };
  std::optional<Target> displacement;  ///< the same

  std::map<int, InpSupport> supports;               ///< by node
  std::map<int, std::array<double, 3>> forces;      ///< by node
  std::map<int, std::array<double, 3>> moments;     ///< by node that leads a rigid body
  std::map<std::pair<int, int>, double> pressures;  ///< by element and side
  struct VolumeLoad {
    InpPlace place;
    std::vector<int> elements;
    std::array<double, 3> force;  ///< by volume, or by mass
    bool byMass;
  };
  std::vector<VolumeLoad> volumeLoads;
};

/// The first step of these kinds; of the others and of what it does not know it leaves remarks. Throws Error
/// where there is none.
InpStep readInpStep(InpModel& model);

}  // namespace atrapos::importer
