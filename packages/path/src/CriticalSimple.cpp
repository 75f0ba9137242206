#include <algorithm>
#include <cmath>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>

#include "Critical.hpp"
#include "atrapos/linear/Dot.hpp"

namespace atrapos::path {

namespace {

/// Null vector of the factored matrix (or of its transpose) by inverse iteration from x, Euclidean norm 1.
void inverseIteration(Calls& calls, Vector& x, bool transposed) {
  auto y = calls.newVector();
  x.scale(1 / x.norm2());
  for (int i = 0; i < 3; ++i) {
    transposed ? calls.solveTransposed(x, *y) : calls.solve(x, *y);
    const double size = y->norm2();
    if (!std::isfinite(size) || !(size > 0)) return;
    x.update(1 / size, *y, 0);
  }
}

/// Newton on the extended system of a simple bifurcation point.
class Refinement {
 public:
  Refinement(Calls& calls, const CriticalSearch& search, const RCP<Vector>& nullGuess)
      : calls_(calls), search_(search), w_(search.series.weight()), phi_(nullGuess), F_(calls.newVector()) {}

  /// The tangent at `state` is factored and borders it.
  bool enter(const State& state, const Augmented& path);
  /// One Newton step from `state` (moved); `moved` is its size in w <U, U> + lambda^2.
  bool iterate(State& state, double& moved);

  const Augmented& V(int i) const { return V_[i]; }
  double H(int i, int j) const { return H_[i][j]; }
  const RCP<Vector>& psi() const { return psi_; }
  const RCP<Vector>& phi() const { return phi_; }
  double unfolding() const { return z_ * p_->norm2(); }

 private:
  /// M [x; z] = [b; beta].
  bool solveM(const Bordered& M, const RCP<const Vector>& b, double beta0, double beta1, Augmented& x,
              double& z) const;

