#include "MumpsEntries.hpp"

#include <Teuchos_DefaultMpiComm.hpp>
#include <Tpetra_CrsMatrix.hpp>

#include "atrapos/linear/Error.hpp"

namespace atrapos::linear {

MPI_Comm mpiComm(const Map& map) {
  const auto comm = map.getComm();
  if (const auto* mpi = dynamic_cast<const Teuchos::MpiComm<int>*>(comm.get())) return *mpi->getRawMpiComm();
  if (comm->getSize() == 1) return MPI_COMM_SELF;
  throw SolverError("MUMPS: the matrix' communicator is not an MPI one");
}

MumpsEntries::MumpsEntries(const CrsMatrix& K, const RowNumbering& numbering, bool symmetric) {
  const auto local = K.getCrsGraph()->getLocalGraphHost();
  const int localRows = static_cast<int>(K.getNodeNumRows());
  for (int i = 0; i < localRows; ++i)
    for (std::size_t e = local.row_map(i); e < local.row_map(i + 1); ++e) {
      const auto row = static_cast<MUMPS_INT>(numbering.first + i);
      const auto column = static_cast<MUMPS_INT>(numbering.columns[local.entries(e)]);
      if (symmetric && column > row) continue;
      rows.push_back(row + 1);
      columns.push_back(column + 1);
      if (symmetric) positions.push_back(e);
    }
}

}  // namespace atrapos::linear
