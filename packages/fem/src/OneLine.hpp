#pragma once

#include <array>
#include <utility>
#include <vector>

#include "LinePoints.hpp"

namespace atrapos::fem {

/// One line, c [coefficient], looked at place by place (side by side in all lanes).
class OneLine {
 public:
  OneLine(const LineLaws& laws, const double* c, double lambda);

  struct At {
    double gap, slope, bend;
    std::array<double, 3> normal;
  };
  /// Its place, x, y, z and the load factor (4), and dx/dxi.
  void place(double xi, double* x, double* along) const;
  /// preferred: the piece to be taken where the place is on the border of several.
  At operator()(double xi, int preferred = PointPieces::any) const;

  /// Gap and slope alone, at a fraction of the cost.
  std::pair<double, double> gapAndSlope(double xi) const;
  int pieceAt(double xi, int preferred = PointPieces::any) const;
  /// Which coordinate in the piece tells that a place is on its border; Hold::place where none does, or the
  /// line runs along the border.
  Hold borderOf(int piece, double xi) const;

 private:
  LineProbe probeAt(double xi, int preferred) const;

  const LineLaws& laws_;
  double lambda_;
  std::vector<double> c_;
};

}  // namespace atrapos::fem
