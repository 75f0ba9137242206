#include "atrapos/path/Problem.hpp"

#include <Tpetra_Vector.hpp>

#include "atrapos/linear/Dot.hpp"

namespace atrapos::path {

State State::copy() const { return {Teuchos::rcp(new Vector(*u, Teuchos::Copy)), lambda, memory}; }

double Problem::scaleAlong(const Vector& /*v*/, const State& state) {
  Vector r(map());
  return residual(state, r).scale;
}

double Problem::inner(const Increment& x, const Increment& y) const { return linear::dot(*x.u, *y.u); }

double Problem::weight(const Increment& Xhat, std::optional<double> given) {
  return given ? *given : 1 / inner(Xhat, Xhat);
}

std::string Problem::name(long long unknown) const { return "unknown " + std::to_string(unknown); }

}  // namespace atrapos::path
