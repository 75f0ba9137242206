#include "atrapos/linear/Eigenvalues.hpp"

#include <algorithm>
#include <cmath>

#include <AnasaziBasicEigenproblem.hpp>
#include <AnasaziBlockKrylovSchurSolMgr.hpp>
#include <AnasaziTpetraAdapter.hpp>
#include <Teuchos_LAPACK.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Operator.hpp>
#include <Tpetra_Vector.hpp>

#include "ReferenceVector.hpp"
#include "atrapos/linear/Error.hpp"
#include "atrapos/linear/OnAllRanks.hpp"

namespace atrapos::linear {

namespace {

using Operator = Tpetra::Operator<double, LocalIndex, GlobalIndex>;

class InverseOperator final : public Operator {
 public:
  InverseOperator(const Inverse& inverse, RCP<const Map> map) : inverse_(inverse), map_(std::move(map)) {}

  Teuchos::RCP<const Map> getDomainMap() const override { return map_; }
  Teuchos::RCP<const Map> getRangeMap() const override { return map_; }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, double alpha,
             double beta) const override {
    if (alpha != 1 || beta != 0) throw SolverError("eigenvalues: K^-1 is applied as it is only");
    inverse_(x, y);
  }

 private:
  const Inverse& inverse_;
  RCP<const Map> map_;
};

/// Eigenvalues theta of K^-1 M turned into those of K, nearest to zero first.
std::vector<std::complex<double>> inverted(const std::vector<std::complex<double>>& theta, Mass mass) {
  // Zero is a multiple eigenvalue of a singular M, in chains of two where a constraint acts through another
  // unknown (pressures): rounding makes its square root of it, 1e-8.
  constexpr double zero = 1e-7;
  double largest = 0;
  for (const auto& t : theta) largest = std::max(largest, std::abs(t));
  std::vector<std::complex<double>> values;
  for (const auto& t : theta)
    if (mass == Mass::regular || std::abs(t) > zero * largest) values.push_back(1.0 / t);
  // Of a conjugate pair the moduli are the same to the bit: which one comes first is of no account.
  std::stable_sort(values.begin(), values.end(),
                   [](const auto& a, const auto& b) { return std::norm(a) < std::norm(b); });
  return values;
}

NearestEigenvalues allOf(const Inverse& inverse, const RCP<const Map>& map, Mass mass) {
  const int n = static_cast<int>(map->getGlobalNumElements());
  std::vector<double> A, real(n), imaginary(n), work(4 * n);
  MultiVector unit(map, 1), column(map, 1);
  const auto ids = map->getNodeElementList();
  const GlobalIndex base = map->getIndexBase();
  for (int j = 0; j < n; ++j) {
    unit.putScalar(0);
    if (map->isNodeGlobalElement(base + j)) unit.replaceGlobalValue(base + j, 0, 1.0);
    inverse(unit, column);
    const auto entries = onAllRanks(*column.getVector(0));
    A.insert(A.end(), entries.begin(), entries.end());
  }
  int info = 0;
  Teuchos::LAPACK<int, double>().GEEV('N', 'N', n, A.data(), n, real.data(), imaginary.data(), nullptr, 1,
                                      nullptr, 1, work.data(), 4 * n, &info);
  if (info != 0) return {};
  std::vector<std::complex<double>> theta;
  for (int i = 0; i < n; ++i) theta.emplace_back(real[i], imaginary[i]);
  return {inverted(theta, mass), true};
}

}  // namespace

NearestEigenvalues nearestEigenvalues(const Inverse& inverse, const RCP<const Map>& map, int count,
                                      Mass mass) {
  constexpr int blockSize = 2, small = 64;
  const long long n = static_cast<long long>(map->getGlobalNumElements());
  // Twice as many directions as eigenvalues, and some: fewer restarts than with the least that would do.
  const int blocks = count + 4;
  if (n <= small || n <= blockSize * (blocks + 2)) return allOf(inverse, map, mass);

  const auto start = Teuchos::rcp(new MultiVector(map, blockSize));
  for (int j = 0; j < blockSize; ++j) fillReference(*start->getVectorNonConst(j), j + 1);
  if (mass == Mass::singular) {
    // Twice: what is left of infinite eigenvalues, with chains of two, is rounding.
    MultiVector applied(map, blockSize);
    inverse(*start, applied);
    inverse(applied, *start);
    Teuchos::Array<double> norms(blockSize);
    start->norm2(norms());
    if (*std::min_element(norms.begin(), norms.end()) == 0) return {{}, true};  // M = 0: all are infinite
    for (int j = 0; j < blockSize; ++j) start->getVectorNonConst(j)->scale(1 / norms[j]);
  }
  using Problem = Anasazi::BasicEigenproblem<double, MultiVector, Operator>;
  const RCP<Operator> op = Teuchos::rcp(new InverseOperator(inverse, map));
  const auto problem = Teuchos::rcp(new Problem(op, start));
  problem->setHermitian(false);
  problem->setNEV(count);
  if (!problem->setProblem()) throw SolverError("eigenvalues: Anasazi does not take the problem");
  Teuchos::ParameterList list;
  list.set("Which", "LM");
  list.set("Block Size", blockSize);
  list.set("Num Blocks", blocks);
  list.set("Maximum Restarts", 20);
  list.set("Convergence Tolerance", 1e-8);
  list.set("Relative Convergence Tolerance", true);
  list.set("Verbosity", static_cast<int>(Anasazi::Errors));
  try {
    Anasazi::BlockKrylovSchurSolMgr<double, MultiVector, Operator>(problem, list).solve();
  } catch (const std::logic_error&) {
    return {};  // its orthogonalization broke down, or LAPACK found no Schur form of what are no numbers
  }
  const auto& solution = problem->getSolution();
  std::vector<std::complex<double>> theta;
  for (int i = 0; i < solution.numVecs; ++i)
    theta.emplace_back(solution.Evals[i].realpart, solution.Evals[i].imagpart);
  return {inverted(theta, mass), false};
}

}  // namespace atrapos::linear
