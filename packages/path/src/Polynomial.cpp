#include "atrapos/path/Polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace atrapos::path {

double Polynomial::operator()(double a) const {
  double p = 0;
  for (std::size_t k = c_.size(); k-- > 0;) p = p * a + c_[k];
  return p;
}

Polynomial Polynomial::derivative() const {
  std::vector<double> d;
  for (std::size_t k = 1; k < c_.size(); ++k) d.push_back(static_cast<double>(k) * c_[k]);
  return Polynomial(std::move(d));
}

Polynomial Polynomial::plus(double factor, const Polynomial& q) const {
  auto c = c_;
  if (c.size() < q.c_.size()) c.resize(q.c_.size(), 0);
  for (std::size_t k = 0; k < q.c_.size(); ++k) c[k] += factor * q.c_[k];
  return Polynomial(std::move(c));
}

Polynomial Polynomial::operator*(const Polynomial& q) const {
  if (c_.empty() || q.c_.empty()) return {};
  std::vector<double> c(c_.size() + q.c_.size() - 1, 0.0);
  for (std::size_t i = 0; i < c_.size(); ++i)
    for (std::size_t j = 0; j < q.c_.size(); ++j) c[i + j] += c_[i] * q.c_[j];
  return Polynomial(std::move(c));
}

Polynomial Polynomial::minus(double value) const {
  auto c = c_;
  if (c.empty()) c.push_back(0);
  c[0] -= value;
  return Polynomial(std::move(c));
}

Polynomial Polynomial::withoutRootAtZero() const {
  if (c_.empty()) return {};
  return Polynomial(std::vector<double>(c_.begin() + 1, c_.end()));
}

double Polynomial::magnitude(double a) const {
  double p = 0;
  for (std::size_t k = c_.size(); k-- > 0;) p = p * std::abs(a) + std::abs(c_[k]);
  return p;
}

namespace {

using Bernstein = std::vector<double>;

/// Bernstein coefficients on [0, 1] of sum_k d_k t^k: b_j = sum_{k<=j} C(j,k)/C(n,k) d_k.
Bernstein bernstein(const std::vector<double>& d) {
  const int n = static_cast<int>(d.size()) - 1;
  Bernstein b(d.size());
  for (int j = 0; j <= n; ++j) {
    double ratio = 1;  // C(j,k)/C(n,k)
    double sum = d[0];
    for (int k = 1; k <= j; ++k) {
      ratio *= static_cast<double>(j - k + 1) / (n - k + 1);
      sum += ratio * d[k];
    }
    b[j] = sum;
  }
  return b;
}

/// Sign changes of the sequence, zeros skipped: an upper bound of the number of roots inside.
int variations(const Bernstein& b) {
  int count = 0;
  double last = 0;
  for (const double x : b) {
    if (x == 0) continue;
    if (last != 0 && (x > 0) != (last > 0)) ++count;
    last = x;
  }
  return count;
}

struct Isolation {
  double flat = 0;                               ///< below this size a Bernstein polynomial is rounding noise
  std::vector<std::pair<double, double>> found;  ///< root and the width it is known to

  void search(Bernstein right, double lo, double hi) {
    if (variations(right) == 0) return;
    const double mid = 0.5 * (lo + hi);
    double largest = 0;
    for (const double x : right) largest = std::max(largest, std::abs(x));
    if (largest <= flat || mid <= lo || mid >= hi) {
      found.emplace_back(mid, hi - lo);
      return;
    }
    // de Casteljau at 1/2: `left` collects the first entries, `right` keeps the last ones.
    const std::size_t n = right.size();
    Bernstein left(n);
    for (std::size_t i = 0; i < n; ++i) {
      left[i] = right[0];
      for (std::size_t j = 0; j + 1 < n - i; ++j) right[j] = 0.5 * (right[j] + right[j + 1]);
    }
    search(left, lo, mid);
    if (right[0] == 0) found.emplace_back(mid, 0.0);
    search(std::move(right), mid, hi);
  }
};

}  // namespace

std::vector<double> Polynomial::roots(double end) const {
  std::vector<double> d = c_;
  double power = 1, size = 0;
  for (double& x : d) {
    x *= power;
    power *= end;
    size = std::max(size, std::abs(x));
    if (!std::isfinite(x)) return {};
  }
  while (!d.empty() && d.back() == 0) d.pop_back();
  if (d.size() < 2) return {};
  Isolation isolation;
  isolation.flat = 2 * std::numeric_limits<double>::epsilon() * size;
  auto b = bernstein(d);
  const double atEnd = b.back();
  isolation.search(std::move(b), 0, 1);
  if (atEnd == 0) isolation.found.emplace_back(1.0, 0.0);
  std::sort(isolation.found.begin(), isolation.found.end());

  // A root that rounding noise smears over neighbouring intervals is one root.
  std::vector<double> roots;
  double lastEnd = -1;
  for (const auto& [t, width] : isolation.found) {
    if (t <= 0) continue;
    if (t - 2 * width - 1e-14 > lastEnd) roots.push_back(std::min(t, 1.0) * end);
    lastEnd = t + 2 * width;
  }
  return roots;
}

}  // namespace atrapos::path
