#pragma once

#include <map>
#include <optional>
#include <vector>

#include "atrapos/fem/FeProblem.hpp"

namespace atrapos {

/// What a problem shows at one state: each evaluated when it is first asked for, and once, whoever asks.
/// Refers to the problem. Collective.
class SceneState {
 public:
  SceneState(const fem::FeProblem& problem, path::State state)
      : problem_(problem), state_(std::move(state)) {}

  const path::Vector& u() const { return *state_.u; }
  double lambda() const { return state_.lambda; }

  /// FeProblem::values, and FeProblem::reactions, [dof]
  const std::vector<double>& values() const {
    if (!values_) values_ = fem::FeProblem::values(*state_.u);
    return *values_;
  }
  const std::vector<double>& supportForces() const {
    if (!supportForces_) supportForces_ = problem_.reactions(state_);
    return *supportForces_;
  }

  /// FeProblem::slaveForces
  const std::vector<double>& slaveForces() const {
    if (!slaveForces_) slaveForces_ = problem_.slaveForces(state_);
    return *slaveForces_;
  }

  // Vectors in space of all nodes (DofMap::vectors), [3 node + component]:

  /// displacements, and changes of directors,
  const std::vector<double>& displacements() const {
    if (!displacements_) displacements_ = vectors(values());
    return *displacements_;
  }
  /// FeProblem::reactions
  const std::vector<double>& reactions() const {
    if (!reactions_) reactions_ = vectors(supportForces());
    return *reactions_;
  }
  /// FeProblem::observe
  const fem::PointValues& observed(int term) const {
    const auto found = observed_.find(term);
    if (found != observed_.end()) return found->second;
    return observed_[term] = problem_.observe(term, state_);
  }
  /// and FeProblem::forces of a term.
  const std::vector<double>& forces(int term) const {
    const auto found = forces_.find(term);
    if (found != forces_.end()) return found->second;
    return forces_[term] = vectors(problem_.forces(problem_.term(term), state_));
  }

 private:
  std::vector<double> vectors(const std::vector<double>& dofs) const {
    return problem_.model().dofs.vectors(dofs);
  }

  const fem::FeProblem& problem_;
  path::State state_;
  mutable std::optional<std::vector<double>> values_, supportForces_, slaveForces_, displacements_,
      reactions_;
  mutable std::map<int, fem::PointValues> observed_;
  mutable std::map<int, std::vector<double>> forces_;
};

}  // namespace atrapos
