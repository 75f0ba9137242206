#pragma once

#include <memory>

#include "atrapos/fem/Term.hpp"
#include "atrapos/solid/Metal.hpp"
#include "atrapos/solid/ShellPoints.hpp"
#include "atrapos/solid/ShellStages.hpp"

/// Shells whose laws are made of stages.
namespace atrapos::solid {

/// How strains of eight nodes are made: of the displacements, or with assumed transverse shear.
enum class ShellStrains { compatible, assumedShear };

/// A material of solids, as ShellMaterialStage<Material>, in shells of six nodes. Inputs: changes of the
/// element's vectors (Mitc6Base.hpp), e; data: those of TiedShell<Mitc6> in Cartesian axes, g. For
/// fem::enhancedTerm at mitc6Points.
std::unique_ptr<fem::PointLaw> sixNodeShellLaw(std::unique_ptr<fem::PointLaw> material);

/// The term of a material, as ShellMaterialStage<Material>, whose lengths grow (GrowthStages.hpp), in shells
/// of any number of nodes. growth, a stage: in: values of fields, of which it reads `fields`, scalars of the
/// elements' own nodes, and the load factor; out: e, 0; data: x, y, z, zeta. Inputs of its law: those of the
/// Kinematics, the fields, the load factor, e; data: the Kinematics' in Cartesian axes, g, growth's,
/// the unit tensor as the element's strains have it, 6. poissonsRatio: of the material at rest (mitc4Points).
std::unique_ptr<fem::Term> expandingShellTerm(const ShellElements& elements, ShellStrains strains,
                                              double poissonsRatio, std::unique_ptr<fem::PointLaw> material,
                                              std::unique_ptr<fem::PointLaw> growth,
                                              const std::vector<std::string>& fields = {},
                                              const ShellCubature& cubature = {});

/// A metal in shells of this many nodes; kinematic hardening where it has a modulus. Inputs: those of the
/// Kinematics (ShellKinematics.hpp); outputs: forces, the event function, variables; data: 1 where the point
/// yields, else 0, the Kinematics' in axes of which 3 is the normal at rest, variables. strains: of eight
/// nodes; those of others are tied.
std::unique_ptr<fem::PointLaw> shellMetalLaw(const Metal& metal, ShellStrains strains, int nodesPerElement);

/// The term of that law, where no point yields and variables are zero. The axes are the same for each point
/// of a column through the thickness: the normal of the mid-surface, and along it the axis of space that is
/// farthest from it, projected.
std::unique_ptr<fem::Term> shellMetalTerm(const Metal& metal, const ShellElements& elements,
                                          ShellStrains strains, const ShellCubature& cubature = {});

}  // namespace atrapos::solid
