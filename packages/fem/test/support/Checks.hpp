#pragma once

#include "atrapos/fem/FeProblem.hpp"

/// What must hold of any model.
namespace atrapos::fem::test {

/// Tangent and load direction are the derivative of the residual: central differences, whose error must fall
/// like h^2.
void checkTangent(FeModel model);

/// Order-k right-hand sides: where U_1..U_K solve the order equations, what is left of the residual along the
/// series starts at order K+1. A mistake in any order shows as a lower rate.
void checkOrders(FeModel model);

}  // namespace atrapos::fem::test
