#include "atrapos/contact/BezierPatch.hpp"

#include <cmath>

#include "atrapos/contact/PatchPoint.hpp"
#include "atrapos/contact/Requirements.hpp"

namespace atrapos::contact {
namespace {

void requireDegree(const char* who, const std::array<int, 2>& degree) {
  for (const int p : degree)
    if (p < 1 || p > maxPatchDegree) detail::refuse(who, "degree must be 1 to 20, got " + std::to_string(p));
}

void requirePoints(const char* who, std::size_t expected, const std::vector<std::array<double, 3>>& points,
                   const std::vector<double>& weights) {
  if (points.size() != expected)
    detail::refuse(
        who, "needs " + std::to_string(expected) + " control points, got " + std::to_string(points.size()));
  if (!weights.empty() && weights.size() != expected)
    detail::refuse(
        who, "needs " + std::to_string(expected) + " weights or none, got " + std::to_string(weights.size()));
  for (const auto& point : points)
    for (const double c : point) detail::requireFinite(who, "control point", c);
  for (const double w : weights) detail::requirePositive(who, "weight", w);
}

/// [i][k]: coefficient of t^k of the Bernstein polynomial i of degree p over t in [-1, 1], times t's powers
/// up to `degree`. Long double: the alternating sums of high degrees lose up to 2^p.
std::vector<std::vector<long double>> bernsteinToPowers(int p, int degree) {
  std::vector<std::vector<long double>> matrix;
  long double binomial = 1;
  for (int i = 0; i <= p; ++i) {
    std::vector<long double> polynomial(degree + 1, 0.0L);
    polynomial[0] = binomial;
    for (int factor = 0; factor < p; ++factor) {  // ((1 + t)/2)^i ((1 - t)/2)^(p-i)
      const long double sign = factor < i ? 0.5L : -0.5L;
      for (int k = p; k > 0; --k) polynomial[k] = 0.5L * polynomial[k] + sign * polynomial[k - 1];
      polynomial[0] *= 0.5L;
    }
    matrix.push_back(std::move(polynomial));
    binomial = binomial * (p - i) / (i + 1);
  }
  return matrix;
}

}  // namespace

void BezierPatch::validate() const {
  requireDegree("Bezier patch", degree);
  requirePoints("Bezier patch", static_cast<std::size_t>(degree[0] + 1) * (degree[1] + 1), points, weights);
}

std::vector<double> BezierPatch::coefficients(std::array<int, 2> degrees) const {
  const auto first = bernsteinToPowers(degree[0], degrees[0]);
  const auto second = bernsteinToPowers(degree[1], degrees[1]);
  std::vector<long double> sum(static_cast<std::size_t>(degrees[0] + 1) * (degrees[1] + 1) * 4, 0.0L);
  for (int a = 0; a <= degree[0]; ++a)
    for (int b = 0; b <= degree[1]; ++b) {
      const std::size_t n = static_cast<std::size_t>(a) * (degree[1] + 1) + b;
      const long double w = weights.empty() ? 1 : weights[n];
      const long double homogeneous[4] = {w * points[n][0], w * points[n][1], w * points[n][2], w};
      for (int i = 0; i <= degree[0]; ++i)
        for (int j = 0; j <= degree[1]; ++j)
          for (int c = 0; c < 4; ++c)
            sum[(static_cast<std::size_t>(i) * (degrees[1] + 1) + j) * 4 + c] +=
                first[a][i] * second[b][j] * homogeneous[c];
    }
  return {sum.begin(), sum.end()};
}

void NurbsSurface::validate() const {
  const char* who = "NURBS surface";
  requireDegree(who, degree);
  for (int d = 0; d < 2; ++d) {
    const auto& u = knots[d];
    const int p = degree[d], n = count[d];
    if (n < p + 1)
      detail::refuse(who, "degree " + std::to_string(p) + " needs at least " + std::to_string(p + 1) +
                              " control points in its direction, got " + std::to_string(n));
    if (static_cast<int>(u.size()) != n + p + 1)
      detail::refuse(who, "needs count + degree + 1 = " + std::to_string(n + p + 1) + " knots, got " +
                              std::to_string(u.size()));
    int multiplicity = 0;
    for (std::size_t k = 0; k < u.size(); ++k) {
      detail::requireFinite(who, "knot", u[k]);
      if (k > 0 && u[k] < u[k - 1])
        detail::refuse(who,
                       "knots must ascend, got " + detail::shown(u[k]) + " after " + detail::shown(u[k - 1]));
      multiplicity = k > 0 && u[k] == u[k - 1] ? multiplicity + 1 : 1;
      const bool end = u[k] == u.front() || u[k] == u.back();
      if (multiplicity > p + (end ? 1 : 0))
        detail::refuse(who, "knot " + detail::shown(u[k]) + " is repeated more than " +
                                std::to_string(p + (end ? 1 : 0)) + " times (degree " + std::to_string(p) +
                                ")");
    }
    if (!(u[p] < u[n])) detail::refuse(who, "its knots span no surface");
  }
  requirePoints(who, static_cast<std::size_t>(count[0]) * count[1], points, weights);
}

namespace {

using Homogeneous = std::array<double, 4>;

/// Control point j of the Bezier form of a B-spline's span [u_k, u_(k+1)]: its polar form at p - j times u_k
/// and j times u_(k+1). d: the span's p + 1 control points, overwritten.
Homogeneous polarForm(const std::vector<double>& u, int p, int k, int j, std::vector<Homogeneous>& d) {
  for (int r = 1; r <= p; ++r) {
    const double argument = r <= p - j ? u[k] : u[k + 1];
    for (int i = p; i >= r; --i) {  // d[i] belongs to control point k - p + i
      const int m = k - p + i;
      const double part = (argument - u[m]) / (u[m + p - r + 1] - u[m]);
      for (int c = 0; c < 4; ++c) d[i][c] = (1 - part) * d[i - 1][c] + part * d[i][c];
    }
  }
  return d[p];
}

}  // namespace

std::vector<BezierPatch> NurbsSurface::patches() const {
  validate();
  const int p = degree[0], q = degree[1];
  const auto control = [&](int i, int j) {
    const std::size_t n = static_cast<std::size_t>(i) * count[1] + j;
    const double w = weights.empty() ? 1 : weights[n];
    return Homogeneous{w * points[n][0], w * points[n][1], w * points[n][2], w};
  };
  std::vector<BezierPatch> result;
  for (int k = p; k < count[0]; ++k) {
    if (!(knots[0][k] < knots[0][k + 1])) continue;
    for (int l = q; l < count[1]; ++l) {
      if (!(knots[1][l] < knots[1][l + 1])) continue;
      BezierPatch patch;
      patch.degree = degree;
      for (int a = 0; a <= p; ++a)
        for (int b = 0; b <= q; ++b) {
          std::vector<Homogeneous> row(q + 1), column(p + 1);
          for (int i = 0; i <= p; ++i) {
            for (int j = 0; j <= q; ++j) row[j] = control(k - p + i, l - q + j);
            column[i] = polarForm(knots[1], q, l, b, row);
          }
          const Homogeneous h = polarForm(knots[0], p, k, a, column);
          patch.points.push_back({h[0] / h[3], h[1] / h[3], h[2] / h[3]});
          if (!weights.empty()) patch.weights.push_back(h[3]);
        }
      result.push_back(std::move(patch));
    }
  }
  return result;
}

}  // namespace atrapos::contact
