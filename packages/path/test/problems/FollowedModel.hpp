#pragma once

#include "Record.hpp"
#include "atrapos/models/Models.hpp"

/// A model problem followed with the dense solver, with inertia where its tangent is symmetric.
struct FollowedModel {
  std::unique_ptr<atrapos::path::Problem> problem;
  atrapos::models::Setup setup;
  std::unique_ptr<DenseSolver> solver;
  Record record;
  atrapos::path::Outcome outcome;

  explicit FollowedModel(const std::string& name, const atrapos::models::Parameters& parameters = {},
                         atrapos::path::Options options = {})
      : problem(atrapos::models::make(name, parameters)),
        setup(atrapos::models::setup(name, parameters, *problem)) {
    if (problem->symmetric())
      solver = std::make_unique<SymmetricDenseSolver>();
    else
      solver = std::make_unique<DenseSolver>();
    options.direction = setup.direction;
    outcome = atrapos::path::PathFollower(*problem, *solver, options, setup.stops).run(setup.start, record);
  }

  /// Monitor number i along a step.
  atrapos::path::Rational monitor(std::size_t step, int i) const {
    return record.series[step].functional(*setup.monitors.at(i).weights);
  }

  /// Largest relative residual at `samples` points inside every step.
  double worstInside(int samples = 20) {
    auto u = Teuchos::rcp(new atrapos::path::Vector(problem->map()));
    auto r = Teuchos::rcp(new atrapos::path::Vector(problem->map()));
    double worst = 0;
    for (std::size_t s = 0; s < record.steps.size(); ++s)
      for (int i = 0; i <= samples; ++i) {
        const double lambda = record.series[s].evaluate(record.steps[s].length * i / samples, *u);
        worst = std::max(worst, problem->residual({u, lambda}, *r).relative());
      }
    return worst;
  }
};
