// The laws of rubber as series: orders, costs, where there is no series.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "RubberLaws.hpp"
#include "SeriesRun.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::solid::test;

namespace {

// The stresses again, of series: S of C by textbook formulas, C^-1 by division, P = F S.

using Series9 = std::array<LongSeries, 9>;

Series9 product(const Series9& A, const Series9& B) {
  Series9 C;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      C[3 * i + j] = A[3 * i] * B[j] + A[3 * i + 1] * B[3 + j] + A[3 * i + 2] * B[6 + j];
  return C;
}

struct SeriesState {
  Series9 F, C, inverse;
  LongSeries trace, second, det;  ///< of C

  explicit SeriesState(const LongSeries* H) {
    for (int i = 0; i < 9; ++i) F[i] = i % 4 == 0 ? 1.0 + H[i] : H[i];
    Series9 transposed;
    for (int i = 0; i < 9; ++i) transposed[i] = F[3 * (i % 3) + i / 3];
    C = product(transposed, F);
    const auto minor = [&](int i, int j) {
      const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
      return C[3 * a + c] * C[3 * b + d] - C[3 * a + d] * C[3 * b + c];
    };
    det = C[0] * minor(0, 0) + C[1] * minor(0, 1) + C[2] * minor(0, 2);
    for (int i = 0; i < 9; ++i) inverse[i] = minor(i / 3, i % 3) / det;
    trace = C[0] + C[4] + C[8];
    const Series9 CC = product(C, C);
    second = 0.5 * (trace * trace - (CC[0] + CC[4] + CC[8]));
  }

  /// P of S = a I + b C + c C^-1
  void stress(const LongSeries& a, const LongSeries& b, const LongSeries& c, LongSeries* P) const {
    Series9 S;
    for (int i = 0; i < 9; ++i) {
      S[i] = b * C[i] + c * inverse[i];
      if (i % 4 == 0) S[i] = S[i] + a;
    }
    const Series9 result = product(F, S);
    for (int i = 0; i < 9; ++i) P[i] = result[i];
  }
};

void seriesStress(const NeoHookean& m, const SeriesState& s, LongSeries* P) {
  s.stress(LongSeries(m.mu), LongSeries(0.0), (0.5 * m.lambda) * log(s.det) - m.mu * LongSeries(1.0), P);
}
/// Isochoric slopes and the common volumetric part.
void splitStress(const LongSeries& first, const LongSeries& second, double bulk, const SeriesState& s,
                 LongSeries* P) {
  const LongSeries logarithm = log(s.det), three(3.0);
  const LongSeries a = exp(-(logarithm / three)), b = a * a;
  s.stress(2.0 * (first * a + second * b * s.trace), -(2.0 * (second * b)),
           (0.5 * bulk) * (s.det - LongSeries(1.0)) -
               (2.0 * (first * a * s.trace) + 4.0 * (second * b * s.second)) / three,
           P);
}
LongSeries reducedFirst(const SeriesState& s) {
  return exp(-(log(s.det) / LongSeries(3.0))) * s.trace - LongSeries(3.0);
}
void seriesStress(const MooneyRivlin& m, const SeriesState& s, LongSeries* P) {
  splitStress(LongSeries(m.c1), LongSeries(m.c2), m.bulk, s, P);
}
void seriesStress(const Yeoh& m, const SeriesState& s, LongSeries* P) {
  const LongSeries x = reducedFirst(s);
  splitStress(m.c1 + 2 * m.c2 * x + 3 * m.c3 * (x * x), LongSeries(0.0), m.bulk, s, P);
}
void seriesStress(const Gent& m, const SeriesState& s, LongSeries* P) {
  splitStress((m.mu / 2 * m.limit) / (m.limit - reducedFirst(s)), LongSeries(0.0), m.bulk, s, P);
}

/// Counts products of two varying quantities and functions of one: what costs a convolution in a Taylor
/// sweep.
struct Counting {
  bool varies = false;
  static int products;
  Counting() = default;
  Counting(double) {}
  explicit Counting(bool v) : varies(v) {}
};
int Counting::products = 0;
Counting operator+(Counting a, Counting b) { return Counting(a.varies || b.varies); }
Counting operator-(Counting a, Counting b) { return a + b; }
Counting operator-(Counting a) { return a; }
Counting operator*(Counting a, Counting b) {
  if (a.varies && b.varies) ++Counting::products;
  return a + b;
}
Counting function(Counting a) {
  ++Counting::products;
  return a;
}
Counting operator/(Counting a, Counting b) { return function(a + b); }
Counting pow(Counting a, double) { return function(a); }
Counting log1p(Counting a) { return function(a); }
Counting exp(Counting a) { return function(a); }
Counting& operator+=(Counting& a, Counting b) { return a = a + b; }
Counting& operator-=(Counting& a, Counting b) { return a = a + b; }

template <class Law>
class RubberOrders : public testing::Test {};

}  // namespace

