#include "machine/Threads.hpp"

#include <fmt/format.h>
#include <sched.h>

#include <Kokkos_Core.hpp>
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "Version.hpp"
#include "atrapos/fem/Processor.hpp"
#include "atrapos/linear/BlasThreads.hpp"

namespace atrapos::threads {
namespace {

/// The processors that this process may run on, one bit each.
std::vector<unsigned char> ownProcessors() {
  std::vector<unsigned char> bits(sizeof(cpu_set_t), 0);
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) == 0) std::memcpy(bits.data(), &set, sizeof set);
  return bits;
}

int countOf(const std::vector<unsigned char>& bits) {
  int count = 0;
  for (unsigned char byte : bits)
    for (; byte != 0; byte &= static_cast<unsigned char>(byte - 1)) ++count;
  return std::max(count, 1);
}

bool isSet(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != 0;
}

int ranksOf(MPI_Comm comm) {
  int count = 1;
  MPI_Comm_size(comm, &count);
  return count;
}

std::string counted(int n, const char* what) { return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s"); }

std::string mpiLibrary() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING];
  int length = 0;
  MPI_Get_library_version(text, &length);
  const std::string all(text, length);
  return all.substr(0, all.find_first_of(",\n"));
}

}  // namespace

Machine machine(MPI_Comm comm) {
  MPI_Comm here = MPI_COMM_NULL;
  MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
  Machine m;
  m.ranks = ranksOf(here);
  std::vector<unsigned char> bits = ownProcessors();
  m.own = countOf(bits);
  MPI_Allreduce(MPI_IN_PLACE, bits.data(), static_cast<int>(bits.size()), MPI_UNSIGNED_CHAR, MPI_BOR, here);
  m.processors = countOf(bits);
  MPI_Comm_free(&here);
  return m;
}

int share(const Machine& machine) {
  return std::max(1, std::min(machine.own, machine.processors / machine.ranks));
}

int ofElementLoops(int asked, const Machine& machine) {
  if (asked > 0) return asked;
  if (isSet("OMP_NUM_THREADS") || isSet("KOKKOS_NUM_THREADS")) return 0;
  return share(machine);
}

std::string describe(MPI_Comm comm) {
  const Machine m = machine(comm);
  const int ranks = ranksOf(comm), loops = Kokkos::DefaultExecutionSpace::concurrency();
  return fmt::format("{} with {}{} on {}{}{}", counted(ranks, "rank"), counted(loops, "thread"),
                     ranks > 1 ? " each" : "", counted(m.processors, "processor"),
                     m.ranks < ranks ? " a machine" : "",
                     m.ranks * loops > m.processors ? " (more threads than processors: slow)" : "");
}

std::string describeAll(MPI_Comm comm) {
  const Machine m = machine(comm);
  const std::string blas = linear::blasName();
  const int blasThreads = linear::blasThreads();
  return fmt::format(
      "atrapos     {}\n"
      "MPI         {}\n"
      "Kokkos      {}.{}.{}, {}\n"
      "BLAS        {}\n"
      "kernels     {}\n"
      "processors  {}; this rank may run on {}\n"
      "ranks       {}, {} on this machine\n"
      "threads     element loops {}, BLAS and MUMPS {} (a rank)\n",
      kVersion, mpiLibrary(), KOKKOS_VERSION / 10000, KOKKOS_VERSION / 100 % 100, KOKKOS_VERSION % 100,
      Kokkos::DefaultExecutionSpace::name(), blas.empty() ? "without control of its threads" : blas,
      fem::describeKernels(), m.processors, m.own, ranksOf(comm), m.ranks,
      Kokkos::DefaultExecutionSpace::concurrency(),
      blasThreads > 0 ? std::to_string(blasThreads) : "their own");
}

}  // namespace atrapos::threads
