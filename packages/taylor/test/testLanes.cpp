// The number of lanes is a matter of speed: 1, 2, 4, 8 and 16 of them give the same coefficients. Compiled
// once more for each instruction set (ATRAPOS_LANES_LEVEL), with a register of it and two.

#include <gtest/gtest.h>

#include <vector>

#include "TestLaws.hpp"
#include "atrapos/taylor/Functions.hpp"
#include "atrapos/taylor/Tensor.hpp"

using namespace atrapos::taylor;

namespace {

constexpr int numPoints = 16, maxOrder = 20;

// Every kind of recurrence, a choice, tensors.
struct Everything {
  static constexpr int numInputs = 9, numOutputs = 6, numData = 2;
  template <class T>
  void operator()(const T* in, const Passive<T>* data, T* out) const {
    using std::exp, std::log, std::sqrt, std::tanh, std::erf, std::atan2, std::pow;
    Matrix3<T> H(in);
    const Symmetric3<T> G = gramian(H);
    const T a = in[0] * in[1] - in[2] * in[3] + data[0], b = 2.0 + in[4] * in[4];
    out[0] = exp(a) / b + sqrt(b) * log(b);
    out[1] = tanh(a) * erf(a) + atan2(a, b);
    out[2] = pow(b, data[1]) + pow(a, 3) - pow(b, a);
    out[3] = trace(G) * a;
    out[4] = if_then_else(a < 0.9, a * b, sin(a));
    const T x[3] = {in[5] + 3.0, in[6], in[7] + 4.0};
    T projection[4];
    CylinderLaw{}(x, data, projection);
    out[5] = projection[0] * projection[3];
  }
};

using Series = std::vector<std::vector<std::vector<double>>>;  // [output][point][order]

template <int L>
Series compute() {
  const Everything law;
  constexpr int n = Everything::numInputs, m = Everything::numOutputs;
  Series result(m, std::vector<std::vector<double>>(numPoints, std::vector<double>(maxOrder + 1)));
  Context<L> context;
  context.shape = historyShape(law);
  for (int first = 0; first < numPoints; first += L) {
    std::vector<double> memory(context.shape.template doubles<L>(maxOrder), std::nan(""));
    context.memory = memory.data();
    for (int k = 0; k <= maxOrder; ++k) {
      context.order = k;
      Lanes<L> in[n], data[2], out[m], linear[m];
      for (int l = 0; l < L; ++l) {
        const int point = first + l;
        for (int j = 0; j < n; ++j)
          in[j][l] = std::pow(0.5, k) * (0.6 * std::cos(1.0 + point + 1.3 * j + 2.1 * k));
        data[0][l] = 0.8 + 0.02 * point;
        data[1][l] = -0.5 + 0.1 * point;
      }
      if (k == 0) {
        start(law, context, in, data, out);
      } else {
        sweep(law, context, data, out);
        complete(law, context, in, data, linear);
        for (int i = 0; i < m; ++i) out[i] += linear[i];
      }
      for (int i = 0; i < m; ++i)
        for (int l = 0; l < L; ++l) result[i][first + l][k] = out[i][l];
    }
  }
  return result;
}

template <int L>
void expectSame(const Series& expected) {
  const Series actual = compute<L>();
  for (std::size_t i = 0; i < actual.size(); ++i)
    for (int p = 0; p < numPoints; ++p) {
      double size = 0;  // of the coefficients up to k, at the decay of the inputs
      for (int k = 0; k <= maxOrder; ++k) {
        size = std::max(0.5 * size, std::fabs(expected[i][p][k]));
        // The same operations in the same order; only fused multiply-adds may fall differently, which changes
        // each of some hundred terms by half a unit in the last place.
        ASSERT_NEAR(actual[i][p][k], expected[i][p][k], 1e-13 * size)
            << L << " lanes, output " << i << ", point " << p << ", order " << k;
      }
    }
}

TEST(Lanes, anyNumberGivesTheSameCoefficients) {
  const Series one = compute<1>();
  for (const auto& output : one)
    for (const auto& point : output)
      for (const double c : point) ASSERT_TRUE(std::isfinite(c));
#ifdef ATRAPOS_LANES_LEVEL
  static_assert(nativeLanes == (ATRAPOS_LANES_LEVEL == 2 ? 2 : ATRAPOS_LANES_LEVEL == 3 ? 4 : 8));
  expectSame<nativeLanes>(one);
  expectSame<2 * nativeLanes>(one);
#else
  expectSame<2>(one);
  expectSame<4>(one);
  expectSame<8>(one);
  expectSame<16>(one);
#endif
}

}  // namespace
