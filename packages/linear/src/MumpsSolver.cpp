#include "MumpsSolver.hpp"

#include <fmt/format.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <numeric>

#include "OrderingOnRoot.hpp"
#include "RowNumbering.hpp"
#include "atrapos/linear/Error.hpp"

namespace atrapos::linear {
namespace {

MPI_Comm mpiComm(const Map& map) {
  const auto comm = map.getComm();
  if (const auto* mpi = dynamic_cast<const Teuchos::MpiComm<int>*>(comm.get())) return *mpi->getRawMpiComm();
  if (comm->getSize() == 1) return MPI_COMM_SELF;
  throw SolverError("MUMPS: the matrix' communicator is not an MPI one");
}

/// The columns of b one behind another.
void copyColumns(const MultiVector& b, std::vector<double>& to) {
  to.clear();
  for (std::size_t j = 0; j < b.getNumVectors(); ++j) {
    const auto bj = b.getVector(j);
    const auto view = bj->getLocalViewHost(Tpetra::Access::ReadOnly);
    to.insert(to.end(), view.data(), view.data() + view.extent(0));
  }
}

// The work space was estimated too small: enlarge ICNTL(14) and repeat (users' guide, error diagnostics).
bool needsWorkspace(int infog1) { return infog1 == -8 || infog1 == -9 || infog1 == -17 || infog1 == -20; }

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
  auto mumps = std::make_unique<MumpsInstance>(comm_, options_.symmetric ? 2 : 0);
  MPI_Comm_size(comm_, &size_);

  // The owner of the lower triangle's row passes an entry, so that every one is passed once.
  const int localRows = static_cast<int>(K->getNodeNumRows());
  const RowNumbering numbering(*K);
  firstRows_.assign(size_ + 1, static_cast<GlobalIndex>(K->getGlobalNumRows()));
  MPI_Allgather(&numbering.first, 1, MPI_LONG_LONG, firstRows_.data(), 1, MPI_LONG_LONG, comm_);
  ownRows_.resize(localRows);
  std::iota(ownRows_.begin(), ownRows_.end(), static_cast<MUMPS_INT>(numbering.first + 1));
  const auto local = K->getCrsGraph()->getLocalGraphHost();
  rows_.clear();
  columns_.clear();
  positions_.clear();
  for (int i = 0; i < localRows; ++i)
    for (std::size_t e = local.row_map(i); e < local.row_map(i + 1); ++e) {
      const auto row = static_cast<MUMPS_INT>(numbering.first + i);
      const auto column = static_cast<MUMPS_INT>(numbering.columns[local.entries(e)]);
      if (options_.symmetric && column > row) continue;
      rows_.push_back(row + 1);
      columns_.push_back(column + 1);
      if (options_.symmetric) positions_.push_back(e);
    }
  values_.resize(positions_.size());

  auto& data = mumps->data();
  data.n = static_cast<MUMPS_INT>(K->getGlobalNumRows());
  data.nnz_loc = static_cast<MUMPS_INT8>(rows_.size());
  data.irn_loc = rows_.data();
  data.jcn_loc = columns_.data();
  mumps->icntl(5) = 0;   // assembled
  mumps->icntl(18) = 3;  // distributed, at analysis and at factorization
  mumps->icntl(28) = 1;  // sequential analysis, so that ICNTL(7) decides
  mumps->icntl(7) = 1;   // the ordering in perm_in
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
  auto ordering = orderingOnRoot(data.n, rows_, columns_, comm_);
  data.perm_in = ordering.data();
  if (mumps->run(1) < 0) mumps->fail("analysis");
  data.perm_in = nullptr;
  estimate_ = FactorCost{mumps->count(20), 1e6 * mumps->infog(17) + ownBytes(), mumps->rinfog(1)};

  graph_ = std::move(graph);
  mumps_ = std::move(mumps);
  ++counters_.analyses;
  counters_.analysisSeconds += MPI_Wtime() - start;
}

double MumpsSolver::ownBytes() const {
  const double local =
      static_cast<double>((rows_.size() + columns_.size()) * sizeof(MUMPS_INT) +
                          positions_.size() * sizeof(std::size_t) + values_.size() * sizeof(double));
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

  const auto local = K->getLocalMatrixHost();
  const double* source = local.values.data();
  auto& data = mumps_->data();
  if (options_.symmetric) {
    for (std::size_t e = 0; e < positions_.size(); ++e) values_[e] = source[positions_[e]];
    data.a_loc = values_.data();
  } else {
    data.a_loc = const_cast<double*>(source);  // read only by JOB=2
  }
  constexpr int maxRetries = 10;
  for (int retry = 0; needsWorkspace(mumps_->run(2)) && retry < maxRetries; ++retry) {
    mumps_->icntl(14) *= 2;
    ++memoryRetries_;
  }
  data.a_loc = nullptr;
  if (mumps_->infog(1) < 0) mumps_->fail("factorization");

  spent_ = FactorCost{mumps_->count(29), 1e6 * mumps_->infog(19) + ownBytes(), mumps_->rinfog(3)};
  const int nullPivots = mumps_->infog(28);
  if (options_.symmetric) inertia_ = Inertia{mumps_->infog(12), nullPivots};
  // Its mantissa; the exponent is another number.
  if (!options_.symmetric && nullPivots == 0) determinantSign_ = mumps_->rinfog(12) < 0 ? -1 : 1;
  ++counters_.factorizations;
  counters_.factorSeconds += MPI_Wtime() - start;
  if (nullPivots > 0)
    throw SingularTangentError(
        fmt::format("MUMPS: the matrix is numerically singular: {} null pivot(s) of {}", nullPivots, data.n),
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
