#include "CoupledSystem.hpp"

#include <stdexcept>

#include "Upload.hpp"

namespace atrapos::fem::detail {

namespace {

/// Position of a column in a row, or -1.
KOKKOS_INLINE_FUNCTION std::ptrdiff_t find(const View<std::size_t*>& rowStart, const View<int*>& columns,
                                           int row, int column) {
  std::size_t low = rowStart(row), high = rowStart(row + 1);
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (columns(middle) < column)
      low = middle + 1;
    else
      high = middle;
  }
  return low < rowStart(row + 1) && columns(low) == column ? static_cast<std::ptrdiff_t>(low) : -1;
}

}  // namespace

CoupledSystem::CoupledSystem(std::vector<Coupling> resolved) : couplings_(std::move(resolved)) {
  std::vector<int> slave, start{0}, master;
  std::vector<double> factor, value, rate;
  for (const Coupling& c : couplings_) {
    slave.push_back(c.dof);
    value.push_back(c.value);
    rate.push_back(c.perLoadFactor);
    for (const CoupledDof& m : c.masters) {
      master.push_back(m.dof);
      factor.push_back(m.factor);
    }
    start.push_back(static_cast<int>(master.size()));
  }
  rows_ = {static_cast<int>(couplings_.size()),
           upload("slave", slave),
           upload("start", start),
           upload("master", master),
           upload("factor", factor),
           upload("value", value),
           upload("rate", rate)};
}

// Couplings are few and may share masters: one thread runs through them, in their order, in each kernel.

void CoupledSystem::gatherForces(const DofView& f) const {
  if (empty()) return;
  const Rows r = rows_;
  Kokkos::parallel_for(
      "gatherForces", Kokkos::RangePolicy<Execution>(0, 1), KOKKOS_LAMBDA(int) {
        for (int c = 0; c < r.count; ++c) {
          const double force = f(r.slave(c));
          for (int m = r.start(c); m < r.start(c + 1); ++m) f(r.master(m)) += r.factor(m) * force;
          f(r.slave(c)) = 0;
        }
      });
}

void CoupledSystem::addGaps(const ConstDofView& u, double lambda, const ConstDofView& s,
                            const DofView& f) const {
  if (empty()) return;
  const Rows r = rows_;
  Kokkos::parallel_for(
      "coupling gaps", Kokkos::RangePolicy<Execution>(0, 1), KOKKOS_LAMBDA(int) {
        for (int c = 0; c < r.count; ++c) {
          double gap = u(r.slave(c)) - r.value(c) - lambda * r.rate(c);
          for (int m = r.start(c); m < r.start(c + 1); ++m) gap -= r.factor(m) * u(r.master(m));
          const double own = s(r.slave(c));
          f(r.slave(c)) += own * gap;
          for (int m = r.start(c); m < r.start(c + 1); ++m) f(r.master(m)) -= r.factor(m) * own * gap;
        }
      });
}

void CoupledSystem::transform(const View<std::size_t*>& rowStart, const View<int*>& columns,
                              const View<double*>& values, const ConstDofView& s, const DofView& F) const {
  if (empty()) return;
  const Rows r = rows_;
  int missing = 0;
  Kokkos::parallel_reduce(
      "couplings", Kokkos::RangePolicy<Execution>(0, 1),
      KOKKOS_LAMBDA(int, int& lacking) {
        const auto add = [&](int row, int column, double value) {
          if (value == 0) return;
          const auto at = find(rowStart, columns, row, column);
          if (at < 0)
            ++lacking;
          else
            values(at) += value;
        };
        for (int c = 0; c < r.count; ++c) {  // one slave after the other: K = T_s^T K T_s
          const int slave = r.slave(c), first = r.start(c), last = r.start(c + 1);
          // Its prescribed part goes to the load direction, its row to those of the masters.
          for (std::size_t e = rowStart(slave); e < rowStart(slave + 1); ++e) {
            const int j = columns(e);
            const auto back = find(rowStart, columns, j, slave);
            if (back >= 0) F(j) -= values(back) * r.rate(c);
          }
          for (std::size_t e = rowStart(slave); e < rowStart(slave + 1); ++e) {
            for (int m = first; m < last; ++m) add(r.master(m), columns(e), r.factor(m) * values(e));
            values(e) = 0;
          }
          for (int m = first; m < last; ++m) F(r.master(m)) += r.factor(m) * F(slave);
          F(slave) = 0;
          // Its column to those of the masters; the graph is symmetric.
          for (std::size_t e = rowStart(slave); e < rowStart(slave + 1); ++e) {
            const int j = columns(e);
            const auto at = find(rowStart, columns, j, slave);
            if (at < 0) continue;
            for (int m = first; m < last; ++m) add(j, r.master(m), r.factor(m) * values(at));
            values(at) = 0;
          }
        }
        for (int c = 0; c < r.count; ++c) {
          const int slave = r.slave(c), first = r.start(c), last = r.start(c + 1);
          const double own = s(slave);
          add(slave, slave, own);
          F(slave) += own * r.rate(c);
          for (int m = first; m < last; ++m) {
            const double factor = r.factor(m);
            add(slave, r.master(m), -own * factor);
            add(r.master(m), slave, -own * factor);
            F(r.master(m)) -= own * factor * r.rate(c);
            for (int n = first; n < last; ++n) add(r.master(m), r.master(n), own * factor * r.factor(n));
          }
        }
      },
      missing);
  if (missing > 0) throw std::logic_error("the graph lacks entries of the couplings");
}

}  // namespace atrapos::fem::detail
