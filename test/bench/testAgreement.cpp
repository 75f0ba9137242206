#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "AtraposSweep.hpp"
#include "Cases.hpp"
#include "HandSweep.hpp"
#include "SacadoPeer.hpp"
#ifdef ATRAPOS_BENCH_ADOLC
#include "AdolcPeer.hpp"
#endif

/// All methods of the benchmark compute the same coefficients: what is compared in speed is the same work.
namespace atrapos::bench {
namespace {

constexpr int kOrder = 24;  // several blocks of HandSweep, odd and even ends
constexpr int kPoints = kDistinct;

/// [point][output][order]
class Coefficients {
 public:
  explicit Coefficients(int outputs)
      : outputs_(outputs), c_(static_cast<std::size_t>(kPoints) * outputs * (kOrder + 1)) {}
  double& operator()(std::size_t p, int i, int k) { return c_[(p * outputs_ + i) * (kOrder + 1) + k]; }
  double operator()(std::size_t p, int i, int k) const { return c_[(p * outputs_ + i) * (kOrder + 1) + k]; }
  int outputs() const { return outputs_; }

 private:
  int outputs_;
  std::vector<double> c_;
};

template <int O, class S>
Coefficients runSweep(const S& sweep, const Inputs& inputs) {
  constexpr std::size_t batches = kPoints / kLanes;
  std::vector<taylor::Lanes<kLanes>> history(sweep.historyDoubles(batches) / kLanes);
  std::vector<taylor::Lanes<kLanes>> out((kOrder + 1) * batches * O);
  sweep.run(reinterpret_cast<double*>(history.data()), batches, inputs,
            [&](int k, std::size_t b) { return &out[(k * batches + b) * O]; });
  Coefficients result(O);
  for (int k = 0; k <= kOrder; ++k)
    for (std::size_t p = 0; p < kPoints; ++p)
      for (int i = 0; i < O; ++i) result(p, i, k) = out[(k * batches + p / kLanes) * O + i][p % kLanes];
  return result;
}

template <class Peer>
Coefficients runPeer(const Peer& peer, const Inputs& inputs, int outputs, bool oneShot) {
  std::vector<double> series(peer.seriesDoubles(kPoints));
  Coefficients result(outputs);
  const auto sink = [&](int k, std::size_t p, int i, double c) { result(p, i, k) = c; };
  if (oneShot)
    peer.oneShot(series.data(), kPoints, inputs, sink);
  else
    peer.reevaluate(series.data(), kPoints, inputs, sink);
  return result;
}

/// Largest difference at a point, over the largest of max_{j<=k} |c_j| 2^(j-k) of its outputs: the size of
/// what enters order k, since inputs decrease like 2^-k.
double difference(const Coefficients& a, const Coefficients& b) {
  double worst = 0;
  for (std::size_t p = 0; p < kPoints; ++p) {
    double size = 0;
    for (int k = 0; k <= kOrder; ++k) {
      size /= 2;
      for (int i = 0; i < a.outputs(); ++i) size = std::max(size, std::fabs(a(p, i, k)));
      for (int i = 0; i < a.outputs(); ++i) {
        const double d = std::fabs(a(p, i, k) - b(p, i, k)) / size;
        if (!(d <= worst)) worst = d;  // NaN, too
      }
    }
  }
  return worst;
}

/// Different summation orders in a hundred operations; measured 2e-15 at most, up to 20 eps an operation can
/// be expected at high orders (docs/theory/taylor.md, Rounding).
constexpr double kTolerance = 2e-14;
/// Laws solved by Newton against their closed form: both round h = |x - C| - r, ten times smaller than |x -
/// C|, in their own way, and the pressure follows Delta - h, down to a hundredth of h. Measured 3e-13.
constexpr double kImplicitTolerance = 2e-12;

TEST(BenchAgreement, AllMethodsGiveTheSameCoefficients) {
  forEachCase([](const char* name, const auto& law, const auto& peerLaw, const Domain& domain) {
    SCOPED_TRACE(name);
    using Law = std::decay_t<decltype(law)>;
    using PeerLaw = std::decay_t<decltype(peerLaw)>;
    constexpr int O = Law::numOutputs;
    const Inputs inputs(domain, kOrder);
    const SacadoPeer<PeerLaw> sacado(peerLaw, kOrder);
    const Coefficients reference = runPeer(sacado, inputs, O, false);
    double nonlinear = 0;
    for (int i = 0; i < O; ++i) nonlinear += std::fabs(reference(0, i, 3));
    EXPECT_GT(nonlinear, 0);

    const bool implicit = !std::is_same_v<Law, PeerLaw>;
    EXPECT_LT(difference(reference, runSweep<O>(AtraposSweep<Law>(law, kOrder), inputs)),
              implicit ? kImplicitTolerance : kTolerance);
    EXPECT_LT(difference(reference, runSweep<O>(AtraposSweep<PeerLaw>(peerLaw, kOrder), inputs)), kTolerance);
#ifdef ATRAPOS_BENCH_ADOLC
    const AdolcPeer<PeerLaw> adolc(peerLaw, kOrder, 1, inputs);
    EXPECT_LT(difference(reference, runPeer(adolc, inputs, O, false)), kTolerance);
    EXPECT_LT(difference(runPeer(sacado, inputs, O, true), runPeer(adolc, inputs, O, true)), kTolerance);
#endif
    if constexpr (std::is_same_v<Law, solid::SaintVenantKirchhoff>)
      for (bool blocked : {false, true}) {
        const HandSweep hand({law.lambda, law.mu}, kOrder, blocked);
        EXPECT_LT(difference(reference, runSweep<O>(hand, inputs)), kTolerance) << "blocked " << blocked;
      }
  });
}

/// One shot knows x_k, the others do not: they differ by the tangent times x_k.
TEST(BenchAgreement, OneShotIsNonlinearPartPlusTangent) {
  forEachCase([](const char* name, const auto&, const auto& law, const Domain& domain) {
    SCOPED_TRACE(name);
    using Law = std::decay_t<decltype(law)>;
    constexpr int I = Law::numInputs, O = Law::numOutputs;
    const Inputs inputs(domain, kOrder);
    const SacadoPeer<Law> sacado(law, kOrder);
    Coefficients sum = runPeer(sacado, inputs, O, false);
    for (std::size_t p = 0; p < kPoints; ++p) {
      const double* x = inputs.point(p);
      double x0[I], y0[O], jacobian[O * I];
      for (int j = 0; j < I; ++j) x0[j] = x[j * (kOrder + 1)];
      taylor::tangent(law, x0, &inputs.datum(), y0, jacobian);
      for (int i = 0; i < O; ++i)
        for (int k = 1; k <= kOrder; ++k)
          for (int j = 0; j < I; ++j) sum(p, i, k) += jacobian[i * I + j] * x[j * (kOrder + 1) + k];
    }
    EXPECT_LT(difference(runPeer(sacado, inputs, O, true), sum), kTolerance);
  });
}

}  // namespace
}  // namespace atrapos::bench
