#pragma once

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

/// What `validate` members say, in one line: who, what, what would be accepted, what was given.
namespace atrapos::contact::detail {

inline std::string shown(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

[[noreturn]] inline void refuse(const std::string& who, const std::string& problem) {
  throw std::invalid_argument(who + ": " + problem);
}

inline void requireFinite(const char* who, const char* what, const double (&v)[3]) {
  for (const double c : v)
    if (!std::isfinite(c)) refuse(who, std::string(what) + " must be finite, got " + shown(c));
}

inline void requireFinite(const char* who, const char* what, double value) {
  if (!std::isfinite(value)) refuse(who, std::string(what) + " must be finite, got " + shown(value));
}

inline void requirePositive(const char* who, const char* what, double value) {
  if (!(value > 0) || !std::isfinite(value))
    refuse(who, std::string(what) + " must be > 0 and finite, got " + shown(value));
}

inline void requireBetween(const char* who, const char* what, double value, double least, double most) {
  if (!(value > least && value < most))
    refuse(who, std::string(what) + " must be between " + shown(least) + " and " + shown(most) + ", got " +
                    shown(value));
}

inline void requireUnit(const char* who, const char* what, const double (&v)[3]) {
  const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  // Rounding of a normalised vector; anything else was never normalised.
  if (!(std::fabs(length - 1) < 1e-12))
    refuse(who, std::string(what) + " must be a unit vector, got one of length " + shown(length));
}

}  // namespace atrapos::contact::detail
