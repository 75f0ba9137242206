#include "machine/Runtime.hpp"

#include <mpi.h>
#include <unistd.h>

#include <Kokkos_Core.hpp>
#include <Tpetra_Core.hpp>
#include <algorithm>
#include <cstdlib>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "atrapos/linear/BlasThreads.hpp"
#include "machine/Ranks.hpp"
#include "machine/Threads.hpp"

namespace atrapos {

namespace {

/// Names of the variables that are Open MPI's.
std::set<std::string> variablesOfMpi() {
  std::set<std::string> names;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text = *entry;
    if (text.substr(0, 5) == "OMPI_" || text.substr(0, 5) == "PMIX_")
      names.emplace(text.substr(0, text.find('=')));
  }
  return names;
}

/// Of mpirun and PMIx, of PMI, of Slurm, Flux, ALPS, PALS and jsrun.
bool launched() {
  const auto names = {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK",   "PMI_RANK",    "PMI_SIZE",
                      "SLURM_PROCID",         "FLUX_JOB_ID", "ALPS_APP_PE", "PALS_RANKID",
                      "JSM_NAMESPACE_RANK"};
  return std::any_of(names.begin(), names.end(),
                     [](const char* name) { return std::getenv(name) != nullptr; });
}

/// A process that no launcher has started needs neither networks nor a daemon, which Open MPI takes 0.3 s to
/// find and to start: three quarters of the time of a command that reads a deck. What the user has set stays,
/// and processes that this one starts, mpirun perhaps, inherit nothing of it, nor of what MPI sets then.
void startMpi() {
  if (launched()) {
    MPI_Init(nullptr, nullptr);
    return;
  }
  const std::set<std::string> before = variablesOfMpi();
  // Without a daemon all such processes have one number, and would share a session folder.
  const std::pair<const char*, const char*> settings[]{{"OMPI_MCA_ess_singleton_isolated", "1"},
                                                       {"OMPI_MCA_orte_create_session_dirs", "0"},
                                                       {"OMPI_MCA_pml", "ob1"},
                                                       {"OMPI_MCA_btl", "self"}};
  for (const auto& [name, value] : settings) setenv(name, value, 0);
  MPI_Init(nullptr, nullptr);
  for (const std::string& name : variablesOfMpi())
    if (before.count(name) == 0) unsetenv(name.c_str());
}

}  // namespace

Runtime::Runtime(int threads) {
  // Without it Kokkos warns at every start; binding is the user's choice.
  setenv("OMP_PROC_BIND", "false", 0);
  startMpi();
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
