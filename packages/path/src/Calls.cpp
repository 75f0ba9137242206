#include "atrapos/path/Calls.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <new>

#include "Stopwatch.hpp"
#include "atrapos/linear/Error.hpp"
#include "atrapos/linear/NoMemory.hpp"

namespace atrapos::path {

namespace {

/// What the Problem throws ends the path with its message; but for a lack of memory, which says nothing about
/// the path.
template <class Call>
auto problemCall(Call call) {
  try {
    return call();
  } catch (const std::exception& error) {
    if (linear::isNoMemory(error)) throw std::bad_alloc();
    throw PathError(EndReason::problemFailed, error.what());
  }
}

template <class Call>
void solverCall(Call call) {
  try {
    call();
  } catch (const linear::SingularTangentError& error) {
    throw PathError(EndReason::singularTangent, error.what());
  } catch (const std::exception& error) {
    if (linear::isNoMemory(error)) throw std::bad_alloc();
    throw PathError(EndReason::solverFailed, error.what());
  }
}

}  // namespace

ResidualNorm Calls::residual(const State& state, Vector& r) {
  Stopwatch watch(work_.seconds.residual);
  return problemCall([&] { return problem_.residual(state, r); });
}

double Calls::scaleAlong(const Vector& v, const State& state) {
  Stopwatch watch(work_.seconds.residual);
  return problemCall([&] { return problem_.scaleAlong(v, state); });
}

RCP<const CrsMatrix> Calls::tangent(const State& state, Vector& F) {
  Stopwatch watch(work_.seconds.tangent);
  return problemCall([&] { return problem_.tangent(state, F); });
}

RCP<const CrsMatrix> Calls::mass(const State& state) {
  Stopwatch watch(work_.seconds.tangent);
  return problemCall([&] { return problem_.mass(state); });
}

RCP<const Vector> Calls::eigenvalueWeights(const State& state) {
  if (problem_.symmetric()) return Teuchos::null;
  Stopwatch watch(work_.seconds.tangent);
  return problemCall([&] { return problem_.eigenvalueWeights(state); });
}

void Calls::factor(const State& state, Vector& F) { factor(tangent(state, F)); }

void Calls::factor(const RCP<const CrsMatrix>& K) {
  ++work_.factorizations;
  if (!analysed_) {
    Stopwatch watch(work_.seconds.analysis);
    solverCall([&] { solver_.analyze(K); });
    analysed_ = true;
  }
  Stopwatch watch(work_.seconds.factor);
  solverCall([&] { solver_.factor(K); });
}

void Calls::solve(const Vector& b, Vector& x) {
  Stopwatch watch(work_.seconds.solve);
  ++work_.solves;
  solverCall([&] { solver_.solve(b, x); });
}

void Calls::solve(const linear::MultiVector& b, linear::MultiVector& x) {
  Stopwatch watch(work_.seconds.solve);
  work_.solves += static_cast<int>(b.getNumVectors());
  solverCall([&] { solver_.solve(b, x); });
}

void Calls::solveTransposed(const Vector& b, Vector& x) {
  if (problem_.symmetric()) return solve(b, x);
  Stopwatch watch(work_.seconds.solve);
  ++work_.solves;
  solverCall([&] { solver_.solveTransposed(b, x); });
}

void Calls::beginSeries(const State& state, int maxOrder) {
  Stopwatch watch(work_.seconds.orderRhs);
  problemCall([&] { problem_.beginSeries(state, maxOrder); });
}

void Calls::orderRhs(int k, Vector& Fk) {
  Stopwatch watch(work_.seconds.orderRhs);
  ++work_.orders;
  problemCall([&] { problem_.orderRhs(k, Fk); });
}

Increment Calls::internalOrder(int k, RCP<Vector> v, double mu) {
  Stopwatch watch(work_.seconds.orderRhs);
  Increment x{std::move(v), std::vector<double>(problem_.internalCount(), 0.0)};
  problemCall([&] { problem_.internalOrder(k, *x.u, mu, x.internal); });
  return x;
}

void Calls::completeOrder(int k, const Vector& Uk, double lambdaK) {
  Stopwatch watch(work_.seconds.orderRhs);
  problemCall([&] { problem_.completeOrder(k, Uk, lambdaK); });
}

double Calls::weight(const Increment& Xhat, std::optional<double> given) {
  return problemCall([&] { return problem_.weight(Xhat, given); });
}

void Calls::weighFields(const std::vector<double>& factors) {
  problemCall([&] { problem_.weighFields(factors); });
}

std::vector<double> Calls::fieldChanges(const State& from, const State& to) {
  Stopwatch watch(work_.seconds.residual);
  return problemCall([&] { return problem_.fieldChanges(from, to); });
}

std::vector<double> Calls::eventOrder(int k) {
  Stopwatch watch(work_.seconds.orderRhs);
  std::vector<double> g(problem_.eventCount(), 0.0);
  if (!g.empty()) problemCall([&] { problem_.eventOrder(k, g); });
  return g;
}

State Calls::afterEvent(const std::vector<int>& indices, const State& state) {
  return problemCall([&] { return problem_.afterEvent(indices, state); });
}

std::vector<int> Calls::eventsBeside(const std::vector<int>& indices, const State& state) {
  return problemCall([&] { return problem_.eventsBeside(indices, state); });
}

bool Calls::eventGradient(int index, const State& state, double& value, Vector& byU, double& byLambda) {
  return problemCall([&] { return problem_.eventGradient(index, state, value, byU, byLambda); });
}

std::vector<std::vector<double>> Calls::memoryOrders() {
  Stopwatch watch(work_.seconds.orderRhs);
  return problemCall([&] { return problem_.memoryOrders(); });
}

State Calls::settled(const State& state) {
  Stopwatch watch(work_.seconds.residual);
  return problemCall([&] { return problem_.settled(state); });
}

std::vector<int> Calls::eventsAt(const State& start) {
  return problemCall([&] { return problem_.eventsAt(start); });
}

ResidualNorm Calls::residualOfSeries(const State& state, Vector& r) {
  Stopwatch watch(work_.seconds.residual);
  return problemCall([&] { return problem_.pieces()->residualOfSeries(state, r); });
}

bool Calls::eventsAstray(const State& state, const std::vector<int>& events) {
  return problemCall([&] { return problem_.pieces()->eventsAstray(state, events); });
}

std::vector<Break> Calls::breaks(const Series& series, double end) {
  return problemCall([&] { return problem_.pieces()->breaks(series, end); });
}

bool Calls::continues(const State& state, int index) {
  return problemCall([&] { return problem_.pieces()->continues(state, index); });
}

std::string Calls::breakText(int index) const { return problem_.pieces()->text(index); }

std::optional<linear::Inertia> Calls::inertia() const {
  auto inertia = solver_.inertia();
  if (inertia) inertia->negative -= problem_.constraintPivots();
  return inertia;
}

RCP<Vector> Calls::newVector() const { return Teuchos::rcp(new Vector(problem_.map())); }

}  // namespace atrapos::path
