// The Taylor series of (1 + a)^3 from the installed headers, coefficient by coefficient.
#include <cmath>
#include <cstdio>
#include <vector>

#include "atrapos/taylor/Law.hpp"

namespace taylor = atrapos::taylor;

struct Cube {
  static constexpr int numInputs = 1, numOutputs = 1, numData = 0;
  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    out[0] = in[0] * in[0] * in[0];
  }
};

int main() {
  constexpr int lanes = 4, maxOrder = 4;
  const double expected[maxOrder + 1] = {1, 3, 3, 1, 0};
  taylor::Context<lanes> context;
  context.shape = taylor::historyShape(Cube{});
  std::vector<double> history(context.shape.doubles<lanes>(maxOrder));
  context.memory = history.data();
  const taylor::Lanes<lanes>* noData = nullptr;
  for (context.order = 0; context.order <= maxOrder; ++context.order) {
    const int order = context.order;
    taylor::Lanes<lanes> in, out;
    in = order <= 1 ? 1.0 : 0.0;
    if (order == 0)
      taylor::start(Cube{}, context, &in, noData, &out);
    else
      taylor::sweepKnown(Cube{}, context, &in, noData, &out);
    for (int lane = 0; lane < lanes; ++lane) {
      // Sums and products of small whole numbers are exact.
      if (out[lane] != expected[order]) {
        std::printf("order %d: %g instead of %g\n", order, out[lane], expected[order]);
        return 1;
      }
    }
  }
  return 0;
}
