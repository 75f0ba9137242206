#include "ElementKernels.hpp"

#include <stdexcept>
#include <string>

#include "atrapos/fem/KernelChoice.hpp"

// Shape components: values; values with multipliers; gradients; four vectors of a shell; five of a rigid
// body.
#ifdef ATRAPOS_KERNEL_LEVEL  // compiled for every instruction set, as laws are (ATRAPOS_POINT_LAW)
namespace atrapos::fem::detail {
template ElementKernels ElementKernelsOf<1, taylor::nativeLanes>::table();
template ElementKernels ElementKernelsOf<2, taylor::nativeLanes>::table();
template ElementKernels ElementKernelsOf<3, taylor::nativeLanes>::table();
template ElementKernels ElementKernelsOf<4, taylor::nativeLanes>::table();
template ElementKernels ElementKernelsOf<5, taylor::nativeLanes>::table();
}  // namespace atrapos::fem::detail
#else
namespace atrapos::fem {
namespace {

template <int C>
ElementKernels kernelsHere() {
  return detail::chosenKernels(
      [](auto lanes) { return detail::ElementKernelsOf<C, decltype(lanes)::value>::table(); });
}

}  // namespace

ElementKernels elementKernels(int components) {
  switch (components) {
    case 1:
      return kernelsHere<1>();
    case 2:
      return kernelsHere<2>();
    case 3:
      return kernelsHere<3>();
    case 4:
      return kernelsHere<4>();
    case 5:
      return kernelsHere<5>();
    default:
      throw std::logic_error("shape functions with " + std::to_string(components) +
                             " components at a point: the loops take 1 to 5");
  }
}

}  // namespace atrapos::fem
#endif
