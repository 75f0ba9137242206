// Patch surfaces, paper (13): against cylinders, evaluation by basis functions, sampling, differences, their
// own equation; borders, edges and loss of uniqueness; bad surfaces.
#include <gtest/gtest.h>

#include <cmath>

#include "SeriesRun.hpp"
#include "atrapos/contact/ContactLaw.hpp"
#include "support/Differences.hpp"
#include "support/PatchSurfaces.hpp"
#include "support/Refusals.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

struct PatchProjection {
  static constexpr int numInputs = 3, numOutputs = 6, numData = 3;
  PatchTool tool;
  template <class T>
  void operator()(const T* x, const taylor::Passive<T>* data, T* y) const {
    for (int i = 0; i < 6; ++i) y[i] = T(0.0);
    taylor::solveImplicit<3, 6, 3>(tool, x, data, y);
  }
};

Vector3 at(const BezierPatch& patch, double t1, double t2, Vector3* normal = nullptr) {
  const auto coefficients = patch.coefficients(patch.degree);
  const PatchPoint s = PatchPoint::of(coefficients.data(), patch.degree[0], patch.degree[1], t1, t2);
  if (normal != nullptr) {
    double N[3];
    s.cross(N);
    *normal = unit(vector(N));
  }
  return vector(s.S);
}

/// Gap over the wavy patches up to which the place below is the nearest one.
constexpr double reach = 0.25;

TEST(Patches, NurbsCylinderIsTheCylinder) {
  Random random(41);
  for (int n = 0; n < 5; ++n) {
    Cylinder cylinder = random.cylinder();
    const PatchSet set(nurbsCylinder(cylinder, 5).patches());
    EXPECT_EQ(set.numPatches(), 4);
    for (const double gap : {7.0, 0.3, 1e-6, -1e-6, -0.2})
      for (int i = 0; i < 4; ++i) {
        const Vector3 x = pointAt(cylinder, gap, random);
        const auto exact = project(cylinder, x), y = project(set, x);
        // 50 operations on coordinates up to 20; normals over radii of 0.5 at least.
        EXPECT_NEAR(y[0], exact[0], 50 * 20 * eps);
        for (int c = 1; c < 4; ++c) EXPECT_NEAR(y[c], exact[c], 100 * 20 * eps);
      }
  }
}

// Coordinates and parts of the normal that are zero, points far away: rounding is all that is left of whole
// equations there.
TEST(Patches, PointsInPlanesOfSymmetry) {
  const Cylinder cylinder{{200, 0, -54.4}, {0, 1, 0}, 50};
  const PatchSet set(nurbsCylinder(cylinder, 50).patches());
  for (const Vector3& x : {Vector3{200, 0, 0}, Vector3{0, 0, -54.4}, Vector3{2.3, -0.47, -0.4},
                           Vector3{2.3, 0, -0.4}, Vector3{190, 0, -0.4}, Vector3{200, 3, 150}}) {
    const auto exact = project(cylinder, x), y = project(set, x);
    EXPECT_NEAR(y[0], exact[0], 50 * 300 * eps);  // 50 operations on coordinates up to 300
    for (int c = 1; c < 4; ++c) EXPECT_NEAR(y[c], exact[c], 100 * eps);
  }
}

