#pragma once

#include <complex>
#include <functional>
#include <vector>

#include "atrapos/linear/Types.hpp"

namespace atrapos::linear {

/// y = K^-1 x, column by column; x and y live on the same map and are different objects.
using Inverse = std::function<void(const MultiVector& x, MultiVector& y)>;

/// Eigenvalues of a matrix K that need not be symmetric, nearest to zero first.
struct NearestEigenvalues {
  std::vector<std::complex<double>> values;
  bool complete = false;  ///< these are all that K has
};

/// At least `count` eigenvalues of K next to zero, or all, as the largest of K^-1: block Krylov-Schur
/// (Anasazi; Stewart 2001, Zhou and Saad 2008) with blocks of two, which see a double eigenvalue; below 64
/// unknowns the whole K^-1 by LAPACK. Relative accuracy 1e-8. Fewer, perhaps none, where the iteration does
/// not converge. Global indices are 0, 1, ... Collective; some 5 solves an eigenvalue.
NearestEigenvalues nearestEigenvalues(const Inverse& inverse, const RCP<const Map>& map, int count);

}  // namespace atrapos::linear