  Calls& calls_;
  const CriticalSearch& search_;
  double w_;
  RCP<Vector> phi_, F_, p_, psi_;
  Augmented Q_[2], V_[2];
  double H_[2][2] = {{0, 0}, {0, 0}};
  double z_ = 0;
};

bool Refinement::enter(const State& state, const Augmented& path) {
  calls_.factor(state, *F_);
  phi_ = Teuchos::rcp(new Vector(*phi_, Teuchos::Copy));
  inverseIteration(calls_, *phi_, false);
  p_ = Teuchos::rcp(new Vector(*phi_, Teuchos::Copy));
  if (!calls_.problem().symmetric()) inverseIteration(calls_, *p_, true);

  // Two directions that nearly span the kernel of [K, -F]: the null vector, and the response to the load with
  // the null vector taken out of it, which exists where the load has no part along p.
  Augmented first{Teuchos::rcp(new Vector(*phi_, Teuchos::Copy)), 0};
  Augmented second{calls_.newVector(), 1};
  auto load = Teuchos::rcp(new Vector(*F_, Teuchos::Copy));
  load->update(-linear::dot(*p_, *F_), *p_, 1);
  calls_.solve(*load, *second.u);
  second.u->update(-linear::dot(*phi_, *second.u), *phi_, 1);
  scale(first, 1 / std::sqrt(dot(first, first, w_)));
  add(second, -dot(second, first, w_), first);
  scale(second, 1 / std::sqrt(dot(second, second, w_)));
  // The path must lie in their plane, or this is not the neighbourhood of a bifurcation point on it.
  const double inPlane = std::hypot(dot(path, first, w_), dot(path, second, w_));
  constexpr double fairly = 0.8;
  if (!(inPlane > fairly * std::sqrt(dot(path, path, w_)))) return false;
  Q_[0] = first;
  Q_[1] = second;
  return true;
}

bool Refinement::solveM(const Bordered& M, const RCP<const Vector>& b, double beta0, double beta1,
                        Augmented& x, double& z) const {
  const auto s = M.solve(calls_, b, {beta0, beta1});
  if (!s.good) return false;
  x = {s.x, s.xi[0]};
  z = s.xi[1];
  return true;
}

bool Refinement::iterate(State& state, double& moved) {
  // M = [K, -F, p; Q^T, 0] at the state, with the factorization of `enter` as preconditioner.
  Bordered M;
  M.K = calls_.tangent(state, *F_);
  auto minusF = Teuchos::rcp(new Vector(*F_, Teuchos::Copy));
  minusF->scale(-1);
  RCP<Vector> q[2];
  for (int i = 0; i < 2; ++i) {
    q[i] = Teuchos::rcp(new Vector(*Q_[i].u, Teuchos::Copy));
    q[i]->scale(w_);
    M.rows[i] = q[i];
    M.d[i][0] = Q_[i].lambda;
  }
  M.columns = {minusF, p_};
  Bordered T;
  T.K = M.K;
  T.transposed = !calls_.problem().symmetric();
  T.columns = {q[0], q[1]};
  T.rows = {minusF, p_};
  T.d[0][0] = Q_[0].lambda;
  T.d[0][1] = Q_[1].lambda;

  const auto zero = calls_.newVector();
  double unused = 0;
  for (int i = 0; i < 2; ++i)
    if (!solveM(M, zero, i == 0, i == 1, V_[i], unused)) return false;
  const auto left = T.solve(calls_, zero, {0, 1});
  if (!left.good) return false;
  psi_ = left.x;
  const double g[2] = {left.xi[0], left.xi[1]};

  auto r = calls_.newVector();
  calls_.residual(state, *r);
  r->scale(-1);
  Augmented dx;
  if (!solveM(M, r, 0, 0, dx, z_)) return false;

  // g_i' y = -psi . D^2R(y, V_i)
  SecondOrder second(calls_, state, psi_);
  H_[0][0] = second(V_[0]);
  H_[1][1] = second(V_[1]);
  H_[0][1] = H_[1][0] = second(V_[0], V_[1]);
  double rhs[2] = {g[0], g[1]};
  const double size = std::sqrt(dot(dx, dx, w_));
  if (size > 0) {
    Augmented unit = copy(dx);
    scale(unit, 1 / size);
    for (int i = 0; i < 2; ++i) rhs[i] -= size * second(unit, V_[i]);
  }
  // H c = g + g'(dx)
  const double det = H_[0][0] * H_[1][1] - H_[0][1] * H_[1][0];
  const double c0 = (H_[1][1] * rhs[0] - H_[0][1] * rhs[1]) / det;
  const double c1 = (H_[0][0] * rhs[1] - H_[1][0] * rhs[0]) / det;
  add(dx, c0, V_[0]);
  add(dx, c1, V_[1]);
  moved = std::sqrt(dot(dx, dx, w_));
  if (!std::isfinite(moved)) return false;
  auto u = Teuchos::rcp(new Vector(*state.u, Teuchos::Copy));
  u->update(1, *dx.u, 1);
  state = {u, state.lambda + dx.lambda};
  return true;
}

/// The tangents of the two branches: roots of H_00 x^2 + 2 H_01 x y + H_11 y^2 = 0 (algebraic bifurcation
/// equation), as directions x V_0 + y V_1. False where they are not real and distinct.
bool branches(const Refinement& r, double w, std::vector<Augmented>& tangents) {
  const double A = r.H(0, 0), B = r.H(0, 1), C = r.H(1, 1);
  const double size = std::abs(A) + std::abs(B) + std::abs(C), disc = B * B - A * C;
  // Two tangents closer than a thousandth are one, to the accuracy of a second derivative.
  if (!(disc > 1e-6 * size * size)) return false;
  const double s = B >= 0 ? B + std::sqrt(disc) : B - std::sqrt(disc);
  const double roots[2][2] = {{-C, s}, {-s, A}};  // both free of cancellation
  for (const auto& xy : roots) {
    Augmented t = copy(r.V(0));
    scale(t, xy[0]);
    add(t, xy[1], r.V(1));
    scale(t, 1 / std::sqrt(dot(t, t, w)));
    tangents.push_back(t);
  }
  return true;
}

/// Where the step's series passes nearest to a point, and how far from it.
std::pair<double, double> nearest(Calls& calls, const Series& series, const State& point, double guess) {
  auto u = calls.newVector();
  const double w = series.weight();
  double a = guess, distance = 0;
  for (int i = 0; i < 3; ++i) {
    const double lambda = series.evaluate(a, *u);
    const auto t = series.tangent(a);
    const Augmented direction{t.x.u, t.lambda};
    Augmented gap{Teuchos::rcp(new Vector(*point.u, Teuchos::Copy)), point.lambda - lambda};
    gap.u->update(-1, *u, 1);
    distance = std::sqrt(dot(gap, gap, w));
    a += dot(gap, direction, w) / dot(direction, direction, w);
  }
  return {a, distance};
}

}  // namespace

bool refineSimple(Calls& calls, const CriticalSearch& search, double guess, const RCP<Vector>& nullGuess,
                  int maxFactorizations, CriticalPoint& point, int& factorizations) {
  const double w = search.series.weight();
  Refinement refinement(calls, search, nullGuess);
  State state{calls.newVector(), 0};
  state.lambda = search.series.evaluate(guess, *state.u);
  double a = guess, moved = search.length;
  // Newton goes on until its corrections no longer fall (rounding); one of `accepted` of the step confirms.
  constexpr double accepted = 1e-8, far = 1e-2;
  constexpr int maxIterations = 8;
  bool done = false;
  for (int f = 0; f < maxFactorizations && !done; ++f) {
    const auto t = search.series.tangent(std::clamp(a, 0.0, search.length));
    try {
      ++factorizations;
      if (!refinement.enter(state, {t.x.u, t.lambda})) return false;
    } catch (const PathError& error) {
      if (error.reason() != EndReason::singularTangent) throw;
      // Hit exactly: a little aside the tangent can be factored, and Newton comes back.
      a += 1e-4 * search.length;
      state.lambda = search.series.evaluate(a, *state.u);
      continue;
    }
    double last = search.length;
    for (int i = 0; i < maxIterations; ++i) {
      double next = 0;
      if (!refinement.iterate(state, next)) break;
      moved = next;
      if (moved == 0 || moved > 0.1 * last) break;
      last = moved;
    }
    done = moved <= accepted * search.length;
    a = nearest(calls, search.series, state, a).first;
    if (!done && !(std::abs(a - guess) < search.length)) return false;
  }
  if (!done) return false;

  const auto [position, distance] = nearest(calls, search.series, state, a);
  auto r = calls.newVector();
  point.residual = calls.residual(state, *r).relative();
  // Not on this path, or a near miss: an imperfection larger than the bound keeps the branches apart.
  if (distance > far * search.length || point.residual > search.residualBound) return false;
  constexpr double outside = 0.01;
  if (position < -outside * search.length || position > (1 + outside) * search.length) return false;
  std::vector<Augmented> tangents;
  if (!branches(refinement, w, tangents)) return false;
  const auto t = search.series.tangent(std::clamp(position, 0.0, search.length));
  const Augmented path{t.x.u, t.lambda};
  double along[2];
  for (int i = 0; i < 2; ++i) along[i] = dot(tangents[i], path, w);
  if (std::abs(along[1]) > std::abs(along[0])) {
    std::swap(tangents[0], tangents[1]);
    std::swap(along[0], along[1]);
  }
  constexpr double sameDirection = 0.9;
  if (!(std::abs(along[0]) > sameDirection * std::sqrt(dot(path, path, w)))) return false;
  if (along[0] < 0) scale(tangents[0], -1);

  point.a = std::clamp(position, 0.0, search.length);
  point.state = state;
  point.uncertainty = moved / search.length;
  for (const auto& x : tangents) {
    PathTangent tangent;
    tangent.x = {x.u, std::vector<double>(calls.problem().internalCount(), 0.0)};
    tangent.lambda = x.lambda;
    point.tangents.push_back(tangent);
  }
  // Along one branch of a pitchfork lambda turns: its share of the unit tangent vanishes.
  constexpr double turns = 1e-4;
  const bool pitchfork = std::min(std::abs(tangents[0].lambda), std::abs(tangents[1].lambda)) < turns;
  point.kind = pitchfork ? CriticalKind::pitchfork : CriticalKind::transcritical;
  point.nullVectors = {refinement.phi()};
  // The eigenvalue that vanishes moves at the rate psi . D^2R(X', phi) along the path; it does not cross zero
  // on a branch that leaves a pitchfork.
  SecondOrder second(calls, state, refinement.psi());
  const double size =
      std::abs(refinement.H(0, 0)) + std::abs(refinement.H(0, 1)) + std::abs(refinement.H(1, 1));
  const double rate =
      second(tangents[0], {refinement.phi(), 0}) * linear::dot(*refinement.psi(), *refinement.phi());
  constexpr double crosses = 1e-6;
  const double phiSize = std::sqrt(dot({refinement.phi(), 0}, {refinement.phi(), 0}, w));
  point.negativeChange = std::abs(rate) < crosses * size * phiSize ? 0 : rate < 0 ? 1 : -1;
  return true;
}

}  // namespace atrapos::path