// The force of the contact law, all orders: from both descriptions.
TEST(Patches, NurbsCylinderHasTheCylindersSeries) {
  Random random(42);
  const Cylinder cylinder = random.cylinder();
  const PatchSet set(nurbsCylinder(cylinder, 6).patches());
  const RegularisedPressure pressure{1e-3, 0.1};
  Coefficients x(3, std::vector<Values>(21));
  Values data[4];
  for (int l = 0; l < L; ++l) {
    const Vector3 start = pointAt(cylinder, 0.3 + 0.05 * l, random);
    const auto place = set.locate(start.data());
    data[0][l] = 1;
    for (int d = 0; d < 3; ++d) data[1 + d][l] = place[d];
    for (int k = 0; k <= 20; ++k) {
      const Vector3 c = k == 0 ? start : scaled(0.03 * std::pow(0.4, k - 1), random.direction());
      for (int i = 0; i < 3; ++i) x[i][k][l] = c[i];
    }
  }
  for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
    const auto exact = runSeries(ContactLaw<Cylinder>{cylinder, pressure}, x, mode, data);
    const auto r = runSeries(ContactLaw<PatchTool>{set.tool(), pressure}, x, mode, data);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k <= 20; ++k)
        for (int l = 0; l < L; ++l)
          // Rounding of coordinates up to 20 through dR/dh of about 1; orders decay at least as 0.6^k.
          ASSERT_NEAR(r.out[i][k][l], exact.out[i][k][l], 1e4 * eps * std::pow(0.6, k)) << i << ' ' << k;
  }
}

// Error of the Taylor polynomials: r (pi/8)^(p+1)/(p+1)! in the place, less in the distance.
TEST(Patches, BezierCylinderIsOneToItsApproximationError) {
  Random random(43);
  const Cylinder cylinder = random.cylinder();
  double factor = 1;
  for (int p = 5, k = 1; p <= 9; p += 2) {  // patches of lower degree do not meet closely enough
    for (; k <= p + 1; ++k) factor *= std::acos(-1.0) / 8 / k;
    const double bound = cylinder.radius * factor;
    const PatchSet set(bezierCylinder(cylinder, 5, p));
    double worst = 0;
    for (int i = 0; i < 100; ++i) {
      const double gap = random.between(-0.2, 1);
      const Vector3 x = pointAt(cylinder, gap, random);
      const double h = project(set, x)[0];
      ASSERT_FALSE(std::isnan(h));
      worst = std::max(worst, std::fabs(h - gap));
    }
    EXPECT_LT(worst, bound + 1e-13);
    // Nor much nearer: the patches are approximations, and the bound is of their size.
    EXPECT_GT(worst, 1e-3 * bound) << p;
    if (p == 9) {
      EXPECT_LT(worst, 1e-6);
    }
  }
}

/// Cox-de Boor basis functions by their recursion.
double basis(const std::vector<double>& u, int i, int p, double t) {
  if (p == 0) return u[i] <= t && t < u[i + 1] ? 1 : 0;
  double sum = 0;
  if (u[i + p] > u[i]) sum += (t - u[i]) / (u[i + p] - u[i]) * basis(u, i, p - 1, t);
  if (u[i + p + 1] > u[i + 1])
    sum += (u[i + p + 1] - t) / (u[i + p + 1] - u[i + 1]) * basis(u, i + 1, p - 1, t);
  return sum;
}

TEST(Patches, NurbsSplitIntoPatchesIsTheSameSurface) {
  Random random(44);
  NurbsSurface s;
  s.degree = {3, 2};
  s.knots[0] = {-1, 0, 0.5, 2, 3, 3, 4.5, 5, 7, 8};  // not clamped, an inner knot twice
  s.knots[1] = {0, 0, 0, 1, 1, 4, 4, 4};             // clamped, an inner knot p times
  s.count = {6, 5};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 5; ++j) {
      s.points.push_back(
          {i + random.between(-0.2, 0.2), j + random.between(-0.2, 0.2), random.between(-1, 1)});
      s.weights.push_back(random.between(0.5, 2));
    }
  const auto patches = s.patches();
  ASSERT_EQ(patches.size(), 2u * 2u);  // spans [2, 3], [3, 4.5] and [0, 1], [1, 4]
  const double spans[2][3] = {{2, 3, 4.5}, {0, 1, 4}};
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b)
      for (int i = 0; i < 10; ++i) {
        const double t1 = random.between(-1, 1), t2 = random.between(-1, 1);
        const double u = spans[0][a] + (t1 + 1) / 2 * (spans[0][a + 1] - spans[0][a]);
        const double v = spans[1][b] + (t2 + 1) / 2 * (spans[1][b + 1] - spans[1][b]);
        double weight = 0;
        Vector3 exact{0, 0, 0};
        for (int m = 0; m < 6; ++m)
          for (int n = 0; n < 5; ++n) {
            const double N = basis(s.knots[0], m, 3, u) * basis(s.knots[1], n, 2, v) * s.weights[5 * m + n];
            weight += N;
            exact = sum(exact, N, s.points[5 * m + n]);
          }
        const Vector3 p = at(patches[2 * a + b], t1, t2);
        // Sums of 12 terms up to 6.
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(p[c], exact[c] / weight, 200 * eps);
      }
}

