#pragma once

#include <mpi.h>

#include <string>

/// How the processors of a machine are shared out over ranks and threads: docs/install.md, Threads and ranks.
namespace atrapos::threads {

/// The processors of one machine and the ranks that run there.
struct Machine {
  int processors = 1;  ///< that some rank of the program may run on, on this machine
  int ranks = 1;       ///< of the program, on this machine
  int own = 1;         ///< processors that this rank may run on: fewer where mpirun binds it
};

/// Collective over the communicator; MPI runs.
Machine machine(MPI_Comm comm);

/// Threads of a rank's element loops where nobody says how many: its share of the processors, not more than
/// it may run on, at least 1.
int share(const Machine& machine);

/// The same, or what the user says: `asked` where it is > 0, else the environment's OMP_NUM_THREADS or
/// KOKKOS_NUM_THREADS, for which this is 0 (Kokkos reads them).
int ofElementLoops(int asked, const Machine& machine);

/// One line: ranks and threads of the program that runs here, and on how many processors. Kokkos runs;
/// collective.
std::string describe(MPI_Comm comm);

/// Versions, ranks and threads, several lines for `atrapos --version --verbose`. Kokkos runs; collective.
std::string describeAll(MPI_Comm comm);

}  // namespace atrapos::threads
