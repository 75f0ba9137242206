// Laws of metals in shells in stages beside the same laws written as one template each: values, tangents,
// orders to 20, internal variables along a path and away from it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "MetalPath.hpp"
#include "WholeMetal.hpp"
#include "atrapos/fem/PointLawOf.hpp"
#include "atrapos/solid/ShellTerms.hpp"
#include "support/Meshes.hpp"
#include "support/Vectors.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::solid::test;
using fem::kLanes;
using fem::test::Numbers;
using fem::test::randomNumbers;

namespace {

constexpr int Q = 2, lanes = 5, K = 20;

struct Points {
  Numbers in, to, data;  ///< [point][entry][lane]
};

/// Entries [point][entry][lane] of a random perturbation of one point's.
Numbers about(const Numbers& point, double size, unsigned seed) {
  const std::size_t count = point.size();
  Numbers all = randomNumbers(Q * count * kLanes, size, seed);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] += point[i / kLanes % count];
  return all;
}

/// Both solve the same equations to rounding, whose errors grow with the order like the coefficients
/// themselves: 1e-11 of the largest is some hundred operations' worth.
void expectSame(const Numbers& a, const Numbers& b, const std::string& what) {
  double size = 1e-300, difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (static_cast<int>(i % kLanes) >= lanes) continue;
    ASSERT_FALSE(std::isnan(a[i] - b[i])) << what;
    size = std::max(size, std::abs(b[i]));
    difference = std::max(difference, std::abs(a[i] - b[i]));
  }
  EXPECT_LE(difference, 1e-11 * size) << what;
}

/// What a law says at points; of each order what is known of it, then the rest.
std::vector<Numbers> everything(const fem::PointLaw& law, const Points& points) {
  const fem::LawShape s = law.shape();
  const std::size_t size = static_cast<std::size_t>(Q) * s.outputs * kLanes;
  Numbers out(size), rest(size), jacobian(size * s.inputs), column(size),
      memory(std::max(law.historyDoubles(0), Q * law.historyDoubles(K)));
  const fem::PointBatch batch{Q, lanes, points.data.data(), memory.data()};
  law.tangent(batch, points.in.data(), out.data(), jacobian.data());
  law.derivative(batch, 1, points.in.data(), out.data(), column.data());
  law.value(batch, points.in.data(), out.data());
  std::vector<Numbers> results{out, jacobian, column};
  fem::PointFailure failure;
  law.start(batch, fem::seriesOrder(0, K), points.in.data(), out.data(), failure);
  results.push_back(out);
  EXPECT_EQ(failure.lane, -1);
  for (int k = 1; k <= K; ++k) {
    const Numbers last = randomNumbers(static_cast<std::size_t>(Q) * s.inputs * kLanes,
                                       1e-3 * std::pow(0.5, k), static_cast<unsigned>(k));
    law.advance(batch, fem::seriesOrder(k, K), {last.data(), nullptr}, {rest.data(), out.data()});
    if (s.variables > 0 && k > 1) results.push_back(rest);
    results.push_back(out);
  }
  if (s.variables > 0) {  // the rest of the highest order alone
    fem::SeriesOrder behind = fem::seriesOrder(K, K);
    behind.k = K + 1;
    const Numbers last = randomNumbers(static_cast<std::size_t>(Q) * s.inputs * kLanes, 1e-9, 99);
    law.advance(batch, behind, {last.data(), nullptr}, {rest.data(), nullptr});
    results.push_back(rest);
  }
  return results;
}

void compare(const fem::PointLaw& staged, const fem::PointLaw& whole, const Points& points) {
  const fem::LawShape a = staged.shape(), b = whole.shape();
  ASSERT_EQ(a.inputs, b.inputs);
  ASSERT_EQ(a.outputs, b.outputs);
  ASSERT_EQ(a.data, b.data);
  EXPECT_EQ(a.symmetric, b.symmetric);
  EXPECT_EQ(a.variables, b.variables);
  EXPECT_EQ(a.events, b.events);
  const std::vector<Numbers> first = everything(staged, points), second = everything(whole, points);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) expectSame(first[i], second[i], std::to_string(i));
}