TEST(Patches, DistanceIsThatOfSamples) {
  Random random(45);
  for (const bool rational : {false, true}) {
    const BezierPatch patch = wavyPatch(rational, 5);
    const PatchSet set({patch}), reversed({patch}, true);
    for (int i = 0; i < 8; ++i) {
      Vector3 n;
      const Vector3 foot = at(patch, random.between(-0.9, 0.9), random.between(-0.9, 0.9), &n);
      for (const double gap : {reach, 1e-3, -reach}) {
        const Vector3 x = sum(foot, gap, n);
        const auto y = project(set, x), z = project(reversed, x);
        EXPECT_NEAR(y[0], gap, 1000 * eps);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(y[1 + c], n[c], 1e4 * eps);
        for (int c = 0; c < 4; ++c) EXPECT_NEAR(z[c], -y[c], 1e4 * eps);
        EXPECT_EQ(set.ambiguity(x.data()), "");
        double t1 = 0, t2 = 0, half = 1, best = 1e300;
        for (int zoom = 0; zoom < 9; ++zoom, half /= 5) {
          const double m1 = t1, m2 = t2;
          for (int a = -15; a <= 15; ++a)
            for (int b = -15; b <= 15; ++b) {
              const double u = std::fmin(1, std::fmax(-1, m1 + half * a / 15));
              const double v = std::fmin(1, std::fmax(-1, m2 + half * b / 15));
              const double d = length(sum(x, -1, at(patch, u, v)));
              if (d < best) {
                best = d;
                t1 = u;
                t2 = v;
              }
            }
        }
        EXPECT_NEAR(set.nearest(x.data()).distance, best, 1e-9);  // the last grid's 1/15/5^8 at gap 1e-3
        EXPECT_NEAR(std::fabs(y[0]), best, 1e-9);
      }
    }
  }
}

// Patches that are passed over, and starts that are left out, have no nearer point, however far the tool is;
// a patch that is preferred is looked at first and changes nothing elsewhere.
TEST(Patches, NothingIsNearerThanTheNearest) {
  Random random(46);
  std::vector<BezierPatch> patches;
  for (int n = 0; n < 6; ++n) {
    BezierPatch patch = wavyPatch(n % 2 == 1, 5 + n);
    const Vector3 shift{random.between(-4, 4), random.between(-4, 4), random.between(-4, 4)};
    for (auto& point : patch.points)
      for (int c = 0; c < 3; ++c) point[c] += shift[c];
    patches.push_back(patch);
  }
  const PatchSet set(patches);
  std::vector<Vector3> samples;
  for (const BezierPatch& patch : patches)
    for (int a = -20; a <= 20; ++a)
      for (int b = -20; b <= 20; ++b) samples.push_back(at(patch, a / 20.0, b / 20.0));
  for (int i = 0; i < 400; ++i) {
    const double far = i % 4 == 0 ? 40 : 6;
    const Vector3 x{random.between(-far, far), random.between(-far, far), random.between(-far, far)};
    double least = 1e300;
    for (const Vector3& place : samples) least = std::min(least, length(sum(x, -1, place)));
    EXPECT_LE(set.nearest(x.data()).distance, least) << "point " << i;
    const auto alone = set.locate(x.data());
    for (int n = 0; n < 6; ++n) {
      const auto preferred = set.locate(x.data(), n);
      for (int d = 0; d < 3; ++d)
        EXPECT_NEAR(preferred[d], alone[d], 1e-9) << "point " << i << ", patch " << n;
    }
  }
}

