#pragma once

#include <optional>
#include <string>
#include <vector>

#include "atrapos/path/BranchOptions.hpp"
#include "atrapos/path/PathFollower.hpp"

namespace atrapos::path {

enum class BranchEnd {
  path,       ///< as its Outcome says
  closed,     ///< it came back to its own start
  joined,     ///< it reached a point from where it would repeat what has been followed
  notStable,  ///< not followed: Follow::stable
  noStart     ///< no equilibrium next to the point in the branch's direction
};

/// "closed" and so on.
const char* toString(BranchEnd end);

/// One path of the diagram: the first one, or half a branch that leaves a bifurcation point.
struct Branch {
  int parent = -1;          ///< the branch whose bifurcation point it leaves; -1: the first path
  int point = -1;           ///< that point, in BranchDiagram::points
  int depth = 0;            ///< bifurcations since the first path
  PathTangent direction;    ///< unit, at that point
  State start;              ///< where its first step starts, next to the point
  double imperfection = 0;  ///< size of the imperfection that it is followed with; 0: perfect
  std::string stage;        ///< of a path in stages: the name of this one; empty: of another path
  BranchEnd end = BranchEnd::path;
  Outcome outcome;
};

/// Whether a branch has come as far as it was to: its path to its stop, or the branch to another end than its
/// path's.
bool atStop(const Branch& branch);

/// A bifurcation point, found once whatever the number of branches that pass it.
struct BranchPoint {
  CriticalPoint point;
  int branch = 0, step = 0;  ///< where it was found first
};

/// All that was followed; `branches[0]` is the first path.
struct BranchDiagram {
  std::vector<Branch> branches;
  std::vector<BranchPoint> points;
  int switchFactorizations = 0;  ///< spent on starts of branches, besides those of the paths
  bool complete = true;          ///< false where maxDepth or maxBranches left branches out
  int unexplained = 0;           ///< sum of StepReport::unexplained: points that were not found
  int uncounted = 0;             ///< steps with StepReport::uncounted: points that may be there, unseen
};

/// Half a branch at a bifurcation point of a diagram.
struct HalfBranch {
  int point = 0;    ///< in BranchDiagram::points
  int tangent = 0;  ///< in CriticalPoint::tangents
  int sense = 1;    ///< -1: against that tangent
  int parent = 0;   ///< the branch on which the point was found
  int depth = 1;
  bool taken = false;  ///< followed, under way, or passed by another path
};

/// A diagram that is followed, between two of its steps or branches: BranchFollower::goOn takes it from here.
struct BranchProgress {
  BranchProgress() = default;
  /// Nothing is followed yet.
  explicit BranchProgress(const State& start);

  BranchDiagram diagram;
  std::vector<HalfBranch> halves;  ///< of all points, in the order in which they are followed
  int next = 0;                    ///< the first half that has not had its turn
  int followed = 0;                ///< halves followed so far
  int current = 0;                 ///< the branch under way, or the last one that was
  /// Where the branch under way goes on; empty: it is over. Where BranchDiagram has another end than `path`
  /// for it, it ends there.
  std::optional<Start> path;

  /// Makes room for the halves of the points from `first` on.
  void addHalves(int first);
};

/// Watches a diagram as it is followed.
class BranchObserver {
 public:
  virtual ~BranchObserver() = default;
  /// Before the first step of a branch, and for those that are not followed; `diagram` has the branch and all
  /// points found so far.
  virtual void onBranch(const BranchDiagram& /*diagram*/, int /*branch*/) {}
  /// Every step of every branch. Return false to end everything.
  virtual bool onStep(int branch, const StepReport& report, const Series& series) = 0;
  /// As Observer::onSearch.
  virtual void onSearch(int /*branch*/, int /*found*/, int /*wanted*/) {}
  /// After onStep, and once more where a branch is over, unless onStep has ended everything. A diagram that
  /// is interrupted later can go on from here.
  virtual void onProgress(const BranchProgress& /*progress*/) {}
};

/// Follows a path and the branches that leave it, each once: a branch that arrives at a known bifurcation
/// point crosses off the direction that it came from, and ends where the one ahead has been followed or waits
/// for its turn. Needs a tangent solver that tells the inertia.
class BranchFollower {
 public:
  /// Throws std::invalid_argument, one line, on options that make no sense.
  BranchFollower(Problem& problem, linear::TangentSolver& solver, Options options, Stops stops,
                 BranchOptions branches);

  /// As PathFollower::watch, on every branch.
  void watch(std::vector<Monitor> monitors);

  BranchDiagram run(const State& start, BranchObserver& observer);

  /// Goes on with a diagram that was interrupted, with the same bits where nothing else has changed. Costs of
  /// the branch under way count from here on. The observer hears nothing of what has been followed before.
  void goOn(BranchProgress& progress, BranchObserver& observer);

 private:
  class Tracer;
  void follow(const Start& from, Tracer& tracer);

  Problem& problem_;
  linear::TangentSolver& solver_;
  Options options_;
  Stops stops_;
  BranchOptions branches_;
  std::vector<Monitor> monitors_;
};

}  // namespace atrapos::path
