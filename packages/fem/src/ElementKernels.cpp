#include "ElementKernels.hpp"

#include <stdexcept>
#include <string>

#include "atrapos/fem/KernelChoice.hpp"

// (components of a field, of its shape functions). In space: values; the six multipliers of a rigid body;
// gradients; the vectors of shells, four at a point of eight nodes, seven of an element of
// four, five of one of three, eleven of one of six. In a plane: values, gradients, gradients and u_r/r.
// Scalars: values, gradients.
#define ATRAPOS_ELEMENT_KERNELS(X) \
  X(3, 1) X(3, 2) X(3, 3) X(3, 4) X(3, 5) X(3, 7) X(3, 11) X(2, 1) X(2, 2) X(2, 3) X(1, 1) X(1, 2) X(1, 3)

#ifdef ATRAPOS_KERNEL_LEVEL  // compiled for every instruction set, as laws are (ATRAPOS_POINT_LAW)
namespace atrapos::fem::detail {
#define ATRAPOS_COMPILE(D, C) template ElementKernels ElementKernelsOf<D, C, taylor::nativeLanes>::table();
ATRAPOS_ELEMENT_KERNELS(ATRAPOS_COMPILE)
}  // namespace atrapos::fem::detail
#else
namespace atrapos::fem {
namespace {

template <int D, int C>
ElementKernels kernelsHere() {
  return detail::chosenKernels(
      [](auto lanes) { return detail::ElementKernelsOf<D, C, decltype(lanes)::value>::table(); });
}

}  // namespace

ElementKernels elementKernels(int components, int shapeComponents) {
#define ATRAPOS_CHOOSE(D, C) \
  if (components == D && shapeComponents == C) return kernelsHere<D, C>();
  ATRAPOS_ELEMENT_KERNELS(ATRAPOS_CHOOSE)
  throw std::logic_error("no element loops for fields with " + std::to_string(components) +
                         " components and shape functions with " + std::to_string(shapeComponents));
}

}  // namespace atrapos::fem
#endif
