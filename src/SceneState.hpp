#pragma once

#include <map>
#include <optional>
#include <vector>

#include "atrapos/fem/FeProblem.hpp"

namespace atrapos {

/// What a problem shows at one state: each evaluated when it is first asked for, and once, whoever asks.
/// Refers to both; the problem must stay as it is meanwhile. Collective.
class SceneState {
 public:
  SceneState(const fem::FeProblem& problem, const path::Vector& u, double lambda)
      : problem_(problem), u_(u), lambda_(lambda) {}

  const path::Vector& u() const { return u_; }
  double lambda() const { return lambda_; }

  /// FeProblem::values
  const std::vector<double>& values() const {
    if (!values_) values_ = fem::FeProblem::values(u_);
    return *values_;
  }
  /// FeProblem::reactions
  const std::vector<double>& reactions() const {
    if (!reactions_) reactions_ = problem_.reactions(u_, lambda_);
    return *reactions_;
  }
  /// FeProblem::observe
  const fem::PointValues& observed(int term) const {
    const auto found = observed_.find(term);
    if (found != observed_.end()) return found->second;
    return observed_[term] = problem_.observe(term, u_, lambda_);
  }
  /// FeProblem::forces of a term.
  const std::vector<double>& forces(int term) const {
    const auto found = forces_.find(term);
    if (found != forces_.end()) return found->second;
    return forces_[term] = problem_.forces(problem_.term(term), u_, lambda_);
  }

 private:
  const fem::FeProblem& problem_;
  const path::Vector& u_;
  double lambda_;
  mutable std::optional<std::vector<double>> values_, reactions_;
  mutable std::map<int, fem::PointValues> observed_;
  mutable std::map<int, std::vector<double>> forces_;
};

}  // namespace atrapos
