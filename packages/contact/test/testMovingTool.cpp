// Tools that move with the load factor: against the same tool put where it has moved to, points that ride on
// it, derivatives three ways with respect to place and load factor, orders to 20.
#include <gtest/gtest.h>

#include <cmath>

#include "SeriesRun.hpp"
#include "atrapos/contact/MovingTool.hpp"
#include "support/Differences.hpp"
#include "support/PatchSurfaces.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

template <class Tool>
struct MovingProjection {
  static constexpr int numInputs = 4, numOutputs = 4, numData = 0;
  MovingTool<Tool> tool;
  template <class T>
  void operator()(const T* x, const taylor::Passive<T>*, T* y) const {
    for (int i = 0; i < 4; ++i) y[i] = T(0.0);
    taylor::solveImplicit<4, 4>(tool, x, y);
  }
};

Motion randomMotion(Random& random, bool turns) {
  Motion motion;
  const Vector3 p = random.inCube(2), a = random.direction();
  for (int i = 0; i < 3; ++i) {
    motion.pivot[i] = p[i];
    motion.axis[i] = a[i];
    for (int k = 0; k <= 3; ++k) motion.shift[k][i] = random.between(-0.5, 0.5);
  }
  for (int k = 0; k <= 3 && turns; ++k) motion.angle[k] = random.between(-0.4, 0.4);
  return motion;
}

/// Where the point X of the tool is at lambda, for any scalar.
template <class T>
void moved(const Motion& motion, const T& lambda, const T* X, T* x) {
  T c[3], s(0.0), k(1.0), v[3];
  motion.at(lambda, c, s, k);
  for (int i = 0; i < 3; ++i) v[i] = X[i] - motion.pivot[i];
  motion.turn(v, s, k, x);
  for (int i = 0; i < 3; ++i) x[i] += c[i] + motion.pivot[i];
}

TEST(MovingTool, IsTheToolWhereItHasMovedTo) {
  Random random(51);
  for (int n = 0; n < 10; ++n) {
    const Cylinder cylinder = random.cylinder();
    const MovingTool<Cylinder> moving{cylinder, randomMotion(random, n % 3 != 0)};
    for (const double lambda : {-0.7, 0.0, 0.4, 1.5}) {
      // The axis by two of its points.
      double end[3], center[3], other[3];
      for (int i = 0; i < 3; ++i) end[i] = cylinder.center[i] + cylinder.axis[i];
      moved(moving.motion, lambda, cylinder.center, center);
      moved(moving.motion, lambda, end, other);
      Cylinder there = cylinder;
      const Vector3 axis = unit(sum(vector(other), -1, vector(center)));
      for (int i = 0; i < 3; ++i) {
        there.center[i] = center[i];
        there.axis[i] = axis[i];
      }
      const Vector3 p = pointAt(there, 0.3, random);
      const double x[4] = {p[0], p[1], p[2], lambda};
      double y[4];
      ASSERT_TRUE((taylor::solveImplicit<4, 4>(moving, x, y)));
      const auto exact = project(there, p);
      for (int i = 0; i < 4; ++i) EXPECT_NEAR(y[i], exact[i], 1e3 * 10 * eps);  // coordinates up to 10
    }
  }
}

// A point that rides on the tool keeps its gap, at every order; its normal turns with the tool.
TEST(MovingTool, RidingPointsKeepTheirGap) {
  Random random(52);
  for (int n = 0; n < 5; ++n) {
    Torus torus;
    torus.radius = 4;
    torus.tubeRadius = 1.5;
    const MovingTool<Torus> moving{torus, randomMotion(random, true)};
    Coefficients x(4, std::vector<Values>(21, Values(0.0)));
    for (int l = 0; l < L; ++l) {
      const double angle = random.between(0, 6), around = random.between(0, 6), gap = random.between(0.1, 1);
      const Vector3 e{std::cos(angle), 0, std::sin(angle)};
      const Vector3 X = sum(sum(scaled(4, e), (1.5 + gap) * std::cos(around), e),
                            (1.5 + gap) * std::sin(around), {0, 1, 0});
      LongSeries lambda(std::vector<long double>(21, 0.0L));
      lambda.c[0] = random.between(-0.5, 0.5);
      lambda.c[1] = 0.5;
      const LongSeries rest[3] = {X[0], X[1], X[2]};
      LongSeries place[3];
      moved(moving.motion, lambda, rest, place);
      for (int k = 0; k <= 20; ++k) {
        for (int i = 0; i < 3; ++i) x[i][k][l] = static_cast<double>(place[i].at(k));
        x[3][k][l] = static_cast<double>(lambda.at(k));
      }
    }
    const auto r = runSeries(MovingProjection<Torus>{moving}, x, Mode::AsASolver);
    for (int k = 1; k <= 20; ++k)
      for (int l = 0; l < L; ++l)
        ASSERT_NEAR(r.out[0][k][l], 0.0, 1e3 * 10 * eps) << "order " << k;  // coordinates up to 10
    EXPECT_GT(std::fabs(r.out[1][1][0]) + std::fabs(r.out[2][1][0]), 1e-3);
  }
}

