#include "SingleFactor.hpp"

#include <fmt/format.h>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>

#include "RowNumbering.hpp"
#include "atrapos/linear/Error.hpp"

namespace atrapos::linear {

SingleFactor::SingleFactor(bool symmetric, double lowRank, int threads)
    : symmetric_(symmetric), lowRank_(lowRank), threads_(threads) {}
SingleFactor::~SingleFactor() = default;

std::string SingleFactor::name() const {
  return fmt::format("MUMPS SYM={} in single precision{}", symmetric_ ? 2 : 0,
                     lowRank_ > 0 ? fmt::format(", low rank {:g}", lowRank_) : "");
}

void SingleFactor::analyze(const RCP<const CrsMatrix>& K) {
  estimate_.reset();
  spent_.reset();
  mumps_.reset();
  comm_ = mpiComm(*K->getRowMap());
  int size = 1;
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size);
  auto mumps = std::make_unique<MumpsInstance<SingleMumps>>(comm_, symmetric_ ? 2 : 0);

  const int localRows = static_cast<int>(K->getNodeNumRows());
  counts_.assign(rank_ == 0 ? size : 0, 0);
  offsets_ = counts_;
  MPI_Gather(&localRows, 1, MPI_INT, counts_.data(), 1, MPI_INT, 0, comm_);
  for (std::size_t r = 1; r < counts_.size(); ++r) offsets_[r] = offsets_[r - 1] + counts_[r - 1];

  entries_ = MumpsEntries(*K, RowNumbering(*K), symmetric_);
  mumps->icntl(14) = 30;
  mumps->icntl(10) = 0;  // refinement is what the iterations do
  if (lowRank_ > 0) {
    mumps->icntl(35) = 2;  // low rank in the factorization and in the solves
    mumps->cntl(7) = static_cast<float>(lowRank_);
  }
  mumps->analyze(static_cast<MUMPS_INT>(K->getGlobalNumRows()), entries_);
  estimate_ = FactorCost{mumps->count(20), 1e6 * mumps->infog(17), mumps->rinfog(1)};
  mumps_ = std::move(mumps);
}

void SingleFactor::factor(const RCP<const CrsMatrix>& K) {
  auto& mumps = *mumps_;
  entries_.copyValues(*K, values_);
  mumps.factor(values_.data(), threads_);
  const double entries = mumps.count(lowRank_ > 0 ? 35 : 29);
  spent_ = FactorCost{entries, 1e6 * mumps.infog(19), mumps.rinfog(lowRank_ > 0 ? 14 : 3)};
}

void SingleFactor::apply(const Vector& x, Vector& y, bool transposed) const {
  auto& mumps = *mumps_;
  // A series' right-hand sides may exceed the range of single precision: their size is taken out.
  const double size = x.normInf();
  if (!(size > 0)) {
    y.putScalar(0);
    return;
  }
  const auto from = x.getLocalViewHost(Tpetra::Access::ReadOnly);
  own_.resize(from.extent(0));
  for (std::size_t i = 0; i < own_.size(); ++i) own_[i] = static_cast<float>(from(i, 0) / size);
  if (rank_ == 0) rhs_.resize(mumps.data().n);
  const int count = static_cast<int>(own_.size());
  MPI_Gatherv(own_.data(), count, MPI_FLOAT, rhs_.data(), counts_.data(), offsets_.data(), MPI_FLOAT, 0,
              comm_);
  mumps.data().rhs = rhs_.data();
  mumps.data().nrhs = 1;
  mumps.data().lrhs = mumps.data().n;
  mumps.icntl(9) = transposed ? 0 : 1;
  if (mumps.run(3) < 0) mumps.fail("solve");
  MPI_Scatterv(rhs_.data(), counts_.data(), offsets_.data(), MPI_FLOAT, own_.data(), count, MPI_FLOAT, 0,
               comm_);
  const auto to = y.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t i = 0; i < own_.size(); ++i) to(i, 0) = size * own_[i];
}

}  // namespace atrapos::linear