/// How far apart the variables are that the two laws carry along a share of the way.
double carriedApart(const fem::PointLaw& staged, const fem::PointLaw& whole, const Points& points,
                    double share) {
  Numbers to = points.in, variables[2];
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += share * (points.to[i] - points.in[i]);
  for (int l = 0; l < 2; ++l) {
    const fem::PointLaw& law = l == 0 ? staged : whole;
    variables[l].resize(static_cast<std::size_t>(Q) * law.shape().variables * kLanes);
    Numbers memory(law.historyDoubles(0));
    fem::PointFailure failure;
    law.carry({Q, lanes, points.data.data(), memory.data()}, points.in.data(), to.data(), variables[l].data(),
              failure);
    EXPECT_EQ(failure.lane, -1);
  }
  double apart = 0;
  for (std::size_t i = 0; i < variables[0].size(); ++i)
    if (static_cast<int>(i % kLanes) < lanes)
      apart = std::max(apart, std::abs(variables[0][i] - variables[1][i]));
  return apart;
}

/// The same law; but stages carry variables along lines of strains, which lines of displacements are but for
/// their squares.
void compareMetals(const fem::PointLaw& staged, const fem::PointLaw& whole, const Points& points) {
  compare(staged, whole, points);
  const double coarse = carriedApart(staged, whole, points, 1),
               fine = carriedApart(staged, whole, points, 0.5);
  EXPECT_GT(coarse, 0);
  EXPECT_GT(std::log2(coarse / fine), 1.8);
}

/// Vectors of an element near those of a flat one of size 1 and half a thickness 0.1, its place's numbers,
/// and the base of Cartesian axes.
template <class Element>
Numbers restOf() {
  Numbers data(TiedShell<Element>::numData, 0.0);
  for (int v = 0; v < Element::vectors; ++v) {
    const int axis = v < 2 ? v : 2;
    data[axis * Element::vectors + v] = axis == 2 ? 0.1 : 1;
  }
  const int first = TiedShell<Element>::numInputs, base = TiedShell<Element>::firstBase;
  for (int d = first; d < base; ++d) data[d] = 0.3 + 0.01 * (d - first);
  for (int i = 0; i < 3; ++i) data[base + 4 * i] = i == 2 ? 10 : 1;
  return data;
}

/// Points that yield and points that do not.
Points metalPoints(const Numbers& rest, int inputs, int numVariables) {
  Numbers point{0};
  point.insert(point.end(), rest.begin(), rest.end());
  const Numbers variables{0.003, 0.0012, -0.0017, 0.0005, 0.0004, 0, 0, 0, 10, -15, 5, 6, 0, 0};
  point.insert(point.end(), variables.begin(), variables.begin() + numVariables);
  Points points;
  points.data = about(point, 1e-5, 3);
  for (int q = 0; q < Q; ++q)
    for (int lane = 0; lane < kLanes; ++lane) points.data[q * point.size() * kLanes + lane] = (q + lane) % 2;
  points.in = randomNumbers(static_cast<std::size_t>(Q) * inputs * kLanes, 1e-3, 5);
  points.to = randomNumbers(points.in.size(), 1e-3, 6);
  return points;
}

const Metal hardening = metal(300, 60, 150, 30e3, 250);

}  // namespace

TEST(ShellStages, MetalWithStrainsOfDisplacements) {
  const Numbers axes{0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1};
  const Points points = metalPoints(axes, PlainShell::numInputs, 13);
  const auto staged = shellMetalLaw(hardening, ShellStrains::compatible, 8);
  const fem::PointLawOf<WholeMetal<PlainShell>> whole({hardening});
  compareMetals(*staged, whole, points);
}

TEST(ShellStages, MetalWithTiedStrains) {
  Metal isotropic = hardening;
  isotropic.kinematicModulus = 0;
  compareMetals(*shellMetalLaw(isotropic, ShellStrains::compatible, 3),
                fem::PointLawOf<WholeMetal<TiedShell<Mitc3>, false>>({isotropic}),
                metalPoints(restOf<Mitc3>(), TiedShell<Mitc3>::numInputs, 7));
}
