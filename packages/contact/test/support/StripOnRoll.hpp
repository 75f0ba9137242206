#pragma once

#include "ContactModel.hpp"
#include "ShellPath.hpp"

namespace atrapos::contact::test {

/// The paper's first example (4.1) with shell elements, without its contact: a strip of 20 `refinement`
/// elements, clamped at x = 0, pulled down at its tip by 100 lambda N over a roll, and 40 stations every 10
/// mm at which contact acts (nu = 0, mid-surface radius 50, case A of the references).
struct StripOnRoll {
  static constexpr int stations = 41;
  static constexpr double length = 400, width = 20, thickness = 0.8;

  int refinement;
  solid::test::ShellGrid grid;
  fem::FeModel model;
  fem::PointSet points;      ///< at every node of a station, its share of the width as weight
  std::vector<int> station;  ///< of each point
  int tip;
  Cylinder roll{{200, 0, -54}, {0, 1, 0}, 50};

  explicit StripOnRoll(int times)
      : refinement(times),
        grid(solid::test::shellGrid(20 * times, 1, thickness, solid::test::flat(length, width))),
        model(solid::test::shellModel(grid, solid::SaintVenantKirchhoff::fromYoung(220000, 0))),
        tip(grid.node(2 * grid.nu, 1)) {
    solid::test::clamp(model, grid, grid.lineI(0));
    solid::addShellEdgeForce(grid.elements(), grid.side(1), {0, 0, -100 / width}, model.load);
    points.nodesPerEntity = points.pointsPerEntity = points.shapeComponents = 1;
    for (int s = 1; s < stations; ++s) {
      const auto nodes = grid.lineI(refinement * s);
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        points.nodes.push_back(nodes[k]);
        points.shape.push_back(1);
        points.weights.push_back(nodes.size() == 2 ? 0.5 : k == 1 ? 2.0 / 3 : 1.0 / 6);
        points.positions.insert(points.positions.end(), grid.x[nodes[k]].begin(), grid.x[nodes[k]].end());
        ++points.numEntities;
        station.push_back(s);
      }
    }
  }

  /// Each station as one point, the mean over its two or three nodes: as many contacts as stations.
  std::vector<fem::PointSet> stationPoints() const {
    fem::PointSet sets[2];
    for (int s = 1; s < stations; ++s) {
      const auto nodes = grid.lineI(refinement * s);
      fem::PointSet& p = sets[nodes.size() - 2];
      p.nodesPerEntity = static_cast<int>(nodes.size());
      p.pointsPerEntity = p.shapeComponents = 1;
      ++p.numEntities;
      p.weights.push_back(1);
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        p.nodes.push_back(nodes[k]);
        p.shape.push_back(nodes.size() == 2 ? 0.5 : k == 1 ? 2.0 / 3 : 1.0 / 6);
      }
      p.positions.insert(p.positions.end(), {grid.x[nodes[0]][0], width / 2, 0});
    }
    std::vector<fem::PointSet> used;
    for (const auto& p : sets)
      if (p.numEntities > 0) used.push_back(p);
    return used;
  }

  /// Gaps of points at the start.
  Numbers gaps(const fem::PointSet& p) const {
    Numbers h;
    for (int i = 0; i < p.numPoints(); ++i) {
      double y[Cylinder::numUnknowns];
      taylor::solveImplicit<3, Cylinder::numUnknowns>(roll, &p.positions[3 * i], y);
      h.push_back(y[0]);
    }
    return h;
  }

  /// Force on the strip at every station in the state u, from the contact term's pressures.
  Numbers stationForces(const fem::FeProblem& problem, const Numbers& u) const {
    const Numbers R = observed(problem, 1, {fem::test::vectorOf(problem, u), 0}, "contact_pressure");
    Numbers forces(stations, 0.0);
    for (std::size_t i = 0; i < R.size(); ++i) forces[station[i]] += points.weights[i] * R[i];
    return forces;
  }
};

}  // namespace atrapos::contact::test
