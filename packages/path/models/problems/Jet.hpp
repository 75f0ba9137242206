#pragma once

#include <cmath>
#include <utility>
#include <vector>

/// A truncated power series with plain O(K^2) arithmetic, re-evaluated from scratch: slow, short, and sharing
/// no code with the library. Coefficients beyond those stored are zero; results are truncated to
/// `Jet::terms`.
class Jet {
 public:
  inline static std::size_t terms = 1;

  Jet(double value = 0) : c_(terms, 0.0) { c_[0] = value; }
  explicit Jet(std::vector<double> c) : c_(std::move(c)) { c_.resize(terms, 0.0); }

  double operator[](std::size_t k) const { return c_[k]; }
  double& operator[](std::size_t k) { return c_[k]; }

  friend Jet operator+(Jet a, const Jet& b) {
    for (std::size_t k = 0; k < terms; ++k) a[k] += b[k];
    return a;
  }
  friend Jet operator-(Jet a, const Jet& b) {
    for (std::size_t k = 0; k < terms; ++k) a[k] -= b[k];
    return a;
  }
  friend Jet operator-(const Jet& a) { return Jet(0.0) - a; }
  friend Jet operator*(const Jet& a, const Jet& b) {
    Jet p;
    for (std::size_t k = 0; k < terms; ++k)
      for (std::size_t i = 0; i <= k; ++i) p[k] += a[i] * b[k - i];
    return p;
  }
  friend Jet operator*(double a, Jet b) {
    for (std::size_t k = 0; k < terms; ++k) b[k] *= a;
    return b;
  }
  friend Jet operator*(Jet a, double b) { return b * std::move(a); }
  friend Jet operator/(const Jet& a, const Jet& b) {
    Jet q;
    for (std::size_t k = 0; k < terms; ++k) {
      double s = a[k];
      for (std::size_t i = 1; i <= k; ++i) s -= b[i] * q[k - i];
      q[k] = s / b[0];
    }
    return q;
  }
  friend Jet sqrt(const Jet& a) {
    Jet r;
    r[0] = std::sqrt(a[0]);
    for (std::size_t k = 1; k < terms; ++k) {
      double s = a[k];
      for (std::size_t i = 1; i < k; ++i) s -= r[i] * r[k - i];
      r[k] = s / (2 * r[0]);
    }
    return r;
  }
  friend Jet exp(const Jet& a) {
    Jet r;
    r[0] = std::exp(a[0]);
    for (std::size_t k = 1; k < terms; ++k) {
      for (std::size_t i = 1; i <= k; ++i) r[k] += i * a[i] * r[k - i];
      r[k] /= k;
    }
    return r;
  }
  friend Jet log(const Jet& a) {
    Jet r;
    r[0] = std::log(a[0]);
    for (std::size_t k = 1; k < terms; ++k) {
      double s = 0;
      for (std::size_t i = 1; i < k; ++i) s += i * r[i] * a[k - i];
      r[k] = (a[k] - s / k) / a[0];
    }
    return r;
  }

  /// s = sin a and c = cos a by s' = c a', c' = -s a'.
  static void sinCos(const Jet& a, Jet& s, Jet& c) {
    s[0] = std::sin(a[0]);
    c[0] = std::cos(a[0]);
    for (std::size_t k = 1; k < terms; ++k) {
      s[k] = c[k] = 0;
      for (std::size_t i = 1; i <= k; ++i) {
        s[k] += i * a[i] * c[k - i] / k;
        c[k] -= i * a[i] * s[k - i] / k;
      }
    }
  }
  friend Jet sin(const Jet& a) {
    Jet s, c;
    sinCos(a, s, c);
    return s;
  }
  friend Jet cos(const Jet& a) {
    Jet s, c;
    sinCos(a, s, c);
    return c;
  }

 private:
  std::vector<double> c_;
};
