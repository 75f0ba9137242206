#include "Switch.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Tpetra_Vector.hpp>

#include "Augmented.hpp"
#include "FieldSizes.hpp"
#include "Newton.hpp"
#include "Stability.hpp"

namespace atrapos::path {

namespace {

/// How far from a pitchfork a residual of this size tells the load on the branch along which lambda turns.
///
/// At a distance s along the null vector phi the balance along phi reads s (B/lambda') dlambda = r, with B =
/// phi . D^2R(t, direction) along the path t that the branch leaves, lambda' its load part: nearer than that
/// the load on the branch is rounding, and the tangent singular to it.
double leastDistance(Calls& calls, const CriticalPoint& point, const PathTangent& direction,
                     double tolerance) {
  constexpr double turns = 1e-4;
  if (point.kind != CriticalKind::pitchfork || std::abs(direction.lambda) > turns) return 0;
  const auto other = std::find_if(point.tangents.begin(), point.tangents.end(),
                                  [](const PathTangent& t) { return std::abs(t.lambda) > turns; });
  if (other == point.tangents.end()) return 0;
  const double force = tolerance * calls.scaleAlong(*point.nullVectors.front(), point.state);
  const double B = SecondOrder(calls, point.state, point.nullVectors.front())({other->x.u, other->lambda},
                                                                              {direction.x.u, 0});
  constexpr double told = 1e-6;  // of the load factor
  // Further than that a straight line is no prediction.
  constexpr double furthest = 1e2;
  const double unit = std::max(1.0, std::abs(point.state.lambda));
  return std::min(force * std::abs(other->lambda) / (std::abs(B) * told * unit), furthest * point.stepLength);
}

}  // namespace

namespace {

/// States on the branch that leaves a point, one at a distance.
class BranchStart {
 public:
  BranchStart(Calls& calls, const Options& options, const CriticalPoint& point, const PathTangent& direction,
              double weight, double tolerance)
      : calls_(calls),
        point_(point),
        direction_(direction),
        weight_(weight),
        tolerance_(tolerance),
        accepted_(options.correctAbove * options.residualBound),
        border_(holdPathParameter(calls.problem(), weight, direction)) {}

  /// Corrected in the plane normal to the direction; empty where that does not lead to the branch. The solver
  /// holds a tangent next to it afterwards.
  std::optional<State> at(double s);
  int factorizations() const { return factorizations_; }

 private:
  bool isOnBranch(const State& state) const;

  Calls& calls_;
  const CriticalPoint& point_;
  const PathTangent& direction_;
  double weight_, tolerance_, accepted_;
  Border border_;
  int factorizations_ = 0;
};

std::optional<State> BranchStart::at(double s) {
  auto F = calls_.newVector(), r = calls_.newVector(), trial = calls_.newVector();
  auto x1 = calls_.newVector(), x2 = calls_.newVector();
  State state = point_.state.copy();
  state.u->update(s, *direction_.x.u, 1);
  state.lambda += s * direction_.lambda;
  double residual = calls_.residual(state, *r).relative();
  ++factorizations_;
  try {
    calls_.factor(state, *F);
    calls_.solve(*F, *x2);
    // The factorization of the first iteration serves all: the state moves by s^2, the tangent's smallest
    // eigenvalue is proportional to s, so each contracts by s.
    constexpr int maxIterations = 10;
    for (int i = 0; i < maxIterations && residual > tolerance_; ++i) {
      calls_.solve(*r, *x1);
      const double dLambda = border_.c(x1) / (border_.c(x2) + border_.cLambda);
      trial->update(1, *state.u, -1, *x1, 0);
      trial->update(dLambda, *x2, 1);
      const double now = calls_.residual(state.at(trial, state.lambda + dLambda), *r).relative();
      if (!(now < 0.5 * residual)) break;
      residual = now;
      std::swap(state.u, trial);
      state.lambda += dLambda;
    }
  } catch (const PathError&) {
    return std::nullopt;
  }
  if (!(residual <= accepted_) || !isOnBranch(state)) return std::nullopt;
  return calls_.settled(state);
}

/// Still the branch asked for: not back on the one that it leaves.
bool BranchStart::isOnBranch(const State& state) const {
  const auto inner = [&](const Augmented& x, const Augmented& y) {
    return dot(calls_.problem(), x, y, weight_);
  };
  Augmented gap = copy(Augmented{state.u, state.lambda});
  add(gap, -1, {point_.state.u, point_.state.lambda});
  const Augmented t{direction_.x.u, direction_.lambda};
  constexpr double sameDirection = 0.9;
  return inner(gap, t) > sameDirection * std::sqrt(inner(gap, gap) * inner(t, t));
}

/// The direction of a branch as a unit of the path parameter that measures fields by these sizes.
PathTangent unitDirection(const Problem& problem, const PathTangent& t, double weight) {
  Augmented unit = copy(Augmented{t.x.u, t.lambda});
  scale(unit, 1 / std::sqrt(dot(problem, unit, unit, weight)));
  return {{unit.u, t.x.internal}, unit.lambda};
}

}  // namespace

Switched switchBranch(Problem& problem, linear::TangentSolver& solver, const Options& options,
                      const CriticalPoint& point, const PathTangent& along, double weight) {
  Calls calls(problem, solver);
  const auto factors = FieldSizes(point.fieldSizes).factors(weight);
  calls.weighFields(factors);
  // What is long in one field's unit is next to nothing in another's.
  const PathTangent direction = factors.empty() ? along : unitDirection(problem, along, weight);
  // Next to the point the tangent is almost singular, so the state is wrong by more than its residual says.
  const double tolerance = 1e-4 * options.residualBound;
  const double usual = 1e-2 * point.stepLength;
  const double least = leastDistance(calls, point, direction, tolerance);
  const double first = std::max(usual, least);
  std::vector<double> distances{first, first > usual ? usual : 0.1 * usual};
  // A path that is straight up to the point makes long steps, whatever the scale of its branches.
  if (const double closest = std::max(1e-2 * usual, least); closest < 0.1 * usual)
    distances.push_back(closest);
  // A branch that bends within these: nearer, though its load may be rounding there.
  constexpr double nearest = 1e-4;
  const double end = nearest * std::min(usual, distances.back());
  while (distances.back() >= 10 * end) distances.push_back(0.1 * distances.back());
  BranchStart branch(calls, options, point, direction, weight, tolerance);
  Switched result;
  for (const double s : distances) {
    result.state = branch.at(s);
    if (!result.state) continue;
    // So far from the point that a gap shows: nearer, where the load, which goes like s^2, has moved less.
    constexpr double shows = 1e-3;
    const double gap = std::abs(result.state->lambda - point.state.lambda) /
                       (shows * std::max(1.0, std::abs(point.state.lambda)));
    if (s > usual && gap > 1) {
      const auto nearer = branch.at(std::max(usual, s / std::sqrt(gap)));
      result.state = nearer ? nearer : branch.at(s);
    }
    break;
  }
  result.factorizations = branch.factorizations();
  if (!result.state) return result;
  result.inertia = calls.inertia();
  if (!problem.symmetric() && options.watchedModes > 0)
    if (const auto unstable =
            countUnstable(calls, *result.state, options.watchedModes + 1, EigenProblem::ofTangent))
      result.inertia = linear::Inertia{unstable->all, 0};
  return result;
}

}  // namespace atrapos::path
