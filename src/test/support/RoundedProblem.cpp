#include "RoundedProblem.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace atrapos::test {
namespace {

/// Steele, Lea and Flood's mixing function.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

}  // namespace

RoundedProblem::RoundedProblem(path::Problem& exact, unsigned seed, double size)
    : exact_(exact), seed_(seed), size_(size) {}

double RoundedProblem::noise(int i, int j) const {
  const auto pair = [](std::uint64_t high, std::uint64_t low) { return (high << 32) | low; };
  const std::uint64_t word = mixed(mixed(pair(seed_, calls_)) ^ pair(i, j));
  return size_ * (2 * static_cast<double>(word >> 11) / static_cast<double>(1ull << 53) - 1);
}

void RoundedProblem::multiply(path::Vector& x) {
  ++calls_;
  const auto values = x.getDataNonConst();
  for (int i = 0; i < values.size(); ++i) values[i] *= 1 + noise(i);
}

path::ResidualNorm RoundedProblem::residual(const path::State& state, path::Vector& r) {
  path::ResidualNorm norm = exact_.residual(state, r);
  ++calls_;
  {
    const double part = norm.scale / std::sqrt(static_cast<double>(r.getGlobalLength()));
    const auto values = r.getDataNonConst();
    for (int i = 0; i < values.size(); ++i) values[i] += noise(i) * part;
  }
  norm.norm = r.norm2();
  return norm;
}

path::RCP<const path::CrsMatrix> RoundedProblem::tangent(const path::State& state, path::Vector& F) {
  const auto exact = exact_.tangent(state, F);
  multiply(F);
  ++calls_;
  const auto K = Teuchos::rcp(new path::CrsMatrix(*exact, Teuchos::Copy));
  K->resumeFill();
  const bool symmetric = exact_.symmetric();
  std::vector<double> row;
  for (int i = 0; i < static_cast<int>(K->getNodeNumRows()); ++i) {
    Teuchos::ArrayView<const int> columns;
    Teuchos::ArrayView<const double> values;
    K->getLocalRowView(i, columns, values);
    row.assign(values.begin(), values.end());
    for (int k = 0; k < columns.size(); ++k) {
      const int j = columns[k];
      row[k] *= 1 + (symmetric ? noise(std::min(i, j), std::max(i, j)) : noise(i, j));
    }
    K->replaceLocalValues(i, columns, Teuchos::ArrayView<const double>(row.data(), row.size()));
  }
  K->fillComplete(exact->getDomainMap(), exact->getRangeMap());
  return K;
}

void RoundedProblem::orderRhs(int k, path::Vector& Fk) {
  exact_.orderRhs(k, Fk);
  multiply(Fk);
}

}  // namespace atrapos::test
