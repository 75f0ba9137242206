#include "MumpsInstance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "OrderingOnRoot.hpp"
#include "atrapos/linear/BlasThreads.hpp"
#include "atrapos/linear/Error.hpp"

namespace atrapos::linear {
namespace {

bool mpiIsRunning() {
  int started = 0, ended = 0;
  MPI_Initialized(&started);
  MPI_Finalized(&ended);
  return started && !ended;
}

// The work space was estimated too small: enlarge ICNTL(14) and repeat (users' guide, error diagnostics).
bool needsWorkspace(int code) { return code == -8 || code == -9 || code == -17 || code == -20; }

// Operations from which a second thread of the BLAS pays (docs/install.md).
constexpr double manyOperations = 1e10;

// On few ranks MUMPS may give a separator to another rank than what is below it, where it waits in every
// backward solve until that rank has gone through its own part of the tree: half of the solve is then done by
// one rank after the other. With KEEP(198) = 2 ranks get whole subtrees (docs/theory/parallel.md). That is not
// in the users' guide, hence only for the version whose sources say so.
bool sharesWholeSubtrees() { return std::string(MUMPS_VERSION).rfind("5.5.", 0) == 0; }

const char* meaning(int code) {
  if (needsWorkspace(code)) return "its work space stayed too small after repeated enlargement";
  switch (code) {
    case -5:
    case -7:
    case -13:
      return "out of memory";
    case -6:
      return "the matrix is structurally singular";
    case -10:
      return "the matrix is numerically singular";
    case -19:
      return "the memory allowed to it is too small";
    case -38:
      return "the parallel analysis needs an ordering that is not there";
    case -51:
    case -52:
      return "an ordering needs 64-bit integers for a graph of this size";
    default:
      return "see the MUMPS users' guide";
  }
}

}  // namespace

template <class P>
MumpsInstance<P>::MumpsInstance(MPI_Comm comm, int sym) : comm_(comm) {
  if (!mpiIsRunning())
    throw SolverError(fmt::format("{}: MPI is not running (MPI_Init comes first)", P::name));
  data_.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(comm));
  data_.par = 1;
  data_.sym = sym;
  if (run(-1) < 0) fail("initialisation");
  for (int stream = 1; stream <= 3; ++stream) icntl(stream) = -1;
  icntl(4) = 0;
  if (sharesWholeSubtrees()) data_.keep[197] = 2;
  icntl(16) = std::max(1, blasThreads());  // of its own OpenMP regions, where it has any
}

template <class P>
MumpsInstance<P>::~MumpsInstance() {
  if (mpiIsRunning()) run(-2);
}

template <class P>
void MumpsInstance<P>::analyze(MUMPS_INT n, MumpsEntries& entries) {
  data_.n = n;
  data_.nnz_loc = static_cast<MUMPS_INT8>(entries.rows.size());
  data_.irn_loc = entries.rows.data();
  data_.jcn_loc = entries.columns.data();
  icntl(5) = 0;   // assembled
  icntl(18) = 3;  // distributed, at analysis and at factorization
  icntl(28) = 1;  // sequential analysis, so that ICNTL(7) decides
  icntl(7) = 1;   // the ordering in perm_in
  auto ordering = orderingOnRoot(n, entries.rows, entries.columns, comm_);
  data_.perm_in = ordering.data();
  if (run(1) < 0) fail("analysis");
  data_.perm_in = nullptr;
}

template <class P>
int MumpsInstance<P>::factor(Scalar* values, int threads) {
  const BlasThreadsHere here(rinfog(1) < manyOperations ? blasThreads() : threads);
  constexpr int maxRepeats = 10;
  int repeats = 0;
  data_.a_loc = values;
  for (; needsWorkspace(run(2)) && repeats < maxRepeats; ++repeats) icntl(14) *= 2;
  data_.a_loc = nullptr;
  if (infog(1) < 0) fail("factorization");
  return repeats;
}

template <class P>
int MumpsInstance<P>::run(int job) {
  data_.job = job;
  P::call(data_);
  return infog(1);
}

template <class P>
void MumpsInstance<P>::fail(const char* phase) const {
  const int code = infog(1);
  const auto line = fmt::format("{}: {} failed: {} (INFOG(1)={}, INFOG(2)={})", P::name, phase, meaning(code),
                                code, infog(2));
  if (P::singularMeansK && (code == -6 || code == -10)) throw SingularTangentError(line, 0);
  throw SolverError(line);
}

template class MumpsInstance<DoubleMumps>;
template class MumpsInstance<SingleMumps>;

}  // namespace atrapos::linear
