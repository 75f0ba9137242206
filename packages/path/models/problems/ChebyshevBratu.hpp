#pragma once

#include <cmath>
#include <vector>

#include "Bifurcations.hpp"

/// -Laplace u = lambda exp(u) on the unit interval (dimension 1) or square (2), u = 0 on its boundary, by
/// collocation at the Chebyshev points x_j = cos(j pi/N), N even. Only solutions that are even in every
/// coordinate: unknowns at the points with 0 <= x < 1, (N/2)^dimension of them, the centre last.
struct ChebyshevBratu : NoInternal {
  int half, dimension;
  std::vector<double> second;  ///< d^2/ds^2 on even functions, s in [0, 1]: [row * half + column]

  ChebyshevBratu(int N, int dimension) : half(N / 2), dimension(dimension) {
    std::vector<double> x(N + 1), D((N + 1) * (N + 1), 0.0);
    for (int j = 0; j <= N; ++j) x[j] = std::cos(j * M_PI / N);
    const auto c = [&](int j) { return (j == 0 || j == N ? 2.0 : 1.0) * (j % 2 == 0 ? 1 : -1); };
    for (int i = 0; i <= N; ++i) {
      double sum = 0;
      for (int j = 0; j <= N; ++j)
        if (i != j) sum += D[i * (N + 1) + j] = c(i) / c(j) / (x[i] - x[j]);
      D[i * (N + 1) + i] = -sum;  // constants have no derivative
    }
    const auto square = [&](int i, int j) {
      double sum = 0;
      for (int k = 0; k <= N; ++k) sum += D[i * (N + 1) + k] * D[k * (N + 1) + j];
      return sum;
    };
    for (int i = 1; i <= half; ++i)
      for (int j = 1; j <= half; ++j)
        second.push_back(4 * (square(i, j) + (j < half ? square(i, N - j) : 0)));  // ds = dx / 2
  }
  int size() const { return dimension == 1 ? half : half * half; }
  double scale() const { return 10; }
  bool symmetric() const { return false; }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    std::vector<S> r;
    for (int i = 0; i < size(); ++i) {
      const int row = i % half, block = i / half;
      S laplace = 0;
      for (int j = 0; j < half; ++j) laplace = laplace + second[row * half + j] * u[block * half + j];
      if (dimension == 2)
        for (int j = 0; j < half; ++j) laplace = laplace + second[block * half + j] * u[j * half + row];
      r.push_back(-laplace - lambda * exp(u[i]));
    }
    return r;
  }
};
