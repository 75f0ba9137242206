#pragma once

#include <mpi.h>

#include <memory>
#include <vector>

#include "MumpsInstance.hpp"
#include "Preconditioner.hpp"

namespace atrapos::linear {

/// MUMPS' factor of K in single precision: half the memory of the factor in double precision, and less where
/// its dense blocks have low rank (block low-rank format, ICNTL(35) = 2; Amestoy et al., SIAM J. Sci. Comput.
/// 37 (2015) A1451, doi:10.1137/120903476). It pivots, and serves thin bodies. Where the condition is far
/// above 1e7, as with the multipliers of hard contact, iterations may not repair what it loses.
class SingleFactor final : public Preconditioner {
 public:
  /// lowRank: relative size of what is dropped from dense blocks; 0: full blocks. threads: as
  /// TangentSolverOptions::factorThreads.
  SingleFactor(bool symmetric, double lowRank, int threads = 1);
  ~SingleFactor() override;

  void analyze(const RCP<const CrsMatrix>& K) override;
  void factor(const RCP<const CrsMatrix>& K) override;
  void apply(const Vector& x, Vector& y, bool transposed) const override;
  std::string name() const override;
  std::optional<FactorCost> estimate() const override { return estimate_; }
  std::optional<FactorCost> spent() const override { return spent_; }

 private:
  bool symmetric_;
  double lowRank_;
  int threads_;
  std::unique_ptr<MumpsInstance<SingleMumps>> mumps_;
  std::optional<FactorCost> estimate_, spent_;
  MPI_Comm comm_ = MPI_COMM_NULL;
  int rank_ = 0;
  MumpsEntries entries_;
  std::vector<float> values_;
  std::vector<int> counts_, offsets_;  // rank 0: rows of every rank
  mutable std::vector<float> own_, rhs_;
};

}  // namespace atrapos::linear
