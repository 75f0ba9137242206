#pragma once

#include <dmumps_c.h>
#include <mpi.h>
#include <smumps_c.h>

#include "MumpsEntries.hpp"

namespace atrapos::linear {

struct DoubleMumps {
  using Data = DMUMPS_STRUC_C;
  using Scalar = double;
  static constexpr const char* name = "MUMPS";
  static constexpr bool singularMeansK = true;
  static void call(Data& data) { dmumps_c(&data); }
};

struct SingleMumps {
  using Data = SMUMPS_STRUC_C;
  using Scalar = float;
  static constexpr const char* name = "MUMPS in single precision";
  static constexpr bool singularMeansK = false;  // only that single precision does not do
  static void call(Data& data) { smumps_c(&data); }
};

/// One MUMPS instance (JOB=-1 ... JOB=-2), silent; the ranks of `comm` create, run and destroy it together.
template <class Precision>
class MumpsInstance {
 public:
  using Data = typename Precision::Data;
  using Scalar = typename Precision::Scalar;

  /// sym: 0 unsymmetric, 2 symmetric indefinite. Throws SolverError where MPI is not running.
  MumpsInstance(MPI_Comm comm, int sym);

  /// Frees MUMPS' memory; after MPI_Finalize nothing can be freed any more and it is left to the system.
  ~MumpsInstance();

  MumpsInstance(const MumpsInstance&) = delete;
  MumpsInstance& operator=(const MumpsInstance&) = delete;

  /// Analysis (JOB=1) of a distributed K of n rows with METIS ordering; `entries` live on until the last
  /// factorization. What else ICNTL and CNTL have to say is said before.
  void analyze(MUMPS_INT n, MumpsEntries& entries);

  /// Factorization (JOB=2) of these values, repeated with a larger work space where it was estimated too
  /// small; returns how often. `threads`: of the BLAS where dense blocks are large.
  int factor(Scalar* values, int threads);

  /// Runs a job and returns INFOG(1): < 0 is an error.
  int run(int job);

  /// Throws SolverError (SingularTangentError where K is singular) that says what INFOG means; `phase` names
  /// what failed.
  [[noreturn]] void fail(const char* phase) const;

  Data& data() { return data_; }

  // Numbered from 1 as in the MUMPS users' guide.
  MUMPS_INT& icntl(int i) { return data_.icntl[i - 1]; }
  Scalar& cntl(int i) { return data_.cntl[i - 1]; }
  int infog(int i) const { return data_.infog[i - 1]; }
  int info(int i) const { return data_.info[i - 1]; }  ///< of this rank
  double rinfog(int i) const { return data_.rinfog[i - 1]; }
  /// An INFOG that counts millions where it is negative.
  double count(int i) const { return infog(i) < 0 ? -1e6 * infog(i) : infog(i); }

 private:
  MPI_Comm comm_;
  Data data_{};
};

extern template class MumpsInstance<DoubleMumps>;
extern template class MumpsInstance<SingleMumps>;

}  // namespace atrapos::linear
