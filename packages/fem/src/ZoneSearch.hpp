#pragma once

#include <array>
#include <optional>
#include <vector>

#include "LinePoints.hpp"

namespace atrapos::fem {

/// An extremum of the gap along a line.
struct Extremum {
  double xi = 0, gap = 0;
  bool least = true;  ///< a minimum
};

/// The gap along a line: at both ends, and its extrema, ascending in xi, a little beyond the ends too.
struct GapShape {
  double ends[2] = {0, 0};
  std::vector<Extremum> extrema;
};

/// How far beyond the ends, in xi, extrema are looked for: they may come in within a step.
constexpr double kBeyondEnds = 0.25;

/// Of kLanes lines, c [coefficient][lane].
std::vector<GapShape> gapShapes(const LineLaws& laws, const double* c, double lambda);

/// The same of batches of lines, for which residual, tangent, series, events and results of one state ask by
/// turns: what the last few states had is not looked for again.
class KnownShapes {
 public:
  explicit KnownShapes(int batches = 0) : of_(batches) {}

  /// Valid until others of this batch are asked for.
  const std::vector<GapShape>& of(const LineLaws& laws, int batch, const double* c, double lambda);

 private:
  struct Known {
    std::vector<double> c;
    double lambda = 0;
    std::vector<GapShape> shapes;
  };
  static constexpr int kStates = 4;
  struct Batch {
    std::array<Known, kStates> states;
    int next = 0;  ///< to be overwritten
  };
  std::vector<Batch> of_;
};

/// The root of the gap of one line, c [coefficient], between two places where it has different signs.
double rootBetween(const LineLaws& laws, const double* c, double lambda, double from, double to);
/// The root next to a place where the gap is almost zero; none where Newton's method from there leaves
/// its neighbourhood, |xi - from| < within.
std::optional<double> rootNear(const LineLaws& laws, const double* c, double lambda, double from,
                               double within);

}  // namespace atrapos::fem
