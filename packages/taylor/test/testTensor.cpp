// Tensor operations: each against plain loops over long double series, with Fad and double beside it; which
// entries get a history and how often.

#include "atrapos/taylor/Tensor.hpp"

#include "OperationChecks.hpp"

using namespace atrapos::taylor;

namespace {

constexpr double g[3] = {0.6, -0.3, 1.1};

/// f(A, B, S, s, out) of two matrices, a symmetric tensor and a number.
template <class F, int N>
struct TensorLaw {
  static constexpr int numInputs = 25, numOutputs = N, numData = 0;
  F f;
  template <class T>
  void operator()(const T* in, const Passive<T>*, T* out) const {
    f(Matrix3<T>(in), Matrix3<T>(in + 9), Symmetric3<T>(in + 18), in[24], out);
  }
};

using Square = LongSeries[3][3];

/// Orders 0..20 of f in every entry against `loops`, plain loops over full matrices.
template <int N, class F, class Loops>
void checkTensor(F f, const Loops& loops, const std::string& what) {
  constexpr int order = 20;
  Coefficients in;
  for (int j = 0; j < 25; ++j)
    in.push_back(testSeries(order, 0.9 * std::cos(2.0 * j), 0.9 * std::sin(3.0 * j + 1), j + 1));
  const TensorLaw<F, N> law{f};
  for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
    const auto r = runSeries(law, in, mode);
    for (int l = 0; l < L; ++l) {
      Square A, B, S;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          A[i][j] = lane(in[3 * i + j], l);
          B[i][j] = lane(in[9 + 3 * i + j], l);
          S[i][j] = lane(in[18 + symmetricIndex(i, j)], l);
        }
      LongSeries expected[N];
      loops(A, B, S, lane(in[24], l), expected);
      for (int m = 0; m < N; ++m)
        for (int k = 0; k <= order; ++k)
          // Sums of up to 9 (k + 1) terms of size 2^-k, each rounded by half a unit in the last place; twice
          // in a determinant.
          ASSERT_NEAR(r.out[m][k][l], static_cast<double>(expected[m].at(k)),
                      10 * 2.2e-16 * (k + 1) * std::pow(decay, k))
              << what << " entry " << m << ", order " << k << ", lane " << l;
    }
  }
  // The value and the derivative along the series' direction, from the same source.
  double x[25], values[N], fad[N], jacobian[25 * N];
  for (int j = 0; j < 25; ++j) x[j] = in[j][0][L - 1];
  const auto r = runSeries(law, in, Mode::Direct);
  value(law, x, nullptr, values);
  tangent(law, x, nullptr, fad, jacobian);
  for (int m = 0; m < N; ++m) {
    double derivative = 0;
    for (int j = 0; j < 25; ++j) derivative += jacobian[25 * m + j] * in[j][1][L - 1];
    EXPECT_NEAR(values[m], r.out[m][0][L - 1], 1e-14) << what;  // some ten terms of size 1
    EXPECT_NEAR(fad[m], r.out[m][0][L - 1], 1e-14) << what;
    EXPECT_NEAR(derivative, r.out[m][1][L - 1], 1e-14) << what;
  }
}

LongSeries cofactorOf(const Square& A, int i, int j) {
  const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
  return A[i1][j1] * A[i2][j2] - A[i1][j2] * A[i2][j1];
}
LongSeries determinantOf(const Square& A) {
  return A[0][0] * (A[1][1] * A[2][2] - A[1][2] * A[2][1]) -
         A[0][1] * (A[1][0] * A[2][2] - A[1][2] * A[2][0]) +
         A[0][2] * (A[1][0] * A[2][1] - A[1][1] * A[2][0]);
}
// A tensor's entries from a formula in (i, j).
template <class F>
void fill9(LongSeries* out, F entry) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out[3 * i + j] = entry(i, j);
}
template <class F>
void fill6(LongSeries* out, F entry) {
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) out[symmetricIndex(i, j)] = entry(i, j);
}
LongSeries dot(const Square& A, const Square& B, int i, int j) {
  return A[i][0] * B[0][j] + A[i][1] * B[1][j] + A[i][2] * B[2][j];
}