TEST(Patches, DerivativesThreeWays) {
  Random random(46);
  for (const bool rational : {false, true}) {
    const BezierPatch patch = wavyPatch(rational, 6);
    const PatchSet set({patch});
    const PatchProjection law{set.tool()};
    for (int i = 0; i < 12; ++i) {
      // Corners and edges of the patch among them: the law goes on beyond.
      Vector3 n;
      const double t1 = i == 0 ? 0.9999 : random.between(-1, 1), t2 = i < 2 ? -0.9999 : random.between(-1, 1);
      const Vector3 foot = at(patch, t1, t2, &n);
      const Vector3 x = sum(foot, i % 3 == 0 ? -0.1 : i % 3 == 1 ? 1e-6 : 0.1, n);
      const double data[3] = {0, t1, t2};
      double y[6], jacobian[18];
      taylor::tangent(law, x.data(), data, y, jacobian);
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(jacobian[j], y[1 + j], 1e4 * eps);  // n = grad h
      const Vector3 d = random.direction();
      std::array<double, 6> slope{};
      for (int r = 0; r < 6; ++r)
        for (int j = 0; j < 3; ++j) slope[r] += jacobian[3 * r + j] * d[j];
      const auto f = [&](double step) {
        std::array<double, 6> value;
        taylor::value(law, sum(x, step, d).data(), data, value.data());
        return value;
      };
      expectDerivative(f, slope, 0.01, 1000 * eps, "wavy");
      Coefficients in(3, std::vector<Values>(2));
      for (int c = 0; c < 3; ++c) {
        in[c][0] = x[c];
        in[c][1] = d[c];
      }
      const Values lanes[3] = {data[0], data[1], data[2]};
      const auto r = runSeries(law, in, Mode::AsASolver, lanes);
      for (int c = 0; c < 6; ++c)
        EXPECT_NEAR(r.out[c][1][L - 1], slope[c], 1e5 * eps * (1 + std::fabs(slope[c])));
    }
  }
}

// Eight points, each over a patch of its own: the series of (h, n, t) put into (13) in long double.
TEST(Patches, OrdersTo20WithAPatchForEveryLane) {
  Random random(47);
  for (const bool rational : {false, true}) {
    std::vector<BezierPatch> patches;
    for (unsigned n = 0; n < L; ++n) {
      patches.push_back(wavyPatch(rational, 10 + n));
      for (auto& point : patches.back().points) point[2] += 5.0 * n;
    }
    const PatchSet set(patches);
    const PatchTool& tool = set.tool();
    Coefficients x(3, std::vector<Values>(21));
    Values data[3];
    for (int l = 0; l < L; ++l) {
      Vector3 n;
      const double t1 = random.between(-1, 1), t2 = random.between(-1, 1);
      const Vector3 start = sum(at(patches[l], t1, t2, &n), random.between(-0.1, 0.1), n);
      data[0][l] = l;
      data[1][l] = t1;
      data[2][l] = t2;
      for (int k = 0; k <= 20; ++k) {
        const Vector3 c = k == 0 ? start : scaled(0.03 * std::pow(0.4, k - 1), random.direction());
        for (int i = 0; i < 3; ++i) x[i][k][l] = c[i];
      }
    }
    for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
      const auto r = runSeries(PatchProjection{tool}, x, mode, data);
      for (int l = 0; l < L; ++l) {
        LongSeries in[3], y[6], g[6];
        for (int i = 0; i < 3; ++i) in[i] = lane(x[i], l);
        for (int i = 0; i < 6; ++i) y[i] = lane(r.out[i], l);
        const double one[3] = {data[0][l], data[1][l], data[2][l]};
        tool(in, y, one, g);
        for (int i = 0; i < 6; ++i)
          for (int k = 0; k <= 20; ++k)
            // Terms up to 40, orders that decay at least as 0.7^k.
            ASSERT_NEAR(static_cast<double>(g[i].at(k)), 0.0, 1000 * 40 * eps * std::pow(0.7, k))
                << "equation " << i << " order " << k << " lane " << l;
      }
    }
  }
}

