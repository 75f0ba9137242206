#pragma once

#include <array>
#include <string>
#include <vector>

#include "atrapos/solid/ShellPoints.hpp"

/// What a shell shows: stresses at its surfaces, stress resultants, thickness (docs/theory/shell.md,
/// "Results"). `u` is a model's state, [3 node + component].
namespace atrapos::solid {

/// Where and in which axes the results of an element are: its in-plane cubature points, [element][point].
/// axis: a direction whose projection on the undeformed mid-surface is the local direction 1 (the next of
/// x, y, z where it is within 10 degrees of the normal); it moves with the material. Direction 3 is the
/// normal of the deformed mid-surface, 2 completes a right-handed frame.
struct ShellResultOptions {
  ShellCubature cubature;
  std::array<double, 3> axis{1, 0, 0};
};

/// Cauchy stresses, [element][in-plane point][xx yy zz xy yz zx], at the surface zeta, linear through the two
/// cubature points next to it along zeta (the first six of what the term's observe gives).
std::vector<double> surfaceStress(const fem::PointValues& stress, const ShellCubature& cubature, double zeta);

/// Values at an element's in-plane cubature points taken to its 8 or 4 nodes: [node][in-plane points], the
/// polynomial through the points (bilinear with 2 x 2).
std::vector<double> shellPointsToNodes(const ShellCubature& cubature, int nodes = 8);

/// Stress resultants per deformed length at the in-plane points: forces and moments on the section whose
/// normal on the mid-surface is e_a,
///     n_ab = int e_b.s A_a dz,   m_ab = int z e_b.s A_a dz,   q_a = int e_3.s A_a dz,
/// s the Cauchy stress, e the local axes, z the distance from the mid-surface, A_a dz the section's area
/// there times its normal, per length on the mid-surface. n_12 and m_12 are means of 12 and 21, which differ
/// where the shell is curved. Moments m_11 stretch the side z > 0 along 1.
struct ShellResultants {
  static std::vector<std::string> names();  ///< n_11 n_22 n_12 m_11 m_22 m_12 q_1 q_2
  std::vector<double> values;               ///< [element][point][name]
  std::vector<double> positions;            ///< [element][point][3] on the undeformed mid-surface
};
ShellResultants shellResultants(const ShellElements& elements, const fem::PointValues& stress,
                                const std::vector<double>& u, const ShellResultOptions& options = {});

/// Change of the thickness, 2 (|D + w| - |D|) with the element's own director, [element][node], length.
std::vector<double> thicknessChange(const ShellElements& elements, const std::vector<double>& u);

}  // namespace atrapos::solid