TEST(Tensor, gramian) {
  checkTensor<6>(
      [](auto A, auto, auto, auto, auto* out) { gramian(A).store(out); },
      [](auto& A, auto&, auto&, auto, auto* out) {
        fill6(out, [&](int i, int j) { return A[0][i] * A[0][j] + A[1][i] * A[1][j] + A[2][i] * A[2][j]; });
      },
      "gramian");
}

TEST(Tensor, products) {
  checkTensor<9>([](auto A, auto B, auto, auto, auto* out) { (A * B).store(out); },
                 [](auto& A, auto& B, auto&, auto, auto* out) {
                   fill9(out, [&](int i, int j) { return dot(A, B, i, j); });
                 },
                 "A B");
  checkTensor<9>([](auto A, auto, auto, auto, auto* out) { (A * A).store(out); },
                 [](auto& A, auto&, auto&, auto, auto* out) {
                   fill9(out, [&](int i, int j) { return dot(A, A, i, j); });
                 },
                 "A A");
  checkTensor<9>([](auto A, auto, auto S, auto, auto* out) { (A * S).store(out); },
                 [](auto& A, auto&, auto& S, auto, auto* out) {
                   fill9(out, [&](int i, int j) { return dot(A, S, i, j); });
                 },
                 "A S");
  checkTensor<9>(
      [](auto A, auto, auto, auto s, auto* out) { scaled(A, s).store(out); },
      [](auto& A, auto&, auto&, auto s, auto* out) { fill9(out, [&](int i, int j) { return A[i][j] * s; }); },
      "A s");
  checkTensor<1>([](auto A, auto, auto S, auto, auto* out) { out[0] = contraction(S, symmetricPart(A)); },
                 [](auto& A, auto&, auto& S, auto, auto* out) {
                   out[0] = LongSeries(0.0);
                   for (int i = 0; i < 3; ++i)
                     for (int j = 0; j < 3; ++j) out[0] += S[i][j] * A[i][j];
                 },
                 "A : S");
}

TEST(Tensor, cofactorsAndDeterminants) {
  checkTensor<10>(
      [](auto A, auto, auto, auto, auto* out) {
        const auto cof = cofactor(A);
        cof.store(out);
        out[9] = determinant(A, cof);
      },
      [](auto& A, auto&, auto&, auto, auto* out) {
        fill9(out, [&](int i, int j) { return cofactorOf(A, i, j); });
        out[9] = determinantOf(A);
      },
      "cofactor");
  checkTensor<7>(
      [](auto, auto, auto S, auto, auto* out) {
        const auto cof = cofactor(S);
        cof.store(out);
        out[6] = determinant(S, cof);
      },
      [](auto&, auto&, auto& S, auto, auto* out) {
        fill6(out, [&](int i, int j) { return cofactorOf(S, i, j); });
        out[6] = determinantOf(S);
      },
      "symmetric cofactor");
}

