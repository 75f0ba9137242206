#include "SingleFactor.hpp"

#include <fmt/format.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

#include "OrderingOnRoot.hpp"
#include "RowNumbering.hpp"
#include "atrapos/linear/Error.hpp"

namespace atrapos::linear {
namespace {

MPI_Comm mpiComm(const Map& map) {
  const auto comm = map.getComm();
  if (const auto* mpi = dynamic_cast<const Teuchos::MpiComm<int>*>(comm.get())) return *mpi->getRawMpiComm();
  if (comm->getSize() == 1) return MPI_COMM_SELF;
  throw SolverError("single-precision MUMPS: the matrix' communicator is not an MPI one");
}

bool mpiIsRunning() {
  int started = 0, ended = 0;
  MPI_Initialized(&started);
  MPI_Finalized(&ended);
  return started && !ended;
}

}  // namespace

/// One instance (JOB=-1 ... JOB=-2), silent; all ranks create, run and destroy it together.
struct SingleFactor::Instance {
  SMUMPS_STRUC_C data{};

  Instance(MPI_Comm comm, bool symmetric) {
    if (!mpiIsRunning())
      throw SolverError("single-precision MUMPS: MPI is not running (MPI_Init comes first)");
    data.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(comm));
    data.par = 1;
    data.sym = symmetric ? 2 : 0;
    if (run(-1) < 0) fail("initialisation");
    for (int stream = 1; stream <= 3; ++stream) icntl(stream) = -1;
    icntl(4) = 0;
  }
  ~Instance() {
    if (mpiIsRunning()) run(-2);
  }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  int run(int job) {
    data.job = job;
    smumps_c(&data);
    return infog(1);
  }
  [[noreturn]] void fail(const char* phase) const {
    throw SolverError(fmt::format("single-precision MUMPS: {} failed: {} (INFOG(1)={}, INFOG(2)={})", phase,
                                  infog(1) == -13   ? "out of memory"
                                  : infog(1) == -10 ? "the matrix is singular to single precision"
                                                    : "see the MUMPS users' guide",
                                  infog(1), infog(2)));
  }

  // Numbered from 1 as in the MUMPS users' guide.
  MUMPS_INT& icntl(int i) { return data.icntl[i - 1]; }
  float& cntl(int i) { return data.cntl[i - 1]; }
  int infog(int i) const { return data.infog[i - 1]; }
  double count(int i) const { return infog(i) < 0 ? -1e6 * infog(i) : infog(i); }
};

SingleFactor::SingleFactor(bool symmetric, double lowRank) : symmetric_(symmetric), lowRank_(lowRank) {}
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
  auto mumps = std::make_unique<Instance>(comm_, symmetric_);

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
      if (symmetric_ && column > row) continue;
      rows_.push_back(row + 1);
      columns_.push_back(column + 1);
      positions_.push_back(e);
    }
  values_.resize(positions_.size());

  auto& data = mumps->data;
  data.n = static_cast<MUMPS_INT>(K->getGlobalNumRows());
  data.nnz_loc = static_cast<MUMPS_INT8>(rows_.size());
  data.irn_loc = rows_.data();
  data.jcn_loc = columns_.data();
  mumps->icntl(5) = 0;   // assembled
  mumps->icntl(18) = 3;  // distributed, at analysis and at factorization
  mumps->icntl(28) = 1;  // sequential analysis, so that ICNTL(7) decides
  mumps->icntl(7) = 1;   // the ordering in perm_in
  mumps->icntl(14) = 30;
  mumps->icntl(10) = 0;  // refinement is what the iterations do
  if (lowRank_ > 0) {
    mumps->icntl(35) = 2;  // low rank in the factorization and in the solves
    mumps->cntl(7) = static_cast<float>(lowRank_);
  }
  auto ordering = orderingOnRoot(data.n, rows_, columns_, comm_);
  data.perm_in = ordering.data();
  if (mumps->run(1) < 0) mumps->fail("analysis");
  data.perm_in = nullptr;
  estimate_ = FactorCost{mumps->count(20), 1e6 * mumps->infog(17), mumps->data.rinfog[0]};
  mumps_ = std::move(mumps);
}

void SingleFactor::factor(const RCP<const CrsMatrix>& K) {
  const auto local = K->getLocalMatrixHost();
  for (std::size_t e = 0; e < positions_.size(); ++e)
    values_[e] = static_cast<float>(local.values(positions_[e]));
  auto& mumps = *mumps_;
  mumps.data.a_loc = values_.data();
  constexpr int maxRetries = 10;
  // The work space was estimated too small: enlarge ICNTL(14) and repeat (users' guide, error diagnostics).
  const auto needsWorkspace = [](int code) { return code == -8 || code == -9 || code == -17 || code == -20; };
  for (int retry = 0; needsWorkspace(mumps.run(2)) && retry < maxRetries; ++retry) mumps.icntl(14) *= 2;
  mumps.data.a_loc = nullptr;
  if (mumps.infog(1) < 0) mumps.fail("factorization");
  const double entries = mumps.count(lowRank_ > 0 ? 35 : 29);
  spent_ = FactorCost{entries, 1e6 * mumps.infog(19), mumps.data.rinfog[lowRank_ > 0 ? 13 : 2]};
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
  if (rank_ == 0) rhs_.resize(mumps.data.n);
  const int count = static_cast<int>(own_.size());
  MPI_Gatherv(own_.data(), count, MPI_FLOAT, rhs_.data(), counts_.data(), offsets_.data(), MPI_FLOAT, 0,
              comm_);
  mumps.data.rhs = rhs_.data();
  mumps.data.nrhs = 1;
  mumps.data.lrhs = mumps.data.n;
  mumps.icntl(9) = transposed ? 0 : 1;
  if (mumps.run(3) < 0) mumps.fail("solve");
  MPI_Scatterv(rhs_.data(), counts_.data(), offsets_.data(), MPI_FLOAT, own_.data(), count, MPI_FLOAT, 0,
               comm_);
  const auto to = y.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t i = 0; i < own_.size(); ++i) to(i, 0) = size * own_[i];
}

}  // namespace atrapos::linear
