#include "atrapos/fem/Processor.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "atrapos/taylor/Lanes.hpp"

namespace atrapos::fem {
namespace {

#ifdef ATRAPOS_KERNEL_LEVELS
struct Level {
  std::string name;
  int lanes;
  bool here;
  bool compiled() const { return (ATRAPOS_KERNEL_LEVELS & lanes) != 0; }
};

const std::vector<Level>& levels() {
  static const std::vector<Level> all{{"v2", 2, __builtin_cpu_supports("x86-64-v2") != 0},
                                      {"v3", 4, __builtin_cpu_supports("x86-64-v3") != 0},
                                      {"v4", 8, __builtin_cpu_supports("x86-64-v4") != 0}};
  return all;
}

/// "v2, v3 and v4": those that this build has.
std::string compiledLevels() {
  std::vector<std::string> names;
  for (const Level& level : levels())
    if (level.compiled()) names.push_back(level.name);
  std::string text = names.front();
  for (std::size_t i = 1; i < names.size(); ++i) text += (i + 1 < names.size() ? ", " : " and ") + names[i];
  return text;
}

int askedLanes(const std::string& asked) {
  const std::string key = "ATRAPOS_KERNELS=" + asked + ": ";
  for (const Level& level : levels()) {
    if (asked != level.name) continue;
    if (!level.compiled())
      throw std::invalid_argument(key + "this build has kernels for " + compiledLevels());
    if (!level.here) throw std::invalid_argument(key + "this processor has no x86-64-" + asked);
    return level.lanes;
  }
  throw std::invalid_argument(key + "expected v2, v3 or v4");
}

int chooseLanes() {
  const char* asked = std::getenv("ATRAPOS_KERNELS");
  if (asked != nullptr && *asked != '\0') return askedLanes(asked);
  int lanes = 0;
  for (const Level& level : levels())
    if (level.compiled() && level.here) lanes = level.lanes;
  if (lanes == 0)
    throw std::invalid_argument("the kernels of this build are for x86-64-" + compiledLevels() +
                                ", and this processor has none of these");
  return lanes;
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
  for (const Level& level : levels())
    if (level.lanes == lanes)
      return "x86-64-" + level.name + count +
             (level.lanes == ATRAPOS_KERNEL_LEVELS ? ", the only ones of this build"
                                                   : ", chosen of " + compiledLevels());
  throw std::logic_error("describeKernels: no level has these lanes");
#else
  return "of the instruction set compiled for" + count;
#endif
}

}  // namespace atrapos::fem
