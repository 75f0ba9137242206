#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "atrapos/linear/Types.hpp"

namespace atrapos::linear {

/// Signs of the eigenvalues of a symmetric tangent (Sylvester's law of inertia on L D L^T).
struct Inertia {
  long long negative = 0;  ///< negative pivots = negative eigenvalues
  long long null = 0;      ///< pivots found to be zero (to the solver's threshold)
};

/// Solves K x = b many times with one factorization of the tangent K.
///
/// Order of calls: analyze once per graph, factor once per value of K, solve as often as wanted.
/// All calls are collective on the communicator of K's row map. Failures throw linear::SolverError.
class TangentSolver {
 public:
  virtual ~TangentSolver() = default;

  /// Symbolic analysis of K's graph (ordering, memory). K is fill-complete, square, row map = domain map.
  virtual void analyze(const RCP<const CrsMatrix>& K) = 0;

  /// Numerical factorization; K has the graph last analysed. A numerically singular K throws SolverError.
  virtual void factor(const RCP<const CrsMatrix>& K) = 0;

  /// x = K^-1 b, column by column. x and b live on K's row map and may be the same object.
  virtual void solve(const MultiVector& b, MultiVector& x) const = 0;

  /// x = K^-T b.
  virtual void solveTransposed(const MultiVector& b, MultiVector& x) const = 0;

  /// Inertia of the last factorization; empty where the solver cannot tell (unsymmetric modes).
  virtual std::optional<Inertia> inertia() const = 0;

  /// Name for reports, e.g. "MUMPS SYM=2, METIS".
  virtual std::string name() const = 0;

  /// Counters since construction (a multi-column solve counts its columns).
  struct Counters {
    long long analyses = 0, factorizations = 0, solves = 0;
    double analysisSeconds = 0, factorSeconds = 0, solveSeconds = 0;
  };
  virtual const Counters& counters() const = 0;
};

}  // namespace atrapos::linear