TYPED_TEST_SUITE(RubberOrders, RubberTypes);

TYPED_TEST(RubberOrders, OrdersAgainstLongSeries) {
  const TypeParam law = rubber<TypeParam>();
  Coefficients H;
  for (int i = 0; i < 9; ++i) H.push_back(testSeries(20, -0.2 + 0.02 * i, 0.25 - 0.03 * i, i + 1));
  for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
    const auto r = runSeries(law, H, mode);
    for (int l = 0; l < L; ++l) {
      std::vector<LongSeries> x(9), P(9);
      for (int j = 0; j < 9; ++j) x[j] = lane(H[j], l);
      seriesStress(law, SeriesState(x.data()), P.data());
      // Stresses of size one are sums of terms that are larger: orders grow alike in all of them, so their
      // scale is that of the largest output.
      for (int k = 0; k <= 20; ++k) {
        double scale = 0;
        for (int i = 0; i < 9; ++i)
          scale = std::max(scale, roundingScale([&](int n) { return P[i].at(n); }, k));
        for (int i = 0; i < 9; ++i)
          ASSERT_NEAR(r.out[i][k][l], static_cast<double>(P[i].at(k)), 1e-13 * scale)
              << "output " << i << ", order " << k << ", lane " << l;
      }
    }
  }
}

// What docs/theory/rubber.md says of costs: products in solids, in secondPiola, histories.
TYPED_TEST(RubberOrders, Costs) {
  const TypeParam law = rubber<TypeParam>();
  Counting H[9], P[9], E[6];
  for (auto& h : H) h.varies = true;
  for (auto& e : E) e.varies = true;
  Counting::products = 0;
  law(H, static_cast<const double*>(nullptr), P);
  const int solid = Counting::products;
  Counting::products = 0;
  law.secondPiola(taylor::Symmetric3<Counting>(E));
  const int shell = Counting::products, slots = taylor::historyShape(law).slots;
  struct Costs {
    int solid, shell, slots;
  };
  const Costs expected = std::is_same_v<TypeParam, NeoHookean>     ? Costs{32, 23, 22}
                         : std::is_same_v<TypeParam, MooneyRivlin> ? Costs{89, 37, 44}
                         : std::is_same_v<TypeParam, Yeoh>         ? Costs{58, 29, 33}
                                                                   : Costs{59, 30, 35};
  EXPECT_EQ(solid, expected.solid);
  EXPECT_EQ(shell, expected.shell);
  EXPECT_EQ(slots, expected.slots);
}

// A body that is turned inside out has det C > 0; it is J that has no logarithm.
TYPED_TEST(RubberOrders, NoVolumeIsADomainError) {
  const TypeParam law = rubber<TypeParam>();
  const auto failures = [&](const Numbers& H) {
    taylor::Failures<L> noted;
    taylor::Context<L> context;
    context.shape = taylor::historyShape(law);
    Numbers memory(context.shape.doubles<L>(0));
    context.memory = memory.data();
    context.failures = &noted;
    Values in[9], out[9];
    for (int i = 0; i < 9; ++i) in[i] = H[i];
    taylor::start(law, context, in, static_cast<const Values*>(nullptr), out);
    return noted;
  };
  const auto operation =
      std::is_same_v<TypeParam, NeoHookean> ? taylor::Operation::Log1p : taylor::Operation::Pow;
  EXPECT_EQ(failures(diagonal(0.7L, 1, 1)).operation[0], taylor::Operation::None);
  for (const Real s : {0.0L, -0.5L}) {
    const Numbers H = diagonal(s, 1.2L, 0.9L);
    for (int l = 0; l < L; ++l) EXPECT_EQ(failures(H).operation[l], operation);
  }
  for (const double P : stress(law, diagonal(-0.5L, 1.2L, 0.9L))) EXPECT_FALSE(std::isfinite(P));
}
