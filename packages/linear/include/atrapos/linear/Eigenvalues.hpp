#pragma once

#include <complex>
#include <functional>
#include <vector>

#include "atrapos/linear/Types.hpp"

namespace atrapos::linear {

/// y = K^-1 x, or K^-1 M x, column by column; x and y live on the same map and are different objects.
using Inverse = std::function<void(const MultiVector& x, MultiVector& y)>;

/// Eigenvalues mu of K x = mu x, or K x = mu M x, nearest to zero first. Neither matrix need be symmetric.
struct NearestEigenvalues {
  std::vector<std::complex<double>> values;
  bool complete = false;  ///< these are all that there are
};

/// What stands at the right side of K x = mu M x.
enum class Mass {
  regular,  ///< as many eigenvalues as unknowns
  singular  ///< some are infinite, and left out: those 1e7 times as far from zero as the nearest one
};

/// At least `count` eigenvalues of K next to zero, or all, as the largest of K^-1: block Krylov-Schur
/// (Anasazi; Stewart 2001, Zhou and Saad 2008) with blocks of two, which see a double eigenvalue; below 64
/// unknowns the whole K^-1 by LAPACK. Relative accuracy 1e-8. Fewer, perhaps none, where the iteration does
/// not converge. Global indices are 0, 1, ... Collective; some 5 solves an eigenvalue.
NearestEigenvalues nearestEigenvalues(const Inverse& inverse, const RCP<const Map>& map, int count,
                                      Mass mass = Mass::regular);

}  // namespace atrapos::linear
