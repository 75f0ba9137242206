#include "CoupledSystem.hpp"

#include <map>
#include <stdexcept>
#include <utility>

#include "Upload.hpp"

namespace atrapos::fem::detail {

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
  std::map<int, std::vector<std::pair<int, double>>> byMaster;
  for (std::size_t c = 0; c < couplings_.size(); ++c)
    for (const CoupledDof& m : couplings_[c].masters)
      byMaster[m.dof].push_back({static_cast<int>(c), m.factor});
  std::vector<int> masters, first{0}, coupling;
  std::vector<double> part;
  for (const auto& [dof, of] : byMaster) {
    masters.push_back(dof);
    for (const auto& [c, f] : of) {
      coupling.push_back(c);
      part.push_back(f);
    }
    first.push_back(static_cast<int>(coupling.size()));
  }
  columns_ = {static_cast<int>(masters.size()), upload("masters", masters), upload("first", first),
              upload("coupling", coupling), upload("part", part)};
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
  const Columns t = columns_;
  const int numRows = static_cast<int>(rowStart.extent(0)) - 1;
  int last = 0;  // columns may be of nodes without rows here
  Kokkos::parallel_reduce(
      "last column", Kokkos::RangePolicy<Execution>(0, columns.extent(0)),
      KOKKOS_LAMBDA(std::size_t e, int& most) { most = columns(e) > most ? columns(e) : most; },
      Kokkos::Max<int>(last));
  const int numColumns = last + 1;
  // Places of a row's columns while it is worked on, -1 elsewhere; rows with columns of slaves.
  const View<std::ptrdiff_t*> place("places of columns", numColumns);
  const View<char*> met("rows with slaves", numRows);
  const View<int*> couplingOf("coupling of a dof", numColumns);
  int missing = 0;
  Kokkos::parallel_reduce(
      "couplings", Kokkos::RangePolicy<Execution>(0, 1),
      KOKKOS_LAMBDA(int, int& lacking) {
        for (int d = 0; d < numColumns; ++d) {
          place(d) = -1;
          couplingOf(d) = -1;
        }
        for (int c = 0; c < r.count; ++c) couplingOf(r.slave(c)) = c;
        const auto enter = [&](int row) {
          for (std::size_t e = rowStart(row); e < rowStart(row + 1); ++e)
            place(columns(e)) = static_cast<std::ptrdiff_t>(e);
        };
        const auto leave = [&](int row) {
          for (std::size_t e = rowStart(row); e < rowStart(row + 1); ++e) place(columns(e)) = -1;
        };
        const auto add = [&](int column, double value) {
          if (value == 0) return;
          if (place(column) < 0)
            ++lacking;
          else
            values(place(column)) += value;
        };
        // K T: columns of slaves go to those of their masters, what is prescribed of them to the load
        // direction. The graph is symmetric: a slave's columns are the rows that have it. A node of which
        // some unknowns are slaves and others masters of what another rank has is connected to nodes without
        // rows here.
        for (int c = 0; c < r.count; ++c)
          for (std::size_t e = rowStart(r.slave(c)); e < rowStart(r.slave(c) + 1); ++e)
            if (columns(e) < numRows) met(columns(e)) = 1;
        for (int i = 0; i < numRows; ++i) {
          if (!met(i)) continue;
          enter(i);
          for (std::size_t e = rowStart(i); e < rowStart(i + 1); ++e) {
            const int c = couplingOf(columns(e));
            if (c < 0 || values(e) == 0) continue;
            F(i) -= values(e) * r.rate(c);
            for (int m = r.start(c); m < r.start(c + 1); ++m) add(r.master(m), r.factor(m) * values(e));
            values(e) = 0;
          }
          leave(i);
        }
        // T^T of it: rows of slaves go to those of their masters, which get their part of s (e_s - c)(e_s -
        // c)^T.
        for (int k = 0; k < t.count; ++k) {
          const int i = t.master(k);
          enter(i);
          for (int a = t.start(k); a < t.start(k + 1); ++a) {
            const int c = t.coupling(a), slave = r.slave(c);
            const double factor = t.factor(a), own = factor * s(slave);
            for (std::size_t e = rowStart(slave); e < rowStart(slave + 1); ++e)
              add(columns(e), factor * values(e));
            F(i) += factor * F(slave) - own * r.rate(c);
            add(slave, -own);
            for (int m = r.start(c); m < r.start(c + 1); ++m) add(r.master(m), own * r.factor(m));
          }
          leave(i);
        }
        for (int c = 0; c < r.count; ++c) {
          const int slave = r.slave(c);
          enter(slave);
          for (std::size_t e = rowStart(slave); e < rowStart(slave + 1); ++e) values(e) = 0;
          F(slave) = s(slave) * r.rate(c);
          add(slave, s(slave));
          for (int m = r.start(c); m < r.start(c + 1); ++m) add(r.master(m), -s(slave) * r.factor(m));
          leave(slave);
        }
      },
      missing);
  if (missing > 0) throw std::logic_error("the graph lacks entries of the couplings");
}

}  // namespace atrapos::fem::detail
