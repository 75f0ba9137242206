#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "atrapos/linear/Choice.hpp"
#include "atrapos/linear/FactorCost.hpp"
#include "atrapos/linear/Iterations.hpp"
#include "atrapos/linear/TangentSolver.hpp"

namespace atrapos::linear {

/// The first of several solvers whose memory, as its analysis foresees it, is there. An analysis that fails
/// passes the choice on. Analyses of solvers that are not taken are freed at once.
class AutoSolver final : public TangentSolver, public TellsCost, public Iterates, public Chooses {
 public:
  struct Candidate {
    std::string name;  ///< for the line that says why
    std::function<std::unique_ptr<TangentSolver>()> make;
  };

  /// memory: bytes that the solver may take, all ranks together; 0: any. tell: gets the line that says what
  /// was picked and why; may be empty.
  AutoSolver(std::vector<Candidate> candidates, double memory, std::function<void(const std::string&)> tell);

  /// Picks. Throws SolverError where none fits.
  void analyze(const RCP<const CrsMatrix>& K) override;
  void factor(const RCP<const CrsMatrix>& K) override { picked("factor").factor(K); }
  void solve(const MultiVector& b, MultiVector& x) const override { picked("solve").solve(b, x); }
  void solveTransposed(const MultiVector& b, MultiVector& x) const override {
    picked("solve").solveTransposed(b, x);
  }
  std::optional<Inertia> inertia() const override { return solver_ ? solver_->inertia() : std::nullopt; }
  std::optional<FactorCost> estimate() const override;
  std::optional<FactorCost> spent() const override;
  std::optional<Iterations> iterations() const override;
  std::string choice() const override { return choice_; }
  std::string name() const override { return solver_ ? solver_->name() : "automatic"; }
  const Counters& counters() const override { return solver_ ? solver_->counters() : none_; }

 private:
  TangentSolver& picked(const char* call) const;

  std::vector<Candidate> candidates_;
  double memory_;
  std::function<void(const std::string&)> tell_;
  std::unique_ptr<TangentSolver> solver_;
  std::string choice_;
  Counters none_;
};

}  // namespace atrapos::linear
