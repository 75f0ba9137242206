// The rules of expression templates: which values own a history, passive values in every position, statements
// of many products, variables written over, used twice, copied.

#include "OperationChecks.hpp"

using namespace atrapos::taylor;

namespace {

/// Slots that f takes besides those of its two inputs.
template <class F>
int slotsOf(F f) {
  return historyShape(Binary<F>{f}).slots - 2;
}
template <class F>
int constantsOf(F f) {
  return historyShape(Binary<F>{f}).constants;
}

TEST(Slots, linearOperationsTakeNone) {
  EXPECT_EQ(slotsOf([](auto a, auto b) -> decltype(a) { return 2.0 * (a - b) / 3.0 + 1.0; }), 0);
  EXPECT_EQ(slotsOf([](auto a, auto b) -> decltype(a) {
              return -a + (+b) - (a - 4.0) * Passive<decltype(a)>(2.0);
            }),
            0);
  EXPECT_EQ(slotsOf([](auto a, auto b) -> decltype(a) {
              decltype(a) c = a;
              c += b;
              c -= 1.0;
              c *= 2.0;
              c /= 3.0;
              return 2.0 - c;
            }),
            0);
}

TEST(Slots, productsAndTheirResultsTakeNoneButOperandsDo) {
  EXPECT_EQ(slotsOf([](auto a, auto b) -> decltype(a) { return a * b; }), 0);
  EXPECT_EQ(slotsOf([](auto a, auto b) -> decltype(a) { return a * b + a * a - 2.0 * b * b + a; }), 0);
  EXPECT_EQ(slotsOf([](auto a, auto b) -> decltype(a) { return a * b * b; }), 1);          // a b
  EXPECT_EQ(slotsOf([](auto a, auto b) -> decltype(a) { return (a + b) * b; }), 1);        // a + b
  EXPECT_EQ(slotsOf([](auto a, auto b) -> decltype(a) { return (a + b) * (a - b); }), 2);  // both
}

TEST(Slots, factorsOfOperandsTakeNone) {
  EXPECT_EQ(slotsOf([](auto a, auto b) -> decltype(a) { return (2.0 * a) * b; }), 0);
  EXPECT_EQ(slotsOf([](auto a, auto b) -> decltype(a) { return a * (b / 2.0); }), 0);
  EXPECT_EQ(slotsOf([](auto a, auto b) -> decltype(a) { return (-a) * (3.0 * b); }), 0);
  EXPECT_EQ(slotsOf([](auto a, auto b) -> decltype(a) { return -(2.0 * (a / 3.0)) * -b; }), 0);
  EXPECT_EQ(slotsOf([](auto a, auto b) -> decltype(a) { return (a * Passive<decltype(a)>(2.0) * 3.0) * b; }),
            0);
}

TEST(Slots, passiveOperandsTakeNone) {
  EXPECT_EQ(slotsOf([](auto a, auto b) -> decltype(a) {
              const decltype(a) c = 3.0, d = c * c + 1.0;
              return a * c + d * b + c * d + sqrt(d);
            }),
            0);
  EXPECT_EQ(slotsOf([](auto a, auto) -> decltype(a) { return decltype(a)(2.0) / decltype(a)(3.0) * a; }), 0);
}

TEST(Slots, resultsWithTheirOwnRecurrenceKeepTheirSlot) {
  EXPECT_EQ(slotsOf([](auto a, auto b) -> decltype(a) { return a / b; }), 1);
  EXPECT_EQ(slotsOf([](auto a, auto b) -> decltype(a) {
              const decltype(a) q = a / b;
              return q * q * a;
            }),
            2);  // q and q q
  EXPECT_EQ(slotsOf([](auto a, auto) -> decltype(a) { return exp(a) * sqrt(a); }), 2);
  EXPECT_EQ(slotsOf([](auto a, auto b) -> decltype(a) { return sqrt(a + b); }), 1);  // the root, not a + b
  EXPECT_EQ(slotsOf([](auto a, auto b) -> decltype(a) { return exp(a + b); }), 2);   // a + b too
  EXPECT_EQ(slotsOf([](auto a, auto) -> decltype(a) {
              decltype(a) s, c;
              sinCos(a, s, c);
              return s * c + s * a;
            }),
            2);  // sine and cosine
}

TEST(Slots, anOperandUsedTwiceTakesOne) {
  EXPECT_EQ(slotsOf([](auto a, auto b) -> decltype(a) {
              const decltype(a) c = a + b;
              return c * a + c * b + c * c;
            }),
            1);
  EXPECT_EQ(slotsOf([](auto a, auto b) -> decltype(a) {
              const decltype(a) c = a + b;
              const decltype(a) d = c * c, copy = c;
              return d + copy * a + pow(copy, 2);
            }),
            1);
}

TEST(Slots, powers) {
  EXPECT_EQ(slotsOf([](auto a, auto) -> decltype(a) { return pow(a, 0) + pow(a, 1) + pow(a, 2); }), 0);
  EXPECT_EQ(slotsOf([](auto a, auto) -> decltype(a) { return pow(a, 4); }), 1);  // a^2
  EXPECT_EQ(slotsOf([](auto a, auto) -> decltype(a) { return pow(a, 2.0); }), 0);
  EXPECT_EQ(slotsOf([](auto a, auto) -> decltype(a) { return pow(a, 2.5); }), 1);
}

TEST(Slots, choicesKeepANumberOfOrderZero) {
  const auto f = [](auto a, auto b) -> decltype(a) {
    return fabs(a) + min(a, b) + if_then_else(a < b, a, b);
  };
  EXPECT_EQ(slotsOf(f), 0);
  EXPECT_EQ(constantsOf(f), 3);
}

struct Large {  // 200 slots: more than any guess of the count
  static constexpr int numInputs = 1, numOutputs = 1, numData = 0;
  template <class T>
  void operator()(const T* in, const Passive<T>*, T* out) const {
    T x = in[0];
    for (int i = 0; i < 200; ++i) x = 0.5 * (x + in[0]) * in[0];
    out[0] = x;
  }
};

TEST(Slots, lawsOfAnySize) {
  EXPECT_EQ(historyShape(Large{}).slots, 201);
  const auto r = runSeries(Large{}, {testSeries(3, 0.5, 0.9, 1)}, Mode::AsASolver);
  for (int l = 0; l < L; ++l) EXPECT_TRUE(std::isfinite(r.out[0][3][l]));
}

TEST(Slots, layout) {
  EXPECT_EQ((HistoryShape{3, 2}.doubles<L>(20)), (3u * 21u + 2u) * L);
  const auto square = [](auto a, auto) -> decltype(a) { return fabs(a) * a; };  // one constant, one slot
  const auto a = testSeries(5, 1, 2, 1), b = testSeries(5, 3, 4, 2);
  const auto r = runSeries(Binary<decltype(square)>{square}, {a, b}, Mode::Direct);
  ASSERT_EQ(r.shape.slots, 3);
  ASSERT_EQ(r.shape.constants, 1);
  for (int l = 0; l < L; ++l) {
    EXPECT_EQ(r.memory[l], 1.0);
    for (int k = 0; k <= 5; ++k) {
      EXPECT_EQ(r.memory[(1 + 3 * k) * L + l], a[k][l]);
      EXPECT_EQ(r.memory[(2 + 3 * k) * L + l], b[k][l]);
      EXPECT_EQ(r.memory[(3 + 3 * k) * L + l], a[k][l]);
    }
  }
}

// -------------------------------------------------------------------------------------------- statements

// sum_{n=1..N} n a^? b^?: the products alternate between a a, a b and b b, the signs too.
template <int N, class T>
auto sumOfProducts(const T& a, const T& b) {
  if constexpr (N == 1)
    return a * b;
  else if constexpr (N % 3 == 0)
    return sumOfProducts<N - 1>(a, b) + static_cast<double>(N) * (a * a);
  else if constexpr (N % 3 == 1)
    return sumOfProducts<N - 1>(a, b) - b * (static_cast<double>(N) * b);
  else
    return sumOfProducts<N - 1>(a, b) + a * b / static_cast<double>(N);
}

template <int N>
struct SumOfProducts {
  static constexpr int numInputs = 2, numOutputs = 1, numData = 0;
  template <class T>
  void operator()(const T* in, const Passive<T>*, T* out) const {
    out[0] = sumOfProducts<N>(in[0], in[1]);
  }
};

template <class Law>
void checkLaw(const Law& law, const Coefficients& in, double tolerance, const std::string& what) {
  for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
    const auto r = runSeries(law, in, mode);
    for (int i = 0; i < Law::numOutputs; ++i)
      expectSeries(
          r.out[i],
          [&](int l) {
            std::vector<LongSeries> x, y(Law::numOutputs);
            for (const auto& a : in) x.push_back(lane(a, l));
            law.template operator()<LongSeries>(x.data(), nullptr, y.data());
            const LongSeries c = y[i];
            return [c](int k) { return c.at(k); };
          },
          tolerance, what + ", output " + std::to_string(i));
  }
}

