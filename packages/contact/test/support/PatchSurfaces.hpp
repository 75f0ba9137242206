#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "Geometry.hpp"
#include "atrapos/contact/PatchSearch.hpp"
#include "atrapos/contact/PatchSet.hpp"
#include "atrapos/contact/RigidTool.hpp"
#include "atrapos/fem/FeProblem.hpp"

/// Surfaces of patches for tests.
namespace atrapos::contact::test {

/// A whole cylinder of four rational arcs, exact: degree 2 about the axis, 1 along it, |place| <= half.
inline NurbsSurface nurbsCylinder(const Cylinder& c, double half) {
  const auto [e, f] = normalsTo(vector(c.axis));
  NurbsSurface s;
  s.degree = {2, 1};
  s.count = {9, 2};
  s.knots[0] = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
  s.knots[1] = {0, 0, 1, 1};
  const double corner[9][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
  for (int i = 0; i < 9; ++i)
    for (const double z : {-half, half}) {
      s.points.push_back(
          sum(sum(sum(vector(c.center), c.radius * corner[i][0], e), c.radius * corner[i][1], f), z,
              vector(c.axis)));
      s.weights.push_back(i % 2 == 0 ? 1.0 : std::sqrt(0.5));
    }
  return s;
}

/// A whole cylinder of eight polynomial patches of degree p about the axis: Taylor polynomials of cosine and
/// sine about the middle of each arc, right to (pi/8)^(p+1)/(p+1)! of the radius.
inline std::vector<BezierPatch> bezierCylinder(const Cylinder& c, double half, int p) {
  const auto [e, f] = normalsTo(vector(c.axis));
  const double arc = std::acos(-1.0) / 4;
  std::vector<BezierPatch> patches;
  for (int n = 0; n < 8; ++n) {
    BezierPatch patch;
    patch.degree = {p, 1};
    // About the middle of the arc: half the arc each way; powers of s in [0, 1] from those of 2 s - 1.
    std::vector<Vector3> power(p + 1, Vector3{0, 0, 0});
    double term = 1;  // (arc/2)^k/k!
    for (int k = 0; k <= p; ++k) {
      if (k > 0) term *= arc / 2 / k;
      const double phase = (n + 0.5) * arc + k * 2 * arc;  // the k-th derivative turns by a right angle
      const Vector3 a = scaled(c.radius * term, sum(scaled(std::cos(phase), e), std::sin(phase), f));
      double binomial = 1;
      for (int m = 0; m <= k; ++m) {  // (2 s - 1)^k
        power[m] = sum(power[m], binomial * std::pow(2, m) * ((k - m) % 2 == 0 ? 1 : -1), a);
        binomial = binomial * (k - m) / (m + 1);
      }
    }
    for (int i = 0; i <= p; ++i) {
      Vector3 b{0, 0, 0};
      double share = 1;  // binomial(i, k)/binomial(p, k)
      for (int k = 0; k <= i; ++k) {
        b = sum(b, share, power[k]);
        share *= static_cast<double>(i - k) / (p - k > 0 ? p - k : 1);
      }
      for (const double z : {-half, half})
        patch.points.push_back(sum(sum(vector(c.center), 1, b), z, vector(c.axis)));
    }
    patches.push_back(patch);
  }
  return patches;
}

/// An arc of a cylinder along z about (x, y), less than half of it, exact: |z| <= half, its free side
/// outside.
inline BezierPatch arcPatch(double x, double y, double radius, double from, double to, double half) {
  BezierPatch patch;
  patch.degree = {2, 1};
  const double cosine = std::cos((to - from) / 2);
  for (int i = 0; i < 3; ++i) {
    const double angle = from + i * (to - from) / 2, r = i == 1 ? radius / cosine : radius;
    for (const double z : {-half, half}) {
      patch.points.push_back({x + r * std::cos(angle), y + r * std::sin(angle), z});
      patch.weights.push_back(i == 1 ? cosine : 1);
    }
  }
  return patch;
}

/// Two arcs with a common tangent plane at an angle: of the radius `left` about (x, y) beyond it, of `right`
/// before.
inline std::vector<BezierPatch> twoArcs(double x, double y, double left, double right, double angle) {
  const double way = left - right;
  return {arcPatch(x, y, left, angle, angle + 1.3, 1),
          arcPatch(x + way * std::cos(angle), y + way * std::sin(angle), right, angle - 1.3, angle, 1)};
}

/// A bicubic patch over [0, 3]^2, wavy by a few tenths, with weights between 0.7 and 1.3 where `rational`.
inline BezierPatch wavyPatch(bool rational, unsigned seed) {
  Random random(seed);
  BezierPatch patch;
  patch.degree = {3, 3};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      patch.points.push_back(
          {i + random.between(-0.1, 0.1), j + random.between(-0.1, 0.1), random.between(-0.4, 0.4)});
      if (rational) patch.weights.push_back(random.between(0.7, 1.3));
    }
  return patch;
}

/// The two halves of a patch in direction d, by de Casteljau.
inline std::vector<BezierPatch> halves(const BezierPatch& patch, int d) {
  using Point = std::array<double, 4>;
  const int p = patch.degree[d], stride = d == 0 ? patch.degree[1] + 1 : 1;
  std::vector<BezierPatch> both(2, patch);
  for (auto& half : both) half.weights.assign(patch.points.size(), 1.0);
  const int lines = patch.degree[1 - d] + 1, lineStride = d == 0 ? 1 : patch.degree[1] + 1;
  for (int line = 0; line < lines; ++line) {
    std::vector<Point> b(p + 1);
    for (int i = 0; i <= p; ++i) {
      const int n = line * lineStride + i * stride;
      const double w = patch.weights.empty() ? 1 : patch.weights[n];
      b[i] = {w * patch.points[n][0], w * patch.points[n][1], w * patch.points[n][2], w};
    }
    const auto put = [&](BezierPatch& half, int i, const Point& h) {
      const int n = line * lineStride + i * stride;
      half.points[n] = {h[0] / h[3], h[1] / h[3], h[2] / h[3]};
      half.weights[n] = h[3];
    };
    for (int r = 0; r <= p; ++r) {
      put(both[0], r, b[0]);
      put(both[1], p - r, b[p - r]);
      for (int i = 0; i + r < p; ++i)
        for (int c = 0; c < 4; ++c) b[i][c] = (b[i][c] + b[i + 1][c]) / 2;
    }
  }
  return both;
}

/// The search on these patches, with their tool.
inline PatchSearch<PatchTool> searchOf(const std::vector<BezierPatch>& patches) {
  const auto set = std::make_shared<const PatchSet>(patches);
  return {set, set->tool()};
}

/// Gap and normal by the law from a global search; NaN where the point is over no patch.
inline std::array<double, 4> project(const PatchSet& set, const Vector3& x) {
  const auto data = set.locate(x.data());
  if (data[0] < 0) return {std::nan(""), std::nan(""), std::nan(""), std::nan("")};
  double y[6];
  taylor::solveImplicit<3, 6, 3>(set.tool(), x.data(), data.data(), y);
  return {y[0], y[1], y[2], y[3]};
}

/// Contact of these points with patches by law (15): four data a point, found at every state. `least`:
/// smallest reference gap.
inline void addPatchContact(fem::FeModel& model, const fem::PointSet& points,
                            const PatchSearch<PatchTool>& search, const RegularisedPressure& pressure,
                            double least) {
  std::vector<double> gaps;
  for (int p = 0; p < points.numPoints(); ++p) {
    const double* x = &points.positions[3 * p];
    const auto place = search.set->locate(x);
    double y[6] = {};
    if (place[0] >= 0) taylor::solveImplicit<3, 6, 3>(search.tool, x, place.data(), y);
    gaps.push_back(std::max(y[0], least));
  }
  model.terms.push_back(rigidTool(search.set)->term(AnyPressure(pressure), points, gaps));
}

}  // namespace atrapos::contact::test
