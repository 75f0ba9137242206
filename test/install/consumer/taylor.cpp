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
  std::vector<double> history(taylor::historyDoubles<lanes>(taylor::historySlots<lanes>(Cube{}), maxOrder));
  taylor::Context<lanes> context{history.data(), maxOrder, 0, taylor::Pass::Start, 0};
  for (int order = 0; order <= maxOrder; ++order) {
    context.order = order;
    context.pass = order == 0 ? taylor::Pass::Start : taylor::Pass::Sweep;
    taylor::Lanes<lanes> in, out;
    in = order <= 1 ? 1.0 : 0.0;
    taylor::sweep<lanes>(Cube{}, context, &in, nullptr, &out);
    for (int lane = 0; lane < lanes; ++lane) {
      // Sums and products of small whole numbers are exact.
      if (out.v[lane] != expected[order]) {
        std::printf("order %d: %g instead of %g\n", order, out.v[lane], expected[order]);
        return 1;
      }
    }
  }
  return 0;
}