TEST(MovingTool, DerivativesThreeWaysInPlaceAndLoadFactor) {
  Random random(53);
  for (int n = 0; n < 10; ++n) {
    const Cylinder cylinder = random.cylinder();
    using Law = ContactLaw<MovingTool<Cylinder>>;
    const Law law{{cylinder, randomMotion(random, n % 2 == 0)}, {1e-2, 0.1}};
    const double lambda = random.between(-0.5, 0.5), Delta = 1;
    const Vector3 X = pointAt(cylinder, 0.4, random);
    double x[4], out[3], jacobian[12];
    moved(law.tool.motion, lambda, X.data(), x);
    x[3] = lambda;
    taylor::tangent(law, x, &Delta, out, jacobian);
    std::array<double, 4> d;
    for (double& c : d) c = random.between(-1, 1);
    std::array<double, 3> slope{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j) slope[i] += jacobian[4 * i + j] * d[j];
    const auto f = [&](double step) {
      double at[4];
      for (int j = 0; j < 4; ++j) at[j] = x[j] + step * d[j];
      std::array<double, 3> value;
      taylor::value(law, at, &Delta, value.data());
      return value;
    };
    expectDerivative(f, slope, 0.01, 1e3 * eps, "moving");
    Coefficients in(4, std::vector<Values>(2));
    for (int j = 0; j < 4; ++j) {
      in[j][0] = x[j];
      in[j][1] = d[j];
    }
    const Values data(Delta);
    const auto r = runSeries(law, in, Mode::AsASolver, &data);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(r.out[i][1][0], slope[i], 1e4 * eps);
  }
}

TEST(MovingTool, OrdersTo20) {
  Random random(54);
  const Cylinder cylinder = random.cylinder();
  for (const bool turns : {false, true}) {
    const MovingTool<Cylinder> moving{cylinder, randomMotion(random, turns)};
    Coefficients x(4, std::vector<Values>(21));
    for (int l = 0; l < L; ++l) {
      const double lambda = random.between(-0.5, 0.5);
      const Vector3 X = pointAt(cylinder, random.between(-0.2, 2), random);
      double start[3];
      moved(moving.motion, lambda, X.data(), start);
      for (int k = 0; k <= 20; ++k) {
        const Vector3 c = k == 0 ? vector(start) : scaled(0.05 * std::pow(0.4, k - 1), random.direction());
        for (int i = 0; i < 3; ++i) x[i][k][l] = c[i];
        x[3][k][l] = k == 0 ? lambda : 0.05 * std::pow(0.4, k - 1);
      }
    }
    for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
      const auto r = runSeries(MovingProjection<Cylinder>{moving}, x, mode);
      for (int l = 0; l < L; ++l) {
        LongSeries in[4], y[4], g[4];
        for (int i = 0; i < 4; ++i) in[i] = lane(x[i], l);
        for (int i = 0; i < 4; ++i) y[i] = lane(r.out[i], l);
        moving(in, y, g);
        for (int i = 0; i < 4; ++i)
          for (int k = 0; k <= 20; ++k)  // coordinates up to 10, orders that decay at least as 0.7^k
            ASSERT_NEAR(static_cast<double>(g[i].at(k)), 0.0, 1000 * 10 * eps * std::pow(0.7, k)) << k;
      }
    }
  }
}

// A patch surface that moves: with the data of the point in the tool's frame.
TEST(MovingTool, CarriesPatches) {
  Random random(55);
  const Cylinder cylinder = random.cylinder();
  const PatchSet set(nurbsCylinder(cylinder, 6).patches());
  const Motion motion = randomMotion(random, true);
  const ContactLaw<MovingTool<PatchTool>> law{{set.tool(), motion}, {1e-2, 0.1}};
  const ContactLaw<MovingTool<Cylinder>> exact{{cylinder, motion}, {1e-2, 0.1}};
  for (int n = 0; n < 10; ++n) {
    const double lambda = random.between(-0.5, 0.5);
    const Vector3 X = pointAt(cylinder, 0.4, random);
    double x[4], back[3], out[3], reference[3];
    moved(motion, lambda, X.data(), x);
    x[3] = lambda;
    law.tool.toToolFrame(x, back);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(back[i], X[i], 100 * 10 * eps);
    const auto place = set.locate(back);
    const double data[4] = {1, place[0], place[1], place[2]};
    taylor::value(law, x, data, out);
    taylor::value(exact, x, data, reference);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(out[i], reference[i], 1e3 * eps);
  }
}

TEST(MovingTool, BadMotionsAreRefused) {
  MovingTool<Plane> moving;
  EXPECT_NO_THROW(moving.validate());
  moving.motion.axis[0] = 1;
  EXPECT_THROW(moving.validate(), std::invalid_argument);
  moving.motion.axis[0] = 0;
  moving.motion.shift[2][1] = std::nan("");
  EXPECT_THROW(moving.validate(), std::invalid_argument);
}

}  // namespace
