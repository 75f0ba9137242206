#include "atrapos/path/Imperfect.hpp"

#include <stdexcept>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>

namespace atrapos::path {
namespace {

void addForce(const Vector& force, Vector& r, ResidualNorm& size) {
  r.update(-1, force, 1);
  size.norm = r.norm2();
}

/// The perfect Problem's, with the force in the residual.
class ImperfectPieces final : public Pieces {
 public:
  ImperfectPieces(Pieces& perfect, RCP<const Vector> force) : perfect_(perfect), force_(std::move(force)) {}

  ResidualNorm residualOfSeries(const State& state, Vector& r) override {
    ResidualNorm size = perfect_.residualOfSeries(state, r);
    addForce(*force_, r, size);
    return size;
  }
  bool eventsAstray(const State& state, const std::vector<int>& events) const override {
    return perfect_.eventsAstray(state, events);
  }
  std::vector<Break> breaks(const Series& series, double end) const override {
    return perfect_.breaks(series, end);
  }
  bool continues(const State& state, int index) const override { return perfect_.continues(state, index); }
  std::string text(int index) const override { return perfect_.text(index); }

 private:
  Pieces& perfect_;
  RCP<const Vector> force_;
};

}  // namespace

ImperfectProblem::ImperfectProblem(Problem& perfect, RCP<const Vector> force)
    : perfect_(perfect), force_(std::move(force)) {
  if (force_.is_null() || !force_->getMap()->isSameAs(*perfect.map()))
    throw std::invalid_argument("imperfect problem: the force does not live on the problem's map");
  if (Pieces* pieces = perfect.pieces()) pieces_ = std::make_unique<ImperfectPieces>(*pieces, force_);
}

ImperfectProblem::~ImperfectProblem() = default;

ResidualNorm ImperfectProblem::residual(const State& state, Vector& r) {
  ResidualNorm size = perfect_.residual(state, r);
  addForce(*force_, r, size);
  return size;
}

RCP<Vector> forceOfShape(Problem& problem, const State& state, const Vector& d) {
  Vector F(problem.map());
  const auto K = problem.tangent(state, F);
  auto f = Teuchos::rcp(new Vector(problem.map()));
  K->apply(d, *f);
  return f;
}

}  // namespace atrapos::path
