#pragma once

#include <optional>

namespace atrapos::linear {

class TangentSolver;

/// What a TangentSolver is besides where its factorizations give the sign of det K.
class TellsDeterminant {
 public:
  virtual ~TellsDeterminant() = default;

  /// +1 or -1, of the last factorization; empty before factor() and where K was singular.
  virtual std::optional<int> determinantSign() const = 0;
};

/// TellsDeterminant::determinantSign of a solver; empty where it does not tell. -1: the number of negative
/// real eigenvalues of K is odd.
std::optional<int> determinantSign(const TangentSolver& solver);

}  // namespace atrapos::linear
