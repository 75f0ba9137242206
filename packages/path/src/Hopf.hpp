#pragma once

#include <complex>
#include <vector>

#include "atrapos/path/Calls.hpp"
#include "atrapos/path/Report.hpp"

namespace atrapos::path {

/// Eigenvalues of K x = mu M x next to zero at a place of a step.
struct Spectrum {
  double a = 0;
  std::vector<std::complex<double>> values;
};

struct HopfFound {
  std::vector<HopfPoint> points;  ///< ascending in a
  int factorizations = 0;
};

/// Where, between two places of a step, conjugate pairs cross the imaginary axis (docs/theory/stability.md):
/// as many as the numbers of unstable eigenvalues at both places tell of. Each trial factors the tangent on
/// the series and computes `count` eigenvalues, some nine for a point. What is not found is left out. The
/// solver's factorization is another one afterwards.
HopfFound findHopfPoints(Calls& calls, const Series& series, const Spectrum& start, const Spectrum& end,
                         int count);

}  // namespace atrapos::path