template <int N>
void checkSum() {
  const Coefficients in = {testSeries(12, 0.3, 0.9, 1), testSeries(12, 1.1, 1.9, 2)};
  // The sums' terms are up to 15 times larger than they.
  checkLaw(SumOfProducts<N>{}, in, 10 * rounding, std::to_string(N) + " products");
  EXPECT_EQ(historyShape(SumOfProducts<N>{}).slots, 2);
}
template <int... N>
void checkSums(std::integer_sequence<int, N...>) {
  (checkSum<N + 1>(), ...);
}
TEST(Statements, oneToFifteenProducts) { checkSums(std::make_integer_sequence<int, 15>()); }

TEST(Statements, nested) {
  checkAgainstLongSeries(
      [](auto a, auto b) -> decltype(a) {
        return (a * b + a * a) * 0.5 - 2.0 * (b * b - a * (b - (a * b + 1.0))) +
               (a - b) * (a * a - b * b) * (a + 1.0);
      },
      "products of sums of products", {}, roundingWithCancellation);
  checkAgainstLongSeries(
      [](auto a, auto b) -> decltype(a) {
        return a * a + 3.0 * (b * b) - a * b + (a * b + b * a - a * a) * 2.0 + a * b - b * b + 0.5 * (a * b);
      },
      "ten products", {}, roundingWithCancellation);
  checkAgainstLongSeries(
      [](auto a, auto b) -> decltype(a) { return 1.0 - (a * b - (2.0 - (b - a * a))) / (1.0 + a * a); },
      "signs through brackets", {}, roundingWithCancellation);
}

