// Laws with internal variables, A(v, z) z' = B(v, z) v': all orders against closed forms, their place inside
// other laws.

#include "RateSeries.hpp"
#include "atrapos/taylor/FadFunctions.hpp"
#include "atrapos/taylor/Implicit.hpp"
#include "atrapos/taylor/Polynomial.hpp"
#include "atrapos/taylor/Tensor.hpp"

using namespace atrapos::taylor;

namespace {

TEST(Rate, closedFormsOfOneInput) {
  const Coefficients in = {testSeries(orders, -0.4, 0.8, 1)};
  const Values first = spread(0.3, 1.2), second = spread(-0.5, 0.7);
  const auto v = [&](int l) { return way(lane(in[0], l)); };
  using All = std::vector<LongSeries>;
  expectOrders(
      StateLaw<Growth>{}, in, {first}, [&](int l) { return All{first[l] * exp(v(l))}; }, "growth");
  expectOrders(
      StateLaw<TangentLaw>{}, in, {second},
      [&](int l) { return All{tan(longConstant(std::atan(static_cast<long double>(second[l]))) + v(l))}; },
      "tangent");
  expectOrders(
      StateLaw<Spiral>{}, in, {first, second},
      [&](int l) {
        const Spiral law;
        const LongSeries size = exp(law.d * v(l)), c = cos(law.w * v(l)), s = sin(law.w * v(l));
        return All{size * (first[l] * c - second[l] * s), size * (first[l] * s + second[l] * c)};
      },
      "spiral");
  expectOrders(
      StateLaw<ImplicitRate>{}, in, {first},
      [&](int l) {
        const LongSeries start = longConstant(1.0L + first[l]);
        return All{sqrt(start * start + 2.0 * v(l)) - 1.0};
      },
      "implicit");
}

TEST(Rate, closedFormsOfSeveralInputs) {
  const Coefficients in = {testSeries(orders, -0.4, 0.8, 1), testSeries(orders, 0.6, 1.5, 2)};
  const Values first = spread(0.3, 1.2), second = spread(-0.5, 0.7);
  const auto x = [&](int l) { return lane(in[0], l); };
  const auto y = [&](int l) { return lane(in[1], l); };
  using All = std::vector<LongSeries>;
  expectOrders(
      StateLaw<Polar>{}, in, {first, second},
      [&](int l) {
        const LongSeries r = exp(way(x(l))), c = cos(way(y(l))), s = sin(way(y(l)));
        return All{r * (first[l] * c - second[l] * s), r * (first[l] * s + second[l] * c)};
      },
      "polar");
  expectOrders(
      StateLaw<Swept>{}, in, {first}, [&](int l) { return All{first[l] * exp(integral(0, x(l), y(l)))}; },
      "swept");
  expectOrders(
      StateLaw<Maxwell>{}, in, {first},
      [&](int l) {
        const Maxwell law;  // sigma exp(t/tau) = sigma_0 + int E exp(t/tau) e'
        const LongSeries decay = exp(longConstant(-1.0L / law.tau) * way(y(l)));
        return All{decay * integral(first[l], law.modulus / decay, x(l))};
      },
      "Maxwell");
}

// All that may be done with a rate. The values besides it do not depend on z: sums of integrals.
struct EveryForm {
  static constexpr int numInputs = 2, numStates = 1, numParameters = 1;
  template <class T, class R>
  void operator()(const T* v, const T*, const Passive<T>* data, const R* dv, const R* dz, R* g) const {
    using atrapos::taylor::if_then_else;
    using std::exp;
    const T w = exp(v[0]);
    const R inner = v[1] * dv[0];
    R sum;
    sum += w * inner;            // a form of a form
    sum -= (inner - dv[1]) / w;  // over a value
    sum += inner * (v[0] * w + 2.0) / data[0] + data[0] * dv[1] * 0.5;
    sum *= w;
    sum += if_then_else(v[0] < v[1], R(-dv[0] / 3), R(2 * (w * dv[1])));
    g[0] = 2 * dz[0] - sum;
  }
};

TEST(Rate, everythingThatIsLinearInRates) {
  const Coefficients in = {testSeries(orders, -0.4, 0.8, 1), testSeries(orders, 0.1, 0.2, 2)};
  const Values state = spread(0.3, 1.2), datum = spread(1.5, 2.5);
  expectOrders(
      StateLaw<EveryForm>{}, in, {state, datum},
      [&](int l) {
        const LongSeries x = lane(in[0], l), y = lane(in[1], l), w = exp(x);
        const LongSeries inner = integral(0, y, x);
        LongSeries sum = integral(0, w, inner) - integral(0, 1.0 / w, inner - y) +
                         integral(0, (x * w + 2.0) / datum[l], inner) + 0.5 * datum[l] * y;
        sum = integral(0, w, sum);
        sum += x < y ? longConstant(-1 / 3.0L) * x : 2.0 * integral(0, w, y);
        sum = 0.5 * sum;
        sum.c[0] = state[l];
        return std::vector<LongSeries>{sum};
      },
      "forms");
}

// w^2 = 1 + v^2
struct Hyperbola {
  template <class T>
  void operator()(const T* x, const T* y, T* g) const {
    g[0] = y[0] * y[0] - x[0] * x[0] - 1.0;
  }
};

// An implicit law, and tensors, within a rate law: z' = z (w + S:S) v', S = v (1 2 3; 2 4 5; 3 5 6) / 10
struct Composite {
  template <class T, class R>
  void operator()(const T* v, const T* z, const R* dv, const R* dz, R* g) const {
    T w = 1.0;
    solveImplicit<1, 1>(Hyperbola{}, v, &w);
    T entries[6];
    const double s[6] = {0.1, 0.4, 0.6, 0.2, 0.5, 0.3};
    for (int i = 0; i < 6; ++i) entries[i] = s[i] * v[0];
    const T square = contraction(Symmetric3<T>(entries), Symmetric3<T>(entries));
    g[0] = dz[0] - z[0] * (w + square) * dv[0];
  }
};

// A rate law within a law: v is no input but made of inputs, z is used twice.
struct CompositeLaw {
  static constexpr int numInputs = 2, numOutputs = 2, numData = 1;
  template <class T>
  void operator()(const T* in, const Passive<T>* data, T* out) const {
    const T v[1] = {in[0] - 0.5 * in[1]};
    T z[1] = {T(data[0])};
    solveRate<1, 1>(Composite{}, v, z);
    out[0] = z[0] * z[0] * in[1];
    out[1] = z[0] / (1.0 + in[0] * in[0]);
  }
};

TEST(Rate, insideAndAroundOtherLaws) {
  const Coefficients in = {testSeries(orders, 0.2, 0.5, 1), testSeries(orders, 0.6, 0.9, 2)};
  const Values state = spread(0.3, 1.2);
  expectOrders(
      CompositeLaw{}, in, {state},
      [&](int l) {
        const LongSeries x = lane(in[0], l), y = lane(in[1], l), v = x - 0.5 * y;
        const LongSeries w = sqrt(1.0 + v * v) + 1.29 * (v * v);
        const LongSeries z = static_cast<double>(state[l]) * exp(integral(0, w, v));
        return std::vector<LongSeries>{z * z * y, z / (1.0 + x * x)};
      },
      "composite");
}

// First derivatives by Fad, by order 1 and by unit vectors in lanes: v and w are no inputs, histories are
// nested.
template <class Law>
void expectOneTangent(const Law& law, const std::vector<double>& at, const std::vector<double>& data) {
  constexpr int n = Law::numInputs, m = Law::numOutputs;
  double out[m], jacobian[n * m];
  tangent(law, at.data(), data.data(), out, jacobian);

  Context<L> context;
  context.shape = historyShape(law);
  std::vector<double> memory(context.shape.template doubles<L>(0), std::nan(""));
  context.memory = memory.data();
  const std::vector<Values> there(at.begin(), at.end()), lanes(data.begin(), data.end());
  Values outInLanes[m], jacobianInLanes[n * m];
  tangent(law, context, there.data(), lanes.data(), outInLanes, jacobianInLanes);
  for (int i = 0; i < m; ++i) EXPECT_NEAR(outInLanes[i][L - 1], out[i], 1e-14 * std::fabs(out[i]));
  for (int j = 0; j < n; ++j) {
    Coefficients in(n, std::vector<Values>(2, Values(0.0)));
    for (int i = 0; i < n; ++i) in[i][0] = at[i];
    in[j][1] = 1.0;
    const auto r = runSeries(law, in, Mode::AsASolver, lanes.data());
    for (int i = 0; i < m; ++i) {  // some ten operations each, in other orders
      EXPECT_NEAR(jacobianInLanes[i * n + j][0], jacobian[i * n + j], 1e-14) << i << ' ' << j;
      EXPECT_NEAR(r.out[i][1][L - 1], jacobian[i * n + j], 1e-14) << i << ' ' << j;
    }
  }
}

TEST(Rate, tangentsOfCompositeLaws) {
  expectOneTangent(CompositeLaw{}, {0.3, 0.8}, {0.7});
  expectOneTangent(StateLaw<EveryForm>{}, {-0.3, 0.2}, {0.7, 1.7});
  expectOneTangent(StateLaw<EveryForm>{}, {0.3, 0.2}, {0.7, 1.7});
}

// Inputs that are constants at the point: nothing moves.
struct ConstantInputs {
  static constexpr int numInputs = 1, numOutputs = 1, numData = 1;
  template <class T>
  void operator()(const T* in, const Passive<T>* data, T* out) const {
    const T v[2] = {T(data[0]), in[0]}, still[1] = {T(2.0)};
    T z[1] = {T(3.0)}, y[1] = {T(data[0])};
    solveRate<1, 1>(Growth{}, still, z);
    solveRate<2, 1>(Swept{}, v, y);  // one of two: y' = y v_0 v_1'
    out[0] = z[0] * y[0];
  }
};

TEST(Rate, constantsHaveNoRates) {
  const Coefficients in = {testSeries(orders, -0.4, 0.8, 1)};
  const Values datum = spread(0.5, 1.5);
  expectOrders(
      ConstantInputs{}, in, {datum},
      [&](int l) {
        const double c = datum[l];
        return std::vector<LongSeries>{3.0 * c * exp(c * way(lane(in[0], l)))};
      },
      "constants");
}

// Lanes are points of their own: the series of one at a time, which compilers may round otherwise.
TEST(Rate, lanesAreScalars) {
  const Coefficients in = {testSeries(12, -0.4, 0.8, 1), testSeries(12, 0.6, 1.5, 2)};
  const std::vector<Values> state = {spread(0.3, 1.2), spread(-0.5, 0.7)};
  const auto r = runSeries(StateLaw<Polar>{}, in, Mode::AsASolver, state.data());
  for (int l = 0; l < L; ++l) {
    std::vector<Polynomial> one;
    for (const auto& a : in) {
      std::vector<double> c;
      for (const auto& x : a) c.push_back(x[l]);
      one.emplace_back(c);
    }
    const double data[2] = {state[0][l], state[1][l]};
    const auto expected = polynomials(StateLaw<Polar>{}, one, data);
    for (int i = 0; i < 2; ++i)
      for (int k = 0; k <= 12; ++k)
        EXPECT_NEAR(r.out[i][k][l], expected[i].coefficients()[k], 50 * 2.2e-16) << l << ' ' << i << ' ' << k;
  }
}

// The way back, a -> -a from the end of a step, ends at its beginning: z depends on the way, not on how it is
// passed.
TEST(Rate, theWayBackLeadsBack) {
  const int order = 40;
  const double step = 0.4;  // a third of the radius: terms of order 40 are below rounding
  const std::vector<Polynomial> there = {Polynomial({0.2, 1.0, 0.7}), Polynomial({0.4, -0.3, 1.1})};
  std::vector<Polynomial> back;
  for (const Polynomial& p : there) {
    const Polynomial d = p.derivative();
    back.push_back(Polynomial({p.value(step), -d.value(step), d.derivative().value(step) / 2}));
  }
  const auto along = [&](std::vector<Polynomial> in, double state) {
    for (Polynomial& p : in) {
      std::vector<double> c = p.coefficients();
      c.resize(order + 1);
      p = Polynomial(c);
    }
    return polynomials(StateLaw<Swept>{}, in, &state)[0].value(step);
  };
  const double state = 0.8, end = along(there, state);
  EXPECT_GT(std::fabs(end - state), 0.01);
  EXPECT_NEAR(along(back, end), state, 1e-15 * 10);  // two sums of 40 terms
}

}  // namespace
