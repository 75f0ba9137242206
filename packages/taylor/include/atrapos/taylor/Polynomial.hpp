#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "atrapos/taylor/Law.hpp"

namespace atrapos::taylor {

/// sum_k c_k a^k: one scalar along the path parameter a. Host.
class Polynomial {
 public:
  Polynomial() = default;  ///< zero: no coefficients
  explicit Polynomial(std::vector<double> coefficients) : c_(std::move(coefficients)) {}

  const std::vector<double>& coefficients() const { return c_; }

  /// At a, by Horner's rule.
  double value(double a) const {
    double sum = 0;
    for (auto c = c_.rbegin(); c != c_.rend(); ++c) sum = sum * a + *c;
    return sum;
  }

  /// d/da, one coefficient less.
  Polynomial derivative() const {
    std::vector<double> d;
    for (std::size_t k = 1; k < c_.size(); ++k) d.push_back(static_cast<double>(k) * c_[k]);
    return Polynomial(std::move(d));
  }

 private:
  std::vector<double> c_;
};

/// The series of a law's outputs at one point where those of all its inputs are known: derived quantities
/// anywhere on the path. in[numInputs], data[numData]; every output has as many coefficients as the longest
/// input, shorter inputs go on with zeros. Throws std::invalid_argument where the inputs do not fit the law
/// and DomainError where it has no series at a = 0. Host.
template <class Law>
std::vector<Polynomial> polynomials(const Law& law, const std::vector<Polynomial>& in,
                                    const double* data = nullptr) {
  constexpr int n = Law::numInputs, m = Law::numOutputs;
  if (in.size() != static_cast<std::size_t>(n))
    throw std::invalid_argument("polynomials: the law has " + std::to_string(n) + " inputs, " +
                                std::to_string(in.size()) + " series were given");
  if (Law::numData > 0 && data == nullptr)
    throw std::invalid_argument("polynomials: the law needs " + std::to_string(Law::numData) +
                                " data, none were given");
  std::size_t length = 0;
  for (const Polynomial& p : in) length = std::max(length, p.coefficients().size());
  if (length == 0) throw std::invalid_argument("polynomials: at least one input needs a coefficient");

  Context<1> context;
  Failures<1> failures;
  context.shape = historyShape(law);
  std::vector<double> memory(context.shape.template doubles<1>(static_cast<int>(length) - 1));
  context.memory = memory.data();
  context.failures = &failures;
  Lanes<1> x[n], d[Law::numData + 1] = {}, y[m];
  for (int j = 0; j < Law::numData; ++j) d[j] = data[j];
  std::vector<std::vector<double>> out(m);
  for (std::size_t k = 0; k < length; ++k) {
    context.order = static_cast<int>(k);
    for (int j = 0; j < n; ++j) {
      const auto& c = in[j].coefficients();
      x[j] = k < c.size() ? c[k] : 0.0;
    }
    if (k == 0)
      start(law, context, x, d, y);
    else
      sweepKnown(law, context, x, d, y);
    for (int i = 0; i < m; ++i) {
      if (!std::isfinite(y[i][0])) {
        const bool named = failures.operation[0] != Operation::None;
        throw DomainError(named ? failures.operation[0] : Operation::Result,
                          named ? failures.value[0] : y[i][0],
                          "output " + std::to_string(i) + ", order " + std::to_string(k));
      }
      out[i].push_back(y[i][0]);
    }
  }
  std::vector<Polynomial> result;
  for (auto& c : out) result.emplace_back(std::move(c));
  return result;
}

}  // namespace atrapos::taylor
