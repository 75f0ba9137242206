#include "KrylovSolver.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <BelosBlockGmresSolMgr.hpp>
#include <BelosTpetraAdapter.hpp>
#include <Teuchos_oblackholestream.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <cmath>
#include <limits>

#include "Collectively.hpp"
#include "EarlierSolutions.hpp"
#include "IncompleteFactor.hpp"
#include "SingleFactor.hpp"
#include "atrapos/linear/Error.hpp"

namespace atrapos::linear {
namespace {

using Operator = Tpetra::Operator<double, LocalIndex, GlobalIndex>;
using Problem = Belos::LinearProblem<double, MultiVector, Operator>;
using Gmres = Belos::BlockGmresSolMgr<double, MultiVector, Operator>;

/// K or its transpose.
class Tangent final : public Operator {
 public:
  Tangent(RCP<const CrsMatrix> K, bool transposed) : K_(std::move(K)), transposed_(transposed) {}
  RCP<const Map> getDomainMap() const override { return K_->getDomainMap(); }
  RCP<const Map> getRangeMap() const override { return K_->getRangeMap(); }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, double alpha,
             double beta) const override {
    K_->apply(x, y, transposed_ ? Teuchos::TRANS : Teuchos::NO_TRANS, alpha, beta);
  }

 private:
  RCP<const CrsMatrix> K_;
  bool transposed_;
};

/// y = M^-1 x or M^-T x; Belos asks for nothing else.
class Inverse final : public Operator {
 public:
  Inverse(const Preconditioner& M, RCP<const Map> map, bool transposed)
      : M_(M), map_(std::move(map)), transposed_(transposed) {}
  RCP<const Map> getDomainMap() const override { return map_; }
  RCP<const Map> getRangeMap() const override { return map_; }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, double, double) const override {
    for (std::size_t j = 0; j < x.getNumVectors(); ++j)
      M_.apply(*x.getVector(j), *y.getVectorNonConst(j), transposed_);
  }

 private:
  const Preconditioner& M_;
  RCP<const Map> map_;
  bool transposed_;
};

std::unique_ptr<Preconditioner> preconditioner(const KrylovOptions& options, bool symmetric,
                                               int factorThreads) {
  if (options.preconditioner == KrylovOptions::Preconditioner::ilu)
    return std::make_unique<IncompleteFactor>(options);
  return std::make_unique<SingleFactor>(symmetric, options.lowRank, factorThreads);
}

/// Largest sum of magnitudes in a row, a bound of the 2-norm where K is symmetric.
double rowSumNorm(const CrsMatrix& K) {
  const auto local = K.getLocalMatrixHost();
  double own = 0, all = 0;
  for (int i = 0; i < local.numRows(); ++i) {
    double sum = 0;
    for (auto e = local.graph.row_map(i); e < local.graph.row_map(i + 1); ++e)
      sum += std::abs(local.values(e));
    own = std::max(own, sum);
  }
  Teuchos::reduceAll(*K.getComm(), Teuchos::REDUCE_MAX, own, Teuchos::outArg(all));
  return all;
}

}  // namespace

/// Solves with K, or with its transpose.
struct KrylovSolver::Direction {
  KrylovOptions options;
  double normOfK;
  RCP<Tangent> K;
  RCP<Inverse> inverse;
  RCP<Problem> problem = rcp(new Problem);
  RCP<Gmres> gmres;
  EarlierSolutions earlier;

  Direction(const KrylovOptions& given, const RCP<const CrsMatrix>& matrix, const Preconditioner& M,
            bool transposed)
      : options(given),
        normOfK(rowSumNorm(*matrix)),
        K(rcp(new Tangent(matrix, transposed))),
        inverse(rcp(new Inverse(M, matrix->getRowMap(), transposed))),
        earlier(given.startVectors) {
    problem->setOperator(K);
    problem->setRightPrec(inverse);
    const auto list = Teuchos::rcp(new Teuchos::ParameterList);
    list->set("Flexible Gmres", true);
    list->set("Num Blocks", options.subspace);
    list->set("Maximum Restarts", options.maxIterations);
    list->set("Maximum Iterations", options.maxIterations);
    list->set("Implicit Residual Scaling", "Norm of Initial Residual");
    list->set("Explicit Residual Scaling", "Norm of Initial Residual");
    list->set("Verbosity", 0);
    list->set("Output Stream", Teuchos::rcp<std::ostream>(new Teuchos::oblackholestream));
    gmres = rcp(new Gmres(problem, list));
  }

  /// r = b - K x; its norm.
  double residual(const Vector& b, const Vector& x, Vector& r) const {
    K->apply(x, r, Teuchos::NO_TRANS, -1, 0);
    r.update(1, b, 1);
    return r.norm2();
  }