TEST(Patches, TwoSideBySideAreOne) {
  Random random(48);
  const BezierPatch patch = wavyPatch(true, 7);
  const PatchSet one({patch});
  for (const int d : {0, 1}) {
    const PatchSet two(halves(patch, d));
    for (int i = 0; i < 40; ++i) {
      Vector3 n;
      // About the common border too.
      const double near = i % 4 == 0 ? random.between(-1e-3, 1e-3) : random.between(-1, 1);
      const double other = random.between(-1, 1);
      const Vector3 foot = at(patch, d == 0 ? near : other, d == 0 ? other : near, &n);
      const Vector3 x = sum(foot, random.between(-0.1, reach), n);
      const auto y = project(one, x), z = project(two, x);
      for (int c = 0; c < 4; ++c) EXPECT_NEAR(z[c], y[c], 1e4 * eps) << "direction " << d;
    }
  }
}

TEST(Patches, PointsCrossBordersAndLeaveAtTheEdge) {
  const BezierPatch patch = wavyPatch(true, 8);
  const PatchSet one({patch}), two(halves(patch, 0));
  Vector3 n;
  const Vector3 start = at(patch, -0.8, 0.3, &n);
  const Vector3 from = sum(start, 0.2, n);
  auto data = two.locate(from.data());
  EXPECT_EQ(data[0], 0);
  std::vector<PatchSet::Event> events;
  for (int i = 0; i <= 60; ++i) {  // along x, from the first half over the second and off its edge
    const Vector3 x = sum(from, 0.06 * i, {1, 0, 0});
    const auto following = two.follow(x.data(), data.data());
    // Halves of one polynomial: the old one goes on as the new one does.
    EXPECT_LT(following.mismatch, 1e-12);
    if (following.event != PatchSet::Event::Stays) events.push_back(following.event);
    if (data[0] < 0) break;
    double y[6];
    taylor::solveImplicit<3, 6, 3>(two.tool(), x.data(), data.data(), y);
    const auto exact = project(one, x);
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(y[c], exact[c], 1e4 * eps) << i;
  }
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0], PatchSet::Event::Crosses);
  EXPECT_EQ(events[1], PatchSet::Event::Leaves);
  // Back over the surface: found again from above, not from below.
  const auto center = at(patch, 0.5, 0, &n);
  EXPECT_EQ(two.follow(sum(center, -0.1, n).data(), data.data()).event, PatchSet::Event::Stays);
  EXPECT_LT(data[0], 0);
  EXPECT_EQ(two.follow(sum(center, 0.1, n).data(), data.data()).event, PatchSet::Event::Reaches);
  EXPECT_EQ(data[0], 1);
}

