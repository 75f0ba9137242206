#pragma once

#include <memory>
#include <string>

#include "AnalysedGraph.hpp"
#include "Preconditioner.hpp"
#include "atrapos/linear/FactorCost.hpp"
#include "atrapos/linear/Iterations.hpp"
#include "atrapos/linear/KrylovOptions.hpp"
#include "atrapos/linear/TangentSolver.hpp"

namespace atrapos::linear {

/// Belos' GMRES with a preconditioner that is made once per tangent and serves all its right-hand sides,
/// applied from the right: the residual that decides is that of K x = b itself.
///
/// The flexible variant (Saad, SIAM J. Sci. Comput. 14 (1993) 461) keeps the preconditioned vectors, because
/// a factor in single precision is no linear map to the digits that are asked for: without it iterations
/// diverge on thin bodies. Start vectors are projections on earlier solutions (Fischer, Comput. Methods Appl.
/// Mech. Engrg. 163 (1998) 193): the right-hand sides of a series resemble each other. No inertia, and a
/// singular K is not found as such: its iterations do not converge, or give one of its solutions.
class KrylovSolver final : public TangentSolver, public TellsCost, public Iterates {
 public:
  /// `factorThreads`: TangentSolverOptions::factorThreads.
  KrylovSolver(const KrylovOptions& options, bool symmetric, int factorThreads = 1);
  ~KrylovSolver() override;

  void analyze(const RCP<const CrsMatrix>& K) override;
  void factor(const RCP<const CrsMatrix>& K) override;
  void solve(const MultiVector& b, MultiVector& x) const override { solveWith(b, x, false); }
  void solveTransposed(const MultiVector& b, MultiVector& x) const override { solveWith(b, x, !symmetric_); }
  std::optional<Inertia> inertia() const override { return std::nullopt; }
  std::optional<FactorCost> estimate() const override;
  std::optional<FactorCost> spent() const override;
  std::string name() const override;
  const Counters& counters() const override { return counters_; }
  std::optional<Iterations> iterations() const override { return iterations_; }

 private:
  struct Direction;
  void solveWith(const MultiVector& b, MultiVector& x, bool transposed) const;
  std::optional<FactorCost> withOwn(std::optional<FactorCost> cost) const;

  KrylovOptions options_;
  bool symmetric_;
  std::unique_ptr<Preconditioner> preconditioner_;
  std::unique_ptr<AnalysedGraph> graph_;
  double ownBytes_ = 0;  ///< K's values, vectors of the iterations and of earlier solutions
  mutable std::unique_ptr<Direction> forward_, backward_;
  mutable Counters counters_;
  mutable Iterations iterations_;
};

}  // namespace atrapos::linear
