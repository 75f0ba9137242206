#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "PatchSurfaces.hpp"
#include "atrapos/contact/ContactStages.hpp"
#include "atrapos/contact/CurveContactLaw.hpp"
#include "atrapos/contact/HardContactLaw.hpp"
#include "atrapos/contact/SharpenedContact.hpp"
#include "atrapos/fem/PointLawOf.hpp"

/// Contact laws in stages beside the same laws written as one template each.
namespace atrapos::contact::test {

using fem::kLanes;

constexpr int Q = 2, lanes = 5, K = 20;

using Numbers = std::vector<double>;

/// [point][entry][lane], value(point and lane as one number, entry).
template <class F>
Numbers numbers(int entries, const F& value) {
  Numbers all(static_cast<std::size_t>(Q) * entries * kLanes, 0.0);
  for (int q = 0; q < Q; ++q)
    for (int m = 0; m < entries; ++m)
      for (int lane = 0; lane < lanes; ++lane)
        all[(q * entries + m) * kLanes + lane] = value(q * lanes + lane, m);
  return all;
}

/// Both laws' numbers, of all lanes that are there. Both solve the same equations to rounding, whose errors
/// grow with the order like the coefficients themselves: 1e-11 of the largest is some hundred operations'
/// worth.
inline void expectSame(const Numbers& a, const Numbers& b, const char* what, int order = 0) {
  double size = 1e-300, difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (static_cast<int>(i % kLanes) >= lanes) continue;
    size = std::max(size, std::abs(b[i]));
    difference = std::max(difference, std::abs(a[i] - b[i]));
    ASSERT_FALSE(std::isnan(a[i] - b[i])) << what << ", order " << order;
  }
  EXPECT_LE(difference, 1e-11 * size) << what << ", order " << order;
}

/// in: values of the inputs; further coefficients are random and fall.
inline void compare(const fem::PointLaw& staged, const fem::PointLaw& whole, const Numbers& in,
                    const Numbers& data, unsigned seed) {
  const fem::LawShape s = whole.shape();
  ASSERT_EQ(staged.shape().inputs, s.inputs);
  ASSERT_EQ(staged.shape().outputs, s.outputs);
  ASSERT_EQ(staged.shape().data, s.data);
  EXPECT_EQ(staged.shape().symmetric, s.symmetric);
  EXPECT_EQ(staged.observedNames(), whole.observedNames());
  struct Results {
    Numbers out, jacobian, column, memory;
  };
  const std::size_t size = static_cast<std::size_t>(Q) * s.outputs * kLanes;
  Results results[2];
  const fem::PointLaw* laws[2] = {&staged, &whole};
  for (int l = 0; l < 2; ++l) {
    Results& r = results[l];
    r.out.assign(size, 0.0);
    r.column.assign(size, 0.0);
    r.jacobian.assign(size * s.inputs, 0.0);
    r.memory.assign(std::max(laws[l]->historyDoubles(0), Q * laws[l]->historyDoubles(K)), 0.0);
    const fem::PointBatch batch{Q, lanes, data.data(), r.memory.data()};
    laws[l]->tangent(batch, in.data(), r.out.data(), r.jacobian.data());
    laws[l]->derivative(batch, 1, in.data(), r.out.data(), r.column.data());
    laws[l]->value(batch, in.data(), r.out.data());
  }
  expectSame(results[0].out, results[1].out, "value");
  expectSame(results[0].jacobian, results[1].jacobian, "tangent");
  expectSame(results[0].column, results[1].column, "derivative");

  Random random(seed);
  Numbers last = in;
  for (int k = 0; k <= K; ++k) {
    for (int l = 0; l < 2; ++l) {
      const fem::PointBatch batch{Q, lanes, data.data(), results[l].memory.data()};
      fem::PointFailure failure;
      if (k == 0)
        laws[l]->start(batch, fem::seriesOrder(0, K), in.data(), results[l].out.data(), failure);
      else
        laws[l]->order(batch, fem::seriesOrder(k, K), last.data(), results[l].out.data());
      EXPECT_EQ(failure.lane, -1);
    }
    expectSame(results[0].out, results[1].out, "series", k);
    if (k > 0)
      last = numbers(s.inputs, [&](int, int) { return 0.1 * random.between(-1, 1) * std::pow(0.5, k); });
  }

  if (s.observed == 0) {  // hard contact: conditions ask whether there is something to touch
    for (int lane = 0; lane < lanes; ++lane) {
      Numbers own(s.data + 1);
      for (int d = 0; d < s.data; ++d) own[d] = data[d * kLanes + lane];
      EXPECT_EQ(staged.exists(own.data()), whole.exists(own.data()));
    }
    return;
  }
  Numbers shown[2];
  for (int l = 0; l < 2; ++l) {
    shown[l].assign(static_cast<std::size_t>(Q) * s.observed * kLanes, 0.0);
    laws[l]->observe({Q, lanes, data.data(), results[l].memory.data()}, in.data(), shown[l].data());
  }
  for (std::size_t i = 0; i < shown[0].size(); ++i) {
    if (static_cast<int>(i % kLanes) >= lanes) continue;
    const double a = shown[0][i], b = shown[1][i];
    if (std::isinf(b))
      EXPECT_EQ(a, b);
    else
      EXPECT_NEAR(a, b, 1e-12 * (1 + std::abs(b)));
  }
}

