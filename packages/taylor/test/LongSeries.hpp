#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

/// Truncated series with long double coefficients, all orders at once: the oracle of the tests. Functions
/// are built by other recurrences than the library's where there are any (tan = sin/cos, pow = exp(r log),
/// log = integral of a'/a), for clarity, never for speed.
struct LongSeries {
  std::vector<long double> c;

  LongSeries() = default;
  LongSeries(double constant) : c(1, constant) {}
  explicit LongSeries(std::vector<long double> coefficients) : c(std::move(coefficients)) {}
  long double at(std::size_t k) const { return k < c.size() ? c[k] : 0.0L; }
};

template <class F>
LongSeries build(std::size_t n, F coefficient) {
  LongSeries r{std::vector<long double>(n, 0.0L)};
  for (std::size_t k = 0; k < n; ++k) r.c[k] = coefficient(k, r);
  return r;
}

inline std::size_t length(const LongSeries& a, const LongSeries& b) {
  return std::max(a.c.size(), b.c.size());
}

inline LongSeries operator+(const LongSeries& a, const LongSeries& b) {
  return build(length(a, b), [&](std::size_t k, auto&) { return a.at(k) + b.at(k); });
}
inline LongSeries operator-(const LongSeries& a, const LongSeries& b) {
  return build(length(a, b), [&](std::size_t k, auto&) { return a.at(k) - b.at(k); });
}
inline LongSeries operator-(const LongSeries& a) { return LongSeries(0.0) - a; }
inline LongSeries operator*(const LongSeries& a, const LongSeries& b) {
  return build(length(a, b), [&](std::size_t k, auto&) {
    long double s = 0;
    for (std::size_t i = 0; i <= k; ++i) s += a.at(i) * b.at(k - i);
    return s;
  });
}
inline LongSeries operator/(const LongSeries& a, const LongSeries& b) {
  return build(length(a, b), [&](std::size_t k, auto& r) {
    long double s = a.at(k);
    for (std::size_t i = 1; i <= k; ++i) s -= b.at(i) * r.c[k - i];
    return s / b.at(0);
  });
}
inline LongSeries operator+(double a, const LongSeries& b) { return LongSeries(a) + b; }
inline LongSeries operator-(double a, const LongSeries& b) { return LongSeries(a) - b; }
inline LongSeries operator*(double a, const LongSeries& b) { return LongSeries(a) * b; }
inline LongSeries operator/(double a, const LongSeries& b) { return LongSeries(a) / b; }
inline LongSeries& operator+=(LongSeries& a, const LongSeries& b) { return a = a + b; }
inline LongSeries& operator-=(LongSeries& a, const LongSeries& b) { return a = a - b; }
inline LongSeries& operator*=(LongSeries& a, const LongSeries& b) { return a = a * b; }
inline LongSeries& operator/=(LongSeries& a, const LongSeries& b) { return a = a / b; }

/// c0 + integral of w a'
inline LongSeries integral(long double c0, const LongSeries& w, const LongSeries& a) {
  return build(length(a, w), [&](std::size_t k, auto&) {
    long double s = 0;
    for (std::size_t i = 1; i <= k; ++i) s += i * a.at(i) * w.at(k - i);
    return k == 0 ? c0 : s / k;
  });
}

