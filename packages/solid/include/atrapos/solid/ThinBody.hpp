#pragma once

#include <memory>
#include <vector>

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/Term.hpp"
#include "atrapos/solid/Metal.hpp"

/// Bodies that resist stretching alone: membranes and bars (docs/theory/thin.md). Their nodes have
/// displacements, no directors.
namespace atrapos::solid {

/// What a surface or a line in space stands for.
struct ThinSection {
  double size = 1;    ///< of membranes the thickness, of bars the area of the cross-section; > 0
  double stress = 0;  ///< at rest, along the surface or the bar
};

/// The cell with the cubature of its forces: of membranes as of plane cells.
fem::Tabulation thinTabulation(fem::Topology topology);

/// Points of a block of surfaces or bars: gradients along orthonormal axes of the surface (along the bar),
/// and `axes`, [point][component][axis]; weights are volumes. Throws std::runtime_error naming the element
/// that has no area (length), and for other cells.
struct ThinPoints {
  fem::PointSet points;
  std::vector<double> axes;
};
ThinPoints thinPoints(const fem::Mesh& mesh, const fem::Block& block, const fem::Tabulation& cell,
                      const ThinSection& section);

/// The same with shape values (body forces).
fem::PointSet thinValuePoints(const fem::Mesh& mesh, const fem::Block& block, const fem::Tabulation& cell,
                              const ThinSection& section);

/// A material as ShellMaterialStage<Material>, at thinPoints: plane stress in membranes, uniaxial in bars,
/// by a condensed stretch across them.
std::unique_ptr<fem::PointLaw> membraneLaw(std::unique_ptr<fem::PointLaw> material);
std::unique_ptr<fem::PointLaw> barLaw(std::unique_ptr<fem::PointLaw> material);
/// The same of a metal at small strains; the section has no stress at rest.
std::unique_ptr<fem::PointLaw> membraneLaw(const Metal& metal);
std::unique_ptr<fem::PointLaw> barLaw(const Metal& metal);

/// The term of one of these laws.
std::unique_ptr<fem::Term> thinTerm(std::unique_ptr<fem::PointLaw> law, const ThinPoints& points,
                                    const ThinSection& section);

}  // namespace atrapos::solid
