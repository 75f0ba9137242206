#pragma once

#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "atrapos/linear/Types.hpp"

namespace atrapos::linear::test {

/// How rows 0..n-1 become global indices of a map on all ranks of MPI_COMM_WORLD.
enum class Layout {
  contiguous,  ///< 0..n-1, in blocks
  scattered    ///< 5 + 3 i for row i, dealt out by turns and descending on every rank
};

/// Columns and values of row i.
using Row = std::vector<std::pair<int, double>>;
using RowFunction = std::function<Row(int i)>;

RCP<const Map> makeMap(int n, Layout layout);

/// Fill-complete n x n matrix with the given rows.
RCP<CrsMatrix> makeMatrix(int n, const RowFunction& row, Layout layout = Layout::contiguous);

/// Vector of `columns` columns with reproducible values in [-1, 1).
RCP<MultiVector> makeReference(const RCP<const Map>& map, int columns = 1);

/// Second-difference matrix of a chain of n points, ends clamped, plus diag on the diagonal.
RowFunction chain(int n, double diag = 0);

/// The same chain closed to a ring: singular, the null vector is constant.
RowFunction ring(int n);

/// Chain with convection, (-1 - c, 2, -1 + c): unsymmetric.
RowFunction convection(int n, double c);

/// Saddle point [A B^T; B 0]: A a chain of n >= 2 m points plus the identity, B of full rank m.
/// Inertia: n positive, m negative.
RowFunction saddlePoint(int n, int m);

/// Seven-point Laplacian on a box of points, minus shift on the diagonal.
RowFunction laplacian3d(std::array<int, 3> points, double shift);

/// Its eigenvalues: sum over directions of 2 - 2 cos(i pi / (points + 1)), minus shift.
std::vector<double> laplacian3dEigenvalues(std::array<int, 3> points, double shift);

/// Largest backward error of K x = b over the columns, in maximum norms:
/// |b - K x| / (|K| |x| + |b|); with K^T where transposed.
double backwardError(const CrsMatrix& K, const MultiVector& x, const MultiVector& b, bool transposed = false);

/// A backward stable elimination with threshold pivoting leaves some units in the last place, times a growth
/// of the elements that is below 10 here: 2.2e-16 x 50.
constexpr double roundingBound = 1e-14;

}  // namespace atrapos::linear::test
