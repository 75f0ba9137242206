#pragma once

#include <optional>
#include <vector>

#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/linear/TangentSolver.hpp"

/// A problem's vectors and matrices as plain numbers, so that the tests need no Tpetra header.
namespace atrapos::fem::test {

using Numbers = std::vector<double>;

/// Numbers of all dofs, given alike on every rank.
linear::RCP<path::Vector> vectorOf(const path::Problem& problem, const Numbers& values);
linear::RCP<path::Vector> zeroVector(const path::Problem& problem);
void copyInto(const Numbers& values, path::Vector& vector);

struct Residual {
  Numbers r;
  path::ResidualNorm norm;
};
/// At the state (u, lambda) with this memory, null: as the problem starts.
using Memory = std::shared_ptr<const path::Memory>;
Residual residual(path::Problem& problem, const Numbers& u, double lambda, const Memory& memory = nullptr);

/// K x and F = -dR/dlambda, on any number of ranks.
struct TangentTimes {
  Numbers Kx, F;
};
TangentTimes tangentTimes(path::Problem& problem, const Numbers& u, double lambda, const Numbers& x,
                          const Memory& memory = nullptr);

/// The tangent in compressed rows, and F = -dR/dlambda. One rank.
struct Tangent {
  std::vector<std::size_t> start;
  std::vector<int> column;
  Numbers value, F;

  Numbers times(const Numbers& x) const;
  double at(int row, int column) const;  ///< 0 where there is no entry
};
Tangent tangent(path::Problem& problem, const Numbers& u, double lambda, const Memory& memory = nullptr);

/// Newton's method at fixed lambda until the largest change of u is below `tolerance` in 20 iterations;
/// throws std::runtime_error where it is not.
struct Equilibrium {
  Numbers u;
  std::optional<linear::Inertia> inertia;  ///< of the last tangent
};
Equilibrium equilibrium(path::Problem& problem, double lambda, Numbers start, double tolerance = 1e-12,
                        const Memory& memory = nullptr);

double norm(const Numbers& x);
double dot(const Numbers& x, const Numbers& y);
double largest(const Numbers& x);                           ///< of the absolute values
Numbers sum(const Numbers& x, double c, const Numbers& y);  ///< x + c y

}  // namespace atrapos::fem::test