// Steps as path following makes them: data brought up to date, series of the force from there, their sum at
// the step's end; against the surface as one patch, whose data need no change. The point runs over the border
// of two halves inside a step and off their edge.
TEST(Patches, SeriesOfStepsRunOverABorder) {
  const BezierPatch patch = wavyPatch(true, 8);
  const PatchSet one({patch}), two(halves(patch, 0));
  const RegularisedPressure pressure{1e-2, 0.1};
  const ContactLaw<PatchTool> lawOne{one.tool(), pressure}, lawTwo{two.tool(), pressure};
  Vector3 n;
  Vector3 x = sum(at(patch, -0.8, 0.3, &n), 0.3, n);
  const Vector3 velocity = unit({1, 0.1, 0.02});
  auto placeOne = one.locate(x.data()), placeTwo = two.locate(x.data());
  const double step = 0.13;
  int crossed = 0, carried = 0;
  for (int i = 0; i < 30; ++i, x = sum(x, step, velocity)) {
    one.follow(x.data(), placeOne.data());
    const auto event = two.follow(x.data(), placeTwo.data()).event;
    crossed += event == PatchSet::Event::Crosses ? 1 : 0;
    ASSERT_EQ(placeOne[0] < 0, placeTwo[0] < 0) << i;
    if (placeTwo[0] < 0) break;
    ++carried;
    Coefficients in(3, std::vector<Values>(21, Values(0.0)));
    Values dataOne[4] = {0.3}, dataTwo[4] = {0.3};
    for (int d = 0; d < 3; ++d) {
      in[d][0] = x[d];
      in[d][1] = step * velocity[d];
      dataOne[1 + d] = placeOne[d];
      dataTwo[1 + d] = placeTwo[d];
    }
    const auto a = runSeries(lawOne, in, Mode::AsASolver, dataOne);
    const auto b = runSeries(lawTwo, in, Mode::AsASolver, dataTwo);
    const double end[4] = {0.3, placeTwo[0], placeTwo[1], placeTwo[2]};
    double exact[3];
    taylor::value(lawTwo, sum(x, step, velocity).data(), end, exact);
    for (int c = 0; c < 3; ++c) {
      double sumOne = 0, sumTwo = 0;
      for (int k = 0; k <= 20; ++k) {
        sumOne += a.out[c][k][0];
        sumTwo += b.out[c][k][0];
      }
      EXPECT_NEAR(sumTwo, sumOne, 1e5 * eps) << i;  // 20 orders of the same series in other parameters
      // The step is about half the radius, sqrt(h^2 + 4 eta Delta/alpha) >= 0.25: 0.13/0.25 to the power 21.
      EXPECT_NEAR(sumTwo, exact[c], 1e-5) << i;
    }
  }
  EXPECT_EQ(crossed, 1);
  EXPECT_GT(carried, 15);
  EXPECT_LT(carried, 25);
}

// Around a closed surface, over the border where the knots begin and end.
TEST(Patches, PointsGoRoundACylinder) {
  const Cylinder cylinder{{1, 2, 3}, {0, 1, 0}, 2};
  const PatchSet set(nurbsCylinder(cylinder, 5).patches());
  const auto [e, f] = normalsTo({0, 1, 0});
  auto place = [&](double angle) {
    return sum(sum(sum({1, 2, 3}, 2.5 * std::cos(angle), e), 2.5 * std::sin(angle), f), 1, {0, 1, 0});
  };
  auto data = set.locate(place(0.1).data());
  const double first = data[0];
  int crossings = 0;
  for (double angle = 0.1; angle < 0.1 + 2 * std::acos(-1.0); angle += 0.2) {
    crossings += set.follow(place(angle).data(), data.data()).event == PatchSet::Event::Crosses ? 1 : 0;
    double y[6];
    taylor::solveImplicit<3, 6, 3>(set.tool(), place(angle).data(), data.data(), y);
    EXPECT_NEAR(y[0], 0.5, 100 * 10 * eps);
  }
  set.follow(place(0.1).data(), data.data());
  EXPECT_GE(crossings, 3);
  EXPECT_EQ(data[0], first);
}

