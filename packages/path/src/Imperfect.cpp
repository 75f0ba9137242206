#include "atrapos/path/Imperfect.hpp"

#include <stdexcept>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>

namespace atrapos::path {

ImperfectProblem::ImperfectProblem(Problem& perfect, RCP<const Vector> force)
    : perfect_(perfect), force_(std::move(force)) {
  if (force_.is_null() || !force_->getMap()->isSameAs(*perfect.map()))
    throw std::invalid_argument("imperfect problem: the force does not live on the problem's map");
}

ResidualNorm ImperfectProblem::residual(const Vector& u, double lambda, Vector& r) {
  ResidualNorm size = perfect_.residual(u, lambda, r);
  r.update(-1, *force_, 1);
  size.norm = r.norm2();
  return size;
}

RCP<Vector> forceOfShape(Problem& problem, const State& state, const Vector& d) {
  Vector F(problem.map());
  const auto K = problem.tangent(*state.u, state.lambda, F);
  auto f = Teuchos::rcp(new Vector(problem.map()));
  K->apply(d, *f);
  return f;
}

}  // namespace atrapos::path
