// Laws with inputs that vanish or are condensed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "atrapos/fem/PointLawOf.hpp"
#include "atrapos/fem/ReducedLaw.hpp"
#include "support/Laws.hpp"
#include "support/Meshes.hpp"
#include "support/Vectors.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;

namespace {

constexpr int Q = 3, lanes = 5, K = 12;

/// H in a plane, [H_xx, H_xy, H_yx, H_yy], of a body in space; with `stress` P_zz = 0.
Reduction plane(bool stress) { return {{0, 1, -1, 2, 3, -1, -1, -1, -1}, {0, 1, 3, 4}, 4, stress ? 8 : -1}; }

struct Law {
  std::unique_ptr<PointLaw> law;
  Numbers memory, data;
  explicit Law(bool stress) : law(reducedLaw(pointLaw(ExponentialSolid{}), plane(stress))) {
    data.assign(Q * kLanes, 1.3);
  }
  PointBatch batch(std::size_t doubles) {
    memory.assign(doubles, 0.0);
    return {Q, lanes, data.data(), memory.data()};
  }
  Numbers value(const Numbers& in) {
    Numbers out(Q * 4 * kLanes);
    law->value(batch(law->historyDoubles(0)), in.data(), out.data());
    return out;
  }
};

/// The largest difference in lanes that there are.
double difference(const Numbers& a, const Numbers& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (static_cast<int>(i % kLanes) < lanes) worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst;
}

}  // namespace

class Reduced : public testing::TestWithParam<bool> {};

TEST_P(Reduced, ValueIsTheWholeLaws) {
  Law reduced(GetParam());
  const Numbers in = randomNumbers(Q * 4 * kLanes, 0.2, 1);
  const Numbers out = reduced.value(in);
  for (int q = 0; q < Q; ++q)
    for (int lane = 0; lane < lanes; ++lane) {
      double H[9] = {}, P[9];
      const int places[4] = {0, 1, 3, 4};
      for (int i = 0; i < 4; ++i) H[places[i]] = in[(q * 4 + i) * kLanes + lane];
      const double scale = 1.3;
      // P_zz = 0 by bisection: it grows with H_zz here.
      double low = -0.5, high = 0.5;
      for (int n = 0; GetParam() && n < 80; ++n) {
        H[8] = 0.5 * (low + high);
        ExponentialSolid{}(H, &scale, P);
        (P[8] > 0 ? high : low) = H[8];
      }
      ExponentialSolid{}(H, &scale, P);
      for (int i = 0; i < 4; ++i) EXPECT_NEAR(out[(q * 4 + i) * kLanes + lane], P[places[i]], 1e-14);
    }
}

TEST_P(Reduced, TangentIsTheDerivative) {
  Law reduced(GetParam());
  const Numbers in = randomNumbers(Q * 4 * kLanes, 0.2, 1);
  Numbers out(Q * 4 * kLanes), jacobian(Q * 16 * kLanes), column(Q * 4 * kLanes);
  reduced.law->tangent(reduced.batch(reduced.law->historyDoubles(0)), in.data(), out.data(), jacobian.data());
  EXPECT_LT(difference(out, reduced.value(in)), 1e-15);
  for (int j = 0; j < 4; ++j) {
    const auto error = [&](double h) {
      Numbers ahead = in, behind = in, exact(out.size());
      for (int q = 0; q < Q; ++q)
        for (int lane = 0; lane < kLanes; ++lane) {
          ahead[(q * 4 + j) * kLanes + lane] += h;
          behind[(q * 4 + j) * kLanes + lane] -= h;
          for (int o = 0; o < 4; ++o)
            exact[(q * 4 + o) * kLanes + lane] = jacobian[((q * 4 + o) * 4 + j) * kLanes + lane];
        }
      const Numbers change = sum(reduced.value(ahead), -1, reduced.value(behind));
      return difference(sum(change, -2 * h, exact), Numbers(out.size(), 0.0)) / (2 * h);
    };
    EXPECT_NEAR(std::log2(error(0.02) / error(0.01)), 2, 0.05) << "input " << j;
    reduced.law->derivative(reduced.batch(reduced.law->historyDoubles(0)), j, in.data(), out.data(),
                            column.data());
    for (int o = 0; o < Q * 4; ++o)
      for (int lane = 0; lane < lanes; ++lane)
        EXPECT_EQ(column[o * kLanes + lane], jacobian[(o * 4 + j) * kLanes + lane]);
  }
}

// The series of the outputs along a path of the inputs, against values on it: what is left falls like
// a^(K+1).
TEST_P(Reduced, OrdersAreThoseOfTheValue) {
  Law reduced(GetParam());
  std::vector<Numbers> in{randomNumbers(Q * 4 * kLanes, 0.2, 1)};
  for (int k = 1; k <= K; ++k) in.push_back(randomNumbers(in[0].size(), 0.2 / k, 10 + k));
  const SeriesOrder start = seriesOrder(0, K);
  const PointBatch batch = reduced.batch(Q * reduced.law->seriesDoubles(start));
  Numbers out(in[0].size()), jacobian(Q * 16 * kLanes);
  std::vector<Numbers> series;
  PointFailure failure;
  {
    Law other(GetParam());
    other.law->tangent(other.batch(other.law->historyDoubles(0)), in[0].data(), out.data(), jacobian.data());
  }
  reduced.law->start(batch, start, in[0].data(), out.data(), failure);
  ASSERT_EQ(failure.lane, -1);
  series.push_back(out);
  for (int k = 1; k <= K; ++k) {
    reduced.law->order(batch, seriesOrder(k, K), in[k - 1].data(), out.data());
    // With coefficient k of the inputs: it enters linearly.
    for (int q = 0; q < Q; ++q)
      for (int o = 0; o < 4; ++o)
        for (int j = 0; j < 4; ++j)
          for (int lane = 0; lane < kLanes; ++lane)
            out[(q * 4 + o) * kLanes + lane] +=
                jacobian[((q * 4 + o) * 4 + j) * kLanes + lane] * in[k][(q * 4 + j) * kLanes + lane];
    series.push_back(out);
  }
  const auto left = [&](double a) {
    Numbers at = in[0], expected = series[0];
    double power = 1;
    for (int k = 1; k <= K; ++k) {
      power *= a;
      at = sum(at, power, in[k]);
      expected = sum(expected, power, series[k]);
    }
    return difference(reduced.value(at), expected);
  };
  EXPECT_GT(left(0.2), 1e-13);
  EXPECT_NEAR(std::log2(left(0.4) / left(0.2)), K + 1, 1.0);
}

INSTANTIATE_TEST_SUITE_P(Plane, Reduced, testing::Bool(),
                         [](const auto& info) { return info.param ? "Stress" : "Strain"; });

TEST(ReducedLaw, WhatDoesNotFitIsRefused) {
  EXPECT_THROW(reducedLaw(pointLaw(CentralForce{}), plane(false)), std::logic_error);
  Reduction given = plane(true);
  given.inputs[8] = 0;
  EXPECT_THROW(reducedLaw(pointLaw(ExponentialSolid{}), given), std::logic_error);
  EXPECT_THROW(
      reducedLaw(reducedLaw(pointLaw(ExponentialSolid{}), plane(false)), {{0, 1, 2, 3}, {0, 1, 2, 3}, 4, -1}),
      std::logic_error);
}
