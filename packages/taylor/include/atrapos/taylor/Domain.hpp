#pragma once

#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>

#include "atrapos/taylor/Lanes.hpp"

/// What happens at the edge of an operation's domain: where no Taylor series exists, the lane becomes NaN and
/// Start notes the operation and the order-0 value, so that the caller can name the point.
namespace atrapos::taylor {

/// The operations whose domain has an edge.
enum class Operation {
  None,
  Division,
  Sqrt,
  Cbrt,
  Hypot,
  Log,
  Log10,
  Log1p,
  Pow,
  Asin,
  Acos,
  Atan2,
  Acosh,
  Atanh,
  Abs,
  Min,
  Max,
  Implicit,
  Rate,
  Chord,
  Result
};

/// The first failure in each lane; value is the order-0 value that lies outside the domain.
template <int L>
struct Failures {
  Operation operation[L] = {};
  double value[L] = {};

  KOKKOS_INLINE_FUNCTION void note(int lane, Operation which, double at) {
    if (operation[lane] != Operation::None) return;
    operation[lane] = which;
    value[lane] = at;
  }
};

/// One line: the operation, the value, what would be accepted. "log of -0.3: its argument must be positive"
inline std::string describe(Operation operation, double value);

/// A law was expanded at a point where one of its operations has no Taylor series.
class DomainError : public std::runtime_error {
 public:
  DomainError(Operation operation, double value, const std::string& where = "")
      : std::runtime_error((where.empty() ? "" : where + ": ") + describe(operation, value)),
        operation(operation),
        value(value) {}
  Operation operation;
  double value;
};

namespace detail {

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

}  // namespace detail

inline std::string describe(Operation operation, double value) {
  const auto number = [&] {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return std::string(text);
  }();
  const auto line = [&](const char* name, const char* rule) {
    return std::string(name) + " of " + number + ": " + rule;
  };
  switch (operation) {
    case Operation::Division:
      return "division by " + number + ": the divisor must not vanish";
    case Operation::Sqrt:
      return line("sqrt", "its argument must be positive");
    case Operation::Cbrt:
      return line("cbrt", "its argument must not vanish");
    case Operation::Hypot:
      return line("hypot", "its arguments must not both vanish");
    case Operation::Log:
      return line("log", "its argument must be positive");
    case Operation::Log10:
      return line("log10", "its argument must be positive");
    case Operation::Log1p:
      return line("log1p", "its argument must be above -1");
    case Operation::Pow:
      return line("pow",
                  "the base must be positive where the exponent is not an integer, and must not "
                  "vanish where it is negative or differs from point to point");
    case Operation::Asin:
      return line("asin", "its argument must lie between -1 and 1");
    case Operation::Acos:
      return line("acos", "its argument must lie between -1 and 1");
    case Operation::Atan2:
      return line("atan2", "its arguments must not both vanish");
    case Operation::Acosh:
      return line("acosh", "its argument must be above 1");
    case Operation::Atanh:
      return line("atanh", "its argument must lie between -1 and 1");
    case Operation::Abs:
      return line("abs", "its argument must not vanish");
    case Operation::Min:
      return line("min", "its arguments must differ");
    case Operation::Max:
      return line("max", "its arguments must differ");
    case Operation::Implicit:
      return "the local system g(x, y) = 0 has no regular solution here: Newton's method ended with a "
             "relative residual of " +
             number;
    case Operation::Rate:
      return "the rate law A z' = B v' gives no unique rates here: its matrix A is singular, a pivot cancels "
             "to " +
             number + " of its terms";
    case Operation::Chord:
      return "the rate law cannot be followed to the new inputs: after " + number +
             " of the way its series end or the sub-steps are used up";
    case Operation::None:
    case Operation::Result:
      break;
  }
  return "the law's result is not a number";
}

}  // namespace atrapos::taylor
