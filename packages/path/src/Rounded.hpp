#pragma once

#include <cmath>

namespace atrapos::path {

/// A length with the first 7 bits of its mantissa. Step lengths come from the highest orders, whose last
/// digits are rounding; taken as they are, two runs that round differently (another machine, compiler, number
/// of ranks) would drift apart along the path and could not be compared point by point.
inline double rounded(double length) {
  int exponent = 0;
  const double mantissa = std::frexp(length, &exponent);
  return std::ldexp(std::floor(mantissa * 128) / 128, exponent);
}

}  // namespace atrapos::path
