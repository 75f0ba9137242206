#include "atrapos/path/Series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Tpetra_Vector.hpp>

#include "atrapos/linear/Dot.hpp"

namespace atrapos::path {

Series::Series(const State& start, double weight) : weight_(weight), memory_(start.memory) {
  auto u = Teuchos::rcp(new Vector(start.u->getMap(), false));
  Tpetra::deep_copy(*u, *start.u);
  x_.push_back({u, {}});
  lambda_.push_back(start.lambda);
  norm_.push_back(0);
}

void Series::append(Increment x, double lambda, double norm) {
  x_.push_back(std::move(x));
  lambda_.push_back(lambda);
  norm_.push_back(norm);
}

void Series::appendEvents(const std::vector<double>& g) {
  events_.resize(g.size());
  for (std::size_t i = 0; i < g.size(); ++i) events_[i].push_back(g[i]);
}

Series Series::reversed() const {
  Series s = *this;
  s.form_ = nullptr;
  for (int k = 1; k <= order(); k += 2) {
    s.x_[k].u = Teuchos::rcp(new Vector(*x_[k].u, Teuchos::Copy));
    s.x_[k].u->scale(-1);
    for (double& y : s.x_[k].internal) y = -y;
    s.lambda_[k] = -lambda_[k];
    for (auto& g : s.events_) g[k] = -g[k];
    if (!s.variables_.empty())
      for (double& z : s.variables_[k]) z = -z;
  }
  return s;
}

double Series::evaluate(double a, Vector& u) const {
  u.putScalar(0);
  if (form_) {
    const auto c = form_->weights(a);
    for (std::size_t k = 0; k < c.size(); ++k) u.update(c[k], *x_[k].u, 1);
  } else {
    for (int k = order(); k >= 0; --k) u.update(1, *x_[k].u, a);
  }
  return lambda(a);
}

State Series::state(double a) const {
  State state{Teuchos::rcp(new Vector(x_[0].u->getMap(), false)), 0, memory_};
  state.lambda = evaluate(a, *state.u);
  if (variables_.empty()) return state;
  auto memory = memory_ ? std::make_shared<Memory>(*memory_) : std::make_shared<Memory>();
  memory->u = Teuchos::rcp(new Vector(*state.u, Teuchos::Copy));
  memory->lambda = state.lambda;
  memory->variables.assign(variables_[0].size(), 0.0);
  const auto c = weights(a);
  for (std::size_t k = c.size(); k-- > 0;)
    for (std::size_t i = 0; i < memory->variables.size(); ++i)
      memory->variables[i] += c[k] * variables_[k][i];
  state.memory = std::move(memory);
  return state;
}

std::vector<double> Series::weights(double a) const {
  if (form_) return form_->weights(a);
  std::vector<double> c(order() + 1, 1.0);
  for (int k = 1; k <= order(); ++k) c[k] = c[k - 1] * a;
  return c;
}

std::vector<double> Series::derivativeWeights(double a) const {
  if (form_) return form_->derivativeWeights(a);
  std::vector<double> c(order() + 1, 0.0);
  double power = 1;
  for (int k = 1; k <= order(); ++k, power *= a) c[k] = k * power;
  return c;
}

double Series::derivative(double a, Vector& du) const {
  du.putScalar(0);
  double lambda = 0;
  const auto c = derivativeWeights(a);
  for (std::size_t k = 1; k < c.size(); ++k) {
    du.update(c[k], *x_[k].u, 1);
    lambda += c[k] * lambda_[k];
  }
  return lambda;
}

PathTangent Series::tangent(double a) const {
  PathTangent t;
  t.x.u = Teuchos::rcp(new Vector(x_[0].u->getMap(), false));
  t.lambda = derivative(a, *t.x.u);
  t.x.internal.assign(x_.back().internal.size(), 0);
  const auto c = derivativeWeights(a);
  for (std::size_t k = 1; k < c.size(); ++k)
    for (std::size_t i = 0; i < t.x.internal.size(); ++i) t.x.internal[i] += c[k] * x_[k].internal[i];
  return t;
}

double Series::lambda(double a) const { return lambdaFunction()(a); }

Rational Series::scalar(const std::vector<double>& coefficients) const {
  return form_ ? form_->fraction(coefficients) : Rational(Polynomial(coefficients));
}

Rational Series::functional(const Vector& weights) const {
  std::vector<double> c;
  for (const auto& x : x_) c.push_back(linear::dot(weights, *x.u));
  return scalar(c);
}

bool Series::standsStill() const {
  return std::all_of(norm_.begin() + 1, norm_.end(), [](double norm) { return norm == 0; });
}

bool Series::eventsMove() const {
  return std::any_of(events_.begin(), events_.end(), [](const std::vector<double>& g) {
    return std::any_of(g.begin() + 1, g.end(), [](double c) { return c != 0; });
  });
}

double Series::ratio(int k, double first, double last) {
  return last > 0 ? std::pow(first / last, 1.0 / (k - 1)) : std::numeric_limits<double>::infinity();
}

double Series::convergenceOfGrowth(int k) const {
  const auto growth = [&](int j) {
    double sum = 0;
    for (const int i : growing_) sum += events_[i][j] * events_[i][j];
    return std::sqrt(sum);
  };
  if (growing_.empty()) return std::numeric_limits<double>::infinity();
  // Functions are of size 1: where next to nothing grows it need not be right to more digits than that.
  constexpr double little = 1e-3;
  const double last = growth(k);
  return std::max(ratio(k, growth(1), last), last > 0 ? std::pow(little / last, 1.0 / k) : 0);
}

double Series::convergenceOfUnknowns(int k) const {
  const auto both = [&](int j) { return std::hypot(std::sqrt(weight_) * norm_[j], lambda_[j]); };
  double smallest = std::min(ratio(k, norm_[1], norm_[k]), ratio(k, both(1), both(k)));
  if (standsStill())
    for (const auto& g : events_)
      smallest = std::min(smallest, ratio(k, std::max(std::abs(g[0]), std::abs(g[1])), std::abs(g[k])));
  return smallest;
}

double Series::convergence(int k) const { return std::min(convergenceOfUnknowns(k), convergenceOfGrowth(k)); }

bool Series::hidesGrowth() const {
  const int K = order();
  return K > 2 && convergenceOfUnknowns(K) > 2 * convergenceOfGrowth(K);
}

double Series::radius(double delta) const {
  const int K = order();
  if (K < 2) return std::numeric_limits<double>::infinity();
  double rho = convergence(K);
  // An odd or even series has every other coefficient zero (or rounding noise, which would pass for a huge
  // range); elsewhere the two estimates differ by a few per cent.
  if (K > 2 && rho > 2 * convergence(K - 1)) rho = convergence(K - 1);
  return rho * std::pow(delta, 1.0 / (K - 1));
}

}  // namespace atrapos::path
