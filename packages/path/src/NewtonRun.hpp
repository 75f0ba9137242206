#pragma once

#include "Corrector.hpp"
#include "FieldSizes.hpp"
#include "atrapos/path/Stops.hpp"

namespace atrapos::path {

/// One path as Newton steps follow it: the state that moves, and its tangent.
class NewtonRun {
 public:
  NewtonRun(Problem& problem, linear::TangentSolver& solver, const NewtonOptions& options, const Stops& stops,
            Observer& observer, Outcome& outcome)
      : options_(options),
        stops_(stops),
        observer_(observer),
        outcome_(outcome),
        calls_(problem, solver),
        corrector_(calls_, options) {}

  void follow(const Start& start);

  const Work& work() const { return calls_.work(); }

 private:
  /// The end of a step under trial.
  struct Trial {
    double s = 0;
    State state;
    RCP<Vector> r;
    Corrector::Result newton;
    Augmented slope;     ///< dX/da there
    double middle = 0;   ///< distance of the path from the cubic in the middle; 0: not asked for
    std::string reject;  ///< why it is not accepted; empty: it is
    double shorter = 0.5;
  };

  void equilibrate();
  void startTangent(const Start& start);
  bool step();
  Trial tryLength(double s);
  Series cubic(const Trial& trial) const;
  bool needsExactTangent(const Trial& trial, double cosine) const;
  double distanceInTheMiddle(const Series& series, double s);
  bool correctAtStop(const StopHit& stop, const Series& series, Trial& trial, int& iterations);
  double nextLength(const Trial& trial, double cosine) const;
  bool accept(Trial& trial, Series& series, StepReport& report);
  FieldSizes atFirst();
  void weighResponse();
  void measureAnew();
  /// Nothing has moved yet.
  bool standsStill() const { return weight_ == 0; }
  PathError withoutEffect() const;
  bool end(EndReason reason, std::string text);

  const NewtonOptions& options_;
  const Stops& stops_;
  Observer& observer_;
  Outcome& outcome_;
  Calls calls_;
  Corrector corrector_;

  double weight_ = 0;  ///< 0: nothing has moved yet
  Augmented tangent_;  ///< unit, at the current state
  double length_ = 0;  ///< to try next
  FieldSizes fieldSizes_;
  bool first_ = true;    ///< no step has left the start yet
  int limitPoints_ = 0;  ///< passed
  std::optional<linear::Inertia> inertia_;
};

}  // namespace atrapos::path
