#include "BestOrder.hpp"

#include <cmath>

namespace atrapos::path {

int bestOrder(double factorSeconds, double orderSeconds, double delta) {
  constexpr int least = 5, most = 40;
  int best = least;
  double cheapest = 0;
  for (int K = least; K <= most; ++K) {
    const double cost = (factorSeconds + K * orderSeconds) / std::pow(delta, 1.0 / (K - 1));
    if (K == least || cost < cheapest) {
      cheapest = cost;
      best = K;
    }
  }
  return best;
}

}  // namespace atrapos::path
