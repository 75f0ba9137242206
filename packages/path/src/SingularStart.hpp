#pragma once

#include <string>

#include "Newton.hpp"
#include "PathUnderWay.hpp"

namespace atrapos::path {

/// A path whose tangent is singular where it starts: it starts a little further along what the null vectors,
/// phi and psi (left), and the load say of it.
///
/// F with a part along psi: a limit point, U = U_0 + s phi, lambda = lambda_0 + c s^2,
/// c = psi . D^2R(phi, phi) / (2 psi . F). Without: a bifurcation point, which the path passes along
/// K Uhat = F, phi . Uhat = 0. Where that state's tangent is singular too, a mechanism.
class SingularStart {
 public:
  explicit SingularStart(PathUnderWay& path) : path_(path) {}

  /// Moves the position, at which `cause` has been found. Throws PathError with its reason and the null
  /// vector's largest entries where there is no state to start from.
  void leave(const PathError& cause);

 private:
  struct NullVectors {
    RCP<Vector> right, left;
  };
  NullVectors nullVectors(const RCP<const CrsMatrix>& K) const;
  Border leaveLimitPoint(State& state, const NullVectors& null, double load, const PathError& cause) const;
  Border leaveBifurcation(State& state, const NullVectors& null, const RCP<const CrsMatrix>& K,
                          const RCP<const Vector>& F, const PathError& cause) const;
  [[noreturn]] void giveUp(const PathError& cause, const std::string& why) const;

  PathUnderWay& path_;
  std::string mechanism_;  ///< the null vector of a start that was left
};

}  // namespace atrapos::path
