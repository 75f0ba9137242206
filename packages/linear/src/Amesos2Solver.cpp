#include "Amesos2Solver.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <Trilinos_version.h>
#include <Amesos2.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_RowMatrixTransposer.hpp>
#include <algorithm>
#include <cctype>

#include "AnalysedGraph.hpp"
#include "Collectively.hpp"
#include "ReferenceVector.hpp"
#include "RowNumbering.hpp"
#include "atrapos/linear/Error.hpp"

namespace atrapos::linear {

// KLU2 of Trilinos 13.2 breaks the aliasing rules: compiled with -O2 or more (as distributions do), its
// klu_solve returns wrong solutions, while klu_tsolve is right. The adapter calls klu_tsolve on one rank for
// A x = b, on several for A^T x = b; so there it is given the transposed matrix and asked for the transposed
// solution.
struct Amesos2Solver::Impl {
  using Solver = Amesos2::Solver<CrsMatrix, MultiVector>;

  // One factorization: of K for x = K^-1 b, or of K^T for x = K^-T b.
  struct Direction {
    Teuchos::RCP<Solver> solver;
    RCP<const CrsMatrix> waiting;  // given, but not factored yet
  };

  std::string label;  // for messages
  bool symmetric = true;
  bool swapped = false;  // the adapter transposes, see above
  std::unique_ptr<AnalysedGraph> graph;
  RCP<const Map> rowNumbers;
  RCP<const CrsGraph> renumberedGraph;
  Direction forward, backward;
  bool factored = false;

  void create(Direction& direction, const std::string& name, const RCP<const CrsMatrix>& matrix) {
    // On one rank the adapters hand local column indices on, which count positions in the column map.
    if (rowNumbers->getComm()->getSize() == 1 && !matrix->getColMap()->locallySameAs(*rowNumbers))
      throw SolverError(fmt::format(
          "Amesos2 {}: on one rank the column map must equal the row map (is a row or column empty?)", name));
    direction.solver = Amesos2::create<CrsMatrix, MultiVector>(name, matrix);
    if (swapped) {
      auto list = Teuchos::rcp(new Teuchos::ParameterList("Amesos2"));
      list->set("Transpose", true);
      list->sublist(direction.solver->name()).set("Transpose", true);
      direction.solver->setParameters(list);
    }
    collectively("analysis", [&] { direction.solver->preOrdering().symbolicFactorization(); });
  }

  void factorWaiting(Direction& direction) {
    direction.solver->setA(direction.waiting, Amesos2::SYMBFACT);
    collectively("factorization", [&] { direction.solver->numericFactorization(); });
    direction.waiting = Teuchos::null;
  }

  // K with row numbers for global indices, sharing K's values: the adapters take 0..n-1 only (their option
  // IsContiguous = false gives wrong solutions in 13.2).
  RCP<const CrsMatrix> renumbered(const CrsMatrix& K) const {
    auto matrix = rcp(new CrsMatrix(renumberedGraph, K.getLocalMatrixDevice().values));
    matrix->fillComplete(rowNumbers, rowNumbers);
    return matrix;
  }

  RCP<const CrsMatrix> matrixFor(const CrsMatrix& K, bool transposed) const {
    const auto matrix = renumbered(K);
    if (symmetric || transposed == swapped) return matrix;
    return Tpetra::RowMatrixTransposer<double, LocalIndex, GlobalIndex>(matrix).createTranspose();
  }

