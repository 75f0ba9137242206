#pragma once

#include <Kokkos_Core.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace atrapos::fem {

using Execution = Kokkos::DefaultExecutionSpace;
using Memory = Execution::memory_space;
template <class T>
using View = Kokkos::View<T, Memory>;
/// The unknowns that a rank has, or forces on them, [dof].
using DofView = View<double*>;
using ConstDofView = View<const double*>;

/// Where a tangent is assembled: the rows of all dofs of a node have the same columns, in ascending order, so
/// one position serves the whole block of two nodes.
struct TangentSink {
  View<const std::size_t*> rowStart;  ///< [dof] first entry of the row
  View<double*> values;               ///< [entry]
  DofView loadDirection;              ///< [dof] F = -dR/dlambda
};

/// Named values that a law shows at its points (stresses, gaps, ...): [entity][point][name].
struct PointValues {
  std::vector<std::string> names;
  std::vector<double> values;
};

class DofMap;
class PointPieces;

/// Sums of squares of the entities' own forces at their nodes, before they are summed there: what equilibrium
/// is the cancellation of. [balance] of DofMap::balances, as far as the term has some.
using OwnForces = std::vector<double>;

/// The share of a term that one rank works on.
struct TermPart {
  std::vector<int> entities;  ///< numbers within the term, ascending
  std::vector<int> nodes;     ///< [entity of the part][node] as the rank counts them
};

/// One contribution F(u, lambda) to the residual: a law acting at the points of a set of entities, sum over
/// points of B^T law(B u, lambda). Virtual once per loop, never inside it. The unknowns are those of a
/// DofMap.
class Term {
 public:
  virtual ~Term() = default;

  virtual int numEntities() const = 0;
  virtual int nodesPerEntity() const = 0;
  virtual const std::vector<int>& nodes() const = 0;  ///< [entity][node]
  virtual bool symmetric() const = 0;
  virtual bool seesLoadFactor() const = 0;  ///< false: F depends on u alone

  /// Drops all entities but these; called at most once, before anything else, where a problem has several
  /// ranks. From then on the term is that of the part: fields, numbers of entities and sums over them. What
  /// it says about an entity names it by its number in the whole. Throws std::invalid_argument where the term
  /// cannot be shared out.
  virtual void keep(const TermPart& /*part*/) {
    throw std::invalid_argument("one of the problem's terms works on one rank only: start without mpirun");
  }

  /// Receives once which unknowns the nodes have and where these are in the matrix: position of the first
  /// unknown of node b in the rows of node a, [entity][a][b]. Throws std::logic_error where nodes lack a
  /// field that the term needs.
  virtual void connect(const DofMap& dofs, const std::vector<int>& positions) = 0;

  /// Internal variables of its points at the start of a path, [entity][point][variable]; empty: the term
  /// remembers nothing.
  virtual std::vector<double> startVariables() const { return {}; }
  /// From here on states have these variables at (u, lambda), and elsewhere those that the straight way from
  /// there makes of them. Before anything else that takes a state.
  virtual void remember(const double* /*variables*/, const ConstDofView& /*u*/, double /*lambda*/) {}
  /// The variables at a state.
  virtual std::vector<double> variablesAt(const ConstDofView& /*u*/, double /*lambda*/) const { return {}; }
  /// Their coefficients on the series under way, [order][entity][point][variable], when the order added last
  /// is (`last`, `lastLambda`); no order can be added afterwards.
  virtual std::vector<std::vector<double>> variableOrders(const ConstDofView& /*last*/,
                                                          double /*lastLambda*/) {
    return {};
  }

  /// f += F(u, lambda).
  virtual OwnForces addResidual(const ConstDofView& u, double lambda, const DofView& f) const = 0;

  /// K += dF/du, load direction -= dF/dlambda.
  virtual void addTangent(const ConstDofView& u, double lambda, const TangentSink& sink) const = 0;

  /// K += C, the derivative of what the term stores by the unknowns, where these have rates (fem::Capacity;
  /// the load direction is left alone). False: it stores nothing.
  virtual bool addCapacity(const ConstDofView& /*u*/, double /*lambda*/, const TangentSink& /*sink*/) const {
    return false;
  }

  /// Order 0 of the series at (u, lambda); histories for orders up to maxOrder. Throws taylor::DomainError,
  /// naming the point, where the law has no series.
  virtual void beginSeries(const ConstDofView& u, double lambda, int maxOrder) = 0;

  /// Makes order k - 1, (`last`, `lastLambda`), known (k > 1; unused for k = 1), then f += order k of
  /// F(u(a), lambda(a)) with U_k = 0 and lambda_k = 0.
  virtual void addOrder(int k, const ConstDofView& last, double lastLambda, const DofView& f) = 0;

  /// Internal variables that take part in the path parameter, of this rank's entities: numbers of which a
  /// change by 1 is much (path::Problem::internalOrder). The same number at all states.
  virtual int internalCount() const { return 0; }
  /// y[i] = their order k if U_k were v and lambda_k were mu, between addOrder(k) and the next.
  virtual void internalOrder(int /*k*/, const ConstDofView& /*v*/, double /*mu*/, double* /*y*/) const {}

  /// The pieces that its points are on, the term's own; null where the law is analytic everywhere.
  virtual PointPieces* pieces() { return nullptr; }
  /// What pieces are found from, in the state (u, lambda): [point][input] (PieceSearch); empty where there
  /// are none.
  virtual std::vector<double> places(const ConstDofView& /*u*/, double /*lambda*/) const { return {}; }

  /// The law's named values at every point in the state (u, lambda).
  virtual PointValues observe(const ConstDofView& u, double lambda) const = 0;

  /// Bytes of the histories of a series of order maxOrder.
  virtual std::size_t historyBytes(int maxOrder) const = 0;
};

}  // namespace atrapos::fem
