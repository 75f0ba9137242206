#pragma once

#include <type_traits>

#include "atrapos/fem/Processor.hpp"
#include "atrapos/taylor/Lanes.hpp"

namespace atrapos::fem::detail {

/// of(number of lanes, a std::integral_constant) for the instruction set that is in use here.
template <class Of>
auto chosenKernels(const Of& of) {
#ifdef ATRAPOS_KERNEL_LEVELS
  // Of levels without kernels nothing may be named: processorLanes() is none of theirs.
  constexpr int levels = ATRAPOS_KERNEL_LEVELS, narrowest = levels & -levels;
  const int lanes = processorLanes();
  if constexpr ((levels & 8) != 0 && narrowest != 8)
    if (lanes == 8) return of(std::integral_constant<int, 8>());
  if constexpr ((levels & 4) != 0 && narrowest != 4)
    if (lanes == 4) return of(std::integral_constant<int, 4>());
  return of(std::integral_constant<int, narrowest>());
#else
  return of(std::integral_constant<int, taylor::nativeLanes>());
#endif
}

}  // namespace atrapos::fem::detail
