#pragma once

#include "ShellModel.hpp"

namespace atrapos::solid::test {

/// A state off the linear range: random displacements of this size at free dofs, 0 at the supports.
Numbers randomState(const fem::FeModel& model, double amplitude, unsigned seed);

/// Makes a vector keep to the couplings, at this rate of the load factor; masters first.
void keepTo(const fem::FeModel& model, double lambda, Numbers& u);

/// Central differences of the residual against the tangent along `direction` (zero at prescribed dofs): their
/// error falls like h^2.
void expectTangent(fem::FeProblem& problem, const Numbers& u, const Numbers& direction, double lambda);

/// Where U_1..U_K solve the order equations, what is left of the residual along the series starts at order
/// K+1. u0 need not be an equilibrium: its own residual is constant along the series and taken off.
void expectOrders(fem::FeProblem& problem, const Numbers& u0, double lambda0);

/// Both of a model whose tangent is symmetric, at a random state of all its unknowns under random loads.
/// Returns path::Problem::constraintPivots.
int expectSymmetricTangentAndOrders(fem::FeModel model);

}  // namespace atrapos::solid::test
