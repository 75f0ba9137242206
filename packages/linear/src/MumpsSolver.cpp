#include "MumpsSolver.hpp"

#include <fmt/format.h>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <numeric>

#include "RowNumbering.hpp"
#include "atrapos/linear/Error.hpp"

namespace atrapos::linear {
namespace {

/// The columns of b one behind another.
void copyColumns(const MultiVector& b, std::vector<double>& to) {
  to.clear();
  for (std::size_t j = 0; j < b.getNumVectors(); ++j) {
    const auto bj = b.getVector(j);
    const auto view = bj->getLocalViewHost(Tpetra::Access::ReadOnly);
    to.insert(to.end(), view.data(), view.data() + view.extent(0));
  }
}

}  // namespace

MumpsSolver::MumpsSolver(const MumpsOptions& options) : options_(options) {}
MumpsSolver::~MumpsSolver() = default;

std::string MumpsSolver::name() const {
  const int sym = options_.symmetric ? 2 : 0;
  if (!graph_) return fmt::format("MUMPS SYM={}", sym);
  return fmt::format("MUMPS SYM={}, METIS", sym);
}

void MumpsSolver::analyze(const RCP<const CrsMatrix>& K) {
  const double start = MPI_Wtime();
  factored_ = false;
  inertia_.reset();
  determinantSign_.reset();
  estimate_.reset();
  spent_.reset();
  graph_.reset();
  mumps_.reset();

  auto graph = std::make_unique<AnalysedGraph>("MUMPS", *K);
  comm_ = mpiComm(*graph->rowMap());
  auto mumps = std::make_unique<MumpsInstance<DoubleMumps>>(comm_, options_.symmetric ? 2 : 0);
  MPI_Comm_size(comm_, &size_);

  const int localRows = static_cast<int>(K->getNodeNumRows());
  const RowNumbering numbering(*K);
  firstRows_.assign(size_ + 1, static_cast<GlobalIndex>(K->getGlobalNumRows()));
  MPI_Allgather(&numbering.first, 1, MPI_LONG_LONG, firstRows_.data(), 1, MPI_LONG_LONG, comm_);
  ownRows_.resize(localRows);
  std::iota(ownRows_.begin(), ownRows_.end(), static_cast<MUMPS_INT>(numbering.first + 1));
  entries_ = MumpsEntries(*K, numbering, options_.symmetric);

  mumps->icntl(14) = options_.workspacePercent;
  mumps->icntl(24) = 1;  // null pivots are found and counted, not fatal: we decide
  mumps->cntl(3) = options_.nullPivotTolerance;
  // A ScaLAPACK root would hide its pivots' signs from INFOG(12).
  if (options_.symmetric && size_ > 1) mumps->icntl(13) = 1;
  if (size_ > 1) {
    mumps->icntl(20) = 10;  // right-hand sides distributed
    mumps->icntl(21) = 1;   // solutions distributed
  }
  if (!options_.symmetric) mumps->icntl(33) = 1;  // det K, of which the sign tells
  mumps->analyze(static_cast<MUMPS_INT>(K->getGlobalNumRows()), entries_);
  estimate_ = FactorCost{mumps->count(20), 1e6 * mumps->infog(17) + ownBytes(), mumps->rinfog(1)};

  graph_ = std::move(graph);
  mumps_ = std::move(mumps);
  ++counters_.analyses;
  counters_.analysisSeconds += MPI_Wtime() - start;
}

double MumpsSolver::ownBytes() const {
  const double local =
      static_cast<double>((entries_.rows.size() + entries_.columns.size()) * sizeof(MUMPS_INT) +
                          entries_.positions.size() * (sizeof(std::size_t) + sizeof(double)));
  double all = 0;
  MPI_Allreduce(&local, &all, 1, MPI_DOUBLE, MPI_SUM, comm_);
  return all;
}

void MumpsSolver::factor(const RCP<const CrsMatrix>& K) {
  if (!graph_) throw SolverError("MUMPS: factor comes after analyze");
  const double start = MPI_Wtime();
  factored_ = false;
  inertia_.reset();
  for (auto& exchange : exchange_) exchange.reset();
  determinantSign_.reset();
  graph_->checkMatrix(*K);
  if (options_.symmetric) graph_->checkSymmetry(*K);

  if (options_.symmetric) {
    entries_.copyValues(*K, values_);
    memoryRetries_ += mumps_->factor(values_.data(), options_.factorThreads);
  } else {
    const auto local = K->getLocalMatrixHost();
    auto* values = const_cast<double*>(local.values.data());  // read only
    memoryRetries_ += mumps_->factor(values, options_.factorThreads);
  }

  spent_ = FactorCost{mumps_->count(29), 1e6 * mumps_->infog(19) + ownBytes(), mumps_->rinfog(3)};
  const int nullPivots = mumps_->infog(28);
  if (options_.symmetric) inertia_ = Inertia{mumps_->infog(12), nullPivots};
  // Its mantissa; the exponent is another number.
  if (!options_.symmetric && nullPivots == 0) determinantSign_ = mumps_->rinfog(12) < 0 ? -1 : 1;
  ++counters_.factorizations;
  counters_.factorSeconds += MPI_Wtime() - start;
  if (nullPivots > 0)
    throw SingularTangentError(
        fmt::format("MUMPS: the matrix is numerically singular: {} null pivot(s) of {}", nullPivots,
                    mumps_->data().n),
        nullPivots);
  factored_ = true;
}

void MumpsSolver::solveWith(const MultiVector& b, MultiVector& x, bool transposed) const {
  if (!factored_) throw SolverError("MUMPS: solve comes after a successful factor");
  const double start = MPI_Wtime();
  graph_->checkVectors(b, x);
  const std::size_t columns = b.getNumVectors();
  if (columns == 0) return;
  mumps_->data().nrhs = static_cast<MUMPS_INT>(columns);
  mumps_->icntl(9) = transposed ? 0 : 1;
  if (size_ == 1)
    solveHere(b, x);
  else
    solveDistributed(b, x, transposed);
  counters_.solves += static_cast<long long>(columns);
  counters_.solveSeconds += MPI_Wtime() - start;
}

void MumpsSolver::solveHere(const MultiVector& b, MultiVector& x) const {
  auto& data = mumps_->data();
  copyColumns(b, rhs_);
  data.rhs = rhs_.data();
  data.lrhs = data.n;
  if (mumps_->run(3) < 0) mumps_->fail("solve");
  const std::size_t n = static_cast<std::size_t>(data.n);
  for (std::size_t j = 0; j < b.getNumVectors(); ++j) {
    const auto xj = x.getVectorNonConst(j);
    const auto view = xj->getLocalViewHost(Tpetra::Access::OverwriteAll);
    std::copy_n(rhs_.data() + j * n, n, view.data());
  }
}

void MumpsSolver::solveDistributed(const MultiVector& b, MultiVector& x, bool transposed) const {
  auto& data = mumps_->data();
  const std::size_t columns = b.getNumVectors();
  copyColumns(b, rhs_);
  data.rhs_loc = rhs_.data();
  data.irhs_loc = const_cast<MUMPS_INT*>(ownRows_.data());  // read only
  data.nloc_rhs = data.lrhs_loc = static_cast<MUMPS_INT>(ownRows_.size());
  const std::size_t here = mumps_->info(23);
  solved_.resize(here);
  solution_.resize(here * columns);
  data.sol_loc = solution_.data();
  data.isol_loc = solved_.data();
  data.lsol_loc = static_cast<MUMPS_INT>(here);
  if (mumps_->run(3) < 0) mumps_->fail("solve");

  // The lists of K^T are others than those of K, and both change with the pivots.
  auto& exchange = exchange_[transposed];
  if (!exchange) {
    std::vector<GlobalIndex> rows;
    for (const MUMPS_INT row : solved_) rows.push_back(row - 1);
    exchange = std::make_unique<RowExchange>(comm_, rows, firstRows_);
  }
  for (std::size_t j = 0; j < columns; ++j) {
    const auto xj = x.getVectorNonConst(j);
    const auto view = xj->getLocalViewHost(Tpetra::Access::OverwriteAll);
    exchange->toOwners(solution_.data() + j * here, view.data());
  }
}

}  // namespace atrapos::linear
