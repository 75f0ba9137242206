#pragma once

#include <Kokkos_Core.hpp>
#include <algorithm>
#include <memory>

#include "atrapos/contact/ContactLaw.hpp"
#include "atrapos/contact/MovingTool.hpp"
#include "atrapos/contact/PatchSet.hpp"
#include "atrapos/fem/PointPieces.hpp"

namespace atrapos::contact {

/// Which patch every point of a contact is over: brings the data of laws with PatchTool or
/// MovingTool<PatchTool> up to date with the places, [point] (x) or (x, load factor). On the host, points in
/// parallel.
template <class Tool>
struct PatchSearch {
  std::shared_ptr<const PatchSet> set;
  Tool tool;

  /// As a fem::DataUpdate for laws with data (Delta, patch, t1, t2): the choice is a function of the place
  /// alone, and where the surface is not smooth a path ends with steps that are too small.
  void operator()(int numPoints, const double* in, double* data) const {
    update(numPoints, in, nullptr, 1, data);
  }

  /// For fem::LawTerm and fem::UnilateralTerm: paths go on across borders of patches where the surface is not
  /// smooth. `before`: data of the law that stand before the tool's (patch, t1, t2).
  fem::PieceSearch pieces(int before) const {
    fem::PieceSearch search;
    search.count = set->numPatches();
    search.numInputs = detail::PlaceInputs<Tool>::value;
    search.numData = before + detail::ToolData<Tool>::value;
    search.piece = before;
    search.update = [self = *this, before](int numPoints, const double* in, const int* preferred,
                                           double* data) {
      self.update(numPoints, in, preferred, before, data);
    };
    return search;
  }

 private:
  void update(int numPoints, const double* in, const int* preferred, int before, double* data) const {
    constexpr int inputs = detail::PlaceInputs<Tool>::value;
    const int stride = before + detail::ToolData<Tool>::value;
    using Host = Kokkos::DefaultHostExecutionSpace;
    Kokkos::parallel_for("patchSearch", Kokkos::RangePolicy<Host>(0, numPoints), [&](int p) {
      const double* x = in + static_cast<std::size_t>(p) * inputs;
      double X[3];
      if constexpr (inputs == 4)
        tool.toToolFrame(x, X);
      else
        std::copy_n(x, 3, X);
      const bool chosen = preferred != nullptr && preferred[p] != fem::PointPieces::any;
      const auto place = chosen ? set->locate(X, preferred[p]) : set->locate(X);
      std::copy(place.begin(), place.end(), data + static_cast<std::size_t>(p) * stride + before);
    });
    Host().fence();
  }
};

}  // namespace atrapos::contact
