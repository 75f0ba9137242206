#include "ReferencePath.hpp"

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

#include "atrapos/linear/Dot.hpp"

namespace atrapos {

using path::Vector;

double ReferencePath::dot(const Vector& u, double lambda, const Vector& v, double mu) const {
  return weight_ * linear::dot(u, v) + lambda * mu;
}

void ReferencePath::append(const path::StepReport& report, const path::Series& series) {
  if (states_.empty()) {
    weight_ = series.weight();
    append(*series.coefficient(0).u, series.lambdaCoefficient(0));
  }
  Vector u(series.coefficient(0).u->getMap());
  for (int j = 1; j < samples_; ++j) {
    const double lambda = series.evaluate(report.length * j / samples_, u);
    append(u, lambda);
  }
  append(*report.end.u, report.end.lambda);
}

void ReferencePath::append(const Vector& u, double lambda) {
  double chord = 0;
  if (!states_.empty()) {
    Vector d(u, Teuchos::Copy);
    d.update(-1, *states_.back().u, 1);
    const double dLambda = lambda - states_.back().lambda;
    chord = std::sqrt(dot(d, dLambda, d, dLambda));
  }
  at_.push_back(length() + chord);
  states_.push_back({Teuchos::rcp(new Vector(u, Teuchos::Copy)), lambda});
}

double ReferencePath::extent() const {
  double largest = 0;
  for (const path::State& s : states_) {
    Vector d(*s.u, Teuchos::Copy);
    d.update(-1, *states_.front().u, 1);
    const double dLambda = s.lambda - states_.front().lambda;
    largest = std::max(largest, std::sqrt(dot(d, dLambda, d, dLambda)));
  }
  return largest;
}

ReferencePath::Walker::Place ReferencePath::Walker::go(const Vector& u, double lambda) {
  Vector gap(u, Teuchos::Copy), chord(u, Teuchos::Copy);
  double gone = 0;
  if (last_.u) {
    gap.update(-1, *last_.u, 1);
    gone = std::sqrt(path_.dot(gap, lambda - last_.lambda, gap, lambda - last_.lambda));
  }
  last_ = {Teuchos::rcp(new Vector(u, Teuchos::Copy)), lambda};
  // An arc between close states is not longer than three chords, sharp turns included.
  const double first = reached_ - 2 * tolerance_, last = reached_ + 3 * gone + 4 * tolerance_;
  // The nearest place in reach; failing that, whether there is one behind.
  double nearestAhead = tolerance_, placeAhead = -1;
  bool behind = false;
  for (std::size_t i = 0; i + 1 < path_.states_.size(); ++i) {
    const path::State &p = path_.states_[i], &q = path_.states_[i + 1];
    gap.update(1, u, -1, *p.u, 0);
    chord.update(1, *q.u, -1, *p.u, 0);
    const double gapLambda = lambda - p.lambda, chordLambda = q.lambda - p.lambda;
    const double square = path_.dot(chord, chordLambda, chord, chordLambda);
    if (!(square > 0)) continue;
    const double t = std::min(1.0, std::max(0.0, path_.dot(gap, gapLambda, chord, chordLambda) / square));
    gap.update(-t, chord, 1);
    const double distance =
        std::sqrt(path_.dot(gap, gapLambda - t * chordLambda, gap, gapLambda - t * chordLambda));
    if (!(distance <= tolerance_)) continue;
    const double place = path_.at_[i] + t * (path_.at_[i + 1] - path_.at_[i]);
    if (place < first) {
      behind = true;
    } else if (place <= last && distance <= nearestAhead) {
      nearestAhead = distance;
      placeAhead = place;
    }
  }
  if (placeAhead >= 0) {
    reached_ = std::max(reached_, placeAhead);
    return Place::on;
  }
  return behind ? Place::behind : Place::off;
}

}  // namespace atrapos
