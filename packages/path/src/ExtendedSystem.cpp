#include "ExtendedSystem.hpp"

#include <cmath>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>

#include "atrapos/linear/Dot.hpp"

namespace atrapos::path {

namespace {

/// Null vector of the factored matrix (or of its transpose) by inverse iteration from x, Euclidean norm 1.
/// `weights`: what eigenvalues are measured by; null: 1.
void inverseIteration(Calls& calls, const RCP<const Vector>& weights, Vector& x, bool transposed) {
  auto y = calls.newVector();
  x.scale(1 / x.norm2());
  for (int i = 0; i < 3; ++i) {
    if (!weights.is_null()) x.elementWiseMultiply(1, *weights, x, 0);
    transposed ? calls.solveTransposed(x, *y) : calls.solve(x, *y);
    const double size = y->norm2();
    if (!std::isfinite(size) || !(size > 0)) return;
    x.update(1 / size, *y, 0);
  }
}

}  // namespace

bool ExtendedSystem::enter(const State& state, const Augmented& path, bool held, bool exact) {
  if (held)
    calls_.tangent(state, *F_);
  else
    calls_.factor(state, *F_);
  phi_ = Teuchos::rcp(new Vector(*phi_, Teuchos::Copy));
  const auto weights = calls_.eigenvalueWeights(state);
  // Of two eigenvalues next to each other an inverse iteration finds the one nearer to zero here.
  if (exact)
    phi_->scale(1 / phi_->norm2());
  else
    inverseIteration(calls_, weights, *phi_, false);
  p_ = Teuchos::rcp(new Vector(*phi_, Teuchos::Copy));
  if (!calls_.problem().symmetric()) inverseIteration(calls_, weights, *p_, true);

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

bool ExtendedSystem::solveM(const Bordered& M, const RCP<const Vector>& b, double beta0, double beta1,
                            Augmented& x, double& z) const {
  const auto s = M.solve(calls_, b, {beta0, beta1});
  if (!s.good) return false;
  x = {s.x, s.xi[0]};
  z = s.xi[1];
  return true;
}

bool ExtendedSystem::iterate(State& state, double& moved) {
  // M = [K, -F, p; Q^T, 0] at the state, with the factorization of `enter` as preconditioner.
  Bordered M;
  M.K = calls_.tangent(state, *F_);
  auto r = calls_.newVector();
  const auto forces = calls_.residual(state, *r);
  const double displaced = state.u->norm2();
  if (displaced > 0) M.stiffness = forces.scale / displaced;
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
  T.stiffness = M.stiffness;
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
  state = state.at(u, state.lambda + dx.lambda);
  return true;
}

}  // namespace atrapos::path
