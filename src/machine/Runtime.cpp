#include "machine/Runtime.hpp"

#include <mpi.h>

#include <Kokkos_Core.hpp>
#include <Tpetra_Core.hpp>
#include <cstdlib>
#include <utility>
#include <vector>

#include "atrapos/linear/BlasThreads.hpp"
#include "machine/Ranks.hpp"
#include "machine/Threads.hpp"

namespace atrapos {

namespace {

/// A process that no launcher has started needs neither networks nor a daemon, which Open MPI takes 0.3 s to
/// find and to start: four fifths of the time of a command that reads a deck. What the user has set stays,
/// and processes that this one starts, mpirun perhaps, inherit nothing.
class NoNetwork {
 public:
  NoNetwork() {
    // Of mpirun and PMIx, of PMI, of Slurm, Flux, ALPS, PALS and jsrun.
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE", "SLURM_PROCID",
                             "FLUX_JOB_ID", "ALPS_APP_PE", "PALS_RANKID", "JSM_NAMESPACE_RANK"})
      if (std::getenv(name)) return;
    const std::pair<const char*, const char*> settings[]{
        {"OMPI_MCA_ess_singleton_isolated", "1"}, {"OMPI_MCA_pml", "ob1"}, {"OMPI_MCA_btl", "self"}};
    for (const auto& [name, value] : settings)
      if (!std::getenv(name)) {
        setenv(name, value, 1);
        set_.push_back(name);
      }
  }
  ~NoNetwork() {
    for (const char* name : set_) unsetenv(name);
  }
  NoNetwork(const NoNetwork&) = delete;
  NoNetwork& operator=(const NoNetwork&) = delete;

 private:
  std::vector<const char*> set_;
};

}  // namespace

Runtime::Runtime(int threads) {
  // Without it Kokkos warns at every start; binding is the user's choice.
  setenv("OMP_PROC_BIND", "false", 0);
  {
    const NoNetwork alone;
    MPI_Init(nullptr, nullptr);
  }
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
