#pragma once

#include <vector>

#include "atrapos/fem/Term.hpp"

namespace atrapos::fem {

/// A term that is analytic only piecewise and changes at roots of its event functions (docs/theory/path.md,
/// Events). Numbers are those of the term: of points, or of what else its event functions stand for. A term
/// that several ranks share out (keep) goes by those of its part; EventTerms puts the parts together.
class EventTerm : public Term {
 public:
  /// Number of event functions, one a point.
  virtual int eventCount() const = 0;

  /// Coefficient k of every event function on the series under way, into g[eventCount()]. k = 0 after
  /// beginSeries; k >= 1 after addOrder(k), with U_k and lambda_k given.
  virtual void eventOrder(int k, const ConstField& Uk, double lambdaK, double* g) const = 0;

  /// The points whose event function is zero at a state, up to the rounding of coordinates. Throws
  /// std::invalid_argument where a point is below zero.
  virtual std::vector<int> eventsAt(const ConstField& u, double lambda) const = 0;

  /// Whether event functions of the series under way are wrong at a state on it (path::Pieces::eventsAstray).
  virtual bool eventsAstray(const ConstField& /*u*/, double /*lambda*/,
                            const std::vector<int>& /*points*/) const {
    return false;
  }

  /// Changes these points from one condition to the other.
  virtual void applyEvent(const std::vector<int>& points) = 0;

  /// Condition of every point: 0 free, 1 active.
  virtual std::vector<int> conditions() const = 0;
  virtual void setConditions(const std::vector<int>& conditions) = 0;

  /// Negative pivots of the tangent that are owed to the term's active points.
  virtual int constraintPivots() const = 0;

  /// Receives once the stiffness of the body at every node (force per length; 0 where the node cannot move),
  /// which gives multipliers and conditions their size.
  virtual void setStiffness(const std::vector<double>& ofNodes) = 0;
};

}  // namespace atrapos::fem
