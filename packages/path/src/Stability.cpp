#include "Stability.hpp"

#include <algorithm>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>

#include "atrapos/linear/Determinant.hpp"
#include "atrapos/linear/Eigenvalues.hpp"

namespace atrapos::path {

namespace {

/// Whether those found, nearest to zero first, end with stable ones: then no negative one is expected behind
/// them. A real one and a conjugate pair are the most that a block brings at once.
bool endStable(const linear::NearestEigenvalues& found) {
  constexpr std::size_t last = 3;
  const auto& mu = found.values;
  if (found.complete) return true;
  return mu.size() >= last &&
         std::all_of(mu.end() - last, mu.end(), [](const auto& value) { return value.real() > 0; });
}

}  // namespace

EigenMeasure::EigenMeasure(Calls& calls, const State& at, EigenProblem of)
    : mass_(of == EigenProblem::ofRates ? calls.mass(at) : Teuchos::null),
      weights_(mass_.is_null() ? calls.eigenvalueWeights(at) : Teuchos::null) {}

void EigenMeasure::apply(const linear::MultiVector& x, linear::MultiVector& y) const {
  if (!mass_.is_null())
    mass_->apply(x, y);
  else if (!weights_.is_null())
    y.elementWiseMultiply(1, *weights_, x, 0);
  else
    y.assign(x);
}

std::optional<Unstable> countUnstable(Calls& calls, const State& at, int count, EigenProblem of) {
  if (calls.problem().constraintPivots() != 0) return std::nullopt;
  const auto sign = linear::determinantSign(calls.solver());
  const EigenMeasure measure(calls, at, of);
  const linear::Inverse inverse = [&](const linear::MultiVector& x, linear::MultiVector& y) {
    if (measure.isOne()) return calls.solve(x, y);
    linear::MultiVector weighed(x.getMap(), x.getNumVectors());
    measure.apply(x, weighed);
    calls.solve(weighed, y);
  };
  // More would cost more than the step; the number is then not told.
  constexpr int most = 40;
  for (int wanted = count; wanted <= most; wanted *= 2) {
    const auto found =
        linear::nearestEigenvalues(inverse, calls.problem().map(), wanted,
                                   measure.isRegular() ? linear::Mass::regular : linear::Mass::singular);
    Unstable unstable;
    for (const auto& mu : found.values) {
      unstable.all += mu.real() < 0;
      unstable.real += mu.real() < 0 && mu.imag() == 0;
    }
    // det K is the product of all: negative real ones give its sign, conjugate pairs do not.
    const bool agrees = !sign || (unstable.real % 2 != 0) == (*sign < 0);
    if (agrees && endStable(found)) {
      unstable.nearest = found.values;
      return unstable;
    }
    if (found.complete) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace atrapos::path
