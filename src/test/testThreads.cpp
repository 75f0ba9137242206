// Threads of a rank where nobody says how many: all ranks of a machine together take no more than it has.
#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <cstdlib>

#include "machine/Threads.hpp"

namespace atrapos {
namespace {

TEST(Threads, RanksShareTheProcessors) {
  struct Case {
    threads::Machine machine;
    int threads;
  };
  for (const Case& c : {Case{{16, 1, 16}, 16}, Case{{16, 4, 16}, 4}, Case{{16, 5, 16}, 3},
                        // More ranks than processors: one thread is the least.
                        Case{{2, 3, 2}, 1},
                        // Bound to one or to four of them by mpirun.
                        Case{{16, 2, 1}, 1}, Case{{16, 2, 4}, 4}})
    EXPECT_EQ(threads::share(c.machine), c.threads)
        << c.machine.processors << " processors, " << c.machine.ranks << " ranks, " << c.machine.own;
}

TEST(Threads, UserGoesFirst) {
  const threads::Machine machine{8, 2, 8};
  unsetenv("OMP_NUM_THREADS");
  unsetenv("KOKKOS_NUM_THREADS");
  EXPECT_EQ(threads::ofElementLoops(0, machine), 4);
  EXPECT_EQ(threads::ofElementLoops(7, machine), 7);
  setenv("OMP_NUM_THREADS", "3", 1);
  EXPECT_EQ(threads::ofElementLoops(0, machine), 0);  // left to Kokkos, which reads it
  EXPECT_EQ(threads::ofElementLoops(7, machine), 7);
  unsetenv("OMP_NUM_THREADS");
}

TEST(Threads, MachineCountsItsRanks) {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const threads::Machine machine = threads::machine(MPI_COMM_WORLD);
  EXPECT_EQ(machine.ranks, ranks);  // tests run on one machine
  EXPECT_GE(machine.own, 1);
  EXPECT_LE(machine.own, machine.processors);
  int own = threads::share(machine), all = 0;
  MPI_Allreduce(&own, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_LE(all, std::max(ranks, machine.processors));
  // A communicator of its own sees this rank alone.
  EXPECT_EQ(threads::machine(MPI_COMM_SELF).ranks, 1);
  EXPECT_EQ(threads::machine(MPI_COMM_SELF).processors, machine.own);
}

}  // namespace
}  // namespace atrapos
