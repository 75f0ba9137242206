#include "SingularStart.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "Augmented.hpp"
#include "Line.hpp"
#include "Newton.hpp"
#include "atrapos/linear/Dot.hpp"
#include "atrapos/linear/OnAllRanks.hpp"

namespace atrapos::path {

namespace {

/// K with a diagonal so much larger that it can be factored, and so little that its null vectors stay.
RCP<const CrsMatrix> shifted(const CrsMatrix& K) {
  auto moved = Teuchos::rcp(new CrsMatrix(K, Teuchos::Copy));
  const double rows = static_cast<double>(K.getGlobalNumRows());
  constexpr double part = 1e-8;
  const double size = K.getFrobeniusNorm() / std::sqrt(rows), shift = part * (size > 0 ? size : 1);
  moved->resumeFill();
  const auto& map = *K.getRowMap();
  for (std::size_t i = 0; i < K.getNodeNumRows(); ++i) {
    const auto row = map.getGlobalElement(static_cast<int>(i));
    moved->sumIntoGlobalValues(row, Teuchos::tuple(row), Teuchos::tuple(shift));
  }
  moved->fillComplete(K.getDomainMap(), K.getRangeMap());
  return moved;
}

void inverseIterations(Calls& calls, Vector& x, bool transposed) {
  auto y = calls.newVector();
  x.scale(1 / x.norm2());
  constexpr int iterations = 4;
  for (int i = 0; i < iterations; ++i) {
    transposed ? calls.solveTransposed(x, *y) : calls.solve(x, *y);
    x.update(1 / y->norm2(), *y, 0);
  }
}

/// The largest entries of a null vector, for a message; the same on all ranks.
std::string largestEntries(const Problem& problem, const Vector& x) {
  const std::vector<double> data = linear::onAllRanks(x);
  std::vector<int> order(data.size());
  std::iota(order.begin(), order.end(), 0);
  const int count = static_cast<int>(std::min<std::size_t>(3, data.size()));
  std::partial_sort(order.begin(), order.begin() + count, order.end(),
                    [&](int i, int j) { return std::abs(data[i]) > std::abs(data[j]); });
  std::string text = "largest entries of its null vector: ";
  for (int i = 0; i < count; ++i)
    text += line(i > 0 ? ", " : "", problem.name(order[i]), " (", data[order[i]], ')');
  return text;
}

/// Of the load factor, from the singular state to where the path starts.
double aside(const State& state) { return 1e-4 * std::max(1.0, std::abs(state.lambda)); }

}  // namespace

void SingularStart::giveUp(const PathError& cause, const std::string& why) const {
  throw PathError(cause.reason(), line("at lambda = ", path_.here.state.lambda, ": ", cause.what(),
                                       "; the path cannot start here", why));
}

void SingularStart::leave(const PathError& cause) {
  if (!mechanism_.empty()) giveUp(cause, ", nor next to it: " + mechanism_);
  Calls& calls = path_.calls;
  Position& here = path_.here;
  State state = here.state.copy();
  const auto F = calls.newVector();
  const auto K = calls.tangent(state, *F);
  NullVectors null;
  try {
    null = nullVectors(K);
  } catch (const PathError&) {
    giveUp(cause, "");
  }
  if (!std::isfinite(null.right->norm2())) giveUp(cause, "");
  mechanism_ = largestEntries(calls.problem(), *null.right);

  const double load = linear::dot(*null.left, *F);
  constexpr double none = 1e-6;
  const bool limitPoint = std::abs(load) > none * F->norm2();
  const Border border =
      limitPoint ? leaveLimitPoint(state, null, load, cause) : leaveBifurcation(state, null, K, F, cause);
  constexpr int maxHalvings = 0;
  const auto found = newton(calls, state, *here.r, border, path_.correctAbove(),
                            path_.options.maxStartIterations, maxHalvings);
  path_.outcome.startIterations += found.iterations;
  if (!found.converged) giveUp(cause, ", and no equilibrium is found next to it; " + mechanism_);
  ++path_.outcome.restarts;  // the factorization that failed
  here.state = calls.settled(state);
  here.residual = found.residual;
}

SingularStart::NullVectors SingularStart::nullVectors(const RCP<const CrsMatrix>& K) const {
  Calls& calls = path_.calls;
  auto phi = calls.newVector();
  fillUnsymmetric(*phi, 1);
  auto psi = copy(*phi);
  ++path_.outcome.restarts;
  calls.factor(shifted(*K));
  inverseIterations(calls, *phi, false);
  if (calls.problem().symmetric())
    psi = phi;
  else
    inverseIterations(calls, *psi, true);
  return {phi, psi};
}

/// The state next to a limit point, and what a correction of it keeps; `load` is psi . F.
Border SingularStart::leaveLimitPoint(State& state, const NullVectors& null, double load,
                                      const PathError& cause) const {
  const auto& tangent = path_.here.tangent;
  const double bend = SecondOrder(path_.calls, state, null.left)({null.right, 0}) / (2 * load);
  if (!std::isfinite(bend) || bend == 0) giveUp(cause, ": " + mechanism_);
  if (!tangent && bend * path_.options.direction < 0)
    giveUp(cause,
           line(": the load factor ", bend < 0 ? "falls" : "grows", " on both sides of it; ", mechanism_));
  const double along = tangent ? linear::dot(*tangent->x.u, *null.right) : null.right->meanValue();
  const double s = std::copysign(std::sqrt(aside(state) / std::abs(bend)), along);
  state.u->update(s, *null.right, 1);
  state.lambda += bend * s * s;
  return holdFunctional(null.right);
}

/// The same next to a bifurcation point.
Border SingularStart::leaveBifurcation(State& state, const NullVectors& null, const RCP<const CrsMatrix>& K,
                                       const RCP<const Vector>& F, const PathError& cause) const {
  // One border only: the second unknown is zero.
  Bordered system;
  system.K = K;
  system.columns = {null.left, path_.calls.newVector()};
  system.rows = {null.right, path_.calls.newVector()};
  system.d[1][1] = 1;
  const auto Uhat = system.solve(path_.calls, F, {0, 0});
  if (!Uhat.good) giveUp(cause, ": " + mechanism_);
  const auto& tangent = path_.here.tangent;
  const double sense = tangent ? std::copysign(1.0, tangent->lambda) : path_.options.direction;
  const double dLambda = sense * aside(state);
  state.u->update(dLambda, *Uhat.x, 1);
  state.lambda += dLambda;
  return holdLoad();
}

}  // namespace atrapos::path
