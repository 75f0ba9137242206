#include "OrderingOnRoot.hpp"

#include <fmt/format.h>

#include <limits>
#include <string>

#include "NestedDissection.hpp"
#include "atrapos/linear/Error.hpp"

namespace atrapos::linear {
namespace {

// All ranks' parts, one after another, on rank 0; empty on the others.
std::vector<int> gather(const std::vector<int>& part, MPI_Comm comm) {
  int rank = 0, size = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  const int count = static_cast<int>(part.size());
  std::vector<int> counts(rank == 0 ? size : 0), offsets(counts.size(), 0);
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, comm);
  for (std::size_t r = 1; r < counts.size(); ++r) offsets[r] = offsets[r - 1] + counts[r - 1];
  std::vector<int> all(counts.empty() ? 0 : offsets.back() + counts.back());
  MPI_Gatherv(part.data(), count, MPI_INT, all.data(), counts.data(), offsets.data(), MPI_INT, 0, comm);
  return all;
}

}  // namespace

std::vector<int> orderingOnRoot(int n, const std::vector<int>& rows, const std::vector<int>& columns,
                                MPI_Comm comm) {
  long long entries = static_cast<long long>(rows.size()), allEntries = 0;
  MPI_Allreduce(&entries, &allEntries, 1, MPI_LONG_LONG, MPI_SUM, comm);
  if (allEntries > std::numeric_limits<int>::max())
    throw SolverError(fmt::format("METIS: {} entries are too many for the ordering on one rank", allEntries));
  const auto allRows = gather(rows, comm), allColumns = gather(columns, comm);
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::vector<int> ordering;
  std::string message;
  if (rank == 0) try {
      ordering = nestedDissection(n, allRows, allColumns);
    } catch (const SolverError& e) {
      message = e.what();
    }
  int failed = !message.empty();
  MPI_Bcast(&failed, 1, MPI_INT, 0, comm);
  if (failed) throw SolverError(rank == 0 ? message : "METIS: the ordering failed on rank 0");
  return ordering;
}

}  // namespace atrapos::linear
