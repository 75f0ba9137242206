#include "OrderChoice.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>

#include <Tpetra_Vector.hpp>

#include "BestOrder.hpp"
#include "atrapos/path/Series.hpp"

namespace atrapos::path {

void OrderChoice::add(const Series& series) {
  orders_ += series.order();
  ++built_;
}

/// What a step costs whatever its order, besides the factorization the eigenvalues followed, residuals and
/// searches, is all that is not spent on the orders of the series.
int OrderChoice::best(const Calls& calls, double delta, int present) const {
  const Work& work = calls.work();
  if (work.solves == 0 || work.orders == 0) return present;
  const auto& s = work.seconds;
  const double order = s.solve / work.solves + s.orderRhs / work.orders;
  const double all = s.tangent + s.factor + s.solve + s.orderRhs + s.residual;
  // Clocks differ from rank to rank; the order may not.
  const double own[2] = {std::max(0.0, all - order * orders_) / built_, order};
  double slowest[2] = {0, 0};
  Teuchos::reduceAll(*calls.problem().map()->getComm(), Teuchos::REDUCE_MAX, 2, own, slowest);
  return bestOrder(slowest[0], slowest[1], delta);
}

}  // namespace atrapos::path
