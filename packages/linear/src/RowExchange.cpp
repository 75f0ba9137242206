#include "RowExchange.hpp"

#include <algorithm>
#include <numeric>

namespace atrapos::linear {
namespace {

std::vector<int> offsetsOf(const std::vector<int>& counts) {
  std::vector<int> offsets(counts.size(), 0);
  std::partial_sum(counts.begin(), counts.end() - 1, offsets.begin() + 1);
  return offsets;
}

}  // namespace

RowExchange::RowExchange(MPI_Comm comm, const std::vector<GlobalIndex>& rows,
                         const std::vector<GlobalIndex>& firstRows)
    : comm_(comm), order_(rows.size()), sendCounts_(firstRows.size() - 1, 0) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(), [&](int a, int b) { return rows[a] < rows[b]; });
  std::vector<GlobalIndex> asked;
  for (const int place : order_) {
    asked.push_back(rows[place]);
    // A rank without rows has the next one's first row: the last such rank owns it.
    const auto beyond = std::upper_bound(firstRows.begin(), firstRows.end(), rows[place]);
    ++sendCounts_[beyond - firstRows.begin() - 1];
  }
  receiveCounts_.resize(sendCounts_.size());
  MPI_Alltoall(sendCounts_.data(), 1, MPI_INT, receiveCounts_.data(), 1, MPI_INT, comm);
  sendOffsets_ = offsetsOf(sendCounts_);
  receiveOffsets_ = offsetsOf(receiveCounts_);
  std::vector<GlobalIndex> told(receiveOffsets_.back() + receiveCounts_.back());
  static_assert(sizeof(GlobalIndex) == sizeof(long long), "sent as MPI_LONG_LONG");
  MPI_Alltoallv(asked.data(), sendCounts_.data(), sendOffsets_.data(), MPI_LONG_LONG, told.data(),
                receiveCounts_.data(), receiveOffsets_.data(), MPI_LONG_LONG, comm);
  for (const GlobalIndex row : told) owned_.push_back(static_cast<int>(row - firstRows[rank]));
  sent_.resize(order_.size());
  received_.resize(owned_.size());
}

void RowExchange::toOwners(const double* values, double* owned) const {
  for (std::size_t i = 0; i < order_.size(); ++i) sent_[i] = values[order_[i]];
  MPI_Alltoallv(sent_.data(), sendCounts_.data(), sendOffsets_.data(), MPI_DOUBLE, received_.data(),
                receiveCounts_.data(), receiveOffsets_.data(), MPI_DOUBLE, comm_);
  for (std::size_t i = 0; i < owned_.size(); ++i) owned[owned_[i]] = received_[i];
}

}  // namespace atrapos::linear
