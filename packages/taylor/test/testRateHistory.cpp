// Materials that remember: viscoelasticity, endochronic plasticity and plastic flow, in series and along
// chords forward and back, against closed forms and Runge's method.

#include "RateChords.hpp"
#include "RateSeries.hpp"

using namespace atrapos::taylor;

namespace {

TEST(RateHistory, endochronicPlasticityBothWays) {
  const Coefficients in = {testSeries(orders, -0.1, 0.1, 1)};
  const Values stress = spread(-0.2, 0.3);
  for (const double sign : {1.0, -1.0})
    expectOrders(
        StateLaw<Endochronic>{}, in, {stress, Values(sign)},
        [&](int l) {
          const Endochronic law;
          const LongSeries limit = longConstant(static_cast<long double>(sign) * law.strength);
          const long double rate = -static_cast<long double>(sign) * law.modulus / law.strength;
          const LongSeries decay = exp(longConstant(rate) * way(lane(in[0], l)));
          return std::vector<LongSeries>{limit - (limit - stress[l]) * decay};
        },
        "endochronic");
}

// q - h p of plastic flow: no order of it but the first is there, whatever the strains do.
struct YieldFunction {
  static constexpr int numInputs = 6, numOutputs = 2, numData = 7;
  PlasticFlow flow;
  template <class T>
  void operator()(const T* in, const Passive<T>* data, T* out) const {
    T z[7], deviator[6];
    const T mean = (in[0] + in[1] + in[2]) / 3.0;
    for (int i = 0; i < 6; ++i) deviator[i] = i < 3 ? T(in[i] - mean) : in[i];
    for (int i = 0; i < 7; ++i) z[i] = T(data[i]);
    solveRate<6, 7>(flow, deviator, z);
    out[0] = flow.stress(z) - flow.hardening * z[6];
    out[1] = z[6];
  }
};

TEST(RateHistory, plasticFlowKeepsTheYieldSurfaceInAllOrders) {
  Coefficients in;
  for (int i = 0; i < 6; ++i) in.push_back(testSeries(20, 0.01 * i, 0.04, 1 + i));
  const double state[7] = {0.9, -0.4, -0.5, 0.3, -0.2, 0.6, 0.1};
  const std::vector<Values> data(state, state + 7);
  const double yield = PlasticFlow{}.stress(state) - PlasticFlow{}.hardening * state[6];
  for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
    const auto r = runSeries(YieldFunction{}, in, mode, data.data());
    for (int l = 0; l < L; ++l) {
      EXPECT_NEAR(r.out[0][0][l], yield, 4 * 2.2e-16);
      double size = 1;
      for (int k = 1; k <= 20; ++k) {
        size = std::max(size * decay, std::fabs(r.out[1][k][l]));
        EXPECT_GT(std::fabs(r.out[1][k][l]), 0) << k;
        EXPECT_NEAR(r.out[0][k][l], 0, rounding * size) << k;
      }
    }
  }
}

// Loading and unloading: strain up, down and up again, with the times for it.
struct Turn {
  double strain, time;
};
constexpr Turn turns[] = {{0.0, 0.0}, {0.5, 0.8}, {-0.3, 1.5}, {0.1, 1.6}};

// The error of Runge's method with n steps a leg against the chords; the state is handed on at the turns.
template <class Leg>
void expectFourthOrder(const Leg& leg) {
  const auto error = [&](int n) {
    std::array<double, 1> byChords{0.05}, byRunge = byChords;
    double largest = 0;
    for (int i = 1; i < 4; ++i) {
      leg(turns[i - 1], turns[i], n, byChords, byRunge);
      largest = std::max(largest, distance(byChords, byRunge));
    }
    return largest;
  };
  // Far above rounding (1e-16) and with h so small that the next term of the error is a few per cent.
  const double coarse = error(32), middle = error(64), fine = error(128);
  EXPECT_GT(fine, 1e3 * eps);
  EXPECT_NEAR(coarse / middle, 16, 1.6);
  EXPECT_NEAR(middle / fine, 16, 0.8);
}

TEST(RateHistory, maxwellForwardAndBackAgainstRunge) {
  const Maxwell law;
  expectFourthOrder(
      [&](const Turn& from, const Turn& to, int n, std::array<double, 1>& a, std::array<double, 1>& b) {
        const double start = a[0], t = to.time - from.time, rate = (to.strain - from.strain) / t;
        a = follow(law, {from.strain, from.time}, {to.strain, to.time}, a);
        b = runge(law, {from.strain, from.time}, {to.strain, to.time}, b, n);
        const double decay = std::exp(-t / law.tau);
        EXPECT_NEAR(a[0], start * decay + law.modulus * law.tau * rate * (1 - decay), 50 * eps);
      });
}

TEST(RateHistory, endochronicForwardAndBackAgainstRunge) {
  const Endochronic law;
  expectFourthOrder(
      [&](const Turn& from, const Turn& to, int n, std::array<double, 1>& a, std::array<double, 1>& b) {
        const double start = a[0], sign = to.strain > from.strain ? 1 : -1, limit = sign * law.strength;
        a = follow(law, {from.strain}, {to.strain}, a, &sign);
        b = runge(law, {from.strain}, {to.strain}, b, n, &sign);
        const double decay = std::exp(-law.modulus / limit * (to.strain - from.strain));
        EXPECT_NEAR(a[0], limit - (limit - start) * decay, 50 * eps);
      });
}

// Flow at the yield surface, non-proportional: the surface is an invariant, and one way ends like two halves
// of it.
TEST(RateHistory, plasticFlowKeepsTheYieldSurfaceAlongChords) {
  const PlasticFlow flow;
  const State<PlasticFlow> state{0.9, -0.4, -0.5, 0.3, -0.2, 0.6, 0.1};
  const Place<PlasticFlow> from{}, middle{0.2, 0.1, -0.3, -0.1, 0.2, 0.4}, to{0.4, 0.2, -0.6, -0.2, 0.4, 0.8};
  const auto end = follow(flow, from, to, state);
  const auto yield = [&](const State<PlasticFlow>& z) {
    return flow.stress(z.data()) - flow.hardening * z[6];
  };
  EXPECT_GT(end[6], state[6] + 0.1);
  EXPECT_NEAR(yield(end), yield(state), 50 * eps);
  EXPECT_LT(distance(end, follow(flow, middle, to, follow(flow, from, middle, state))), 50 * eps);
  const auto error = [&](int n) { return distance(end, runge(flow, from, to, state, n)); };
  EXPECT_NEAR(error(32) / error(64), 16, 1.6);
}

}  // namespace
