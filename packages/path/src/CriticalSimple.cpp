#include <algorithm>
#include <cmath>
#include <optional>

#include <Tpetra_Vector.hpp>

#include "ExtendedSystem.hpp"
#include "atrapos/linear/Dot.hpp"

namespace atrapos::path {

namespace {

/// The tangents of the two branches: roots of H_00 x^2 + 2 H_01 x y + H_11 y^2 = 0 (algebraic bifurcation
/// equation), as directions x V_0 + y V_1. False where they are not real and distinct.
bool branches(const ExtendedSystem& r, double w, std::vector<Augmented>& tangents) {
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
                  Held held, int maxFactorizations, CriticalPoint& point, int& factorizations) {
  const double w = search.series.weight();
  std::optional<ExtendedSystem> system;
  system.emplace(calls, search, nullGuess);
  State state = search.series.state(guess);
  double a = guess, moved = search.length;
  // Newton goes on until its corrections no longer fall. One of `accepted` of the step confirms; where they
  // stop falling above that, what is left is the rounding of the tangent over the eigenvalue's rate, and the
  // point is known to that.
  constexpr double accepted = 1e-8, ofRounding = 1e-5, far = 1e-2;
  constexpr int maxIterations = 8;
  bool done = false;
  const int attempts = maxFactorizations + (held == Held::nothing ? 0 : 1);
  for (int f = 0; f < attempts && !done; ++f) {
    const bool frozen = f == 0 && held != Held::nothing;
    const auto t = search.series.tangent(std::clamp(a, 0.0, search.length));
    try {
      if (!frozen) ++factorizations;
      if (!system->enter(state, {t.x.u, t.lambda}, frozen, frozen && held == Held::eigenvector)) {
        if (!frozen) return false;
        continue;
      }
    } catch (const PathError& error) {
      if (error.reason() != EndReason::singularTangent) throw;
      // Hit exactly: a little aside the tangent can be factored, and Newton comes back.
      a += 1e-4 * search.length;
      state = search.series.state(a);
      continue;
    }
    double last = search.length;
    bool stagnates = false;
    for (int i = 0; i < maxIterations; ++i) {
      double next = 0;
      if (!system->iterate(state, next)) break;
      moved = next;
      // Quadratic after the first few.
      stagnates = moved > (i < 3 ? 1 : 0.1) * last;
      if (moved == 0 || stagnates) break;
      last = moved;
    }
    done = moved <= (stagnates ? ofRounding : accepted) * search.length;
    if (!done && frozen) {  // too far off: as if it had not been tried
      a = guess;
      state = search.series.state(guess);
      system.emplace(calls, search, nullGuess);
      continue;
    }
    a = nearest(calls, search.series, state, a).first;
    if (!done && !(std::abs(a - guess) < search.length)) return false;
  }
  if (!done) return false;

  const auto [position, distance] = nearest(calls, search.series, state, a);
  auto r = calls.newVector();
  point.residual = calls.residual(state, *r).relative();
  // Not on this path, or a near miss: an imperfection larger than the bound keeps the branches apart.
  if (distance > far * search.length || point.residual > search.residualBound) return false;
  // Beyond an end it is a neighbour's, whose counts tell; in place of one of this step it would hide that
  // one.
  constexpr double outside = 1e-4;
  if (position < -outside * search.length || position > (1 + outside) * search.length) return false;
  std::vector<Augmented> tangents;
  if (!branches(*system, w, tangents)) return false;
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
  if (!calls.problem().symmetric()) {
    // Inverse iterations from a vector of one's own leave the other sense to rounding.
    auto fixed = calls.newVector();
    fillUnsymmetric(*fixed, 1);
    if (linear::dot(*tangents[1].u, *fixed) < 0) scale(tangents[1], -1);
  }

  point.a = std::clamp(position, 0.0, search.length);
  point.state = calls.settled(state);
  point.uncertainty = moved / search.length;
  for (const auto& x : tangents) {
    PathTangent tangent;
    tangent.x = {x.u, std::vector<double>(calls.problem().internalCount(), 0.0)};
    tangent.lambda = x.lambda;
    point.tangents.push_back(tangent);
  }
  // Where lambda turns its share of the unit tangent vanishes.
  constexpr double turns = 1e-4;
  const auto turning = std::count_if(tangents.begin(), tangents.end(),
                                     [&](const Augmented& x) { return std::abs(x.lambda) < turns; });
  constexpr CriticalKind kinds[] = {CriticalKind::transcritical, CriticalKind::pitchfork,
                                    CriticalKind::hilltop};
  point.kind = kinds[turning];
  point.nullVectors = {system->phi()};
  // The eigenvalue that vanishes moves at the rate psi . D^2R(X', phi) along the path; it does not cross zero
  // on a branch that leaves a pitchfork.
  SecondOrder second(calls, state, system->psi());
  const double size = std::abs(system->H(0, 0)) + std::abs(system->H(0, 1)) + std::abs(system->H(1, 1));
  // psi . N phi > 0 would make it that of the eigenvalue; a symmetric tangent has psi = phi.
  auto measured = calls.newVector();
  if (calls.problem().symmetric())
    measured->assign(*system->phi());
  else
    EigenMeasure(calls, state, search.counted).apply(*system->phi(), *measured);
  const double rate = second(tangents[0], {system->phi(), 0});
  const double sense = linear::dot(*system->psi(), *measured);
  constexpr double crosses = 1e-6;
  const double phiSize = std::sqrt(dot({system->phi(), 0}, {system->phi(), 0}, w));
  const bool still =
      std::abs(rate) * system->psi()->norm2() * system->phi()->norm2() < crosses * size * phiSize;
  point.negativeChange = still ? 0 : rate * sense < 0 ? 1 : -1;
  return true;
}

}  // namespace atrapos::path
