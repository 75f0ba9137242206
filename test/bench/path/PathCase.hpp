#pragma once

#include <memory>
#include <string>
#include <vector>

#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/path/Stops.hpp"

namespace atrapos::bench {

/// A path to follow from rest.
struct PathCase {
  std::string name;
  std::unique_ptr<fem::FeProblem> problem;
  path::Stops stops;
};

/// roof: hinged cylindrical roof, 12.7 mm, through both limit points of the load, shells;
/// roof_thin: the same of 6.35 mm, which snaps back as well;
/// strip: the strip on the roll of examples/strip_roll/solid.yaml, 400 x 20 x 0.8 mm, HEX20, to load factor
/// 0.25.
const std::vector<std::string>& pathCases();

/// The refinement whose number of unknowns is nearest to this one. Throws std::invalid_argument on an unknown
/// name.
int refinementFor(const std::string& name, double unknowns);

/// `refinement` >= 1 multiplies the divisions. Throws std::invalid_argument on an unknown name.
PathCase makePathCase(const std::string& name, int refinement);

}  // namespace atrapos::bench
