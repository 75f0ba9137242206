#include "TwoFold.hpp"

#include <algorithm>
#include <cmath>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>

#include "atrapos/linear/Dot.hpp"
#include "atrapos/path/Polynomial.hpp"

namespace atrapos::path {

namespace {

using Pair = std::array<double, 2>;

/// f(c) of a binary form by Horner's rule.
double valueOf(const std::vector<double>& f, const Pair& c) {
  const int d = static_cast<int>(f.size()) - 1;
  double sum = 0;
  for (int i = 0; i <= d; ++i) sum += f[i] * std::pow(c[0], d - i) * std::pow(c[1], i);
  return sum;
}

std::vector<double> product(const std::vector<double>& f, const std::vector<double>& g) {
  return (Polynomial(f) * Polynomial(g)).coefficients();
}

double largest(const std::vector<double>& f) {
  double size = 0;
  for (const double x : f) size = std::max(size, std::abs(x));
  return size;
}

/// A binary form of degree 2 or 3 through its values: at (1, 0), (0, 1), (1, 1), (1, -1).
std::vector<double> quadraticForm(double v10, double v01, double v11) { return {v10, v11 - v10 - v01, v01}; }
std::vector<double> cubicForm(double v10, double v01, double v11, double v1m) {
  const double sum = v11 - v10 - v01, difference = v1m - v10 + v01;
  return {v10, 0.5 * (sum - difference), 0.5 * (sum + difference), v01};
}

}  // namespace

std::vector<std::array<double, 2>> rootsOfForm(const std::vector<double>& f) {
  std::vector<Pair> roots;
  const int d = static_cast<int>(f.size()) - 1;
  if (!(largest(f) > 0)) return roots;
  // Seen in axes turned by an angle that no symmetry has, no root lies on an axis: f(c) with
  // c = cos(t) e_1 + sin(t) e_2, once by m = tan t, once by 1/m, each in [-1, 1].
  constexpr double turn = 0.2345;
  const Pair e1{std::cos(turn), std::sin(turn)}, e2{-std::sin(turn), std::cos(turn)};
  std::vector<double> g{0};
  for (int i = 0; i <= d; ++i) {
    std::vector<double> term{f[i]};
    for (int j = 0; j < d; ++j)
      term = j < d - i ? product(term, {e1[0], e2[0]}) : product(term, {e1[1], e2[1]});
    g = Polynomial(g).plus(1, Polynomial(term)).coefficients();
  }
  g.resize(d + 1, 0.0);
  for (const bool reversed : {false, true})
    for (const double sense : {1.0, -1.0}) {
      auto h = g;
      if (reversed) std::reverse(h.begin(), h.end());
      for (int i = 1; i <= d; i += 2) h[i] *= sense;
      for (const double m : Polynomial(h).roots(1)) {
        const double first = reversed ? sense * m : 1, second = reversed ? 1 : sense * m;
        Pair c{first * e1[0] + second * e2[0], first * e1[1] + second * e2[1]};
        const double size = std::hypot(c[0], c[1]);
        c = {c[0] / size, c[1] / size};
        // A root on the diagonal is seen from both sides, a double root is one direction.
        constexpr double same = 1e-4;
        if (std::none_of(roots.begin(), roots.end(), [&](const Pair& other) {
              return std::abs(c[0] * other[1] - c[1] * other[0]) < same;
            }))
          roots.push_back(c);
      }
    }
  return roots;
}

std::vector<Augmented> twoFoldTangents(Calls& calls, const State& state, double w, const Augmented& path,
                                       const std::array<RCP<Vector>, 2>& phi) {
  Augmented t = copy(path);
  scale(t, 1 / std::sqrt(dot(t, t, w)));
  std::array<RCP<Vector>, 2> v;  // unit in the same norm as t
  for (int i = 0; i < 2; ++i) {
    v[i] = Teuchos::rcp(new Vector(*phi[i], Teuchos::Copy));
    v[i]->scale(1 / (std::sqrt(w) * phi[i]->norm2()));
  }
  const auto inKernel = [&](double x, double y) {
    Augmented c{calls.newVector(), 0};
    c.u->update(x, *v[0], y, *v[1], 0);
    return c;
  };
  const std::array<Pair, 4> samples{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
  std::vector<double> B[2], Q[2];
  double size = 0;
  for (int j = 0; j < 2; ++j) {
    SecondOrder second(calls, state, v[j]);
    B[j] = {second(t, {v[0], 0}), second(t, {v[1], 0})};
    Q[j] = quadraticForm(second(inKernel(1, 0)), second(inKernel(0, 1)), second(inKernel(1, 1)));
    size = std::max({size, std::abs(B[j][0]), std::abs(B[j][1])});
  }
  const auto combine = [](const std::vector<double>& f0, const std::vector<double>& f1,
                          const std::vector<double>(&g)[2]) {
    return Polynomial(product(f0, g[1])).plus(-1, Polynomial(product(f1, g[0]))).coefficients();
  };
  std::vector<Augmented> tangents;
  const auto keep = [&](double along, const Pair& c) {
    Augmented x = inKernel(c[0], c[1]);
    add(x, along, t);
    scale(x, 1 / std::sqrt(dot(x, x, w)));
    tangents.push_back(std::move(x));
  };
  const auto alongPath = [&](const Pair& c, const std::vector<double>(&f)[2], double factor) {
    // f_j(c) + along / factor * B_j(c) = 0, the larger of the two.
    const double b0 = valueOf(B[0], c), b1 = valueOf(B[1], c);
    return -factor * (std::abs(b0) > std::abs(b1) ? valueOf(f[0], c) / b0 : valueOf(f[1], c) / b1);
  };
  // Quadratic terms turn a branch away from the plane of the null vectors by Q/(2B); below the accuracy of
  // the null vectors they are none.
  constexpr double none = 1e-4;
  if (std::max(largest(Q[0]), largest(Q[1])) > none * size) {
    const auto form = combine(Q[0], Q[1], B);
    if (largest(form) > none * none * size * size)
      for (const Pair& c : rootsOfForm(form)) keep(alongPath(c, Q, 0.5), c);
    return tangents;
  }
  // Cubic: U = c + a^2 (w_2 + tau t), K w_2 = F_2, w_2 normal to the null vectors.
  Bordered M;
  auto F = calls.newVector();
  M.K = calls.tangent(state, *F);
  M.columns = {phi[0], phi[1]};
  M.rows = {phi[0], phi[1]};
  double C[2][4];
  auto F2 = calls.newVector(), F3 = calls.newVector();
  for (int s = 0; s < 4; ++s) {
    const Augmented c = inKernel(samples[s][0], samples[s][1]);
    calls.beginSeries(state, 3);
    calls.orderRhs(1, *F2);
    calls.completeOrder(1, *c.u, 0);
    calls.orderRhs(2, *F2);
    const auto w2 = M.solve(calls, F2, {0, 0});
    if (!w2.good) return tangents;
    calls.completeOrder(2, *w2.x, 0);
    calls.orderRhs(3, *F3);
    for (int j = 0; j < 2; ++j) C[j][s] = -linear::dot(*v[j], *F3);
  }
  const std::vector<double> cubic[2] = {cubicForm(C[0][0], C[0][1], C[0][2], C[0][3]),
                                        cubicForm(C[1][0], C[1][1], C[1][2], C[1][3])};
  const double cubicSize = std::max(largest(cubic[0]), largest(cubic[1]));
  const auto form = combine(cubic[0], cubic[1], B);
  // Relative to what it is the difference of: a circle of branches has none that is isolated.
  constexpr double isolated = 1e-6;
  if (largest(form) > isolated * cubicSize * size)
    for (const Pair& c : rootsOfForm(form)) keep(0, c);
  return tangents;
}

}  // namespace atrapos::path
