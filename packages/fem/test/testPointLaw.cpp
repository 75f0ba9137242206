// Laws in batches of points: values and tangents beside those of doubles and Fad types, orders beside the
// series of taylor::PointSeries, for every number of entities that a batch may have.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "atrapos/fem/PointLawOf.hpp"
#include "atrapos/taylor/PointSeries.hpp"
#include "support/Laws.hpp"

using namespace atrapos;
using namespace atrapos::fem;
using namespace atrapos::fem::test;

namespace {

constexpr int Q = 3;  // points of an entity

/// sqrt(x0 + datum): no series where that is 0, no value below.
struct Root {
  static constexpr int numInputs = 1, numOutputs = 1, numData = 1;
  static constexpr bool symmetric = true;
  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    using std::sqrt;
    out[0] = sqrt(in[0] + data[0]);
  }
  bool exists(const double* data) const { return data[0] != 7; }
};

/// [point][entry][lane] of random numbers; lanes that are not there hold NaN.
std::vector<double> numbers(int entries, int lanes, unsigned seed, double low, double high) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(low, high);
  std::vector<double> all(static_cast<std::size_t>(Q) * entries * kLanes);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double x = uniform(generator);
    all[i] = static_cast<int>(i % kLanes) < lanes ? x : std::numeric_limits<double>::quiet_NaN();
  }
  return all;
}

std::vector<double> entriesAt(const std::vector<double>& all, int entries, int q, int lane) {
  std::vector<double> one(entries + 1);
  for (int m = 0; m < entries; ++m) one[m] = all[(static_cast<std::size_t>(q) * entries + m) * kLanes + lane];
  return one;
}

template <class Law>
class PointLaws : public testing::Test {};
using TestedLaws = testing::Types<ExponentialSolid, CentralForce, Swirl, MovingPull>;
TYPED_TEST_SUITE(PointLaws, TestedLaws);

TYPED_TEST(PointLaws, ValuesAndTangentsAreThoseOfFadTypes) {
  constexpr int I = TypeParam::numInputs, O = TypeParam::numOutputs, D = TypeParam::numData;
  const TypeParam plain;
  const auto law = pointLaw(plain);
  for (int lanes = 1; lanes <= kLanes; ++lanes) {
    const auto in = numbers(I, lanes, 1, -0.3, 0.3), data = numbers(D, lanes, 2, 0.5, 1.5);
    std::vector<double> memory(law->historyDoubles(0)), out(Q * O * kLanes), again(out),
        jacobian(I * out.size()), column(out.size());
    const PointBatch batch{Q, lanes, data.data(), memory.data()};
    law->value(batch, in.data(), out.data());
    law->tangent(batch, in.data(), again.data(), jacobian.data());
    law->derivative(batch, I - 1, in.data(), again.data(), column.data());
    for (int q = 0; q < Q; ++q)
      for (int lane = 0; lane < lanes; ++lane) {
        const auto x = entriesAt(in, I, q, lane), d = entriesAt(data, D, q, lane);
        double y[O], dy[O * I];
        taylor::tangent(plain, x.data(), d.data(), y, dy);
        for (int i = 0; i < O; ++i) {
          const std::size_t at = (static_cast<std::size_t>(q) * O + i) * kLanes + lane;
          // Entries of order 1 from a few dozen operations each.
          EXPECT_NEAR(out[at], y[i], 1e-14) << lanes << " lanes";
          EXPECT_EQ(again[at], out[at]);
          for (int j = 0; j < I; ++j)
            EXPECT_NEAR(jacobian[((static_cast<std::size_t>(q) * O + i) * I + j) * kLanes + lane],
                        dy[i * I + j], 1e-14);
          EXPECT_EQ(column[at],
                    jacobian[((static_cast<std::size_t>(q) * O + i) * I + I - 1) * kLanes + lane]);
        }
      }
  }
}

