#pragma once

#include <limits>
#include <string>
#include <vector>

namespace atrapos {

/// What the tangent says of a stretch of a path.
enum class Stability {
  stable,    ///< no negative eigenvalue
  unstable,  ///< some
  unknown    ///< not counted
};

/// What is marked on a curve.
enum class MarkType {
  limit,        ///< a limit point of the load factor
  bifurcation,  ///< a bifurcation point
  hopf          ///< a Hopf point
};

struct CurveMark {
  std::size_t point = 0;  ///< of the branch, where the curve has it as a point
  std::string kind;       ///< as in points.csv
  MarkType type = MarkType::limit;
};

/// A branch as its tables have it, with the limit and bifurcation points that were located between the rows
/// of path.csv as points of their own.
struct BranchCurve {
  int number = 0;
  std::string name;                         ///< for a legend
  std::vector<int> steps;                   ///< [point]
  std::vector<std::vector<double>> values;  ///< [quantity][point]
  std::vector<Stability> stability;         ///< [point] of the stretch from it to the next one
  std::vector<CurveMark> marks;             ///< along the path
  std::size_t numPoints() const { return steps.size(); }
};

/// What a quantity is, as far as pictures care.
enum class QuantityKind { load, length, displacement, force, other };

struct Quantity {
  std::string name;
  QuantityKind kind = QuantityKind::other;
};

/// The paths of a result folder.
struct PathCurves {
  std::string title;
  std::vector<Quantity> quantities;  ///< load factor, path length, the monitors
  std::vector<BranchCurve> branches;
  bool drivenByDisplacement = false;  ///< the load factor moves supports or tools, and scales no force
  /// Position of a quantity. Throws std::invalid_argument, one line that names those that there are.
  std::size_t find(const std::string& name) const;
};

/// Reads path.csv and points.csv, and branches.csv and summary.json where they are (a run that was killed has
/// none). Throws std::invalid_argument, one line, where the folder holds no path or a damaged one.
PathCurves readCurves(const std::string& folder);

/// The same curve with more points for the eye. Within a step the path is an analytic function of its length,
/// so that cubics through four of the step's points are far nearer to it than chords; at the ends of steps,
/// where events change the problem, it may bend. Steps with fewer than three points are left as they are.
BranchCurve refined(const BranchCurve& branch);

}  // namespace atrapos
