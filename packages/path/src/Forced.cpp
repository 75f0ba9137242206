#include "atrapos/path/Forced.hpp"

#include <stdexcept>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>

namespace atrapos::path {
namespace {

void addForce(const DeadForce& force, double lambda, Vector& r, ResidualNorm& size) {
  if (!force.constant.is_null()) r.update(-1, *force.constant, 1);
  if (!force.perLoadFactor.is_null()) r.update(-lambda, *force.perLoadFactor, 1);
  size.norm = r.norm2();
}

/// Those of the Problem without the force, with it in the residual.
class ForcedPieces final : public Pieces {
 public:
  ForcedPieces(Pieces& inner, DeadForce force) : inner_(inner), force_(std::move(force)) {}

  ResidualNorm residualOfSeries(const State& state, Vector& r) override {
    ResidualNorm size = inner_.residualOfSeries(state, r);
    addForce(force_, state.lambda, r, size);
    return size;
  }
  bool eventsAstray(const State& state, const std::vector<int>& events) const override {
    return inner_.eventsAstray(state, events);
  }
  std::vector<Break> breaks(const Series& series, double end) const override {
    return inner_.breaks(series, end);
  }
  bool continues(const State& state, int index) const override { return inner_.continues(state, index); }
  std::string text(int index) const override { return inner_.text(index); }

 private:
  Pieces& inner_;
  DeadForce force_;
};

}  // namespace

ForcedProblem::ForcedProblem(Problem& unforced, DeadForce force)
    : unforced_(unforced), force_(std::move(force)) {
  for (const auto& f : {force_.constant, force_.perLoadFactor})
    if (!f.is_null() && !f->getMap()->isSameAs(*unforced.map()))
      throw std::invalid_argument("forced problem: the force does not live on the problem's map");
  if (force_.constant.is_null() && force_.perLoadFactor.is_null())
    throw std::invalid_argument("forced problem: there is no force");
  if (Pieces* pieces = unforced.pieces()) pieces_ = std::make_unique<ForcedPieces>(*pieces, force_);
}

ForcedProblem::~ForcedProblem() = default;

ResidualNorm ForcedProblem::residual(const State& state, Vector& r) {
  ResidualNorm size = unforced_.residual(state, r);
  addForce(force_, state.lambda, r, size);
  return size;
}

RCP<const CrsMatrix> ForcedProblem::tangent(const State& state, Vector& F) {
  auto K = unforced_.tangent(state, F);
  if (!force_.perLoadFactor.is_null()) F.update(1, *force_.perLoadFactor, 1);
  return K;
}

RCP<Vector> forceOfShape(Problem& problem, const State& state, const Vector& d) {
  Vector F(problem.map());
  const auto K = problem.tangent(state, F);
  auto f = Teuchos::rcp(new Vector(problem.map()));
  K->apply(d, *f);
  return f;
}

DeadForce forceThatFades(Problem& problem, const State& state) {
  auto held = Teuchos::rcp(new Vector(problem.map()));
  problem.residual(state, *held);
  auto rate = Teuchos::rcp(new Vector(*held, Teuchos::Copy));
  rate->scale(-1);
  return {held, rate};
}

}  // namespace atrapos::path
