#include "atrapos/path/Branches.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <stdexcept>

#include <Tpetra_Vector.hpp>

#include "Augmented.hpp"
#include "Switch.hpp"

namespace atrapos::path {

const char* toString(BranchEnd end) {
  switch (end) {
    case BranchEnd::path:
      return "path";
    case BranchEnd::closed:
      return "closed";
    case BranchEnd::joined:
      return "joined";
    case BranchEnd::notStable:
      return "notStable";
    case BranchEnd::noStart:
      return "noStart";
  }
  return "unknown";
}

namespace {

Augmented augmented(const PathTangent& t, double sense = 1) {
  Augmented x{Teuchos::rcp(new Vector(*t.x.u, Teuchos::Copy)), t.lambda};
  if (sense < 0) scale(x, -1);
  return x;
}

/// Half a branch at a bifurcation point.
struct Half {
  int point = 0;
  int tangent = 0;  ///< in CriticalPoint::tangents
  int sense = 1;
  int parent = 0, depth = 1;
  bool taken = false;  ///< followed, or passed by a path
};

/// The diagram as it grows.
class Tracer final : public Observer {
 public:
  Tracer(BranchDiagram& diagram, BranchObserver& observer) : diagram_(diagram), observer_(observer) {}

  std::deque<Half> halves;
  int current = 0;  ///< the branch under way
  BranchEnd end = BranchEnd::path;
  bool stopped = false;          ///< the caller's observer wants no more
  const State* start = nullptr;  ///< of the branch under way

  bool onStep(const StepReport& report, const Series& series) override {
    if (!observer_.onStep(current, report, series)) {
      stopped = true;
      return false;
    }
    for (const auto& point : report.criticalPoints)
      if (!pass(point, report, series)) {
        end = BranchEnd::joined;
        return false;
      }
    if (!passKnown(report, series)) {
      end = BranchEnd::joined;
      return false;
    }
    if (report.step > 1 && passes(*start, report, series)) {
      end = BranchEnd::closed;
      return false;
    }
    return true;
  }

  /// The outcome's text in the diagram's terms.
  void explain(Outcome& outcome) const {
    if (end == BranchEnd::joined) outcome.text = "arrived at a bifurcation point from where all is followed";
    if (end == BranchEnd::closed) outcome.text = "came back to its start";
  }

 private:
  /// A bifurcation point on the branch under way: a new one, or one known. False where what lies ahead is
  /// taken.
  bool pass(const CriticalPoint& point, const StepReport& report, const Series& series) {
    const double w = series.weight();
    const int depth = diagram_.branches.at(current).depth;
    for (std::size_t i = 0; i < diagram_.points.size(); ++i) {
      const auto& known = diagram_.points[i].point;
      Augmented gap{Teuchos::rcp(new Vector(*point.state.u, Teuchos::Copy)),
                    point.state.lambda - known.state.lambda};
      gap.u->update(-1, *known.state.u, 1);
      // Both are exact to far better than this part of a step; different points are further apart.
      constexpr double same = 1e-6;
      if (std::sqrt(dot(gap, gap, w)) > same * std::min(point.stepLength, known.stepLength)) continue;
      if (point.tangents.empty()) return true;
      // Crosses off where it came from; goes on where that is new.
      take(static_cast<int>(i), augmented(point.tangents[0], -1), w);
      return take(static_cast<int>(i), augmented(point.tangents[0]), w);
    }
    const int index = static_cast<int>(diagram_.points.size());
    diagram_.points.push_back({point, current, report.step});
    for (int t = 0; t < static_cast<int>(point.tangents.size()); ++t)
      for (const int sense : {1, -1}) halves.push_back({index, t, sense, current, depth + 1, t == 0});
    return true;
  }

  /// Known points on the step that the search did not find there: from a side branch of a multiple point no
  /// eigenvalue tells. False where what lies ahead is taken.
  bool passKnown(const StepReport& report, const Series& series) {
    for (std::size_t i = 0; i < diagram_.points.size(); ++i) {
      const auto& known = diagram_.points[i].point;
      if (known.tangents.empty()) continue;
      const auto a = passes(known.state, report, series);
      if (!a) continue;
      constexpr double same = 1e-2;
      const auto& found = report.criticalPoints;
      if (std::any_of(found.begin(), found.end(),
                      [&](const CriticalPoint& p) { return std::abs(p.a - *a) < same * report.length; }))
        continue;
      const auto t = series.tangent(*a);
      take(static_cast<int>(i), augmented(t, -1), series.weight());
      if (!take(static_cast<int>(i), augmented(t), series.weight())) return false;
    }
    return true;
  }

  /// Marks the half-branch in that direction; false where it was marked already.
  bool take(int point, const Augmented& direction, double w) {
    Half* best = nullptr;
    double cosine = 0;
    for (Half& half : halves) {
      if (half.point != point) continue;
      const auto t = augmented(diagram_.points[point].point.tangents[half.tangent], half.sense);
      const double c = dot(t, direction, w) / std::sqrt(dot(t, t, w) * dot(direction, direction, w));
      if (c > cosine) {
        cosine = c;
        best = &half;
      }
    }
    if (!best) return true;
    const bool free = !best->taken;
    best->taken = true;
    return free;
  }

