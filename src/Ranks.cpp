#include "Ranks.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <chrono>
#include <iostream>
#include <thread>

namespace atrapos::ranks {
namespace {

/// For messages about errors alone: whatever the other communicators are in the middle of.
MPI_Comm errors = MPI_COMM_NULL;

bool running() {
  int started = 0, ended = 0;
  MPI_Initialized(&started);
  MPI_Finalized(&ended);
  return started && !ended;
}

int rank() {
  int r = 0;
  if (running()) MPI_Comm_rank(MPI_COMM_WORLD, &r);
  return r;
}

}  // namespace

int count() {
  int n = 1;
  if (running()) MPI_Comm_size(MPI_COMM_WORLD, &n);
  return n;
}

bool isFirst() { return rank() == 0; }

bool any(bool here) {
  if (count() == 1) return here;
  int own = here, all = 0;
  MPI_Allreduce(&own, &all, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return all != 0;
}

int sum(int here) {
  if (count() == 1) return here;
  int all = 0;
  MPI_Allreduce(&here, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  return all;
}

void wait() {
  if (count() > 1) MPI_Barrier(MPI_COMM_WORLD);
}

void open() { MPI_Comm_dup(MPI_COMM_WORLD, &errors); }

void close() { MPI_Comm_free(&errors); }

void fail(const std::string& line, int exitCode) {
  if (errors == MPI_COMM_NULL || count() == 1) {
    std::cerr << line << '\n';
    return;
  }
  // Ranks that fail alike meet here within moments; one that fails alone meets nobody.
  constexpr auto patience = std::chrono::seconds(3);
  int own = rank(), first = 0, done = 0;
  MPI_Request request;
  MPI_Iallreduce(&own, &first, 1, MPI_INT, MPI_MIN, errors, &request);
  const auto start = std::chrono::steady_clock::now();
  while (!done && std::chrono::steady_clock::now() - start < patience) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (!done) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  if (done) {
    if (own == first) std::cerr << line << '\n';
    return;
  }
  std::cerr << fmt::format("{} (rank {} of {})", line, own, count()) << std::endl;
  MPI_Abort(MPI_COMM_WORLD, exitCode);
}

}  // namespace atrapos::ranks
