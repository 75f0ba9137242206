#pragma once

#include <type_traits>

#include "atrapos/fem/Processor.hpp"
#include "atrapos/taylor/Lanes.hpp"

namespace atrapos::fem::detail {

/// of(number of lanes, a std::integral_constant) for the instruction set that is in use here.
template <class Of>
auto chosenKernels(const Of& of) {
#ifdef ATRAPOS_KERNEL_LEVELS
  switch (processorLanes()) {
    case 8:
      return of(std::integral_constant<int, 8>());
    case 4:
      return of(std::integral_constant<int, 4>());
    default:
      return of(std::integral_constant<int, 2>());
  }
#else
  return of(std::integral_constant<int, taylor::nativeLanes>());
#endif
}

}  // namespace atrapos::fem::detail
