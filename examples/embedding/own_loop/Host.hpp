#pragma once
// The host: an application that has been there before Atrapos. It solves Bratu's problem
//
//     -div grad u = lambda exp(u) on the unit square, u = 0 on its boundary,
//
// with bilinear elements on a uniform grid, its unknowns distributed over the ranks by its own Tpetra map.
// Each element is computed by one rank, which imports the values it needs and exports the forces it makes.

#include <Sacado.hpp>
#include <Teuchos_OrdinalTraits.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Export.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Vector.hpp>
#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace host {

using Teuchos::RCP;
using Teuchos::rcp;
using Map = Tpetra::Map<int, long long>;
using Vector = Tpetra::Vector<double, int, long long>;
using Matrix = Tpetra::CrsMatrix<double, int, long long>;

/// Residual of one square element, written once for all scalars: in = four nodal values and lambda.
struct BratuElement {
  static constexpr int numInputs = 5, numOutputs = 4, numData = 0;
  double size = 0;  ///< edge length

  template <class T, class Data>
  void operator()(const T* in, const Data*, T* out) const {
    using std::exp;
    const double g = 0.5 / std::sqrt(3.0);
    for (int i = 0; i < 4; ++i) out[i] = T(0.0);
    for (int q = 0; q < 4; ++q) {
      const double x = 0.5 + (q % 2 ? g : -g), y = 0.5 + (q / 2 ? g : -g);
      const double N[4] = {(1 - x) * (1 - y), x * (1 - y), x * y, (1 - x) * y};
      const double Nx[4] = {-(1 - y), 1 - y, y, -y}, Ny[4] = {-(1 - x), -x, x, 1 - x};
      T u(0.0), ux(0.0), uy(0.0);
      for (int i = 0; i < 4; ++i) {
        u += N[i] * in[i];
        ux += Nx[i] * in[i];
        uy += Ny[i] * in[i];
      }
      const T source = (0.25 * size * size) * (in[4] * exp(u));
      for (int i = 0; i < 4; ++i) out[i] += 0.25 * (Nx[i] * ux + Ny[i] * uy) - N[i] * source;
    }
  }
};

