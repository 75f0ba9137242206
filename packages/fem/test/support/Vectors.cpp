#include "support/Vectors.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "atrapos/linear/MakeTangentSolver.hpp"

namespace atrapos::fem::test {

linear::RCP<path::Vector> zeroVector(const path::Problem& problem) {
  return linear::rcp(new path::Vector(problem.map()));
}

void copyInto(const Numbers& values, path::Vector& vector) {
  auto view = vector.getLocalViewHost(Tpetra::Access::OverwriteAll);
  if (vector.getGlobalLength() != values.size()) throw std::logic_error("copyInto: wrong size");
  const auto map = vector.getMap();
  for (std::size_t i = 0; i < view.extent(0); ++i)
    view(i, 0) = values[map->getGlobalElement(static_cast<int>(i))];
}

linear::RCP<path::Vector> vectorOf(const path::Problem& problem, const Numbers& values) {
  auto vector = zeroVector(problem);
  copyInto(values, *vector);
  return vector;
}

Residual residual(path::Problem& problem, const Numbers& u, double lambda, const Memory& memory) {
  auto r = zeroVector(problem);
  Residual result;
  result.norm = problem.residual({vectorOf(problem, u), lambda, memory}, *r);
  result.r = FeProblem::values(*r);
  return result;
}

Numbers Tangent::times(const Numbers& x) const {
  Numbers y(x.size(), 0.0);
  for (std::size_t i = 0; i < y.size(); ++i)
    for (std::size_t e = start[i]; e < start[i + 1]; ++e) y[i] += value[e] * x[column[e]];
  return y;
}

double Tangent::at(int row, int col) const {
  for (std::size_t e = start[row]; e < start[row + 1]; ++e)
    if (column[e] == col) return value[e];
  return 0;
}

TangentTimes tangentTimes(path::Problem& problem, const Numbers& u, double lambda, const Numbers& x,
                          const Memory& memory) {
  auto F = zeroVector(problem), y = zeroVector(problem);
  const auto K = problem.tangent({vectorOf(problem, u), lambda, memory}, *F);
  K->apply(*vectorOf(problem, x), *y);
  return {FeProblem::values(*y), FeProblem::values(*F)};
}

Tangent tangent(path::Problem& problem, const Numbers& u, double lambda, const Memory& memory) {
  auto F = zeroVector(problem);
  const auto K = problem.tangent({vectorOf(problem, u), lambda, memory}, *F);
  Tangent result;
  result.F = FeProblem::values(*F);
  const auto local = K->getLocalMatrixHost();
  for (int i = 0; i <= local.numRows(); ++i) result.start.push_back(local.graph.row_map(i));
  for (std::size_t e = 0; e < result.start.back(); ++e) {
    result.column.push_back(local.graph.entries(e));
    result.value.push_back(local.values(e));
  }
  return result;
}

Equilibrium equilibrium(path::Problem& problem, double lambda, Numbers start, double tolerance,
                        const Memory& memory) {
  linear::TangentSolverOptions options;
  options.symmetric = problem.symmetric();
  const auto solver = linear::makeTangentSolver(options);
  auto u = vectorOf(problem, start);
  auto F = zeroVector(problem), r = zeroVector(problem), change = zeroVector(problem);
  for (int iteration = 0; iteration < 20; ++iteration) {
    const auto K = problem.tangent({u, lambda, memory}, *F);
    problem.residual({u, lambda, memory}, *r);
    if (iteration == 0) solver->analyze(K);
    solver->factor(K);
    solver->solve(*r, *change);
    u->update(-1, *change, 1);
    if (change->normInf() < tolerance) return {FeProblem::values(*u), solver->inertia()};
  }
  throw std::runtime_error("equilibrium: Newton's method did not converge");
}

double dot(const Numbers& x, const Numbers& y) {
  double s = 0;
  for (std::size_t i = 0; i < x.size(); ++i) s += x[i] * y.at(i);
  return s;
}

double norm(const Numbers& x) { return std::sqrt(dot(x, x)); }

double largest(const Numbers& x) {
  double m = 0;
  for (double v : x)
    if (!(std::abs(v) <= m)) m = std::abs(v);  // keeps a NaN
  return m;
}

Numbers sum(const Numbers& x, double c, const Numbers& y) {
  Numbers z = x;
  for (std::size_t i = 0; i < x.size(); ++i) z[i] += c * y.at(i);
  return z;
}

}  // namespace atrapos::fem::test
