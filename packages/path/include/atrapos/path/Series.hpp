#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "atrapos/path/Pade.hpp"
#include "atrapos/path/State.hpp"

namespace atrapos::path {

/// One step's Taylor series: X(a) = sum_{k=0..K} a^k X_k, lambda(a) = sum_{k=0..K} a^k lambda_k, with
/// X = (unknowns, internal variables). Anywhere inside the step the path is this series: dense output
/// costs no solve.
///
/// Order 0 is the state that the series starts from; the internal variables of order 0 are not known to path
/// following and are left empty.
class Series {
 public:
  /// Starts with order 0 only.
  Series(const State& start, double weight);

  /// The highest order present, K.
  int order() const { return static_cast<int>(lambda_.size()) - 1; }

  const Increment& coefficient(int k) const { return x_.at(k); }
  double lambdaCoefficient(int k) const { return lambda_.at(k); }

  /// ||X_k|| in the Problem's inner product.
  double norm(int k) const { return norm_.at(k); }

  /// w of a = w <X - X0, X_1> + (lambda - lambda0) lambda_1.
  double weight() const { return weight_; }

  /// From here on evaluate() and all that follows it read the path off this rational form; null: off the
  /// polynomial. The coefficients stay as they are.
  void setForm(std::shared_ptr<const Pade> form) { form_ = std::move(form); }
  const std::shared_ptr<const Pade>& form() const { return form_; }

  /// u = U(a); returns lambda(a).
  double evaluate(double a, Vector& u) const;

  /// The point at a, with the memory that the Problem has there.
  State state(double a) const;

  /// du = dU/da (a); returns dlambda/da (a).
  double derivative(double a, Vector& du) const;

  /// dX/da with the internal variables, and dlambda/da.
  PathTangent tangent(double a) const;

  double lambda(double a) const;

  /// lambda as a function of a.
  Rational lambdaFunction() const { return scalar(lambda_); }

  /// weights . U(a) as a function of a: a displacement, a mean, a reaction.
  Rational functional(const Vector& weights) const;

  /// A scalar with these Taylor coefficients, in the form that the path has.
  Rational scalar(const std::vector<double>& coefficients) const;

  /// Validity, eq. (36): (delta ||X_1|| / ||X_K||)^(1/(K-1)), once with the norm of X alone as printed and
  /// once with w ||X||^2 + lambda^2 (where U is the better parameter, lambda is what the truncation spoils);
  /// and with the norm of the event functions that grow (forces may not show what they do: where a state is
  /// homogeneous they balance whatever it is); the smallest. Where X_K is nearly zero by symmetry, order K-1
  /// stands in for it. Infinity where all vanish (the series terminates) and for K = 1 (nothing to estimate
  /// from). Where the unknowns stand still, that of the event functions.
  double radius(double delta) const;

  /// Whether no unknown moves, only lambda.
  bool standsStill() const;
  /// Whether an event function changes on the path.
  bool eventsMove() const;

  /// Coefficients of the Problem's internal variables, [k][variable], for all orders present.
  void setMemory(std::vector<std::vector<double>> orders) { variables_ = std::move(orders); }
  /// The same path as `other`, its memory besides.
  void takeMemory(const Series& other) { variables_ = other.variables_; }
  const std::vector<std::vector<double>>& memoryOrders() const { return variables_; }

  /// Coefficient k of the Problem's event functions, k = 0, 1, ... in turn.
  void appendEvents(const std::vector<double>& g);
  int eventCount() const { return static_cast<int>(events_.size()); }
  const std::vector<double>& eventCoefficients(int i) const { return events_.at(i); }

  /// Whether what grows has a series much shorter than the unknowns have: forces do not tell how far that one
  /// leads.
  bool hidesGrowth() const;

  /// One of Problem::growingAt of its start, in ascending order, and its Problem::negligibleFall.
  void addGrowing(int event, double negligibleFall) {
    growing_.push_back(event);
    negligibleFalls_.push_back(negligibleFall);
  }
  bool eventGrows(int i) const { return std::binary_search(growing_.begin(), growing_.end(), i); }
  /// Problem::negligibleFall of one that grows.
  double negligibleFall(int i) const {
    return negligibleFalls_[std::lower_bound(growing_.begin(), growing_.end(), i) - growing_.begin()];
  }

  /// The same path with a replaced by -a.
  Series reversed() const;

  /// Appends order K+1; `norm` is ||x|| in the Problem's inner product.
  void append(Increment x, double lambda, double norm);

  /// Estimate of the radius of convergence, radius(1).
  double convergenceRadius() const { return radius(1); }

 private:
  static double ratio(int k, double first, double last);  ///< (first/last)^(1/(k-1))
  /// (||X_1|| / ||X_k||)^(1/(k-1)), the smaller over both norms; of the event functions, max(|g_0|, |g_1|)
  /// over |g_k|, where the unknowns stand still.
  double convergenceOfUnknowns(int k) const;
  double convergenceOfGrowth(int k) const;  ///< the same with the norm of all that grow
  double convergence(int k) const;
  /// Factors of X_0 .. X_K in X(a).
  std::vector<double> weights(double a) const;
  /// Factors of X_0 .. X_K in dX/da (a).
  std::vector<double> derivativeWeights(double a) const;

  double weight_;
  std::shared_ptr<const Pade> form_;
  std::vector<Increment> x_;
  std::vector<double> lambda_;
  std::vector<double> norm_;
  std::vector<std::vector<double>> events_;     ///< coefficients of each event function
  std::vector<int> growing_;                    ///< event functions known by their growth, ascending
  std::vector<double> negligibleFalls_;         ///< of these
  std::shared_ptr<const Memory> memory_;        ///< at the start
  std::vector<std::vector<double>> variables_;  ///< coefficients of the internal variables, [k][variable]
};

}  // namespace atrapos::path
