// Internal variables along straight chords: closed forms; first derivatives four ways; curved paths; lanes;
// where the way ends.

#include "RateChords.hpp"

using namespace atrapos::taylor;

namespace {

constexpr double pi = 3.14159265358979323846;

// Each sub-step rounds once or twice, and its end is the next one's beginning: 50 units of rounding, times
// how much an error grows on the way.
TEST(RateChord, closedForms) {
  for (const double v : {-3.0, -0.2, 0.0, 1e-9, 0.2, 4.0})
    EXPECT_NEAR(follow(Growth{}, {1.0}, {1.0 + v}, {0.7})[0], 0.7 * std::exp(v), 50 * eps * std::exp(v)) << v;
  for (const double v : {-1.5, -0.2, 0.2, 1.0, 1.5}) {
    const double growth = 1 / (std::cos(v) * std::cos(v));
    EXPECT_NEAR(follow(TangentLaw{}, {0.0}, {v}, {0.0})[0], std::tan(v), 50 * eps * growth) << v;
  }
  for (const double x : {-0.4, 0.3, 10.0})
    EXPECT_NEAR(follow(ImplicitRate{}, {0.0}, {x}, {0.0})[0], std::sqrt(1 + 2 * x) - 1, 50 * eps * (1 + x))
        << x;
  const Spiral spiral;
  for (const double v : {-2.0, 0.1, 20.0}) {
    const auto z = follow(spiral, {0.0}, {v}, {1.0, 0.0});
    const double r = std::exp(spiral.d * v);
    EXPECT_NEAR(z[0], r * std::cos(spiral.w * v), 50 * eps * (1 + r) * (1 + std::fabs(v))) << v;
    EXPECT_NEAR(z[1], r * std::sin(spiral.w * v), 50 * eps * (1 + r) * (1 + std::fabs(v))) << v;
  }
  const auto z = follow(Polar{}, {0.2, 0.3}, {0.7, 2.3}, {1.0, 0.0});
  EXPECT_NEAR(z[0], std::exp(0.5) * std::cos(2.0), 50 * eps);
  EXPECT_NEAR(z[1], std::exp(0.5) * std::sin(2.0), 50 * eps);
  const auto swept =
      follow(Swept{}, {0.2, 0.3}, {0.7, 2.3}, {1.0});  // int x dy: the trapezium below the chord
  EXPECT_NEAR(swept[0], std::exp(0.45 * 2.0), 50 * eps * swept[0]);
}

TEST(RateChord, theWayBackLeadsBack) {
  const auto there = follow(Swept{}, {0.2, 0.3}, {2.7, 2.3}, {1.0});
  EXPECT_NEAR(follow(Swept{}, {2.7, 2.3}, {0.2, 0.3}, there)[0], 1.0, 50 * eps);
}

// A curved path, e = sin t, replaced by n chords: z is another one, by the area between, which falls like
// 1/n^2.
TEST(RateChord, chordsOfACurvedPathConvergeToIt) {
  const Maxwell law;
  const double end = 2 * pi, tau = law.tau, factor = law.modulus * tau / (1 + tau * tau);
  const double exact = factor * (1 - std::exp(-end / tau));  // of sigma' = E cos t - sigma / tau
  const auto error = [&](int n) {
    State<Maxwell> z{0.0};
    for (int i = 0; i < n; ++i) {
      const double s = end * i / n, t = end * (i + 1) / n;
      z = follow(law, {std::sin(s), s}, {std::sin(t), t}, z);
    }
    return std::fabs(z[0] - exact);
  };
  EXPECT_NEAR(error(100) / error(200), 4, 0.05);
  EXPECT_NEAR(error(200) / error(400), 4, 0.02);
}

// dz = A^-1 B dv four ways: Fad, in lanes, order 1 of the series, and differences of chords from there.
template <class G>
void expectTangent(const G& g, const Place<G>& at, const State<G>& z) {
  constexpr int I = G::numInputs, S = G::numStates, L = nativeLanes;
  const StateLaw<G> law{g};
  double values[S], jacobian[S * I], direction[I], byFad[S];
  tangent(law, at.data(), z.data(), values, jacobian);
  double size = 0;
  for (int i = 0; i < S; ++i) {
    EXPECT_EQ(values[i], z[i]);
    byFad[i] = 0;
    for (int j = 0; j < I; ++j) {
      direction[j] = std::cos(1.0 + j);
      byFad[i] += jacobian[i * I + j] * direction[j];
      size = std::max(size, std::fabs(jacobian[i * I + j]));
    }
  }

  Context<L> context;
  context.shape = historyShape(law);
  std::vector<double> memory(context.shape.template doubles<L>(1), std::nan(""));
  context.memory = memory.data();
  Lanes<L> in[I], slope[I], state[S], out[S], completed[S], jacobianInLanes[S * I];
  for (int j = 0; j < I; ++j) {
    in[j] = at[j];
    slope[j] = direction[j];
  }
  for (int i = 0; i < S; ++i) state[i] = z[i];
  tangent(law, context, in, state, out, jacobianInLanes);
  // The same sums in another order of rounding.
  for (int i = 0; i < S * I; ++i) EXPECT_NEAR(jacobianInLanes[i][L - 1], jacobian[i], 50 * eps * size) << i;
  context.order = 0;
  start(law, context, in, state, out);
  context.order = 1;
  sweep(law, context, state, out);
  complete(law, context, slope, state, completed);
  for (int i = 0; i < S; ++i) EXPECT_NEAR((out[i] + completed[i])[0], byFad[i], 50 * eps * size);
  sweepKnown(law, context, slope, state, out);
  for (int i = 0; i < S; ++i) EXPECT_NEAR(out[i][L - 1], byFad[i], 50 * eps * size);

  const auto error = [&](double step) {
    Place<G> ahead = at, behind = at;
    for (int j = 0; j < I; ++j) {
      ahead[j] += step * direction[j];
      behind[j] -= step * direction[j];
    }
    const State<G> a = follow(g, at, ahead, z), b = follow(g, at, behind, z);
    double e = 0;
    for (int i = 0; i < S; ++i) e = std::max(e, std::fabs((a[i] - b[i]) / (2 * step) - byFad[i]));
    return e;
  };
  // The step^2 term, far above rounding (1e-16/step) and the step^4 term.
  EXPECT_NEAR(error(4e-3) / error(2e-3), 4, 0.05);
}

TEST(RateChord, tangents) {
  expectTangent(Growth{}, {0.3}, {0.8});
  expectTangent(TangentLaw{}, {0.3}, {0.8});
  expectTangent(Spiral{}, {0.3}, {0.8, -0.4});
  expectTangent(ImplicitRate{}, {0.3}, {0.8});
  expectTangent(Polar{}, {0.3, 0.9}, {0.8, -0.4});
  expectTangent(Swept{}, {0.3, 0.9}, {0.8});
  expectTangent(Maxwell{}, {0.3, 0.9}, {0.8});
  expectTangent(PlasticFlow{}, {}, {0.9, -0.4, -0.5, 0.3, -0.2, 0.6, 0.1});
}

// How z at a chord's end depends on that end is A^-1 B there only for a short chord: another end is reached
// another way, and the area between is of the order of the chord. With one input there is one way.
template <class G>
double defect(const G& g, const Place<G>& from, const State<G>& z, double length) {
  constexpr int I = G::numInputs, S = G::numStates;
  Place<G> to = from;
  for (int j = 0; j < I; ++j) to[j] += length * std::sin(2.0 + j);
  const State<G> end = follow(g, from, to, z);
  double values[S], jacobian[S * I], largest = 0;
  tangent(StateLaw<G>{g}, to.data(), end.data(), values, jacobian);
  for (int j = 0; j < I; ++j) {
    const double step = 1e-5;  // (1e-10 + 1e-16/1e-5) of z: defects are above 1e-4
    Place<G> ahead = to, behind = to;
    ahead[j] += step;
    behind[j] -= step;
    const State<G> a = follow(g, from, ahead, z), b = follow(g, from, behind, z);
    for (int i = 0; i < S; ++i)
      largest = std::max(largest, std::fabs((a[i] - b[i]) / (2 * step) - jacobian[i * I + j]));
  }
  return largest;
}

TEST(RateChord, theTangentAtTheEndIsThatOfShortChords) {
  EXPECT_LT(defect(TangentLaw{}, {0.3}, {0.8}, 0.1), 1e-8);
  EXPECT_LT(defect(Polar{}, {0.3, 0.9}, {0.8, -0.4}, 0.1), 1e-8);  // two inputs, but no matter which way
  for (const double length : {0.08, 0.04}) {
    EXPECT_NEAR(defect(Swept{}, {0.3, 0.9}, {0.8}, length) / defect(Swept{}, {0.3, 0.9}, {0.8}, length / 2),
                2, 0.1);
    EXPECT_NEAR(
        defect(Maxwell{}, {0.3, 0.9}, {0.8}, length) / defect(Maxwell{}, {0.3, 0.9}, {0.8}, length / 2), 2,
        0.1);
  }
}

// Every lane goes its own way: many sub-steps, one, none; where one fails, it fails alone.
TEST(RateChord, lanesAreScalars) {
  constexpr int L = 8;
  Chords<TangentLaw, L> lanes;
  const double ends[L] = {0.1, -1.5, 0.0, 1.2, 2.0, 1e-9, 0.7, -0.3};
  Lanes<L> from(0.0), to, z(0.0);
  for (int l = 0; l < L; ++l) to[l] = ends[l];
  EXPECT_FALSE(lanes(&from, &to, static_cast<const Lanes<L>*>(nullptr), &z));
  for (int l = 0; l < L; ++l) {
    if (l == 4) continue;
    EXPECT_EQ(lanes.failures.operation[l], Operation::None);
    const double one = follow(TangentLaw{}, {0.0}, {ends[l]}, {0.0})[0];
    EXPECT_NEAR(z[l], one, 4 * eps * std::fabs(one)) << l;  // compilers may fuse differently
  }
  EXPECT_TRUE(std::isnan(z[4]));
  EXPECT_EQ(lanes.failures.operation[4], Operation::Chord);
  EXPECT_NEAR(lanes.failures.value[4], pi / 4, 1e-9);  // the pole at pi/2 of 2
}

TEST(RateChord, endsWhereTheLawEnds) {
  const Chords<ImplicitRate, 1> chords;  // (1 + z)^2 = 1 + 2 v ends at v = -1/2
  const double from = 0, to = -0.8;
  double z = 0;
  EXPECT_FALSE(chords(&from, &to, static_cast<const double*>(nullptr), &z));
  EXPECT_TRUE(std::isnan(z));
  EXPECT_EQ(chords.failures.operation[0], Operation::Chord);
  EXPECT_NEAR(chords.failures.value[0], 0.625, 1e-9);
  EXPECT_EQ(describe(Operation::Chord, 0.625),
            "the rate law cannot be followed to the new inputs: after 0.625 of the way its series end or the "
            "sub-steps are used up");

  const Chords<ImplicitRate, 1> singular;  // from the end itself: there are no rates
  z = -1;
  EXPECT_FALSE(singular(&from, &to, static_cast<const double*>(nullptr), &z));
  EXPECT_EQ(singular.failures.operation[0], Operation::Rate);
  z = -1;
  EXPECT_TRUE(
      singular(&from, &from, static_cast<const double*>(nullptr), &z));  // but the state itself is there
  EXPECT_EQ(z, -1);
}

TEST(RateChord, subStepsAreBounded) {
  const Chords<Spiral, 1> chords;
  const double from = 0, to = 20;
  double z[2] = {1, 0};
  EXPECT_FALSE(chords(&from, &to, static_cast<const double*>(nullptr), z, 3));
  EXPECT_EQ(chords.failures.operation[0], Operation::Chord);
  EXPECT_TRUE(chords.failures.value[0] > 0 && chords.failures.value[0] < 0.5);
  EXPECT_TRUE(std::isnan(z[0]) && std::isnan(z[1]));
}

}  // namespace