// Beyond the edge of the set: no force, at any order, beside lanes that have one; gap infinite.
TEST(Patches, OffTheEdgeIsNoContact) {
  const BezierPatch patch = wavyPatch(false, 9);
  const PatchSet set({patch});
  const Vector3 off{4.5, 1.5, 0.05};
  EXPECT_LT(set.locate(off.data())[0], 0);
  EXPECT_GT(set.nearest(off.data()).distance, 1.0);
  Vector3 n;
  const Vector3 over = sum(at(patch, 0.1, 0.2, &n), 0.05, n);
  for (const double compliance : {0.0, 1e-3}) {
    const ContactLaw<PatchTool> law{set.tool(), {compliance, 0.1}};
    Coefficients x(3, std::vector<Values>(21, Values(0.0)));
    Values data[4];
    for (int l = 0; l < L; ++l) {
      const Vector3& p = l % 2 == 0 ? over : off;
      const auto place = set.locate(p.data());
      data[0][l] = 0.3;
      for (int d = 0; d < 3; ++d) data[1 + d][l] = place[d];
      for (int c = 0; c < 3; ++c) {
        x[c][0][l] = p[c];
        x[c][1][l] = 0.01 * (c + 1);
      }
    }
    const auto r = runSeries(law, x, Mode::AsASolver, data);
    for (int k = 0; k <= 20; ++k)
      for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(r.out[i][k][1], 0.0) << "order " << k;
        EXPECT_FALSE(std::isnan(r.out[i][k][0]));
      }
    EXPECT_LT(r.out[2][0][0], -0.1);  // -R n, R = 0.1 * 0.25/0.05 or so
    const double one[4] = {0.3, -1, 0, 0};
    double observed[2];
    law.observe(off.data(), one, observed);
    EXPECT_TRUE(std::isinf(observed[0]));
    EXPECT_EQ(observed[1], 0.0);
  }
}

TEST(Patches, LossOfUniquenessIsSaidInWords) {
  const Cylinder cylinder{{0, 0, 0}, {0, 1, 0}, 2, false};
  // A quarter of a hollow cylinder: its axis is the line of centres of curvature.
  const auto all = nurbsCylinder(cylinder, 5).patches();
  const PatchSet quarter({all[0]}, true);
  EXPECT_NE(quarter.ambiguity(Vector3{0, 1, 0}.data()).find("centre of curvature"), std::string::npos);
  EXPECT_EQ(quarter.ambiguity(
                sum({0, 1, 0}, 1.0, unit(sum(normalsTo({0, 1, 0})[0], 1, normalsTo({0, 1, 0})[1]))).data()),
            "");
  // Between two parallel plates.
  BezierPatch low, high;
  low.points = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
  high.points = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
  const PatchSet plates({low, high});
  EXPECT_NE(plates.ambiguity(Vector3{0.4, 0.3, 0.5}.data()).find("equally near"), std::string::npos);
  EXPECT_EQ(plates.ambiguity(Vector3{0.4, 0.3, 0.4}.data()), "");
}

TEST(Patches, BadSurfacesAreRefused) {
  const auto changed = [](auto change) {
    NurbsSurface s = nurbsCylinder(Cylinder{}, 1);
    change(s);
    return s.patches();
  };
  expectRefused([&] { changed([](auto& s) { s.degree[0] = 0; }); }, "degree must be 1 to 20, got 0");
  expectRefused([&] { changed([](auto& s) { s.knots[0].pop_back(); }); },
                "needs count + degree + 1 = 12 knots, got 11");
  expectRefused([&] { changed([](auto& s) { s.knots[0][5] = 0.5; }); }, "knots must ascend, got 0.5 after 1");
  expectRefused([&] { changed([](auto& s) { s.knots[0][5] = 1; }); },
                "knot 1 is repeated more than 2 times (degree 2)");
  expectRefused([&] { changed([](auto& s) { s.weights[3] = 0; }); }, "weight must be > 0 and finite, got 0");
  expectRefused([&] { changed([](auto& s) { s.weights.pop_back(); }); }, "needs 18 weights or none, got 17");
  expectRefused([&] { changed([](auto& s) { s.points.pop_back(); }); }, "needs 18 control points, got 17");
  expectRefused([&] { changed([](auto& s) { s.points[2][1] = std::nan(""); }); },
                "control point must be finite");
  expectRefused([&] { changed([](auto& s) { s.count = {2, 2}; }); }, "needs at least 3 control points");
  expectRefused([] { PatchSet({}); }, "needs at least one patch");
  BezierPatch collapsed;  // a side that is one point
  collapsed.points = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  expectRefused([&] { PatchSet({collapsed}); }, "the normal of patch 1 vanishes at (0, 0, 0)");
  expectRefused([] { PatchTool{}.validate(); }, "has no patches");
}

}  // namespace