// A variable that is overwritten loses its history, a copy keeps it.
struct Overwriting {
  static constexpr int numInputs = 2, numOutputs = 5, numData = 0;
  template <class T>
  void operator()(const T* in, const Passive<T>*, T* out) const {
    T t = in[0] + in[1];
    const T first = t * t;
    const T copy = t;
    t = in[0] * in[1];
    const T second = t * t;
    t = 2.0;
    out[0] = t * in[0];
    t += in[1];
    out[1] = t * t + first;
    out[2] = second * copy;
    T x = in[0];
    x = x * x + x * in[1];  // over its own operand
    x = x * x - x;
    x *= x;
    x -= x * in[0];
    out[3] = x;
    T y = in[0], z = in[1];
    for (int i = 0; i < 3; ++i) {  // each over an operand of the other
      const T last = y;
      y = y * z - 0.5 * z;
      z = last * z;
    }
    out[4] = y + z;
  }
};

TEST(Statements, overwrittenVariables) {
  // Nested sums of up to 21 rounded terms, some of which cancel.
  checkLaw(Overwriting{}, {testSeries(20, 0.5, 1, 1), testSeries(20, 1, 2, 2)}, roundingWithCancellation,
           "overwriting");
}

// Passive values (p, q: constants of the law) in every position, statements wholly passive included.
struct PassivePositions {
  static constexpr int numInputs = 2, numOutputs = 14, numData = 0;
  template <class T>
  void operator()(const T* in, const Passive<T>*, T* out) const {
    const T a = in[0], b = in[1], p = 3.0, q = -1.5;
    const T pq = p * q, sum = p + q - 1.0;
    out[0] = p * q;
    out[1] = p * q + p * p - 2.0 * q;
    out[2] = a * p;
    out[3] = p * a - a;
    out[4] = p - a;
    out[5] = p * q - a * b;
    out[6] = a * b + p * q + p * a;
    out[7] = (p * q + a * b) * (p + q);
    out[8] = (p + a) * (q - b) + pq * sum;
    out[9] = p / a + a / p + p / q;
    out[10] = (p * q) / (a + p);
    out[11] = (a - a * q) * p - q;
    T c = p;
    c += a;
    c *= q;
    c -= b * p;
    c /= p;
    out[12] = c * c;
    out[13] = 2.0 * p - a * a - b * q + 4.0 * (q - p * a);
  }
};

TEST(Statements, passiveValuesInEveryPosition) {
  checkLaw(PassivePositions{}, {testSeries(20, 0.5, 1, 1), testSeries(20, 1, 2, 2)}, roundingWithCancellation,
           "passive values");
}

struct PassiveOutputs {
  static constexpr int numInputs = 1, numOutputs = 4, numData = 1;
  template <class T>
  void operator()(const T* in, const Passive<T>* data, T* out) const {
    using std::sqrt;
    out[0] = 7.0;
    out[1] = sqrt(T(data[0])) * 2.0;
    out[2] = T(data[0]) / T(4.0) * T(3.0);
    out[3] = in[0] * data[0] + data[0];
  }
};

TEST(Statements, outputsThatDoNotDependOnTheInputs) {
  Values data;
  for (int l = 0; l < L; ++l) data[l] = 1.0 + l;
  const std::vector<Values> in = testSeries(3, 1, 2, 1);
  for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
    const auto r = runSeries(PassiveOutputs{}, {in}, mode, &data);
    for (int l = 0; l < L; ++l) {
      EXPECT_EQ(r.out[0][0][l], 7.0);
      EXPECT_DOUBLE_EQ(r.out[1][0][l], 2 * std::sqrt(1.0 + l));
      EXPECT_DOUBLE_EQ(r.out[2][0][l], 0.75 * (1.0 + l));
      EXPECT_DOUBLE_EQ(r.out[3][0][l], (in[0][l] + 1) * (1.0 + l));
      for (int k = 1; k <= 3; ++k) {
        for (int i = 0; i < 3; ++i) EXPECT_EQ(r.out[i][k][l], 0.0);
        EXPECT_DOUBLE_EQ(r.out[3][k][l], in[k][l] * (1.0 + l));
      }
    }
  }
}

}  // namespace
