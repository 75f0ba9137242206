#pragma once

#include <mpi.h>

#include <vector>

#include "atrapos/linear/Types.hpp"

namespace atrapos::linear {

/// Brings values of rows from where they were computed to the ranks that own the rows. Construction and use
/// are collective.
class RowExchange {
 public:
  /// rows: those that this rank has values of, numbered from 0, every row on one rank only; firstRows: [rank]
  /// the first row it owns, and behind them the number of rows.
  RowExchange(MPI_Comm comm, const std::vector<GlobalIndex>& rows, const std::vector<GlobalIndex>& firstRows);

  /// values: [place in rows]; owned: [row of this rank].
  void toOwners(const double* values, double* owned) const;

 private:
  MPI_Comm comm_;
  std::vector<int> order_, sendCounts_, sendOffsets_;  ///< places in rows, owner by owner
  std::vector<int> receiveCounts_, receiveOffsets_;
  std::vector<int> owned_;  ///< [received] row of this rank
  mutable std::vector<double> sent_, received_;
};

}  // namespace atrapos::linear