TYPED_TEST(PointLaws, OrdersAreThoseOfPointSeries) {
  constexpr int I = TypeParam::numInputs, O = TypeParam::numOutputs, D = TypeParam::numData, K = 12;
  const TypeParam plain;
  const auto law = pointLaw(plain);
  for (int lanes : {1, 2, 5, kLanes}) {
    const auto data = numbers(D, lanes, 3, 0.5, 1.5);
    std::vector<std::vector<double>> in;  // coefficients of the inputs
    for (int k = 0; k <= K; ++k) in.push_back(numbers(I, lanes, 10 + k, -0.3, 0.3));

    std::vector<double> ofPoints;
    for (int q = 0; q < Q; ++q)
      for (int lane = 0; lane < lanes; ++lane)
        for (int d = 0; d < D; ++d) ofPoints.push_back(entriesAt(data, D, q, lane)[d]);
    taylor::PointSeries<TypeParam> series(plain, Q * lanes, ofPoints);
    const auto gather = [&](int k) {
      return [&, k](int point, double* to) {
        const auto x = entriesAt(in[k], I, point / lanes, point % lanes);
        std::copy_n(x.begin(), I, to);
      };
    };
    series.begin(K, gather(0));

    std::vector<double> memory(Q * law->historyDoubles(K)), out(Q * O * kLanes);
    const PointBatch batch{Q, lanes, data.data(), memory.data()};
    PointFailure failure;
    law->start(batch, seriesOrder(0, K), in[0].data(), out.data(), failure);
    EXPECT_EQ(failure.lane, -1);
    for (int k = 1; k <= K; ++k) {
      law->order(batch, seriesOrder(k, K), in[k - 1].data(), out.data());
      series.order(k, gather(k - 1), [&](int point, const double* y) {
        for (int i = 0; i < O; ++i)
          EXPECT_EQ(out[(static_cast<std::size_t>(point / lanes) * O + i) * kLanes + point % lanes], y[i])
              << "order " << k << ", " << lanes << " lanes";
      });
    }
  }
}

TEST(PointLaw, NamesTheFirstPointWithoutSeriesAndPassesValuesBy) {
  const auto law = pointLaw(Root{});
  const int lanes = 6;
  auto in = numbers(1, lanes, 4, 0.5, 1.0), data = numbers(1, lanes, 5, 0.0, 0.1);
  const auto fail = [&](int q, int lane) { in[q * kLanes + lane] = -data[q * kLanes + lane]; };
  fail(2, 1);
  fail(1, 5);
  std::vector<double> memory(Q * law->historyDoubles(4)), out(Q * kLanes);
  const PointBatch batch{Q, lanes, data.data(), memory.data()};
  PointFailure failure;
  law->start(batch, seriesOrder(0, 4), in.data(), out.data(), failure);
  EXPECT_EQ(failure.lane, 5);
  EXPECT_EQ(failure.point, 1);
  EXPECT_EQ(failure.operation, taylor::Operation::Sqrt);
  EXPECT_EQ(failure.value, 0.0);
  law->value(batch, in.data(), out.data());
  EXPECT_EQ(out[1 * kLanes + 5], 0.0);  // a value, though no series
}

TEST(PointLaw, SaysWhatTheLawSays) {
  const auto root = pointLaw(Root{}), solid = pointLaw(ExponentialSolid{});
  EXPECT_EQ(root->shape().observed, 0);
  EXPECT_TRUE(root->observedNames().empty());
  const double seven = 7, one = 1;
  EXPECT_FALSE(root->exists(&seven));
  EXPECT_TRUE(root->exists(&one));
  EXPECT_TRUE(solid->exists(&seven));
  EXPECT_EQ(solid->shape().inputs, 9);
  EXPECT_EQ(solid->shape().data, 1);
  EXPECT_TRUE(solid->shape().symmetric);
  EXPECT_FALSE(pointLaw(Swirl{})->shape().symmetric);
  EXPECT_EQ(solid->observedNames(), (std::vector<std::string>{"trace", "scale"}));
  std::vector<double> H(9 * kLanes, 0.0), data(kLanes, 7.0), memory(solid->historyDoubles(0)),
      shown(2 * kLanes);
  for (int i = 0; i < 3; ++i) H[4 * i * kLanes + 1] = i + 1;  // of the second entity
  solid->observe({1, 2, data.data(), memory.data()}, H.data(), shown.data());
  EXPECT_EQ(shown[1], 6);
  EXPECT_EQ(shown[kLanes + 1], 7);
}

}  // namespace
