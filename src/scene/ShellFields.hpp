#pragma once

#include <string>
#include <vector>

#include "atrapos/fem/Term.hpp"
#include "scene/Shells.hpp"

/// What the result file shows of shells; `u` is the problem's state, [3 node + component].
namespace atrapos {

/// Of each node of the mesh: the director d = D + w as it is, half the thickness long from the middle to the
/// top surface (where several stand at a node, their mean), and the change of the thickness (mean over the
/// elements). Zero where no shell is. [director_x director_y director_z thickness_change][node]
std::vector<std::vector<double>> directorFields(const SceneShells& shells, const std::vector<double>& u);

/// [element][point][value] -> [element][value], the mean over the points.
std::vector<double> meansOverPoints(const std::vector<double>& values, std::size_t points, std::size_t each);

/// Means over each element of the Cauchy stresses at a surface: [element][xx yy zz xy yz zx].
std::vector<double> meanSurfaceStress(const solid::ShellElements& elements, const fem::PointValues& observed,
                                      const solid::ShellCubature& cubature, double zeta);

/// Means over each element of the stress resultants, in axes of which 1 is the projection of x on the
/// undeformed middle surface: [element][n_11 ...].
std::vector<double> meanResultants(const solid::ShellElements& elements, const fem::PointValues& observed,
                                   const solid::ShellCubature& cubature, const std::vector<double>& u);

}  // namespace atrapos
