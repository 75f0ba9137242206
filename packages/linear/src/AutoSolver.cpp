#include "AutoSolver.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>

#include "atrapos/linear/Error.hpp"

namespace atrapos::linear {
namespace {

std::string megabytes(double bytes) { return fmt::format("{:.3g} MB", bytes / 1e6); }

}  // namespace

std::string choice(const TangentSolver& solver) {
  const auto* chooses = dynamic_cast<const Chooses*>(&solver);
  return chooses ? chooses->choice() : "";
}

AutoSolver::AutoSolver(std::vector<Candidate> candidates, double memory,
                       std::function<void(const std::string&)> tell)
    : candidates_(std::move(candidates)), memory_(memory), tell_(std::move(tell)) {}

void AutoSolver::analyze(const RCP<const CrsMatrix>& K) {
  solver_.reset();
  choice_.clear();
  double room = 0;  // ranks that see different memories must not pick different solvers
  Teuchos::reduceAll(*K->getRowMap()->getComm(), Teuchos::REDUCE_MIN, memory_, Teuchos::outArg(room));
  std::string before;  // why those before were not taken
  for (const Candidate& candidate : candidates_) {
    auto solver = candidate.make();
    std::string why;
    try {
      solver->analyze(K);
      const auto cost = linear::estimate(*solver);
      const double bytes = cost ? cost->bytes : 0;
      why =
          fmt::format("{} of {} unknowns needs {}", candidate.name, K->getGlobalNumRows(), megabytes(bytes));
      if (room == 0 || bytes <= room) {
        solver_ = std::move(solver);
        choice_ = fmt::format("{}{}{}", before, why,
                              room > 0 ? fmt::format(", there are {}", megabytes(room)) : "");
        if (tell_) tell_(choice_);
        return;
      }
    } catch (const SolverError& error) {
      why = error.what();
    }
    before += why + "; ";
  }
  throw SolverError(fmt::format("no tangent solver fits: {}there are {}", before, megabytes(room)));
}

TangentSolver& AutoSolver::picked(const char* call) const {
  if (!solver_) throw SolverError(fmt::format("automatic solver: {} comes after analyze", call));
  return *solver_;
}

std::optional<FactorCost> AutoSolver::estimate() const {
  return solver_ ? linear::estimate(*solver_) : std::nullopt;
}
std::optional<FactorCost> AutoSolver::spent() const {
  return solver_ ? linear::spent(*solver_) : std::nullopt;
}
std::optional<Iterations> AutoSolver::iterations() const {
  return solver_ ? linear::iterations(*solver_) : std::nullopt;
}

}  // namespace atrapos::linear
