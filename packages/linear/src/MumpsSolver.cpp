#include "MumpsSolver.hpp"

#include <fmt/format.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <limits>

#include "NestedDissection.hpp"
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

// All ranks' parts, one after another, on rank 0; empty on the others.
std::vector<MUMPS_INT> gather(const std::vector<MUMPS_INT>& part, MPI_Comm comm) {
  int rank = 0, size = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  const int count = static_cast<int>(part.size());
  std::vector<int> counts(rank == 0 ? size : 0), offsets(counts.size(), 0);
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, comm);
  for (std::size_t r = 1; r < counts.size(); ++r) offsets[r] = offsets[r - 1] + counts[r - 1];
  std::vector<MUMPS_INT> all(counts.empty() ? 0 : offsets.back() + counts.back());
  MPI_Gatherv(part.data(), count, MPI_INT, all.data(), counts.data(), offsets.data(), MPI_INT, 0, comm);
  return all;
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
  estimate_.reset();
  spent_.reset();
  graph_.reset();
  mumps_.reset();

  auto graph = std::make_unique<AnalysedGraph>("MUMPS", *K);
  comm_ = mpiComm(*graph->rowMap());
  auto mumps = std::make_unique<MumpsInstance>(comm_, options_.symmetric ? 2 : 0);
  int size = 1;
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size);

  const int localRows = static_cast<int>(K->getNodeNumRows());
  counts_.assign(rank_ == 0 ? size : 0, 0);
  offsets_ = counts_;
  MPI_Gather(&localRows, 1, MPI_INT, counts_.data(), 1, MPI_INT, 0, comm_);
  for (std::size_t r = 1; r < counts_.size(); ++r) offsets_[r] = offsets_[r - 1] + counts_[r - 1];

  // The owner of the lower triangle's row passes an entry, so that every one is passed once.
  const RowNumbering numbering(*K);
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
  if (options_.symmetric && size > 1) mumps->icntl(13) = 1;
  auto ordering = orderingOnRoot(data.n);
  data.perm_in = ordering.data();
  if (mumps->run(1) < 0) mumps->fail("analysis");
  data.perm_in = nullptr;
  estimate_ = FactorCost{mumps->count(20), 1e6 * mumps->infog(17) + ownBytes(), mumps->rinfog(1)};

  graph_ = std::move(graph);
  mumps_ = std::move(mumps);
  ++counters_.analyses;
  counters_.analysisSeconds += MPI_Wtime() - start;
}

// Ours, because ICNTL(7)=5 silently becomes another ordering where MUMPS was built without METIS (Debian 12).
std::vector<MUMPS_INT> MumpsSolver::orderingOnRoot(int n) const {
  long long entries = static_cast<long long>(rows_.size()), allEntries = 0;
  MPI_Allreduce(&entries, &allEntries, 1, MPI_LONG_LONG, MPI_SUM, comm_);
  if (allEntries > std::numeric_limits<int>::max())
    throw SolverError(fmt::format("MUMPS: {} entries are too many for the ordering on one rank", allEntries));
  const auto allRows = gather(rows_, comm_), allColumns = gather(columns_, comm_);
  std::vector<MUMPS_INT> ordering;
  std::string message;
  if (rank_ == 0) try {
      ordering = nestedDissection(n, allRows, allColumns);
    } catch (const SolverError& e) {
      message = e.what();
    }
  int failed = !message.empty();
  MPI_Bcast(&failed, 1, MPI_INT, 0, comm_);
  if (failed) throw SolverError(rank_ == 0 ? message : "MUMPS: the ordering failed on rank 0");
  return ordering;
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
  auto& data = mumps_->data();
  const std::size_t n = static_cast<std::size_t>(data.n);
  if (rank_ == 0) rhs_.resize(n * columns);
  const auto column = [&](std::size_t j) { return rank_ == 0 ? rhs_.data() + j * n : nullptr; };

  for (std::size_t j = 0; j < columns; ++j) {
    const auto bj = b.getVector(j);
    const auto view = bj->getLocalViewHost(Tpetra::Access::ReadOnly);
    MPI_Gatherv(view.data(), static_cast<int>(view.extent(0)), MPI_DOUBLE, column(j), counts_.data(),
                offsets_.data(), MPI_DOUBLE, 0, comm_);
  }

  data.rhs = rhs_.data();
  data.nrhs = static_cast<MUMPS_INT>(columns);
  data.lrhs = data.n;
  mumps_->icntl(9) = transposed ? 0 : 1;
  if (mumps_->run(3) < 0) mumps_->fail("solve");

  for (std::size_t j = 0; j < columns; ++j) {
    const auto xj = x.getVectorNonConst(j);
    const auto view = xj->getLocalViewHost(Tpetra::Access::OverwriteAll);
    MPI_Scatterv(column(j), counts_.data(), offsets_.data(), MPI_DOUBLE, view.data(),
                 static_cast<int>(view.extent(0)), MPI_DOUBLE, 0, comm_);
  }
  counters_.solves += static_cast<long long>(columns);
  counters_.solveSeconds += MPI_Wtime() - start;
}

}  // namespace atrapos::linear
