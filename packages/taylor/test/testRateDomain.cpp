// Laws with internal variables where their rates are not unique, or have no series: what is said, and what
// stays.

#include "RateSeries.hpp"
#include "atrapos/taylor/Polynomial.hpp"

using namespace atrapos::taylor;

namespace {

// A_0 = v, singular at v = 0 (as the matrix of z, which stays z_0).
struct Singular {
  static constexpr int numInputs = 1, numStates = 1;
  template <class T, class R>
  void operator()(const T* v, const T*, const R* dv, const R* dz, R* g) const {
    g[0] = v[0] * dz[0] - dv[0];
  }
};

TEST(RateDomain, singularRatesAreReportedAndAreNaN) {
  Coefficients in = {testSeries(6, 0.3, 0.7, 1)};
  in[0][0][L - 1] = 0.0;
  const Values state = 2.0;
  for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
    const auto r = runSeries(StateLaw<Singular>{}, in, mode, &state);
    for (int l = 0; l < L; ++l) {
      EXPECT_EQ(r.failures.operation[l], l == L - 1 ? Operation::Rate : Operation::None);
      for (const auto& c : r.out[0]) EXPECT_EQ(std::isnan(c[l]), l == L - 1);
    }
  }
  EXPECT_EQ(
      describe(Operation::Rate, 1e-17),
      "the rate law A z' = B v' gives no unique rates here: its matrix A is singular, a pivot cancels to "
      "1e-17 of its terms");
  try {
    const double two = 2;
    polynomials(StateLaw<Singular>{}, {Polynomial({0.0, 1.0})}, &two);
    ADD_FAILURE();
  } catch (const DomainError& error) {
    EXPECT_EQ(error.operation, Operation::Rate);
  }
}

// As a double the state is what it is; its derivatives are not.
TEST(RateDomain, whereRatesAreSingularTheStateIsNot) {
  const double v = 0, data = 2;
  double z = 2, jacobian;
  EXPECT_TRUE((solveRate<1, 1>(Singular{}, &v, &z)));
  EXPECT_EQ(z, 2);
  Sacado::Fad::SFad<double, 1> vf(1, 0, 0.0), zf = 2.0;
  EXPECT_FALSE((solveRate<1, 1>(Singular{}, &vf, &zf)));
  EXPECT_EQ(zf.val(), 2);
  EXPECT_TRUE(std::isnan(zf.dx(0)));
  tangent(StateLaw<Singular>{}, &v, &data, &z, &jacobian);
  EXPECT_TRUE(z == 2 && std::isnan(jacobian));

  Context<L> context;
  Failures<L> failures;
  context.shape = historyShape(StateLaw<Singular>{});
  std::vector<double> memory(context.shape.doubles<L>(0), std::nan(""));
  context.memory = memory.data();
  context.failures = &failures;
  const Values there = spread(0, 1), state = 2.0;
  Values out, slope;
  tangent(StateLaw<Singular>{}, context, &there, &state, &out, &slope);
  for (int l = 0; l < L; ++l) {
    EXPECT_EQ(out[l], 2);
    EXPECT_EQ(std::isnan(slope[l]), l == 0);
    if (l > 0) {
      EXPECT_NEAR(slope[l], 1 / there[l], 1e-15 / there[l]);
    }
    EXPECT_EQ(failures.operation[l], Operation::None);
  }
}

// Singular to rounding, not to the last digit; and regular, whatever the units.
struct TwoByTwo {
  double a, b, c, d;
  template <class T, class R>
  void operator()(const T*, const T*, const R* dv, const R* dz, R* g) const {
    g[0] = a * dz[0] + b * dz[1] - dv[0];
    g[1] = c * dz[0] + d * dz[1] - dv[0];
  }
};

TEST(RateDomain, singularIsAMatterOfRoundingNotOfUnits) {
  using Fad = Sacado::Fad::SFad<double, 1>;
  const auto regular = [](const TwoByTwo& law) {
    const Fad v(1, 0, 1.0);
    Fad z[2] = {0.0, 0.0};
    return solveRate<1, 2>(law, &v, z);
  };
  EXPECT_FALSE(regular({0.1, 0.3, 0.2, 0.6}));
  EXPECT_FALSE(regular({0.1, 0.3, 0.7, 2.1}));
  EXPECT_FALSE(regular({1, 2, 0, 0}));
  EXPECT_TRUE(regular({1e20, 0, 1e20, 1}));
  EXPECT_TRUE(regular({1, 1e-20, 1, 2e-20}));
  EXPECT_TRUE(regular({1e-15, 3e-15, 2e20, 5e20}));
}

// A factor of a rate outside its domain: there is no series, which order 0 tells although z_0 is there.
struct RootOfInput {
  static constexpr int numInputs = 1, numStates = 1;
  template <class T, class R>
  void operator()(const T* v, const T*, const R* dv, const R* dz, R* g) const {
    using std::sqrt;
    g[0] = dz[0] - sqrt(v[0]) * dv[0];
  }
};
struct OverInput {
  static constexpr int numInputs = 1, numStates = 1;
  template <class T, class R>
  void operator()(const T* v, const T*, const R* dv, const R* dz, R* g) const {
    g[0] = dz[0] - dv[0] / v[0];
  }
};

template <class G>
void expectNoSeries(Operation operation, double value) {
  Coefficients in = {testSeries(3, 0.3, 0.7, 1)};
  in[0][0][L - 1] = value;
  const Values state = 2.0;
  const auto r = runSeries(StateLaw<G>{}, in, Mode::AsASolver, &state);
  for (int l = 0; l < L; ++l) {
    EXPECT_EQ(r.failures.operation[l], l == L - 1 ? operation : Operation::None);
    EXPECT_EQ(std::isnan(r.out[0][0][l]), l == L - 1);
  }
  EXPECT_EQ(r.failures.value[L - 1], value);
}

TEST(RateDomain, factorsOutsideTheirDomain) {
  expectNoSeries<RootOfInput>(Operation::Sqrt, -0.5);
  expectNoSeries<OverInput>(Operation::Division, 0.0);
}

}  // namespace
