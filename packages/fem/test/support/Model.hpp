#pragma once

#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/PointLawOf.hpp"
#include "support/Laws.hpp"
#include "support/Meshes.hpp"

namespace atrapos::fem::test {

/// Data of a PointSet's points for ExponentialSolid: stiffness from 0.5 to 1.5, different from point to
/// point.
std::vector<double> unevenScale(const PointSet& points, unsigned seed);

/// One ExponentialSolid term for every block.
std::vector<std::unique_ptr<Term>> solidTerms(const Mesh& mesh);

/// ExponentialSolid with supports, driven supports and both kinds of loads: nodes at x < 0.1 held, z of them
/// driven; y driven along the edge of large x and z; forces at every node that has an element.
FeModel busyModel(const Mesh& mesh);

}  // namespace atrapos::fem::test