  template <class Phase>
  void collectively(const char* what, const Phase& phase) {
    linear::collectively(*graph->rowMap()->getComm(), label, what, phase);
  }
};

std::vector<std::string> Amesos2Solver::available() {
  std::vector<std::string> names;
  for (const char* name : {"klu2", "tacho", "basker", "shylubasker", "superlu", "superlu_mt", "superlu_dist",
                           "umfpack", "cholmod", "mumps", "pardiso_mkl", "strumpack", "lapack"})
    if (Amesos2::query(name)) names.emplace_back(name);
  return names;
}

Amesos2Solver::Amesos2Solver(const Amesos2Options& options)
    : options_(options), impl_(std::make_unique<Impl>()) {
  auto& solver = options_.solver;
  std::transform(solver.begin(), solver.end(), solver.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  const auto names = available();
  if (std::find(names.begin(), names.end(), solver) == names.end())
    throw SolverError(
        fmt::format("Amesos2 has no solver \"{}\"; available: {}", options.solver, fmt::join(names, ", ")));
  if (solver == "tacho" && !options_.symmetric)
    throw SolverError("Amesos2 Tacho: its Cholesky factorization needs symmetric = true");
}

Amesos2Solver::~Amesos2Solver() = default;

std::string Amesos2Solver::name() const { return "Amesos2 " + options_.solver; }

void Amesos2Solver::analyze(const RCP<const CrsMatrix>& K) {
  const double start = MPI_Wtime();
  impl_ = std::make_unique<Impl>();
  auto graph = std::make_unique<AnalysedGraph>(name(), *K);
  const Map& rows = *graph->rowMap();
  const auto n = rows.getGlobalNumElements();
#if TRILINOS_MAJOR_MINOR_VERSION <= 130200
  if (options_.solver == "tacho" && (n >= 1024 || rows.getComm()->getSize() > 1))
    throw SolverError(
        fmt::format("Amesos2 tacho: in Trilinos 13.2 it works on one rank and below 1024 unknowns only; here "
                    "are {} and {}",
                    rows.getComm()->getSize(), n));
#endif
  const RowNumbering numbering(*K);
  impl_->rowNumbers = rcp(new Map(n, rows.getNodeNumElements(), 0, rows.getComm()));
  const auto columnNumbers = rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(),
                                         Teuchos::arrayViewFromVector(numbering.columns), 0, rows.getComm()));
  impl_->renumberedGraph =
      rcp(new CrsGraph(K->getCrsGraph()->getLocalGraphDevice(), impl_->rowNumbers, columnNumbers,
                       impl_->rowNumbers, impl_->rowNumbers, Teuchos::null));
  impl_->label = name();
  impl_->symmetric = options_.symmetric;
  impl_->swapped = options_.solver == "klu2" && rows.getComm()->getSize() > 1;
  impl_->graph = std::move(graph);
  try {
    impl_->create(impl_->forward, options_.solver, impl_->matrixFor(*K, false));
  } catch (...) {
    impl_->graph.reset();
    throw;
  }
  ++counters_.analyses;
  counters_.analysisSeconds += MPI_Wtime() - start;
}

void Amesos2Solver::factor(const RCP<const CrsMatrix>& K) {
  if (!impl_->graph) throw SolverError(name() + ": factor comes after analyze");
  const double start = MPI_Wtime();
  impl_->factored = false;
  impl_->graph->checkMatrix(*K);
  if (options_.symmetric) impl_->graph->checkSymmetry(*K);
  impl_->forward.waiting = impl_->matrixFor(*K, false);
  impl_->factorWaiting(impl_->forward);
  // A copy, because the caller may change K's values before a transposed solve asks for its factorization.
  if (!options_.symmetric)
    impl_->backward.waiting = rcp(new CrsMatrix(*impl_->matrixFor(*K, true), Teuchos::Copy));
  checkConditioning(*K);
  impl_->factored = true;
  ++counters_.factorizations;
  counters_.factorSeconds += MPI_Wtime() - start;
}

void Amesos2Solver::checkConditioning(const CrsMatrix& K) {
  const auto map = impl_->graph->rowMap();
  Vector exact(map, false), b(map, false), x(map, false);
  fillReference(exact, 3);
  K.apply(exact, b);
  solveUnchecked(b, x, false);
  x.update(-1.0, exact, 1.0);
  const double error = x.norm2() / exact.norm2();
  // Rounding gives eps cond(K) in the direction of the smallest singular value: above this, two digits at
  // most are left. The negation also catches NaN.
  if (!(error < 1e-2))
    throw SingularTangentError(
        fmt::format("{}: the matrix is numerically singular (a known solution comes back with error {:.1e})",
                    name(), error),
        0);
}

void Amesos2Solver::solve(const MultiVector& b, MultiVector& x) const { solveWith(b, x, false); }

void Amesos2Solver::solveTransposed(const MultiVector& b, MultiVector& x) const {
  solveWith(b, x, !options_.symmetric);
}

void Amesos2Solver::solveWith(const MultiVector& b, MultiVector& x, bool transposed) const {
  if (!impl_->factored) throw SolverError(name() + ": solve comes after a successful factor");
  const double start = MPI_Wtime();
  impl_->graph->checkVectors(b, x);
  solveUnchecked(b, x, transposed);
  counters_.solves += static_cast<long long>(b.getNumVectors());
  counters_.solveSeconds += MPI_Wtime() - start;
}

void Amesos2Solver::solveUnchecked(const MultiVector& b, MultiVector& x, bool transposed) const {
  auto& direction = transposed ? impl_->backward : impl_->forward;
  if (!direction.waiting.is_null()) {
    if (direction.solver.is_null()) impl_->create(direction, options_.solver, direction.waiting);
    impl_->factorWaiting(direction);
  }
  // Own copies: the adapters take packed columns only, and x and b may be one object.
  const auto rhs = rcp(new MultiVector(*b.offsetView(impl_->rowNumbers, 0), Teuchos::Copy));
  const auto solution = rcp(new MultiVector(impl_->rowNumbers, b.getNumVectors()));
  impl_->collectively("solve", [&] { direction.solver->solve(solution.ptr(), rhs.ptr().getConst()); });
  Tpetra::deep_copy(*x.offsetViewNonConst(impl_->rowNumbers, 0), *solution);
}

}  // namespace atrapos::linear
