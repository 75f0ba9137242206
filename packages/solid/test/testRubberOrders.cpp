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

/// X with X X = C, order by order: X_0 X_k + X_k X_0 = C_k - ..., six linear equations with the same matrix.
Series9 squareRoot(const Series9& C) {
  using Matrix = std::array<Real, 9>;
  const auto times = [](const Matrix& A, const Matrix& B) {
    Matrix R{};
    for (int i = 0; i < 9; ++i)
      for (int k = 0; k < 3; ++k) R[i] += A[i / 3 * 3 + k] * B[3 * k + i % 3];
    return R;
  };
  // Dense elimination of the nine equations A Y + Y A = B.
  const auto solve = [](const Matrix& A, const Matrix& B) {
    std::array<std::array<Real, 10>, 9> rows{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        for (int k = 0; k < 3; ++k) {
          rows[3 * i + j][3 * k + j] += A[3 * i + k];
          rows[3 * i + j][3 * i + k] += A[3 * k + j];
        }
        rows[3 * i + j][9] = B[3 * i + j];
      }
    for (int p = 0; p < 9; ++p)
      for (int r = 0; r < 9; ++r) {
        if (r == p) continue;
        const Real factor = rows[r][p] / rows[p][p];  // positive definite: no pivoting
        for (int c = 0; c < 10; ++c) rows[r][c] -= factor * rows[p][c];
      }
    Matrix Y;
    for (int i = 0; i < 9; ++i) Y[i] = rows[i][9] / rows[i][i];
    return Y;
  };
  const std::size_t n = C[0].c.size();
  std::vector<Matrix> X(n);
  const auto coefficient = [&](std::size_t k) {
    Matrix m;
    for (int i = 0; i < 9; ++i) m[i] = C[i].at(k);
    return m;
  };
  X[0] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (int newton = 0; newton < 12; ++newton) {
    Matrix defect = coefficient(0);
    const Matrix square = times(X[0], X[0]);
    for (int i = 0; i < 9; ++i) defect[i] -= square[i];
    const Matrix step = solve(X[0], defect);
    for (int i = 0; i < 9; ++i) X[0][i] += step[i];
  }
  for (std::size_t k = 1; k < n; ++k) {
    Matrix right = coefficient(k);
    for (std::size_t i = 1; i < k; ++i) {
      const Matrix known = times(X[i], X[k - i]);
      for (int j = 0; j < 9; ++j) right[j] -= known[j];
    }
    X[k] = solve(X[0], right);
  }
  Series9 result;
  for (int i = 0; i < 9; ++i) {
    result[i].c.resize(n);
    for (std::size_t k = 0; k < n; ++k) result[i].c[k] = X[k][i];
  }
  return result;
}

/// Odd powers of U = sqrt(C): S = sum of mu J^(-alpha/3) (U^(alpha-2) - tr(U^alpha)/3 C^-1), and the volume.
void seriesStress(const Ogden& m, const SeriesState& s, LongSeries* P) {
  const Series9 U = squareRoot(s.C);
  const auto power = [&](int alpha) {
    Series9 R = U;
    for (int n = 1; n < alpha; n += 2) R = product(R, s.C);
    for (int n = 1; n > alpha; n -= 2) R = product(R, s.inverse);
    return R;
  };
  const LongSeries logarithm = log(s.det), three(3.0);
  Series9 S;
  for (int i = 0; i < 9; ++i) S[i] = (0.5 * m.bulk) * ((s.det - LongSeries(1.0)) * s.inverse[i]);
  for (int p = 0; p < m.numTerms; ++p) {
    const int alpha = static_cast<int>(m.terms[p].alpha);
    const LongSeries factor = m.terms[p].mu * exp(-(alpha / 2.0) * (logarithm / three));
    const Series9 above = power(alpha), below = power(alpha - 2);
    const LongSeries mean = (above[0] + above[4] + above[8]) / three;
    for (int i = 0; i < 9; ++i) S[i] = S[i] + factor * (below[i] - mean * s.inverse[i]);
  }
  const Series9 result = product(s.F, S);
  for (int i = 0; i < 9; ++i) P[i] = result[i];
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
                         : std::is_same_v<TypeParam, Ogden>        ? Costs{182, 130, 223}
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

// Principal stretches that are equal at the start and part in different orders, others that meet later: with
// fixed axes each is a series of its own, and the stresses are those of l^alpha = exp(alpha log l).
TEST(OgdenOrders, EqualStretches) {
  const Ogden law = Ogden::fromModuli({6.3, 0.012, -0.1}, {1.3, 5, -2}, 10);
  const double orders[3][4] = {{1.4, 0.3, -0.2, 0.1}, {1.4, 0.3, -0.2, -0.15}, {1.4, -0.2, 0.05, 0.1}};
  constexpr int K = 20;
  Coefficients H(9, Coefficients::value_type(K + 1, Values(0.0)));
  LongSeries l[3];
  for (int i = 0; i < 3; ++i) {
    l[i].c.assign(K + 1, 0);
    for (int k = 0; k < 4; ++k) {
      H[4 * i][k] = Values(orders[i][k] - (k == 0));
      l[i].c[k] = Real(H[4 * i][k][0]) + (k == 0);
    }
  }
  const LongSeries J = l[0] * l[1] * l[2], r = log(J) / LongSeries(3.0);
  LongSeries tau[3], mean(0.0);
  for (int i = 0; i < 3; ++i) {
    tau[i] = LongSeries(0.0);
    for (int p = 0; p < law.numTerms; ++p)
      tau[i] = tau[i] + law.terms[p].mu * exp(law.terms[p].alpha * (log(l[i]) - r));
    mean = mean + tau[i] / LongSeries(3.0);
  }
  const auto result = runSeries(law, H, Mode::AsASolver);
  LongSeries P[3];
  for (int i = 0; i < 3; ++i) P[i] = (tau[i] - mean + (law.bulk / 2) * (J * J - LongSeries(1.0))) / l[i];
  for (int k = 0; k <= K; ++k) {
    double scale = 0;  // as above
    for (const LongSeries& p : P) scale = std::max(scale, roundingScale([&](int n) { return p.at(n); }, k));
    for (int i = 0; i < 3; ++i)
      ASSERT_NEAR(result.out[4 * i][k][0], static_cast<double>(P[i].at(k)), 1e-13 * scale)
          << "stretch " << i << ", order " << k;
  }
}
