#pragma once

namespace atrapos::linear {

/// How K x = b is solved by Krylov iterations, with one preconditioner for all right-hand sides of a tangent.
struct KrylovOptions {
  enum class Preconditioner {
    singleFactor,  ///< MUMPS' factor in single precision, half the memory; not with hard contact's
                   ///< multipliers
    ilu  ///< Ifpack2's incomplete factor with thresholds: memory as K's; not for thin bodies or multipliers
  };
  Preconditioner preconditioner = Preconditioner::singleFactor;

  /// A solution x is good where |b - K x| is below tolerance |b|, or below rounding, eps |K| |x|, which is
  /// more in thin bodies; 2-norms, |K| by row sums; checked on the residual itself. In (0, 1).
  double tolerance = 1e-9;

  /// Most iterations of one solve. Beyond them, or where a restart does not halve the residual, the solve
  /// throws SolverError.
  int maxIterations = 300;

  /// Vectors after which the iterations start anew.
  int subspace = 50;

  /// Start vectors combine this many earlier solutions of the same tangent; 0: start from zero.
  int startVectors = 20;

  /// singleFactor: relative size of what is dropped from dense blocks (block low-rank format); 0: full
  /// blocks.
  double lowRank = 0;

  /// ilu: entries of a factor's row against those of K's, at least 1.
  double fill = 3;
  /// ilu: entries below this part of their row's size are dropped.
  double drop = 1e-4;
};

}  // namespace atrapos::linear