/// Grid, maps, gather and scatter of an n x n grid; the unknowns are the (n-1)^2 inner nodes.
class Application {
 public:
  Application(int n, const RCP<const Teuchos::Comm<int>>& comm) : n_(n), element_{1.0 / n} {
    owned_ = rcp(new Map(static_cast<long long>(n - 1) * (n - 1), 0, comm));
    const int rank = comm->getRank(), ranks = comm->getSize();
    std::set<long long> ghosts;
    for (int row = n * rank / ranks; row < n * (rank + 1) / ranks; ++row)
      for (int column = 0; column < n; ++column) {
        const std::array<long long, 4> nodes = {unknown(column, row), unknown(column + 1, row),
                                                unknown(column + 1, row + 1), unknown(column, row + 1)};
        elements_.push_back(nodes);
        for (const long long id : nodes)
          if (id >= 0) ghosts.insert(id);
      }
    const std::vector<long long> ids(ghosts.begin(), ghosts.end());
    overlap_ = rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(), ids.data(),
                           static_cast<int>(ids.size()), 0, comm));
    import_ = rcp(new Tpetra::Import<int, long long>(owned_, overlap_));
    export_ = rcp(new Tpetra::Export<int, long long>(overlap_, owned_));
    ghosted_ = rcp(new Vector(overlap_));
    forces_ = rcp(new Vector(overlap_));
    makeMatrix();
  }

  const BratuElement& element() const { return element_; }
  int numElements() const { return static_cast<int>(elements_.size()); }
  const RCP<const Map>& map() const { return owned_; }
  /// Size of the terms that cancel in the residual: nodal forces of order h^2, sum of squares over the nodes.
  double forceScale() const { return 1.0 / n_; }
  /// The unknown nearest to the middle of the square.
  long long middle() const { return unknown(n_ / 2, n_ / 2); }

  /// Makes these values the ones that gather hands out.
  void import(const Vector& u, double lambda) {
    ghosted_->doImport(u, *import_, Tpetra::INSERT);
    lambda_ = lambda;
  }
  /// The inputs of an element.
  void gather(int e, double* in) const {
    const auto data = ghosted_->getData();
    for (int i = 0; i < 4; ++i)
      in[i] = elements_[e][i] < 0 ? 0.0 : data[overlap_->getLocalElement(elements_[e][i])];
    in[4] = lambda_;
  }
  void clearForces() { forces_->putScalar(0); }
  void scatter(int e, const double* values, double factor) {
    for (int i = 0; i < 4; ++i)
      if (elements_[e][i] >= 0)
        forces_->sumIntoLocalValue(overlap_->getLocalElement(elements_[e][i]), factor * values[i]);
  }
  void exportForces(Vector& r) {
    r.putScalar(0);
    r.doExport(*forces_, *export_, Tpetra::ADD);
  }

  /// The residual at (u, lambda).
  void residual(const Vector& u, double lambda, Vector& r) {
    import(u, lambda);
    clearForces();
    for (int e = 0; e < numElements(); ++e) {
      double in[5], out[4];
      gather(e, in);
      element_(in, static_cast<const double*>(nullptr), out);
      scatter(e, out, 1);
    }
    exportForces(r);
  }

  /// The Jacobian at (u, lambda) by Sacado, and dR/dlambda times -1.
  RCP<const Matrix> jacobian(const Vector& u, double lambda, Vector& F) {
    using Fad = Sacado::Fad::SFad<double, 5>;
    import(u, lambda);
    clearForces();
    overlapping_->resumeFill();
    overlapping_->setAllToScalar(0);
    for (int e = 0; e < numElements(); ++e) {
      double in[5], dLambda[4];
      gather(e, in);
      Fad x[5], out[4];
      for (int j = 0; j < 5; ++j) x[j] = Fad(5, j, in[j]);
      element_(x, static_cast<const double*>(nullptr), out);
      for (int i = 0; i < 4; ++i) {
        dLambda[i] = out[i].dx(4);
        for (int j = 0; j < 4; ++j) {
          const double value = out[i].dx(j);
          if (elements_[e][i] >= 0 && elements_[e][j] >= 0)
            overlapping_->sumIntoGlobalValues(elements_[e][i], 1, &value, &elements_[e][j]);
        }
      }
      scatter(e, dLambda, -1);
    }
    overlapping_->fillComplete(owned_, owned_);
    exportForces(F);
    matrix_->resumeFill();
    matrix_->setAllToScalar(0);
    matrix_->doExport(*overlapping_, *export_, Tpetra::ADD);
    matrix_->fillComplete();
    return matrix_;
  }

 private:
  /// Number of the unknown at grid point (i, j); -1 on the boundary.
  long long unknown(int i, int j) const {
    if (i == 0 || j == 0 || i == n_ || j == n_) return -1;
    return static_cast<long long>(j - 1) * (n_ - 1) + i - 1;
  }

  void makeMatrix() {
    overlapping_ = rcp(new Matrix(overlap_, 9));
    for (const auto& nodes : elements_)
      for (const long long row : nodes)
        for (const long long column : nodes)
          if (row >= 0 && column >= 0) {
            const double zero = 0;
            overlapping_->insertGlobalValues(row, 1, &zero, &column);
          }
    overlapping_->fillComplete(owned_, owned_);
    matrix_ = rcp(new Matrix(owned_, 9));
    matrix_->doExport(*overlapping_, *export_, Tpetra::ADD);
    matrix_->fillComplete();
  }

  int n_;
  BratuElement element_;
  std::vector<std::array<long long, 4>> elements_;
  RCP<const Map> owned_, overlap_;
  RCP<Tpetra::Import<int, long long>> import_;
  RCP<Tpetra::Export<int, long long>> export_;
  RCP<Vector> ghosted_, forces_;
  double lambda_ = 0;
  RCP<Matrix> overlapping_, matrix_;
};

}  // namespace host
