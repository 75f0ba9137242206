#pragma once

#include <mpi.h>

#include <vector>

namespace atrapos::linear {

/// nestedDissection of the entries that all ranks have, rank 0's result; empty on the others. Collective; a
/// failure throws SolverError on all ranks. Ours, because MUMPS' ICNTL(7)=5 silently becomes another ordering
/// where it was built without METIS (Debian 12).
std::vector<int> orderingOnRoot(int n, const std::vector<int>& rows, const std::vector<int>& columns,
                                MPI_Comm comm);

}  // namespace atrapos::linear