inline LongSeries sqrt(const LongSeries& a) {
  return build(a.c.size(), [&](std::size_t k, auto& r) {
    if (k == 0) return std::sqrt(a.c[0]);
    long double s = a.c[k];
    for (std::size_t i = 1; i < k; ++i) s -= r.c[i] * r.c[k - i];
    return s / (2 * r.c[0]);
  });
}
inline LongSeries exp(const LongSeries& a) {
  return build(a.c.size(), [&](std::size_t k, auto& r) {
    long double s = 0;
    for (std::size_t i = 1; i <= k; ++i) s += i * a.c[i] * r.c[k - i];
    return k == 0 ? std::exp(a.c[0]) : s / k;
  });
}
inline LongSeries log(const LongSeries& a) { return integral(std::log(a.c[0]), LongSeries(1.0) / a, a); }
inline LongSeries pow(const LongSeries& a, double r) { return exp(r * log(a)); }
inline LongSeries pow(const LongSeries& a, int n) {
  LongSeries r(1.0);
  for (int i = 0; i < std::abs(n); ++i) r = r * a;
  return n < 0 ? 1.0 / r : r;
}
// sin and cos (sign = -1), sinh and cosh (sign = 1) from the derivatives of order 0 at a_0 and the powers of
// a - a_0.
inline LongSeries bySubstitution(const LongSeries& a, long double f0, long double f1, long double sign) {
  LongSeries delta = a, power(1.0), sum(0.0);
  delta.c[0] = 0;
  long double factorial = 1;
  for (std::size_t k = 0; k < a.c.size(); ++k) {
    if (k > 0) factorial *= k;
    const long double derivative = (k % 2 == 0 ? f0 : f1) * (k / 2 % 2 == 0 ? 1 : sign);
    sum = sum + LongSeries(std::vector<long double>{derivative / factorial}) * power;
    power = power * delta;
  }
  return sum;
}
inline LongSeries sin(const LongSeries& a) {
  return bySubstitution(a, std::sin(a.c[0]), std::cos(a.c[0]), -1);
}
inline LongSeries cos(const LongSeries& a) {
  return bySubstitution(a, std::cos(a.c[0]), -std::sin(a.c[0]), -1);
}
inline LongSeries sinh(const LongSeries& a) {
  return bySubstitution(a, std::sinh(a.c[0]), std::cosh(a.c[0]), 1);
}
inline LongSeries cosh(const LongSeries& a) {
  return bySubstitution(a, std::cosh(a.c[0]), std::sinh(a.c[0]), 1);
}
inline LongSeries tan(const LongSeries& a) { return sin(a) / cos(a); }
inline LongSeries tanh(const LongSeries& a) { return sinh(a) / cosh(a); }
inline LongSeries atan(const LongSeries& a) { return integral(std::atan(a.c[0]), 1.0 / (1.0 + a * a), a); }
inline LongSeries asin(const LongSeries& a) {
  return integral(std::asin(a.c[0]), 1.0 / sqrt(1.0 - a * a), a);
}
inline LongSeries acos(const LongSeries& a) {
  return integral(std::acos(a.c[0]), -1.0 / sqrt(1.0 - a * a), a);
}
inline LongSeries longConstant(long double c) { return LongSeries(std::vector<long double>{c}); }
inline LongSeries cbrt(const LongSeries& a) {
  return a.at(0) < 0 ? -exp(longConstant(1 / 3.0L) * log(-a)) : exp(longConstant(1 / 3.0L) * log(a));
}
inline LongSeries hypot(const LongSeries& a, const LongSeries& b) { return sqrt(a * a + b * b); }
inline LongSeries expm1(const LongSeries& a) {
  LongSeries r = exp(a);
  r.c[0] = std::expm1(a.c[0]);
  return r;
}
inline LongSeries log10(const LongSeries& a) { return longConstant(1 / std::log(10.0L)) * log(a); }
inline LongSeries log1p(const LongSeries& a) { return integral(std::log1p(a.c[0]), 1.0 / (1.0 + a), a); }
inline LongSeries erf(const LongSeries& a) {
  return integral(std::erf(a.c[0]), longConstant(2 / std::sqrt(std::acos(-1.0L))) * exp(-(a * a)), a);
}
inline LongSeries asinh(const LongSeries& a) {
  return a.at(0) < 0 ? -log(sqrt(1.0 + a * a) - a) : log(sqrt(1.0 + a * a) + a);
}
inline LongSeries acosh(const LongSeries& a) { return log(sqrt(a * a - 1.0) + a); }
inline LongSeries atanh(const LongSeries& a) { return 0.5 * log((1.0 + a) / (1.0 - a)); }
// By the angle's tangent or cotangent, whichever is finite.
inline LongSeries atan2(const LongSeries& y, const LongSeries& x) {
  LongSeries r = std::fabs(x.at(0)) > std::fabs(y.at(0)) ? atan(y / x) : -atan(x / y);
  r.c[0] = std::atan2(y.at(0), x.at(0));
  return r;
}
inline LongSeries pow(const LongSeries& a, const LongSeries& b) { return exp(b * log(a)); }
inline LongSeries pow(double a, const LongSeries& b) {
  return exp(b * longConstant(std::log(static_cast<long double>(a))));
}

// Decided by order 0, as the library does.
inline bool operator<(const LongSeries& a, const LongSeries& b) { return a.at(0) < b.at(0); }
inline bool operator>(const LongSeries& a, const LongSeries& b) { return a.at(0) > b.at(0); }
inline LongSeries fabs(const LongSeries& a) { return a < 0.0 ? -a : a; }
inline LongSeries min(const LongSeries& a, const LongSeries& b) { return a < b ? a : b; }
inline LongSeries max(const LongSeries& a, const LongSeries& b) { return a < b ? b : a; }
