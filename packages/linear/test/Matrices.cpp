#include "Matrices.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <algorithm>
#include <cmath>

#include "ReferenceVector.hpp"

namespace atrapos::linear::test {
namespace {

GlobalIndex globalIndex(int i, Layout layout) { return layout == Layout::contiguous ? i : 5 + 3ll * i; }
int rowOf(GlobalIndex g, Layout layout) {
  return static_cast<int>(layout == Layout::contiguous ? g : (g - 5) / 3);
}

}  // namespace

RCP<const Map> makeMap(int n, Layout layout) {
  const auto comm = Tpetra::getDefaultComm();
  if (layout == Layout::contiguous) return rcp(new Map(n, 0, comm));
  Teuchos::Array<GlobalIndex> mine;
  for (int i = n - 1; i >= 0; --i)
    if (i % comm->getSize() == comm->getRank()) mine.push_back(globalIndex(i, layout));
  return rcp(new Map(n, mine(), 0, comm));
}

RCP<CrsMatrix> makeMatrix(int n, const RowFunction& row, Layout layout) {
  const auto map = makeMap(n, layout);
  std::size_t longest = 0;
  for (const auto g : map->getNodeElementList()) longest = std::max(longest, row(rowOf(g, layout)).size());
  auto K = rcp(new CrsMatrix(map, longest));
  for (const auto g : map->getNodeElementList())
    for (const auto& [column, value] : row(rowOf(g, layout))) {
      const GlobalIndex c = globalIndex(column, layout);
      K->insertGlobalValues(g, 1, &value, &c);
    }
  K->fillComplete();
  return K;
}

RCP<MultiVector> makeReference(const RCP<const Map>& map, int columns) {
  auto x = rcp(new MultiVector(map, columns));
  for (int j = 0; j < columns; ++j) fillReference(*x->getVectorNonConst(j), 10 + j);
  return x;
}

RowFunction chain(int n, double diag) {
  return [=](int i) {
    Row row{{i, 2 + diag}};
    if (i > 0) row.emplace_back(i - 1, -1);
    if (i + 1 < n) row.emplace_back(i + 1, -1);
    return row;
  };
}

RowFunction ring(int n) {
  return [=](int i) { return Row{{i, 2.0}, {(i + 1) % n, -1.0}, {(i + n - 1) % n, -1.0}}; };
}

RowFunction convection(int n, double c) {
  return [=](int i) {
    Row row{{i, 2.0}};
    if (i > 0) row.emplace_back(i - 1, -1 - c);
    if (i + 1 < n) row.emplace_back(i + 1, -1 + c);
    return row;
  };
}

RowFunction saddlePoint(int n, int m) {
  // Constraint j couples points 2j and 2j+1 (weights 1 and -2): disjoint pairs, so B has full rank.
  return [=](int i) {
    if (i >= n) return Row{{2 * (i - n), 1.0}, {2 * (i - n) + 1, -2.0}};
    Row row = chain(n, 1)(i);
    if (i < 2 * m) row.emplace_back(n + i / 2, i % 2 == 0 ? 1.0 : -2.0);
    return row;
  };
}

RowFunction laplacian3d(std::array<int, 3> points, double shift) {
  return [=](int i) {
    Row row{{i, 6 - shift}};
    int stride = 1;
    for (int d = 0; d < 3; ++d) {
      const int at = i / stride % points[d];
      if (at > 0) row.emplace_back(i - stride, -1);
      if (at + 1 < points[d]) row.emplace_back(i + stride, -1);
      stride *= points[d];
    }
    return row;
  };
}

std::vector<double> laplacian3dEigenvalues(std::array<int, 3> points, double shift) {
  const auto one = [&](int d, int i) { return 2 - 2 * std::cos(i * std::acos(-1.0) / (points[d] + 1)); };
  std::vector<double> values;
  for (int i = 1; i <= points[0]; ++i)
    for (int j = 1; j <= points[1]; ++j)
      for (int k = 1; k <= points[2]; ++k) values.push_back(one(0, i) + one(1, j) + one(2, k) - shift);
  return values;
}

double backwardError(const CrsMatrix& K, const MultiVector& x, const MultiVector& b, bool transposed) {
  const auto columns = b.getNumVectors();
  MultiVector residual(b, Teuchos::Copy);
  K.apply(x, residual, transposed ? Teuchos::TRANS : Teuchos::NO_TRANS, -1.0, 1.0);
  // |K| and |K^T| by products of the absolute values with ones.
  CrsMatrix absolute(K, Teuchos::Copy);
  absolute.resumeFill();
  const auto local = absolute.getLocalMatrixHost();
  for (std::size_t e = 0; e < local.values.extent(0); ++e) local.values(e) = std::abs(local.values(e));
  absolute.fillComplete(K.getDomainMap(), K.getRangeMap());
  Vector ones(K.getRowMap()), sums(K.getRowMap());
  ones.putScalar(1);
  absolute.apply(ones, sums, transposed ? Teuchos::TRANS : Teuchos::NO_TRANS);
  const double norm = sums.normInf();

  Teuchos::Array<double> r(columns), u(columns), f(columns);
  residual.normInf(r());
  x.normInf(u());
  b.normInf(f());
  double worst = 0;
  for (std::size_t j = 0; j < columns; ++j) {
    const double error = r[j] / (norm * u[j] + f[j]);
    if (!(error <= worst)) worst = error;  // lets NaN through
  }
  return worst;
}

}  // namespace atrapos::linear::test
