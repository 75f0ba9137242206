#pragma once

#include <mpi.h>
#include <mumps_c_types.h>

#include <Tpetra_CrsMatrix.hpp>
#include <cstddef>
#include <vector>

#include "RowNumbering.hpp"
#include "atrapos/linear/Types.hpp"

namespace atrapos::linear {

/// The MPI communicator of a map. Throws SolverError where it has none and several ranks.
MPI_Comm mpiComm(const Map& map);

/// Where K's entries are, as MUMPS takes them (ICNTL(18) = 3): each is passed once, by the owner of its row,
/// and of a symmetric K the lower triangle alone.
struct MumpsEntries {
  MumpsEntries() = default;
  MumpsEntries(const CrsMatrix& K, const RowNumbering& numbering, bool symmetric);

  /// Their values, in the same order.
  template <class Scalar>
  void copyValues(const CrsMatrix& K, std::vector<Scalar>& to) const {
    const auto local = K.getLocalMatrixHost();
    to.resize(rows.size());
    for (std::size_t e = 0; e < to.size(); ++e)
      to[e] = static_cast<Scalar>(local.values(positions.empty() ? e : positions[e]));
  }

  std::vector<MUMPS_INT> rows, columns;  ///< from 1
  std::vector<std::size_t> positions;    ///< among K's local values; empty: all, in K's order
};

}  // namespace atrapos::linear
