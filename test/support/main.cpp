// The main of every test executable: MPI and Kokkos live from before the first test to after the last.
#include <gtest/gtest.h>
#include <mpi.h>
#include <Kokkos_Core.hpp>

#include <algorithm>
#include <cstdlib>
#include <thread>

namespace {

/// Threads of this rank: its share of the machine's processors, where the environment does not say. Ranks
/// that each take all of them make a small problem a hundred times slower.
int threadsOfRank() {
  if (std::getenv("OMP_NUM_THREADS") != nullptr) return -1;  // Kokkos reads it
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / ranks);
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  MPI_Init(&argc, &argv);
  Kokkos::initialize(Kokkos::InitArguments(threadsOfRank()));
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0) {  // one report is enough; a failing rank still fails the run
    auto& listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
  }
  const int failed = RUN_ALL_TESTS();
  int anyFailed = failed;
  MPI_Allreduce(&failed, &anyFailed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  Kokkos::finalize();
  MPI_Finalize();
  return anyFailed;
}
