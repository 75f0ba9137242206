#pragma once

#include <optional>
#include <string>
#include <vector>

#include "atrapos/path/State.hpp"

namespace atrapos::path {

/// Size of a residual: its Euclidean norm and the norm of the forces it is the difference of.
struct ResidualNorm {
  double norm = 0;   ///< ||R||, in force units
  double scale = 0;  ///< ||forces||, same units, > 0; chosen by the Problem
  double relative() const { return norm / scale; }
};

class Pieces;

/// What path following needs from any physics: R(U, lambda) = 0 and its series.
///
/// With U(a) = sum a^k U_k and lambda(a) = sum a^k lambda_k around a solution, order k of R is linear in
/// (U_k, lambda_k) with the same tangent for every k:
///
///     K_T U_k = lambda_k F + F_k,   K_T = dR/dU,   F = -dR/dlambda,
///     F_k = -[order k of R(U(a), lambda(a)) with U_k = 0 and lambda_k = 0].
///
/// One step calls tangent, beginSeries, then for k = 1, 2, ...: orderRhs(k), [internalOrder(k, ...)],
/// completeOrder(k, U_k, lambda_k). residual may be called between two orders, and leaves the series as it
/// is. A series may end before maxOrder. Vectors live on map().
class Problem {
 public:
  virtual ~Problem() = default;

  virtual RCP<const Map> map() const = 0;

  /// True where K_T is symmetric at every state (decides the tangent solver).
  virtual bool symmetric() const { return true; }

  /// r = R(state); r is overwritten.
  virtual ResidualNorm residual(const State& state, Vector& r) = 0;

  /// How large v . R(state) is to the forces that it is the difference of, v of norm 1: what a relative
  /// residual of 1 may leave of it. Default: ResidualNorm::scale.
  virtual double scaleAlong(const Vector& v, const State& state);

  /// K_T and F = -dR/dlambda at a state. The matrix is the Problem's own: its graph never changes, its values
  /// hold until the next call. With internal variables that follow rates K_T is their continuum tangent, that
  /// of the path through the state.
  virtual RCP<const CrsMatrix> tangent(const State& state, Vector& F) = 0;

  /// Starts a series at a state with coefficients up to maxOrder.
  virtual void beginSeries(const State& state, int maxOrder) = 0;

  /// F_k of order k >= 1 from the orders completed so far.
  virtual void orderRhs(int k, Vector& Fk) = 0;

  /// Makes order k known: U_k and lambda_k.
  virtual void completeOrder(int k, const Vector& Uk, double lambdaK) = 0;

  /// Number of internal variables that take part in inner(); 0 where there are none.
  virtual int internalCount() const { return 0; }

  /// Coefficient k of the internal variables if U_k were v and lambda_k were mu. Called between orderRhs(k)
  /// and completeOrder(k); y has internalCount() entries and is overwritten.
  virtual void internalOrder(int /*k*/, const Vector& /*v*/, double /*mu*/,
                             std::vector<double>& /*y*/) const {}

  /// Whether states have internal variables (Memory::variables).
  virtual bool remembers() const { return false; }

  /// Coefficients of the internal variables on the series under way, [order 0 .. the last
  /// completed][variable]. Called once, when no further order is wanted.
  virtual std::vector<std::vector<double>> memoryOrders() { return {}; }

  /// The same state with internal variables that are its own (Memory::u is u): a point that the path goes on
  /// from.
  virtual State settled(const State& state) { return state; }

  /// Number of event functions: scalars of the state that are not negative while the Problem is what it is. 0
  /// where it never changes.
  virtual int eventCount() const { return 0; }

  /// Coefficient k of every event function on the series under way; k = 0 after beginSeries, k >= 1 after
  /// completeOrder(k). g has eventCount() entries and is overwritten.
  virtual void eventOrder(int /*k*/, std::vector<double>& /*g*/) const {}

  /// The event functions that are known by their growth at a state, ascending: it is not the function that
  /// must not be negative but its derivative along the path (plastic work at a point that yields). Their
  /// order 0 is not looked at.
  virtual std::vector<int> growingAt(const State& /*state*/) const { return {}; }

  /// How far one of those may fall without an event, beside its size of 1: rounding, or what makes no
  /// difference (flow back at a smoothed yield surface, next to no stress).
  virtual double negligibleFall(int /*event*/) const { return 1e-10; }

