#include "support/Elastica.hpp"

#include "support/Table.hpp"

namespace atrapos::test {

Elastica::Elastica(Case which) : touch_(which == Case::A ? 0.001117785595 : 0.00111771399) {
  const Table table(which == Case::A ? ATRAPOS_ACCEPT_DATA "/r1_x200_A.csv"
                                     : ATRAPOS_ACCEPT_DATA "/r1_x200_B.csv");
  const auto load = table.column("lambda"), ux = table.column("ux_tip"), uz = table.column("uz_tip"),
             force = table.column("N_total"), phase = table.column("phase");
  for (std::size_t i = 0; i < load.size(); ++i) {
    const auto add = [&](Branch& branch) {
      branch.loadFactor.push_back(load[i]);
      branch.ux.push_back(ux[i]);
      branch.uz.push_back(uz[i]);
      branch.force.push_back(force[i]);
    };
    if (load[i] <= touch_) add(free_);
    if (load[i] >= touch_ && phase[i] >= 1) add(touching_);
  }
}

StripState Elastica::beam(double loadFactor) const {
  const Branch& b = loadFactor < touch_ ? free_ : touching_;
  const auto at = [&](const std::vector<double>& y) { return interpolate(b.loadFactor, y, loadFactor); };
  return {at(b.ux), at(b.uz), at(b.force)};
}

StripState Elastica::plate(double loadFactor) const {
  constexpr double nu = 0.3, ratio = 1 - nu * nu;
  StripState s = beam(ratio * loadFactor);
  s.force /= ratio;
  return s;
}

}  // namespace atrapos::test