  /// Solves K x = b; the number of iterations.
  int solve(const Vector& b, Vector& x, const std::string& name) {
    const double size = b.norm2();
    x.putScalar(0);
    if (!(size > 0)) return 0;
    const auto goal = [&] {
      return std::max(options.tolerance * size, std::numeric_limits<double>::epsilon() * normOfK * x.norm2());
    };
    const auto r = rcp(new Vector(b.getMap(), false)), d = rcp(new Vector(b.getMap()));
    earlier.combine(b, x);
    double left = residual(b, x, *r);
    if (!(left < size)) {
      x.putScalar(0);
      left = residual(b, x, *r);
    }
    // One correction by the preconditioner alone: its size tells which residual rounding allows.
    inverse->apply(*r, *d, Teuchos::NO_TRANS, 1, 0);
    x.update(1, *d, 1);
    const double corrected = residual(b, x, *r);
    if (corrected < left) {
      left = corrected;
    } else {
      x.update(-1, *d, 1);
      left = residual(b, x, *r);
    }
    int iterations = 1;
    while (left > goal()) {
      // Iterations know their residual by recurrence, restarts by K x: half of what is allowed is for that.
      constexpr double least = 1e-12;
      const auto list = Teuchos::rcp(new Teuchos::ParameterList);
      list->set("Convergence Tolerance", std::max(0.5 * goal() / left, least));
      list->set("Maximum Iterations", std::max(1, options.maxIterations - iterations));
      gmres->setParameters(list);
      d->putScalar(0);
      problem->setProblem(d, r);
      collectively(*b.getMap()->getComm(), "Belos", "solve", [&] { gmres->solve(); });
      iterations += gmres->getNumIters();
      x.update(1, *d, 1);
      const double before = left;
      left = residual(b, x, *r);
      if (left <= goal()) break;
      if (!(left < 0.5 * before) || iterations >= options.maxIterations)
        throw SolverError(fmt::format(
            "Belos: no convergence: {:.1e} of the right-hand side left after {} iterations ({:.1e} "
            "asked for, {})",
            left / size, iterations, goal() / size, name));
    }
    Vector product(b, Teuchos::Copy);
    product.update(-1, *r, 1);
    earlier.add(x, product);
    return iterations;
  }
};

KrylovSolver::KrylovSolver(const KrylovOptions& options, bool symmetric, int factorThreads)
    : options_(options),
      symmetric_(symmetric),
      preconditioner_(preconditioner(options, symmetric, factorThreads)) {
  if (!(options.tolerance > 0 && options.tolerance < 1) || options.maxIterations < 1 ||
      options.subspace < 1 || options.startVectors < 0 || !(options.lowRank >= 0 && options.lowRank < 1) ||
      !(options.fill >= 1) || !(options.drop >= 0))
    throw SolverError(
        "Belos: expected tolerance in (0, 1), at least 1 iteration and vector, lowRank in [0, 1), fill of 1 "
        "or "
        "more, drop of 0 or more");
}

KrylovSolver::~KrylovSolver() = default;

std::string KrylovSolver::name() const { return "Belos GMRES, " + preconditioner_->name(); }

std::optional<FactorCost> KrylovSolver::withOwn(std::optional<FactorCost> cost) const {
  if (cost) cost->bytes += ownBytes_;
  return cost;
}
std::optional<FactorCost> KrylovSolver::estimate() const { return withOwn(preconditioner_->estimate()); }
std::optional<FactorCost> KrylovSolver::spent() const { return withOwn(preconditioner_->spent()); }

void KrylovSolver::analyze(const RCP<const CrsMatrix>& K) {
  const double start = MPI_Wtime();
  forward_.reset();
  backward_.reset();
  graph_.reset();
  auto graph = std::make_unique<AnalysedGraph>("Belos", *K);
  preconditioner_->analyze(K);
  const double vectors = 2.0 * (options_.subspace + options_.startVectors);
  ownBytes_ = sizeof(double) * (static_cast<double>(K->getGlobalNumEntries()) +
                                vectors * static_cast<double>(K->getGlobalNumRows()));
  graph_ = std::move(graph);
  ++counters_.analyses;
  counters_.analysisSeconds += MPI_Wtime() - start;
}

void KrylovSolver::factor(const RCP<const CrsMatrix>& K) {
  if (!graph_) throw SolverError("Belos: factor comes after analyze");
  const double start = MPI_Wtime();
  forward_.reset();
  backward_.reset();
  graph_->checkMatrix(*K);
  if (symmetric_) graph_->checkSymmetry(*K);
  preconditioner_->factor(K);
  // A copy, because the caller may change K's values before a solve.
  const RCP<const CrsMatrix> copy = rcp(new CrsMatrix(*K, Teuchos::Copy));
  forward_ = std::make_unique<Direction>(options_, copy, *preconditioner_, false);
  if (!symmetric_) backward_ = std::make_unique<Direction>(options_, copy, *preconditioner_, true);
  ++counters_.factorizations;
  counters_.factorSeconds += MPI_Wtime() - start;
}

void KrylovSolver::solveWith(const MultiVector& b, MultiVector& x, bool transposed) const {
  if (!forward_) throw SolverError("Belos: solve comes after a successful factor");
  const double start = MPI_Wtime();
  graph_->checkVectors(b, x);
  Direction& direction = transposed ? *backward_ : *forward_;
  for (std::size_t j = 0; j < b.getNumVectors(); ++j) {
    const Vector bj(*b.getVector(j), Teuchos::Copy);  // x and b may be one object
    Vector xj(bj.getMap());
    const int iterations = direction.solve(bj, xj, name());
    Tpetra::deep_copy(*x.getVectorNonConst(j), xj);
    ++iterations_.solves;
    iterations_.total += iterations;
    iterations_.most = std::max<long long>(iterations_.most, iterations);
  }
  counters_.solves += static_cast<long long>(b.getNumVectors());
  counters_.solveSeconds += MPI_Wtime() - start;
}

}  // namespace atrapos::linear
