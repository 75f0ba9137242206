#include "atrapos/fem/Processor.hpp"

#include <cstdlib>
#include <stdexcept>

#include "atrapos/taylor/Lanes.hpp"

namespace atrapos::fem {
namespace {

#ifdef ATRAPOS_KERNEL_LEVELS
struct Level {
  const char* name;
  int lanes;
  bool here;
};

int chooseLanes() {
  const Level levels[] = {{"v2", 2, __builtin_cpu_supports("x86-64-v2") != 0},
                          {"v3", 4, __builtin_cpu_supports("x86-64-v3") != 0},
                          {"v4", 8, __builtin_cpu_supports("x86-64-v4") != 0}};
  const char* asked = std::getenv("ATRAPOS_KERNELS");
  int lanes = 0;
  for (const Level& level : levels) {
    if (asked != nullptr && *asked != '\0' && std::string(asked) != level.name) continue;
    if (level.here)
      lanes = level.lanes;
    else if (asked != nullptr && std::string(asked) == level.name)
      throw std::invalid_argument(std::string("ATRAPOS_KERNELS=") + asked +
                                  ": this processor has no x86-64-" + asked);
  }
  if (lanes > 0) return lanes;
  if (asked != nullptr && *asked != '\0')
    throw std::invalid_argument(std::string("ATRAPOS_KERNELS=") + asked + ": expected v2, v3 or v4");
  throw std::invalid_argument("this processor has no x86-64-v2 (SSE4.2), which the kernels need");
}
#endif

}  // namespace

int processorLanes() {
#ifdef ATRAPOS_KERNEL_LEVELS
  static const int lanes = chooseLanes();
  return lanes;
#else
  return taylor::nativeLanes;
#endif
}

std::string describeKernels() {
  const int lanes = processorLanes();
  const std::string count = " (" + std::to_string(lanes) + " lanes)";
#ifdef ATRAPOS_KERNEL_LEVELS
  return std::string("x86-64-") +
         (lanes == 8   ? "v4"
          : lanes == 4 ? "v3"
                       : "v2") +
         count + ", chosen of v2, v3 and v4";
#else
  return "of the instruction set compiled for" + count;
#endif
}

}  // namespace atrapos::fem
