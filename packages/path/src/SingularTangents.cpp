#include "SingularTangents.hpp"

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

}  // namespace

/// The tangent of the state where the path starts is singular: the path starts a little further along what
/// the null vector phi and the load say of it.
///
/// F with a part along the left null vector psi: a limit point, U = U_0 + s phi, lambda = lambda_0 + c s^2,
/// c = psi . D^2R(phi, phi) / (2 psi . F). Without: a bifurcation point, which the path passes along
/// K Uhat = F, phi . Uhat = 0. Where that state's tangent is singular too, a mechanism.
void SingularTangents::startAside(const PathError& cause) {
  Calls& calls = path_.calls;
  Position& here = path_.here;
  Outcome& outcome = path_.outcome;
  const double direction = path_.options.direction;
  const auto giveUp = [&](const std::string& why) {
    throw PathError(cause.reason(), line("at lambda = ", here.state.lambda, ": ", cause.what(),
                                         "; the path cannot start here", why));
  };
  if (!mechanism_.empty()) giveUp(", nor next to it: " + mechanism_);
  State state = here.state.copy();
  auto F = calls.newVector(), phi = calls.newVector();
  const auto K = calls.tangent(state, *F);
  fillUnsymmetric(*phi, 1);
  auto psi = copy(*phi);
  try {
    ++outcome.restarts;
    calls.factor(shifted(*K));
    inverseIterations(calls, *phi, false);
    if (calls.problem().symmetric())
      psi = phi;
    else
      inverseIterations(calls, *psi, true);
  } catch (const PathError&) {
    giveUp("");
  }
  if (!std::isfinite(phi->norm2())) giveUp("");
  mechanism_ = largestEntries(calls.problem(), *phi);

  const double load = linear::dot(*psi, *F), unit = std::max(1.0, std::abs(state.lambda));
  constexpr double none = 1e-6, aside = 1e-4;  // of the load; of the load factor
  Border border;
  if (std::abs(load) > none * F->norm2()) {
    const double bend = SecondOrder(calls, state, psi)({phi, 0}) / (2 * load);
    if (!std::isfinite(bend) || bend == 0) giveUp(": " + mechanism_);
    if (!here.tangent && bend * direction < 0)
      giveUp(line(": the load factor ", bend < 0 ? "falls" : "grows", " on both sides of it; ", mechanism_));
    const double along = here.tangent ? linear::dot(*here.tangent->x.u, *phi) : phi->meanValue();
    const double s = std::copysign(std::sqrt(aside * unit / std::abs(bend)), along);
    state.u->update(s, *phi, 1);
    state.lambda += bend * s * s;
    border = holdFunctional(phi);
  } else {
    // One border only: the second unknown is zero.
    Bordered system;
    system.K = K;
    system.columns = {psi, calls.newVector()};
    system.rows = {phi, calls.newVector()};
    system.d[1][1] = 1;
    const auto Uhat = system.solve(calls, F, {0, 0});
    if (!Uhat.good) giveUp(": " + mechanism_);
    const double sense = here.tangent ? std::copysign(1.0, here.tangent->lambda) : direction;
    state.u->update(sense * aside * unit, *Uhat.x, 1);
    state.lambda += sense * aside * unit;
    border = holdLoad();
  }
  constexpr int maxHalvings = 0;
  const auto found = newton(calls, state, *here.r, border, path_.correctAbove(),
                            path_.options.maxStartIterations, maxHalvings);
  outcome.startIterations += found.iterations;
  if (!found.converged) giveUp(", and no equilibrium is found next to it; " + mechanism_);
  ++outcome.restarts;  // the factorization that failed
  here.state = calls.settled(state);
  here.residual = found.residual;
}

/// Along the last series.
void SingularTangents::stepOver(const PathError& cause, int attempt) {
  Position& here = path_.here;
  const auto giveUp = [&](const std::string& why) {
    throw PathError(cause.reason(), line("at lambda = ", here.state.lambda, ": ", cause.what(), "; ", why));
  };
  if (!path_.last) {
    startAside(cause);
    return;
  }
  LastStep& last = *path_.last;
  constexpr int maxAttempts = 3;
  if (attempt > maxAttempts) giveUp("stepping over it along the previous series did not help");
  // Small against the step, so that the residual, which grows like a^(K+1), hardly changes.
  const double shift = std::min(1e-3 * std::pow(4.0, attempt - 1) * here.lastLength,
                                0.5 * (path_.stops.pathLength - here.pathLength));
  Trial trial;
  trial.a = last.at + shift;
  evaluate(path_, last.series, trial);
  if (!(trial.residual <= path_.bound())) giveUp("the previous series does not reach past it");
  ++path_.outcome.restarts;
  last.at = trial.a;
  here.moveTo(trial.state, trial.r, trial.residual);
  here.pathLength += shift;
  here.tangent = last.series.tangent(trial.a);
}

}  // namespace atrapos::path
