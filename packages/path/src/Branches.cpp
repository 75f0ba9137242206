#include "atrapos/path/Branches.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <Tpetra_Vector.hpp>

#include "Arrival.hpp"
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

bool atStop(const Branch& branch) {
  return branch.end != BranchEnd::path || branch.outcome.reason == EndReason::stopReached ||
         branch.outcome.reason == EndReason::stepLimit || branch.outcome.reason == EndReason::pathClosed;
}

namespace {

Augmented augmented(const PathTangent& t, double sense = 1) {
  Augmented x{Teuchos::rcp(new Vector(*t.x.u, Teuchos::Copy)), t.lambda};
  if (sense < 0) scale(x, -1);
  return x;
}

}  // namespace

/// The diagram as it grows.
class BranchFollower::Tracer final : public Observer {
 public:
  Tracer(const Problem& problem, BranchProgress& progress, BranchObserver& observer)
      : progress(progress), problem_(problem), observer_(observer) {}

  BranchProgress& progress;
  bool stopped = false;  ///< the caller's observer wants no more

  Branch& branch() { return progress.diagram.branches[progress.current]; }

  bool onStep(const StepReport& report, const Series& series) override {
    branch().end = endOn(report, series);
    if (turned_ && report.unexplained > 0) {
      // The tangent's sign is that of either side of the point beside which the branch has turned.
      StepReport explained = report;
      explained.unexplained = 0;
      tell(explained, series);
    } else {
      tell(report, series);
    }
    progress.path = report.next;
    observer_.onProgress(progress);
    return !stopped && branch().end == BranchEnd::path;
  }

  void onSearch(int found, int wanted) override { observer_.onSearch(progress.current, found, wanted); }

  /// The branch under way is over.
  void finish(Outcome outcome) {
    // The outcome's text in the diagram's terms.
    if (branch().end == BranchEnd::joined)
      outcome.text = "arrived at a bifurcation point from where all is followed";
    if (branch().end == BranchEnd::closed) outcome.text = "came back to its start";
    branch().outcome = std::move(outcome);
    if (stopped) return;
    progress.path.reset();
    observer_.onProgress(progress);
  }

 private:
  void tell(const StepReport& report, const Series& series) {
    progress.diagram.unexplained += report.unexplained;
    progress.diagram.uncounted += report.uncounted;
    stopped = !observer_.onStep(progress.current, report, series);
  }

  BranchEnd endOn(const StepReport& report, const Series& series) {
    turned_ = report.criticalPoints.empty() && turnsBesideKnown(report, series);
    if (turned_) return BranchEnd::joined;
    for (const auto& point : report.criticalPoints)
      if (!pass(point, report, series)) return BranchEnd::joined;
    if (!passKnown(report, series)) return BranchEnd::joined;
    if (report.step > 1 && passes(branch().start, report, series)) return BranchEnd::closed;
    return BranchEnd::path;
  }

  /// A bifurcation point on the branch under way: a new one, or one known. False where what lies ahead is
  /// taken.
  bool pass(const CriticalPoint& point, const StepReport& report, const Series& series) {
    const double w = series.weight();
    auto& points = progress.diagram.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& known = points[i].point;
      Augmented gap{Teuchos::rcp(new Vector(*point.state.u, Teuchos::Copy)),
                    point.state.lambda - known.state.lambda};
      gap.u->update(-1, *known.state.u, 1);
      // Both are exact to better than this part of a step, or to what rounding has left of them; different
      // points are further apart.
      constexpr double same = 1e-6, roundings = 10;
      const double rounding = point.uncertainty * point.stepLength + known.uncertainty * known.stepLength;
      const double reach = same * std::min(point.stepLength, known.stepLength) + roundings * rounding;
      if (length(gap, w) > reach) continue;
      if (point.tangents.empty()) return true;
      // Crosses off where it came from; goes on where that is new.
      take(static_cast<int>(i), augmented(point.tangents[0], -1), w);
      return take(static_cast<int>(i), augmented(point.tangents[0]), w);
    }
    points.push_back({point, progress.current, report.step});
    progress.addHalves(static_cast<int>(points.size()) - 1);
    return true;
  }

  /// Known points on the step that the search did not find there: from a side branch of a multiple point no
  /// eigenvalue tells. False where what lies ahead is taken.
  bool passKnown(const StepReport& report, const Series& series) {
    const auto& points = progress.diagram.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& known = points[i].point;
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

  /// The branch came to a known pitchfork and was turned off beside it. What lies ahead is the path that the
  /// point is on; the other half of the branch is followed from the point.
  bool turnsBesideKnown(const StepReport& report, const Series& series) {
    const auto& points = progress.diagram.points;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (const auto from = turnedBeside(problem_, points[i].point, report, series)) {
        take(static_cast<int>(i), *from, series.weight());
        return true;
      }
    return false;
  }

  /// Marks the half-branch in that direction; false where it was marked already.
  bool take(int point, const Augmented& direction, double w) {
    HalfBranch* best = nullptr;
    double cosine = 0;
    for (HalfBranch& half : progress.halves) {
      if (half.point != point) continue;
      const auto t = augmented(progress.diagram.points[point].point.tangents[half.tangent], half.sense);
      const double c = dot(problem_, t, direction, w) / (length(t, w) * length(direction, w));
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
      if (length({u, lambdaAt - state.lambda}, w) <= same * report.length) return a;
    }
    return std::nullopt;
  }

  double length(const Augmented& x, double w) const { return std::sqrt(dot(problem_, x, x, w)); }

  const Problem& problem_;
  BranchObserver& observer_;
  bool turned_ = false;  ///< the last step turned beside a known pitchfork
};