  /// Whether a zero of this function on a series may be none at the state there, however far the series
  /// converges: the function is asked itself (a minimum of a gap that leaves the part where it counts).
  virtual bool eventMayBeNone(int /*event*/) const { return false; }

  /// The event functions that are zero at a state from which a path starts, to the rounding of the state:
  /// they may have to be applied at once. Throws where one is below zero.
  virtual std::vector<int> eventsAt(const State& /*state*/) { return {}; }

  /// These event functions have fallen to zero at the state, and the Problem is another one behind it (a gap
  /// closes and becomes a constraint, a force vanishes and sets a point free): the same point with the memory
  /// of the changed Problem. It solves that Problem too, the map and the graph stay, and the functions of
  /// these indices are others that start at zero. The same indices at the result change it back. Indices from
  /// eventCount() on are those of breaks (pieces()).
  virtual State afterEvent(const std::vector<int>& /*indices*/, const State& state) { return state; }

  /// Where an event lets something begin or end that has a size there already (a zone of contact counts from
  /// a depth on), the state behind it is looked for where the event function still vanishes, not at the same
  /// load: its value, derivatives by the unknowns (overwritten) and by lambda at the state, up to one factor.
  /// False where the state solves the changed Problem as it is.
  virtual bool eventGradient(int /*index*/, const State& /*state*/, double& /*value*/, Vector& /*byU*/,
                             double& /*byLambda*/) {
    return false;
  }

  /// Further event functions that are due where these fall to zero, at this state: what symmetry brings
  /// together and only rounding, or the bound of the residual, tells apart; what may change here as well as
  /// later.
  virtual std::vector<int> eventsBeside(const std::vector<int>& /*indices*/, const State& /*state*/) {
    return {};
  }

  /// Where the Problem is analytic piece by piece only; null: everywhere between its events. The object is
  /// the Problem's own.
  virtual Pieces* pieces() { return nullptr; }

  /// Negative pivots of the last K_T that are owed to constraints with multipliers among the unknowns: they
  /// say nothing about stability and are not counted.
  virtual int constraintPivots() const { return 0; }

  /// M in M dU/dt = -R(U, lambda), on the graph of the tangent or a smaller one: it says which states are
  /// stable where the unknowns have rates of different weights or none (docs/theory/stability.md). Null:
  /// dU/dt = -R. The matrix is the Problem's own, its values hold until the next call.
  virtual RCP<const CrsMatrix> mass(const State& /*state*/) { return Teuchos::null; }

  /// What eigenvalues of a tangent that is not symmetric are measured by where no mass() says so: m > 0 in
  /// K x = mu diag(m) x, of the last tangent. Signs of real eigenvalues do not depend on it, but which ones
  /// are next to zero does where fields of different units act together. Null: all 1.
  virtual RCP<const Vector> eigenvalueWeights(const State& /*state*/) { return Teuchos::null; }

  /// The inner product behind the path parameter (without its weight w and its load term):
  /// a = w <X - X0, X_1> + (lambda - lambda0) lambda_1 with X = (unknowns, internal variables).
  /// Default: the Euclidean product of the unknowns.
  virtual double inner(const Increment& x, const Increment& y) const;

  /// Norms of the changes of fields of different units (displacements, temperatures) over a step: 0 for one
  /// that is at rest but for rounding and the mesh's error. Empty where there is one such field.
  virtual std::vector<double> fieldChanges(const State& /*from*/, const State& /*to*/) { return {}; }

  /// What inner() multiplies the products of these fields by from now on, > 0 each; empty: 1. The Problem's
  /// own state, as it is between two steps of a path.
  virtual void weighFields(const std::vector<double>& /*factors*/) {}

  /// w of the path parameter for the step under way: `given` by the path (Options::weight, or that of its
  /// earlier steps), or chosen from the response Xhat to the load at its first step. Called before inner()
  /// is; what inner() takes from it must depend on the result alone. Default: 1 / <Xhat, Xhat>.
  virtual double weight(const Increment& Xhat, std::optional<double> given);

  /// Whether a change of the unknowns is so small that nobody would see it: the response to a load that has
  /// next to no effect yet, by which no weight is chosen.
  virtual bool isNegligible(const Vector& /*change*/) const { return false; }

  /// What messages call an unknown (its global index in map()): a node and a component where the Problem
  /// knows them. Default: "unknown 17".
  virtual std::string name(long long unknown) const;
};

}  // namespace atrapos::path
