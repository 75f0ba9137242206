#include "ShellPath.hpp"

#include <Tpetra_Vector.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "atrapos/linear/MakeTangentSolver.hpp"

namespace atrapos::solid::test {

namespace {

PathPoint pointAt(const path::Series& series, double a, const std::vector<int>& dofs) {
  PathPoint p;
  auto u = linear::rcp(new path::Vector(series.coefficient(0).u->getMap()));
  p.lambda = series.evaluate(a, *u);
  const Numbers values = fem::FeProblem::values(*u);
  for (int d : dofs) p.u.push_back(values[d]);
  return p;
}

}  // namespace

ShellPath followPath(fem::FeProblem& problem, const path::Stops& stops, int observedDof) {
  struct Collect final : path::Observer {
    ShellPath path;
    int dof = 0;
    bool onStep(const path::StepReport& report, const path::Series& series) override {
      path.series.push_back(series);
      path.lengths.push_back(report.length);
      for (const auto& limit : report.limitPoints) {
        path.limitPoints.push_back(limit);
        path.limitValues.push_back(pointAt(series, limit.a, {dof}).u[0]);
      }
      return true;
    }
  } collect;
  collect.dof = observedDof;
  linear::TangentSolverOptions solverOptions;
  solverOptions.symmetric = problem.symmetric();
  const auto solver = linear::makeTangentSolver(solverOptions);
  path::PathFollower follower(problem, *solver, path::Options{}, stops);
  collect.path.outcome = follower.run({problem.initialState(0.0), 0.0}, collect);
  return std::move(collect.path);
}

PathPoint atLoad(const ShellPath& path, double lambda, const std::vector<int>& dofs) {
  for (std::size_t s = 0; s < path.series.size(); ++s) {
    // A little further than the step: the load at its very end is not lost to rounding.
    const auto roots = path.series[s].lambdaPolynomial().minus(lambda).roots(path.lengths[s] * (1 + 1e-9));
    if (!roots.empty()) return pointAt(path.series[s], roots[0], dofs);
  }
  throw std::runtime_error("the path does not reach load factor " + std::to_string(lambda));
}

std::vector<PathPoint> sampled(const ShellPath& path, int perStep, const std::vector<int>& dofs) {
  std::vector<PathPoint> points;
  for (std::size_t s = 0; s < path.series.size(); ++s)
    for (int i = s == 0 ? 0 : 1; i <= perStep; ++i)
      points.push_back(pointAt(path.series[s], path.lengths[s] * i / perStep, dofs));
  return points;
}

std::vector<std::vector<double>> table(const std::string& file) {
  std::ifstream in(file[0] == '/' ? file : std::string(SHELL_TEST_DATA) + "/" + file);
  if (!in) throw std::runtime_error("no test data " + file);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.find_first_of("0123456789-") != 0) continue;
    std::vector<double> row;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) {
      char* end = nullptr;
      const double value = std::strtod(cell.c_str(), &end);
      row.push_back(end == cell.c_str() ? std::nan("") : value);
    }
    rows.push_back(row);
  }
  if (rows.empty()) throw std::runtime_error("empty test data " + file);
  return rows;
}

path::StopFunctional stopAt(const fem::FeProblem& problem, int dof, double value) {
  Numbers weights(fem::FeProblem::values(*problem.initialState(0.0)).size(), 0.0);
  weights[dof] = 1;
  return {"displacement", fem::test::vectorOf(problem, weights), value};
}

}  // namespace atrapos::solid::test