BranchProgress::BranchProgress(const State& start) {
  diagram.branches.emplace_back();
  diagram.branches[0].start = start;
  path.emplace();
  path->state = start;
}

void BranchProgress::addHalves(int first) {
  for (int p = first; p < static_cast<int>(diagram.points.size()); ++p) {
    const BranchPoint& found = diagram.points[p];
    const int depth = diagram.branches.at(found.branch).depth + 1;
    for (int t = 0; t < static_cast<int>(found.point.tangents.size()); ++t)
      for (const int sense : {1, -1}) halves.push_back({p, t, sense, found.branch, depth, t == 0});
  }
}

BranchFollower::BranchFollower(Problem& problem, linear::TangentSolver& solver, Options options, Stops stops,
                               BranchOptions branches)
    : problem_(problem), solver_(solver), options_(options), stops_(std::move(stops)), branches_(branches) {
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
  BranchProgress progress(start);
  observer.onBranch(progress.diagram, 0);
  goOn(progress, observer);
  return std::move(progress.diagram);
}

void BranchFollower::follow(const Start& from, Tracer& tracer) {
  PathFollower follower(problem_, solver_, options_, stops_);
  follower.watch(monitors_);
  tracer.finish(follower.runFrom(from, tracer));
}

namespace {

/// Of a branch that was found to end where it was interrupted.
Outcome endOf(const Start& at) {
  Outcome outcome;
  outcome.reason = EndReason::observerStopped;
  outcome.steps = at.steps;
  outcome.weight = at.weight.value_or(0);
  outcome.pathLength = at.pathLength;
  outcome.final = at.state;
  return outcome;
}

}  // namespace

void BranchFollower::goOn(BranchProgress& progress, BranchObserver& observer) {
  Tracer tracer(problem_, progress, observer);
  BranchDiagram& diagram = progress.diagram;
  if (progress.path) {
    const Start from = *progress.path;
    if (tracer.branch().end == BranchEnd::path)
      follow(from, tracer);
    else
      tracer.finish(endOf(from));
  }
  const double weight = diagram.branches[0].outcome.weight;

  while (progress.next < static_cast<int>(progress.halves.size()) && !tracer.stopped) {
    HalfBranch& turn = progress.halves[progress.next++];
    if (turn.taken || branches_.follow == Follow::none) continue;
    if (turn.depth > branches_.maxDepth || progress.followed == branches_.maxBranches) {
      diagram.complete = false;
      continue;
    }
    turn.taken = true;
    const HalfBranch half = turn;
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
    const Switched switched = switchBranch(problem_, solver_, options_, point, branch.direction, weight);
    diagram.switchFactorizations += switched.factorizations;
    if (!switched.state)
      branch.end = BranchEnd::noStart;
    else if (branches_.follow == Follow::stable && (!switched.inertia || switched.inertia->negative > 0))
      branch.end = BranchEnd::notStable;
    progress.current = static_cast<int>(diagram.branches.size());
    if (branch.end != BranchEnd::path) {
      branch.outcome.reason = EndReason::observerStopped;
      branch.outcome.text = branch.end == BranchEnd::noStart ? "no equilibrium found next to the point"
                                                             : "not followed: it is not stable";
      diagram.branches.push_back(std::move(branch));
      observer.onBranch(diagram, progress.current);
      observer.onProgress(progress);
      continue;
    }
    ++progress.followed;
    Start from;
    from.state = branch.start = *switched.state;
    from.tangent = branch.direction;
    from.weight = weight;
    from.fieldSizes = point.fieldSizes;
    diagram.branches.push_back(std::move(branch));
    progress.path = from;
    observer.onBranch(diagram, progress.current);
    follow(from, tracer);
  }
}

}  // namespace atrapos::path
