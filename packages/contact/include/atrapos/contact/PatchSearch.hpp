#pragma once

#include <Kokkos_Core.hpp>
#include <algorithm>
#include <memory>

#include "atrapos/contact/ContactLaw.hpp"
#include "atrapos/contact/MovingTool.hpp"
#include "atrapos/contact/PatchSet.hpp"

namespace atrapos::contact {

/// Which patch every point of a contact is over: brings the data of ContactLaw<PatchTool> or
/// ContactLaw<MovingTool<PatchTool>>, [point] (Delta, patch, t1, t2), up to date with the inputs, [point] (x)
/// or (x, load factor). A fem::DataUpdate: the choice is a function of the place alone. On the host, points
/// in parallel.
template <class Tool>
struct PatchSearch {
  std::shared_ptr<const PatchSet> set;
  Tool tool;

  void operator()(int numPoints, const double* in, double* data) const {
    constexpr int inputs = detail::PlaceInputs<Tool>::value, stride = 1 + detail::ToolData<Tool>::value;
    using Host = Kokkos::DefaultHostExecutionSpace;
    Kokkos::parallel_for("patchSearch", Kokkos::RangePolicy<Host>(0, numPoints), [&](int p) {
      const double* x = in + static_cast<std::size_t>(p) * inputs;
      double X[3];
      if constexpr (inputs == 4)
        tool.toToolFrame(x, X);
      else
        std::copy_n(x, 3, X);
      const auto place = set->locate(X);
      std::copy(place.begin(), place.end(), data + static_cast<std::size_t>(p) * stride + 1);
    });
    Host().fence();
  }
};

}  // namespace atrapos::contact