TEST(Tensor, linearOperations) {
  checkTensor<9>([](auto A, auto B, auto, auto, auto* out) { (A + 2.0 * B - 0.5 * A).store(out); },
                 [](auto& A, auto& B, auto&, auto, auto* out) {
                   fill9(out, [&](int i, int j) { return A[i][j] + 2.0 * B[i][j] - 0.5 * A[i][j]; });
                 },
                 "sums");
  checkTensor<9>(
      [](auto A, auto B, auto, auto, auto* out) {
        const decltype(A(0, 0)) t = trace(B);
        plusIdentity(transpose(A), t).store(out);
      },
      [](auto& A, auto& B, auto&, auto, auto* out) {
        fill9(out, [&](int i, int j) {
          return A[j][i] + (i == j ? B[0][0] + B[1][1] + B[2][2] : LongSeries(0.0));
        });
      },
      "transpose, trace and identity of a matrix");
  checkTensor<6>(
      [](auto A, auto, auto S, auto s, auto* out) { plusIdentity(S + symmetricPart(A), s).store(out); },
      [](auto& A, auto&, auto& S, auto s, auto* out) {
        fill6(out, [&](int i, int j) {
          return S[i][j] + 0.5 * (A[i][j] + A[j][i]) + (i == j ? s : LongSeries(0.0));
        });
      },
      "symmetric sums");
  checkTensor<11>(
      [](auto A, auto, auto S, auto s, auto* out) {
        full(S).store(out);
        out[9] = trace(S) * s;
        out[10] = A(1, 2) * S(2, 0);
      },
      [](auto& A, auto&, auto& S, auto s, auto* out) {
        fill9(out, [&](int i, int j) { return S[i][j]; });
        out[9] = (S[0][0] + S[1][1] + S[2][2]) * s;
        out[10] = A[1][2] * S[2][0];
      },
      "full, trace, entries");
  checkTensor<7>(
      [](auto, auto, auto S, auto s, auto* out) {
        using T = std::decay_t<decltype(s)>;
        const Passive<T> v[3] = {g[0], g[1], g[2]};
        plusDyad(S, s, v).store(out);
        out[6] = atrapos::taylor::projection(S, v);
      },
      [](auto&, auto&, auto& S, auto s, auto* out) {
        fill6(out, [&](int i, int j) { return S[i][j] + g[i] * (g[j] * s); });
        out[6] = LongSeries(0.0);
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) out[6] += g[i] * (g[j] * S[i][j]);
      },
      "dyad and projection");
}

// Entries whose histories lie apart, that are passive, that are results or are written over.
TEST(Tensor, mixedEntries) {
  checkTensor<15>(
      [](auto A, auto, auto, auto s, auto* out) {
        using T = std::decay_t<decltype(s)>;
        T e[9];
        for (int m = 0; m < 9; ++m) e[m] = A(m / 3, (2 * m) % 3);  // inputs, but not in their order
        e[3] = T(1.5);
        e[5] = s * s;
        e[7] = T(0.0);
        const Matrix3<T> M(e);
        (M * A).store(out);
        gramian(M).store(out + 9);
      },
      [](auto& A, auto&, auto&, auto s, auto* out) {
        Square M;
        for (int m = 0; m < 9; ++m) M[m / 3][m % 3] = A[m / 3][(2 * m) % 3];
        M[1][0] = LongSeries(1.5);
        M[1][2] = s * s;
        M[2][1] = LongSeries(0.0);
        fill9(out, [&](int i, int j) { return dot(M, A, i, j); });
        fill6(out + 9,
              [&](int i, int j) { return M[0][i] * M[0][j] + M[1][i] * M[1][j] + M[2][i] * M[2][j]; });
      },
      "mixed");
  checkTensor<9>(
      [](auto A, auto, auto S, auto s, auto* out) {
        using T = std::decay_t<decltype(s)>;
        auto M = A;
        M.set(0, 2, s);
        const auto first = M * S;
        M.set(1, 1, M(1, 1) + 1.0);
        M.set(2, 0, T(2.0));
        (first + M * S).store(out);
      },
      [](auto& A, auto&, auto& S, auto s, auto* out) {
        Square M, N;
        for (int m = 0; m < 9; ++m) N[m / 3][m % 3] = M[m / 3][m % 3] = A[m / 3][m % 3];
        M[0][2] = N[0][2] = s;
        N[1][1] = N[1][1] + 1.0;
        N[2][0] = LongSeries(2.0);
        fill9(out, [&](int i, int j) { return dot(M, S, i, j) + dot(N, S, i, j); });
      },
      "written over");
}

