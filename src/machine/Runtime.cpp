#include "machine/Runtime.hpp"

#include <mpi.h>

#include <Kokkos_Core.hpp>
#include <Tpetra_Core.hpp>
#include <cstdlib>

#include "atrapos/linear/BlasThreads.hpp"
#include "machine/Ranks.hpp"
#include "machine/Threads.hpp"

namespace atrapos {

Runtime::Runtime(int threads) {
  // Without it Kokkos warns at every start; binding is the user's choice.
  setenv("OMP_PROC_BIND", "false", 0);
  MPI_Init(nullptr, nullptr);
  Kokkos::InitArguments arguments;
  arguments.disable_warnings = true;
  const int loops = threads::ofElementLoops(threads, threads::machine(MPI_COMM_WORLD));
  if (loops > 0) arguments.num_threads = loops;
  Kokkos::initialize(arguments);
  Tpetra::initialize(nullptr, nullptr);
  // Small fronts: a threaded BLAS costs more than it gives (docs/install.md).
  linear::setBlasThreads(1);
  ranks::open();
}

Runtime::~Runtime() {
  ranks::close();
  Tpetra::finalize();
  Kokkos::finalize();
  MPI_Finalize();
}

}  // namespace atrapos
