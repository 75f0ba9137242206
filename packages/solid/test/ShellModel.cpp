#include "ShellModel.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>

#include "atrapos/fem/EnhancedTerm.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/solid/ShellTerms.hpp"

namespace atrapos::solid::test {

std::unique_ptr<fem::Term> shellTerm(const ShellElements& elements, const SaintVenantKirchhoff& material,
                                     const ShellCubature& cubature, Shear shear) {
  const double poisson = material.lambda / (2 * (material.lambda + material.mu));
  if (shear == Shear::mitc3)
    return fem::enhancedTerm(fem::pointLaw(Mitc3Law<SaintVenantKirchhoff>{material}),
                             mitc3Points(elements, poisson, cubature));
  if (shear == Shear::mitc6)
    return fem::enhancedTerm(
        sixNodeShellLaw(fem::pointLaw(ShellMaterialStage<SaintVenantKirchhoff>{material})),
        mitc6Points(elements, cubature));
  if (shear == Shear::mitc4)
    return fem::enhancedTerm(fem::pointLaw(Mitc4Law<SaintVenantKirchhoff>{material}),
                             mitc4Points(elements, poisson, cubature));
  if (shear == Shear::assumed)
    return fem::enhancedTerm(fem::pointLaw(AssumedShearLaw<SaintVenantKirchhoff>{material}),
                             assumedShearPoints(elements, cubature));
  return fem::enhancedTerm(fem::pointLaw(ShellLaw<SaintVenantKirchhoff>{material}),
                           shellPoints(elements, cubature));
}

Numbers linearSolution(fem::FeProblem& problem) {
  auto F = fem::test::zeroVector(problem), u = fem::test::zeroVector(problem);
  const auto K = problem.tangent({fem::test::zeroVector(problem), 0}, *F);
  linear::TangentSolverOptions options;
  options.symmetric = problem.symmetric();
  const auto solver = linear::makeTangentSolver(options);
  solver->analyze(K);
  solver->factor(K);
  solver->solve(*F, *u);
  return fem::FeProblem::values(*u);
}

}  // namespace atrapos::solid::test