constexpr double Delta = 0.7, loadFactor = 0.3;
inline const RegularisedPressure regularised{0.01, 0.002};

/// All four laws at points with these places, in stages and whole. `toolData`: of the points, where it has
/// any.
template <class Tool>
void compareAll(const ToolStages& stages, const Tool& tool, const std::vector<Vector3>& places,
                const std::vector<std::array<double, 3>>& toolData) {
  constexpr int toolInputs = contact::detail::PlaceInputs<Tool>::value;
  constexpr int D = contact::detail::ToolData<Tool>::value;
  const auto dataBehind = [&](const std::vector<double>& before) {
    const int count = static_cast<int>(before.size());
    return numbers(count + D, [&](int p, int m) { return m < count ? before[m] : toolData[p][m - count]; });
  };
  const auto x = [&](int p, int m) { return m < 3 ? places[p][m] : loadFactor; };

  const ContactLaw<Tool, AnyPressure> contact{tool, AnyPressure(regularised)};
  compare(*stagedContact(stages, AnyPressure(regularised)), *fem::pointLaw(contact), numbers(toolInputs, x),
          dataBehind({Delta}), 1);
  const SharpenedContact<Tool> sharpened{tool, {regularised.compliance, regularised.eta}, loadFactor};
  compare(*stagedSharpenedContact(stages, regularised, loadFactor), *fem::pointLaw(sharpened),
          numbers(4, [&](int p, int m) { return m < 3 ? places[p][m] : 0.4; }), dataBehind({Delta}), 2);
  compare(
      *stagedHardContact(stages), *fem::pointLaw(HardContactLaw<Tool>{tool}),
      numbers(toolInputs + 1, [&](int p, int m) { return m < 3    ? places[p][m]
                                                         : m == 3 ? 0.2
                                                                  : loadFactor; }),
      dataBehind({}), 3);
  compare(
      *stagedCurveContact(stages, regularised), *fem::pointLaw(CurveContactLaw<Tool>{tool, regularised}),
      numbers(toolInputs + 1, [&](int p, int m) { return m < 3    ? places[p][m]
                                                         : m == 3 ? 0.5
                                                                  : loadFactor; }),
      dataBehind({Delta}), 4);
}

inline Motion someMotion(Random& random, bool turns) {
  Motion motion;
  const Vector3 a = random.direction();
  for (int i = 0; i < 3; ++i) {
    motion.pivot[i] = random.between(-1, 1);
    motion.axis[i] = a[i];
    for (int k = 0; k <= 3; ++k) motion.shift[k][i] = random.between(-0.1, 0.1);
  }
  for (int k = 0; k <= 3 && turns; ++k) motion.angle[k] = random.between(-0.1, 0.1);
  return motion;
}

/// Places about a cylinder, at distances up to half of its radius.
inline std::vector<Vector3> placesAbout(const Cylinder& cylinder, Random& random) {
  const auto [e, f] = normalsTo(vector(cylinder.axis));
  std::vector<Vector3> places;
  for (int p = 0; p < Q * lanes; ++p) {
    const double angle = random.between(0, 6), r = cylinder.radius * random.between(0.9, 1.5);
    places.push_back(sum(sum(sum(vector(cylinder.center), r * std::cos(angle), e), r * std::sin(angle), f),
                         random.between(-0.5, 0.5), vector(cylinder.axis)));
  }
  return places;
}

}  // namespace atrapos::contact::test