TEST(Tensor, passiveTensors) {
  checkTensor<18>(
      [](auto A, auto, auto, auto s, auto* out) {
        using T = std::decay_t<decltype(s)>;
        T e[9];
        for (int m = 0; m < 9; ++m) e[m] = T(0.5 * m - 1.0);
        const Matrix3<T> P(e);
        (P * P + A + P).store(out);  // constants count at order 0 alone
        (P * A - A * P).store(out + 9);
      },
      [](auto& A, auto&, auto&, auto, auto* out) {
        Square P;
        for (int m = 0; m < 9; ++m) P[m / 3][m % 3] = LongSeries(0.5 * m - 1.0);
        fill9(out, [&](int i, int j) { return dot(P, P, i, j) + A[i][j] + P[i][j]; });
        fill9(out + 9, [&](int i, int j) { return dot(P, A, i, j) - dot(A, P, i, j); });
      },
      "passive");
}

/// Slots that f takes besides the inputs'.
template <int N, class F>
int slotsOf(F f) {
  return historyShape(TensorLaw<F, N>{f}).slots - 25;
}

TEST(TensorSlots, inputsServeAsTheyAre) {
  EXPECT_EQ(slotsOf<6>([](auto A, auto, auto, auto, auto* out) { gramian(A).store(out); }), 0);
  EXPECT_EQ(slotsOf<9>([](auto A, auto B, auto S, auto s, auto* out) {
              (A * B + A * S + scaled(A, s) + cofactor(A)).store(out);
            }),
            0);
}

TEST(TensorSlots, aTensorInSeveralProductsIsKeptOnce) {
  EXPECT_EQ(slotsOf<9>([](auto A, auto B, auto S, auto, auto* out) {
              const auto M = A + B;
              (M * A + B * M + M * S + cofactor(M)).store(out);
            }),
            9);
  EXPECT_EQ(slotsOf<9>([](auto A, auto, auto S, auto s, auto* out) {  // passive entries do not change that
              using T = std::decay_t<decltype(s)>;
              auto M = A + A;
              M.set(1, 2, T(0.0));
              (M * A + M * S).store(out);
            }),
            9);
}

TEST(TensorSlots, linearOperationsTakeNone) {
  EXPECT_EQ(slotsOf<9>([](auto A, auto B, auto S, auto s, auto* out) {
              const decltype(s) sum = s + trace(S);
              (full(plusIdentity(S + symmetricPart(A), sum)) - 3.0 * B).store(out);
            }),
            0);
}

TEST(TensorSlots, saintVenantKirchhoff) {
  // T = (I + H) S: histories of H and S alone, 15 slots.
  const auto law = [](auto H, auto, auto, auto s, auto* out) {
    const auto E = symmetricPart(H) + 0.5 * gramian(H);
    const decltype(s) spherical = 1.3 * trace(E);
    const auto S = plusIdentity(1.4 * E, spherical);
    (full(S) + H * S).store(out);
  };
  EXPECT_EQ(slotsOf<9>(law), 6);  // H is an input
  checkTensor<9>(
      law,
      [](auto& H, auto&, auto&, auto, auto* out) {
        Square E, S;
        for (int m = 0; m < 9; ++m) {
          const int i = m / 3, j = m % 3;
          E[i][j] = 0.5 * (H[i][j] + H[j][i]);
          for (int k = 0; k < 3; ++k) E[i][j] += 0.5 * (H[k][i] * H[k][j]);
        }
        for (int m = 0; m < 9; ++m) {
          const int i = m / 3, j = m % 3;
          S[i][j] = 1.4 * E[i][j];
          if (i == j) S[i][j] += 1.3 * (E[0][0] + E[1][1] + E[2][2]);
        }
        fill9(out, [&](int i, int j) { return S[i][j] + dot(H, S, i, j); });
      },
      "Saint Venant-Kirchhoff");
}

}  // namespace
