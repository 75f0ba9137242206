#pragma once

#include <dmumps_c.h>
#include <mpi.h>

namespace atrapos::linear {

/// One MUMPS instance (JOB=-1 ... JOB=-2), silent; the ranks of `comm` create, run and destroy it together.
class MumpsInstance {
 public:
  /// sym: 0 unsymmetric, 2 symmetric indefinite. Throws SolverError where MPI is not running.
  MumpsInstance(MPI_Comm comm, int sym);

  /// Frees MUMPS' memory; after MPI_Finalize nothing can be freed any more and it is left to the system.
  ~MumpsInstance();

  MumpsInstance(const MumpsInstance&) = delete;
  MumpsInstance& operator=(const MumpsInstance&) = delete;

  /// Runs a job and returns INFOG(1): < 0 is an error.
  int run(int job);

  /// Throws SolverError (or SingularTangentError) that says what INFOG means; `phase` names what failed.
  [[noreturn]] void fail(const char* phase) const;

  DMUMPS_STRUC_C& data() { return data_; }

  // Numbered from 1 as in the MUMPS users' guide.
  MUMPS_INT& icntl(int i) { return data_.icntl[i - 1]; }
  double& cntl(int i) { return data_.cntl[i - 1]; }
  int infog(int i) const { return data_.infog[i - 1]; }
  int info(int i) const { return data_.info[i - 1]; }  ///< of this rank
  double rinfog(int i) const { return data_.rinfog[i - 1]; }
  /// An INFOG that counts millions where it is negative.
  double count(int i) const { return infog(i) < 0 ? -1e6 * infog(i) : infog(i); }

 private:
  DMUMPS_STRUC_C data_{};
};

}  // namespace atrapos::linear
