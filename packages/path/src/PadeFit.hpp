#pragma once

#include <memory>

#include "atrapos/path/Problem.hpp"
#include "atrapos/path/Series.hpp"

namespace atrapos::path {

/// A rational form of a series and how far it is good for.
struct PadeFit {
  std::shared_ptr<const Pade> form;  ///< null where there is none
  double range = 0;                  ///< largest a of use; 0 where there is none
  bool usable() const { return form != nullptr && range > 0; }
};

/// The forms P_N and P_{N-1} of a series of order N, and the range of P_N: the largest a <= longest, short of
/// the first real positive pole of either, up to which ||P_N - P_{N-1}|| <= delta ||P_N - X_0|| in the norm
/// w ||X||^2 + lambda^2.
///
/// The denominator (docs/theory/path.md) makes the orders L+1 .. N of D(a) X(a) as small as possible; where
/// the series has full rank that is L = M = N-1 and the triangular solve of Cochelin and Najah.
/// Costs N^2/2 inner products and vector updates.
PadeFit fitPade(const Problem& problem, const Series& series, double delta, double longest);

/// Real poles of a series: roots of its denominators of both orders N and N-1 in [-behind, ahead] that agree
/// to `agreement` of their size, nearest to 0 first.
std::vector<double> realPoles(const Problem& problem, const Series& series, double behind, double ahead,
                              double noise, double agreement);

}  // namespace atrapos::path