  /// Where the step passes through a state; empty where it does not.
  std::optional<double> passes(const State& state, const StepReport& report, const Series& series) const {
    const double w = series.weight();
    auto u = Teuchos::rcp(new Vector(state.u->getMap()));
    const auto t = series.tangent(0.5 * report.length);
    // Plane through the state, normal to the step.
    auto weights = Teuchos::rcp(new Vector(*t.x.u, Teuchos::Copy));
    weights->scale(w);
    const double value = w * dot({state.u, 0}, {t.x.u, 0}, 1) + state.lambda * t.lambda;
    const Rational plane = series.functional(*weights);
    const Rational lambda = series.lambdaFunction();
    const Polynomial p =
        plane.numerator().plus(t.lambda, lambda.numerator()).plus(-value, plane.denominator());
    for (const double a : p.roots(report.length)) {
      const double lambdaAt = series.evaluate(a, *u);
      u->update(-1, *state.u, 1);
      // Accuracy of a path at the residual bound; a path next to the state but not through it is further.
      constexpr double same = 1e-3;
      const Augmented gap{u, lambdaAt - state.lambda};
      if (std::sqrt(dot(gap, gap, w)) <= same * report.length) return a;
    }
    return std::nullopt;
  }

  BranchDiagram& diagram_;
  BranchObserver& observer_;
};

}  // namespace

BranchFollower::BranchFollower(Problem& problem, linear::TangentSolver& solver, Options options, Stops stops,
                               BranchOptions branches)
    : problem_(problem),
      solver_(solver),
      options_(std::move(options)),
      stops_(std::move(stops)),
      branches_(branches) {
  options_.validate();
  stops_.validate();
  if (branches_.maxDepth < 0) throw std::invalid_argument("branch options: maxDepth must be >= 0");
  if (branches_.maxBranches < 0) throw std::invalid_argument("branch options: maxBranches must be >= 0");
}

void BranchFollower::watch(std::vector<Monitor> monitors) {
  validate(monitors);
  monitors_ = std::move(monitors);
}

BranchDiagram BranchFollower::run(const State& start, BranchObserver& observer) {
  BranchDiagram diagram;
  Tracer tracer(diagram, observer);
  PathFollower follower(problem_, solver_, options_, stops_);
  follower.watch(monitors_);
  diagram.branches.emplace_back();
  diagram.branches[0].start = start;
  observer.onBranch(diagram, 0);
  const State first = start;
  tracer.start = &first;
  diagram.branches[0].outcome = follower.run(start, tracer);
  diagram.branches[0].end = tracer.end;
  tracer.explain(diagram.branches[0].outcome);
  const double weight = diagram.branches[0].outcome.weight;

  int followed = 0;
  for (std::size_t next = 0; next < tracer.halves.size() && !tracer.stopped; ++next) {
    if (tracer.halves[next].taken || branches_.follow == Follow::none) continue;
    if (tracer.halves[next].depth > branches_.maxDepth || followed == branches_.maxBranches) {
      diagram.complete = false;
      continue;
    }
    tracer.halves[next].taken = true;
    const Half half = tracer.halves[next];
    const CriticalPoint point = diagram.points[half.point].point;
    Branch branch;
    branch.parent = half.parent;
    branch.point = half.point;
    branch.depth = half.depth;
    branch.direction = point.tangents[half.tangent];
    if (half.sense < 0) {
      branch.direction.x.u = Teuchos::rcp(new Vector(*branch.direction.x.u, Teuchos::Copy));
      branch.direction.x.u->scale(-1);
      branch.direction.lambda *= -1;
    }
    if (!point.conditions.empty()) problem_.setConditions(point.conditions);
    const Switched switched = switchBranch(problem_, solver_, options_, point, branch.direction, weight);
    diagram.switchFactorizations += switched.factorizations;
    if (!switched.state)
      branch.end = BranchEnd::noStart;
    else if (branches_.follow == Follow::stable && (!switched.inertia || switched.inertia->negative > 0))
      branch.end = BranchEnd::notStable;
    if (branch.end != BranchEnd::path) {
      branch.outcome.reason = EndReason::observerStopped;
      branch.outcome.text = branch.end == BranchEnd::noStart ? "no equilibrium found next to the point"
                                                             : "not followed: it is not stable";
      diagram.branches.push_back(std::move(branch));
      observer.onBranch(diagram, static_cast<int>(diagram.branches.size()) - 1);
      continue;
    }
    ++followed;
    Start from;
    from.state = branch.start = *switched.state;
    from.tangent = branch.direction;
    from.weight = weight;
    tracer.current = static_cast<int>(diagram.branches.size());
    tracer.end = BranchEnd::path;
    const State begin = *switched.state;
    tracer.start = &begin;
    diagram.branches.push_back(std::move(branch));
    observer.onBranch(diagram, tracer.current);
    Outcome outcome = follower.runFrom(from, tracer);
    tracer.explain(outcome);
    diagram.branches[tracer.current].outcome = std::move(outcome);
    diagram.branches[tracer.current].end = tracer.end;
  }
  return diagram;
}

}  // namespace atrapos::path
