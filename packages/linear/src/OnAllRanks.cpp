#include "atrapos/linear/OnAllRanks.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Vector.hpp>

namespace atrapos::linear {

std::vector<double> onAllRanks(const Map& map, const std::vector<double>& own) {
  if (map.getComm()->getSize() == 1 && map.isContiguous()) return own;
  std::vector<double> mine(map.getGlobalNumElements(), 0.0), all(mine.size());
  const auto ids = map.getNodeElementList();
  for (long i = 0; i < ids.size(); ++i) mine[ids[i]] = own[i];
  Teuchos::reduceAll(*map.getComm(), Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(),
                     all.data());
  return all;
}

std::vector<double> onAllRanks(const Vector& x) {
  const auto data = x.getData();
  return onAllRanks(*x.getMap(), {data.begin(), data.end()});
}

}  // namespace atrapos::linear
