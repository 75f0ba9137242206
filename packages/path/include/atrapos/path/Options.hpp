#pragma once

#include <limits>
#include <optional>

namespace atrapos::path {

/// Where the rational form of a series (Padé) stands in for the polynomial.
enum class PadeUse {
  off,
  automatic,  ///< where its range is longer by a tenth and the residual passes; rests while it does not help
  on          ///< tried at every step
};

/// The knobs of path following. Lengths are lengths of the path parameter a, which at the start of the path
/// changes by sqrt(2) times the change of lambda unless `weight` is given.
struct Options {
  int order = 20;  ///< K, the highest order of the series, >= 1
  /// A series whose step ends near (an event, a stop, the longest length allowed) has as many orders as that
  /// end asks for (docs/theory/path.md). False: all of them, always.
  bool fewerOrders = true;
  /// K is chosen while running, in [5, 40], from the measured seconds of a factorization and of an order;
  /// `order` is that of the first step. Paths then depend on the machine and its load.
  bool autoOrder = false;
  double delta = 1e-6;   ///< accuracy asked of the series, eq. (36), in (0, 1)
  double direction = 1;  ///< +1: lambda grows at the start of the path; -1: it falls

  /// w in a = w <X - X0, X_1> + (lambda - lambda0) lambda_1, > 0, fixed for the whole path. Empty: chosen at
  /// the path's first step so that both terms weigh the same there, w = 1 / <Xhat, Xhat> with K_T Uhat = F. A
  /// value so large that |lambda_1| < 1e-8 reads as a singular tangent.
  std::optional<double> weight;

  PadeUse pade = PadeUse::automatic;  ///< saves a third of the steps (docs/failure_map.md)

  double residualBound = 1e-6;  ///< largest relative residual accepted at the end of a step

  /// Where a path goes on to another piece (Pieces) on which its state has a relative residual up to this, in
  /// [0, 1), forces jump there, as at a slight crease of a surface: Newton corrections lead on to the path
  /// beyond. Where they jump by more the path ends.
  double jumpBound = 1e-3;

  /// The residual left at a step's start is taken to zero along the step: order 1 gets -R0 / (last length) on
  /// its right-hand side. Costs one solve and no factorization, and does most of what Newton corrections do.
  bool relaxResidual = true;

  /// Newton correction at the end of a step whose relative residual exceeds this part of residualBound, in
  /// (0, 1]. Each iteration costs a factorization. With relaxResidual off, 1e-2 is a good value: a series
  /// started near the bound has no room left.
  double correctAbove = 0.5;
  int maxCorrections = 4;       ///< Newton iterations of one correction, >= 0 (0: never correct)
  int maxStartIterations = 25;  ///< Newton iterations at fixed lambda where the start is not in equilibrium

  /// A step whose series ends with another direction than the tangent found there is halved: least cosine of
  /// the angle between the two (in w <X, X> + lambda^2), in [0, 1).
  double minCosine = 0.9;

  /// Bifurcation points are located where the number of negative eigenvalues says that there is one (needs a
  /// tangent solver that tells it). One or two factorizations each, more where several lie close together.
  bool criticalPoints = true;

  /// Eigenvalues of the tangent next to zero that are followed from step to step, >= 0: 2 solves each a step
  /// and their rates by order 2 of the residual. They show two points in one step whose changes cancel in
  /// the count of negative eigenvalues, and make the search start there. Of unsymmetric tangents, whose
  /// factorization does not tell how many are negative, so many eigenvalues and one more are computed at each
  /// end of a step, and more where these leave the number open: some 15 solves a step. 0: neither.
  int watchedModes = 3;

  /// Looks for bifurcation points at every step, whatever the eigenvalues say: 2 K more right-hand sides and
  /// solves each, no factorization unless something is found.
  bool searchEveryStep = false;

  /// One factorization at the path's end, where the solver tells the inertia: without it the stability there,
  /// and what the last step passed, are not known.
  bool closeEnd = true;

  /// Where an unsymmetric tangent has a conjugate pair of eigenvalues that crosses the imaginary axis, the
  /// place is located (HopfPoint): as many eigenvalues next to zero as this, of K x = mu M x with
  /// Problem::mass, are computed at each step's end, and some nine factorizations spent on each point. 0:
  /// eigenvalues are those of K, and pairs are counted only.
  int hopfEigenvalues = 0;

  /// Longest step, which bounds series that terminate. None: 1e3, and no less than what changes lambda by 10:
  /// the unknowns are weighed at the start, and where next to nothing moves there, as before a tool touches,
  /// any motion is long later.
  std::optional<double> maxStep;
  double firstStep = 1e-3;  ///< first trial step of order 1, which has no estimate; later trials double
  double minStep = 1e-10;   ///< a cut-back below this ends the path
  int maxCutBacks = 40;     ///< trials of shorter lengths of one series, >= 0: a force that begins unseen, as
                            ///< that of a penalty law with a corner, lies any distance within its radius
  int maxSteps = 1000;      ///< >= 0

  /// Throws std::invalid_argument with one line that names the knob, its value and what is accepted.
  void validate() const;
};

}  // namespace atrapos::path
