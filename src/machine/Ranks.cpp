#include "machine/Ranks.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <thread>

#include "machine/Interrupt.hpp"

namespace atrapos::ranks {
namespace {

/// For messages about errors alone: whatever the other communicators are in the middle of.
MPI_Comm errors = MPI_COMM_NULL;

bool alone = false;

bool running() {
  int started = 0, ended = 0;
  MPI_Initialized(&started);
  MPI_Finalized(&ended);
  return started && !ended;
}

}  // namespace

int own() {
  int r = 0;
  if (running()) MPI_Comm_rank(MPI_COMM_WORLD, &r);
  return r;
}

int count() {
  int n = 1;
  if (running() && !alone) MPI_Comm_size(MPI_COMM_WORLD, &n);
  return n;
}

MPI_Comm communicator() { return alone ? MPI_COMM_SELF : MPI_COMM_WORLD; }

bool isFirst() { return own() == 0; }

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

double sum(double here) {
  if (count() == 1) return here;
  double all = 0;
  MPI_Allreduce(&here, &all, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return all;
}

std::vector<std::string> gather(const std::string& here) {
  if (count() == 1) return {here};
  std::vector<std::string> all(count());
  all[own()] = here;
  // One by one: messages count their bytes in 31 bits.
  constexpr std::size_t most = std::size_t{1} << 30;
  for (int r = 0; r < count(); ++r) {
    unsigned long long size = all[r].size();
    MPI_Bcast(&size, 1, MPI_UNSIGNED_LONG_LONG, r, MPI_COMM_WORLD);
    all[r].resize(size);
    for (std::size_t first = 0; first < size; first += most)
      MPI_Bcast(&all[r][first], static_cast<int>(std::min<std::size_t>(most, size - first)), MPI_CHAR, r,
                MPI_COMM_WORLD);
  }
  return all;
}

void wait() {
  if (count() > 1) MPI_Barrier(MPI_COMM_WORLD);
}

int onFirst(const std::function<int()>& f) {
  if (count() == 1) return f();
  int result = 0;
  if (isFirst()) {
    alone = true;
    result = f();
    alone = false;
  }
  const Interrupt noted;  // a signal to all is the first one's affair
  MPI_Request request;
  MPI_Ibcast(&result, 1, MPI_INT, 0, MPI_COMM_WORLD, &request);
  for (int done = 0; !done;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (!done) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return result;
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
  int mine = own(), first = 0, done = 0;
  MPI_Request request;
  MPI_Iallreduce(&mine, &first, 1, MPI_INT, MPI_MIN, errors, &request);
  const auto start = std::chrono::steady_clock::now();
  while (!done && std::chrono::steady_clock::now() - start < patience) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (!done) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  if (done) {
    if (mine == first) std::cerr << line << '\n';
    return;
  }
  std::cerr << fmt::format("{} (rank {} of {})", line, mine, count()) << std::endl;
  MPI_Abort(MPI_COMM_WORLD, exitCode);
}

}  // namespace atrapos::ranks
