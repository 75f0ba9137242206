#include "PathCase.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "HingedRoof.hpp"
#include "atrapos/fem/Loads.hpp"
#include "support/ContactModel.hpp"

namespace atrapos::bench {

namespace {

PathCase roof(const std::string& name, int n, double thickness, double deflection) {
  solid::test::HingedRoof roof(n, thickness);
  PathCase c;
  c.name = name;
  c.stops = roof.stopAtDeflection(deflection);
  c.problem = std::move(roof.problem);
  return c;
}

PathCase strip(int refinement) {
  fem::StripOptions options;
  options.length = 400;
  options.width = 20;
  options.thickness = 0.8;
  options.origin = {0, -10, -0.4};
  options.divisions = {40 * refinement, 2, 1};
  const fem::Mesh mesh = fem::stripMesh(options);
  fem::FeModel model = contact::test::solidModel(mesh, 220000, 0);
  for (const int node : fem::test::nodesOfSet(mesh, "x_min"))
    for (int i = 0; i < 3; ++i) model.prescribe(node, i, 0, 0);
  fem::addSurfaceForce(mesh, fem::test::sideSet(mesh, "x_max"), {0, 0, -100}, model.load);
  contact::test::addContact(
      model, contact::test::contactPoints(mesh, "bottom", contact::test::Where::Quadrature, 8),
      contact::Cylinder{{200, 0, -54.4}, {0, 1, 0}, 50}, contact::RegularisedPressure{1e-3, 1e-6}, 0);
  PathCase c;
  c.name = "strip";
  c.problem = std::make_unique<fem::FeProblem>(std::move(model));
  c.stops.loadFactors = {0.25};
  return c;
}

}  // namespace

const std::vector<std::string>& pathCases() {
  static const std::vector<std::string> names{"roof", "roof_thin", "strip"};
  return names;
}

int refinementFor(const std::string& name, double unknowns) {
  // Six dofs at three nodes an element of shells; the strip has 57 nodes in a row of 2 x 1 cells.
  const double own = name == "roof" ? 16 * 18 : name == "roof_thin" ? 64 * 18 : name == "strip" ? 2280 : 0;
  if (own == 0) throw std::invalid_argument("bench_path: unknown case '" + name + "'");
  const double factor = unknowns / own;
  return std::max(1, static_cast<int>(std::lround(name == "strip" ? factor : std::sqrt(factor))));
}

PathCase makePathCase(const std::string& name, int refinement) {
  if (refinement < 1) throw std::invalid_argument("bench_path: the refinement must be >= 1");
  if (name == "roof") return roof(name, 4 * refinement, 12.7, 30);
  if (name == "roof_thin") return roof(name, 8 * refinement, 6.35, 38.6);
  if (name == "strip") return strip(refinement);
  throw std::invalid_argument("bench_path: unknown case '" + name + "', there are roof, roof_thin, strip");
}

}  // namespace atrapos::bench
