#pragma once

#include <memory>
#include <string>
#include <vector>

#include "AnalysedGraph.hpp"
#include "MumpsInstance.hpp"
#include "RowExchange.hpp"
#include "atrapos/linear/Determinant.hpp"
#include "atrapos/linear/FactorCost.hpp"
#include "atrapos/linear/TangentSolver.hpp"

namespace atrapos::linear {

struct MumpsOptions {
  bool symmetric = true;              ///< SYM=2, K's lower triangle is read; else SYM=0
  double nullPivotTolerance = 1e-14;  ///< CNTL(3): null pivot rows, relative to the scaled matrix
  int workspacePercent = 30;  ///< ICNTL(14) to start with; doubled as often as needed, 10 times at most
  int factorThreads = 1;      ///< TangentSolverOptions::factorThreads
};

/// MUMPS, called directly: multifrontal L D L^T (SYM=2) or L U (SYM=0) with METIS ordering, on any number of
/// ranks. K, right-hand sides and solutions are distributed (ICNTL(18) = 3, ICNTL(20) = 10, ICNTL(21) = 1):
/// no rank holds a whole vector. The ordering alone is made on rank 0.
///
/// SYM=2 gives the exact inertia (Sylvester). A K with null pivots throws SingularTangentError with their
/// number; inertia() is then still that of K, but nothing can be solved. SYM=0 gives the sign of det K.
///
/// Construction needs a running MPI, and destruction is collective: the owner destroys solvers before
/// MPI_Finalize (later, MUMPS' memory cannot be freed and stays with the process).
class MumpsSolver final : public TangentSolver, public TellsCost, public TellsDeterminant {
 public:
  explicit MumpsSolver(const MumpsOptions& options = {});
  ~MumpsSolver() override;

  void analyze(const RCP<const CrsMatrix>& K) override;
  void factor(const RCP<const CrsMatrix>& K) override;
  void solve(const MultiVector& b, MultiVector& x) const override { solveWith(b, x, false); }
  void solveTransposed(const MultiVector& b, MultiVector& x) const override { solveWith(b, x, true); }
  std::optional<Inertia> inertia() const override { return inertia_; }
  std::optional<int> determinantSign() const override { return determinantSign_; }
  std::optional<FactorCost> estimate() const override { return estimate_; }
  std::optional<FactorCost> spent() const override { return spent_; }
  std::string name() const override;
  const Counters& counters() const override { return counters_; }

  /// Factorizations repeated with a larger work space, since construction.
  int memoryRetries() const { return memoryRetries_; }

 private:
  void solveWith(const MultiVector& b, MultiVector& x, bool transposed) const;
  void solveHere(const MultiVector& b, MultiVector& x) const;
  void solveDistributed(const MultiVector& b, MultiVector& x, bool transposed) const;
  double ownBytes() const;  ///< lists of K's entries, all ranks

  MumpsOptions options_;
  std::unique_ptr<AnalysedGraph> graph_;
  std::unique_ptr<MumpsInstance<DoubleMumps>> mumps_;
  MPI_Comm comm_ = MPI_COMM_NULL;
  int size_ = 1;
  bool factored_ = false;
  int memoryRetries_ = 0;
  std::optional<Inertia> inertia_;
  std::optional<int> determinantSign_;
  std::optional<FactorCost> estimate_, spent_;
  mutable Counters counters_;

  MumpsEntries entries_;
  std::vector<double> values_;                  // SYM=2: theirs
  std::vector<GlobalIndex> firstRows_;          // [rank], then n
  std::vector<MUMPS_INT> ownRows_;              // of this rank, from 1
  mutable std::vector<double> rhs_, solution_;  // as MUMPS has them: [column][row here]
  mutable std::vector<MUMPS_INT> solved_;       // rows whose solution MUMPS leaves here, from 1
  // From there to the rows' owners, with K and with K^T, since the last factorization.
  mutable std::unique_ptr<RowExchange> exchange_[2];
};

}  // namespace atrapos::linear
