#pragma once

#include "ShellPath.hpp"

namespace atrapos::solid::test {

/// A quarter of the cylindrical roof of Sze, Liu and Lo (2004), 3.8: hinged along its straight edges, free
/// along the curved ones, load 3000 N at its centre at load factor 1. n x n shells.
struct HingedRoof {
  std::unique_ptr<fem::FeProblem> problem;
  int centreDof = 0;  ///< vertical displacement of the centre

  HingedRoof(int n, double thickness) {
    const ShellGrid grid = shellGrid(n, n, thickness, cylinder(2540, 0, 0.1, 0, 254));
    fem::FeModel model = shellModel(grid, SaintVenantKirchhoff::fromYoung(3102.75, 0.3));
    symmetric(model, grid, grid.lineI(0), 'x');
    symmetric(model, grid, grid.lineJ(0), 'y');
    hold(model, grid.lineI(2 * n), "xyz");  // hinged: directors free
    centreDof = 3 * grid.node(0, 0) + 2;
    model.load[centreDof] = -3000.0 / 4;
    problem = std::make_unique<fem::FeProblem>(std::move(model));
  }

  path::Stops stopAtDeflection(double deflection) const {
    path::Stops stops;
    stops.functionals = {stopAt(*problem, centreDof, -deflection)};
    return stops;
  }
};

}  // namespace atrapos::solid::test
