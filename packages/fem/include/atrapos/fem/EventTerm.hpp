#pragma once

#include <string>
#include <vector>

#include "atrapos/fem/Term.hpp"

namespace atrapos::fem {

/// A term that is analytic only piecewise and changes at roots of its event functions (docs/theory/path.md,
/// Events): one for each of its conditions, which is free or active. Conditions have the numbers of the whole
/// term. A term that several ranks share out (keep) knows those of its part's entities, its own, and tells
/// what these entities contribute; a condition may have entities in several parts. EventTerms puts the parts
/// together and remembers which conditions are active.
class EventTerm : public Term {
 public:
  /// Number of conditions of the whole term.
  virtual int eventCount() const = 0;
  /// [own condition] its number, ascending.
  virtual const std::vector<int>& eventNumbers() const = 0;
  /// The subject of a message on a condition's gap: "contact point 3 (of 40) is".
  virtual std::string eventText(int number) const = 0;

  /// Whether the functions of conditions that are active, or free, are known by their growth: not the
  /// function but its derivative along the path must not be negative (order 0 is not looked at).
  virtual bool grows(bool /*active*/) const { return false; }
  /// path::Problem::negligibleFall of these.
  virtual double negligibleFall() const { return 1e-10; }
  /// path::Problem::eventMayBeNone of a condition, the same on all ranks.
  virtual bool mayBeNone(int /*number*/) const { return false; }
  /// Not 0 of own conditions that may change at a state without effect, in parts that sum over all ranks;
  /// asked where free ones grow.
  virtual std::vector<double> indifferent(const ConstDofView& /*u*/, double /*lambda*/) const {
    return std::vector<double>(eventNumbers().size(), 0.0);
  }
  /// Coefficient k of the own conditions' event functions on the series under way: the part that sums over
  /// all ranks, and is to be divided by `covered`, too. k = 0 after beginSeries; k >= 1 after addOrder(k),
  /// with U_k and lambda_k given.
  virtual std::vector<double> eventOrder(int k, const ConstDofView& Uk, double lambdaK) const = 0;
  /// What each own condition has of the surface on the series under way, in such parts: 1 where all of it is
  /// there, as it is without pieces; 0 of a free condition that has nothing to come into contact with.
  virtual std::vector<double> covered() const = 0;

  /// The event functions of own conditions that are free, at a state, in such parts; zeros for the others.
  struct MeanGaps {
    std::vector<double> sum, covered;
  };
  virtual MeanGaps gapsAt(const ConstDofView& u, double lambda) const = 0;
  /// path::Problem::eventGradient of a condition, by its number in the whole term, the part that sums over
  /// all ranks: derivatives by the unknowns are added to byU. `has`: 1 where this part tells it, 0 elsewhere.
  struct Gradient {
    double has = 0, value = 0, byLambda = 0;
  };
  virtual Gradient eventGradient(int /*number*/, const ConstDofView& /*u*/, double /*lambda*/,
                                 const DofView& /*byU*/) const {
    return {};
  }
  /// What is wrong where a free condition's function is negative at the start of a path, behind its text and
  /// the amount.
  virtual std::string violation() const {
    return "inside the tool where the path starts; hard contact needs a gap >= 0";
  }
  /// Gaps below this are the rounding of coordinates.
  virtual double touching(const ConstDofView& u) const = 0;
  /// [own condition] not 0: at this state one of its points here is on another piece than in the series.
  virtual std::vector<double> moved(const ConstDofView& u, double lambda) const = 0;

  /// Whether the own conditions are active, 1, or free, 0.
  virtual void setConditions(const std::vector<int>& conditions) = 0;

  /// Whether an active condition has a multiplier among the unknowns, and so owes a negative pivot.
  virtual bool owesPivots() const { return true; }
  /// Whether conditions follow from a state but next to their changes (renewed).
  virtual bool renews() const { return false; }
  /// Whether the own conditions are active at a state, in parts that sum over all ranks, where
  /// `renews`.
  virtual std::vector<double> renewed(const ConstDofView& /*u*/, double /*lambda*/) const { return {}; }

  /// How far own conditions are from their change at a state, in units of what those differ by that change
  /// together, where that is known (1, else 0); in parts that sum over all ranks. Asked where `renews`.
  struct Nearness {
    std::vector<double> known, distance;
  };
  virtual Nearness nearChange(const ConstDofView& /*u*/, double /*lambda*/) const {
    return {std::vector<double>(eventNumbers().size(), 0.0), std::vector<double>(eventNumbers().size(), 0.0)};
  }

  /// The least stiffness of the body (force per length) at a node of each own condition, given those of the
  /// nodes (0 where a node cannot move); infinity where none can move.
  virtual std::vector<double> leastStiffness(const std::vector<double>& ofNodes) const = 0;
  /// Receives these once, the least of all parts, and the largest of all conditions that is not infinite:
  /// they give multipliers and conditions their size.
  virtual void setStiffness(const std::vector<double>& least, double largest) = 0;
};

}  // namespace atrapos::fem
