#pragma once

#include <Kokkos_Core.hpp>
#include <algorithm>
#include <memory>
#include <vector>

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
  static constexpr int numPlace = detail::PlaceInputs<Tool>::value;

  std::shared_ptr<const PatchSet> set;
  Tool tool;

  /// As a fem::DataUpdate for laws with data (Delta, patch, t1, t2): the choice is a function of the place
  /// alone, and where the surface is not smooth a path ends with steps that are too small.
  void operator()(int numPoints, const double* in, double* data) const {
    const std::vector<int> none(numPoints, fem::PointPieces::any);
    pieces(1).update(numPoints, in, none.data(), data);
  }

  /// For fem::LawTerm and fem::UnilateralTerm: paths go on across borders of patches where the surface is not
  /// smooth. `before`: data of the law that stand before the tool's (patch, t1, t2).
  fem::PieceSearch pieces(int before) const {
    return pieces(numPlace, before,
                  [](const double* in, const double*, double* x) { std::copy_n(in, numPlace, x); });
  }

  /// The same for laws with other inputs: placeOf(inputs, data, x) gives (x) or (x, load factor) of a point.
  template <class PlaceOf>
  fem::PieceSearch pieces(int numInputs, int before, const PlaceOf& placeOf) const {
    fem::PieceSearch search;
    search.count = set->numPatches();
    search.numInputs = numInputs;
    search.numData = before + detail::ToolData<Tool>::value;
    search.piece = before;
    search.update = [self = *this, placeOf, stride = search.numData, numInputs, before](
                        int numPoints, const double* in, const int* preferred, double* data) {
      using Host = Kokkos::DefaultHostExecutionSpace;
      Kokkos::parallel_for("patchSearch", Kokkos::RangePolicy<Host>(0, numPoints), [&](int p) {
        double* own = data + static_cast<std::size_t>(p) * stride;
        double x[numPlace];
        placeOf(in + static_cast<std::size_t>(p) * numInputs, own, x);
        self.locate(x, preferred[p], own + before);
      });
      Host().fence();
    };
    return search;
  }

  /// The tool's data of points that are over no patch, to begin with.
  static std::vector<double> overNothing(int numPoints) {
    std::vector<double> data;
    for (int p = 0; p < numPoints; ++p) data.insert(data.end(), {-1, 0, 0});
    return data;
  }

 private:
  /// The tool's data at a place, on the patch that is preferred where it lies on a border.
  void locate(const double* x, int preferred, double* toolData) const {
    double X[3];
    if constexpr (numPlace == 4)
      tool.toToolFrame(x, X);
    else
      std::copy_n(x, 3, X);
    const auto place = preferred == fem::PointPieces::any ? set->locate(X) : set->locate(X, preferred);
    std::copy(place.begin(), place.end(), toolData);
  }
};

}  // namespace atrapos::contact
