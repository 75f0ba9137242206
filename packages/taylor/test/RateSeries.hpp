#pragma once

#include "RateLaws.hpp"
#include "SeriesRun.hpp"

constexpr int orders = 40;

// Each order sums up to 40 rounded terms in each of a few nested convolutions, whose errors the later orders
// take along: 200 units of rounding of the largest coefficient that a coefficient grows from.
constexpr double rounding = 200 * 2.2e-16;

/// expected(lane) is the vector of all outputs as LongSeries.
template <class Law, class Expected>
void expectOrders(const Law& law, const Coefficients& in, const std::vector<Values>& data,
                  const Expected& expected, const std::string& what) {
  for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
    const auto r = runSeries(law, in, mode, data.data());
    for (int i = 0; i < Law::numOutputs; ++i)
      expectSeries(
          r.out[i],
          [&](int l) {
            const LongSeries c = expected(l)[i];
            return [c](int k) { return c.at(k); };
          },
          rounding,
          what + (mode == Mode::Direct ? ", given, output " : ", solved, output ") + std::to_string(i));
  }
}

/// Another value in each lane.
inline Values spread(double first, double last) { return testSeries(0, first, last, 1)[0]; }

/// v without its value of order 0: the way from there.
inline LongSeries way(LongSeries v) {
  v.c[0] = 0;
  return v;
}
