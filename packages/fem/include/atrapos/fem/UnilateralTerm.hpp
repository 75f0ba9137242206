#pragma once

#include <memory>
#include <vector>

#include "atrapos/fem/EventTerm.hpp"
#include "atrapos/fem/Multipliers.hpp"
#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/fem/PointPieces.hpp"

namespace atrapos::fem {

/// One-sided conditions with forces that are unknowns: one multiplier for each condition, at a node of its
/// own (docs/theory/contact.md, Hard contact).
///
///     at points:   h(x, lambda) >= 0, force P grad h, P >= 0, P h = 0
///     over faces:  g_i = int psi_i h dA / int psi_i dA >= 0, pressure sum_i psi_i p_i, p_i >= 0, p_i g_i = 0
///
/// with the functions psi_i >= 0 of `UnilateralPoints`. A point is a face with psi = 1.
///
/// The law has the inputs (x, r) or (x, r, lambda) and the outputs (-r grad h, h), x in space or in a plane;
/// its observedNames are those of h and of the pressure, which at a point is P over its weight. A law with
/// data (pieces: PieceSearch) has zeros for its outputs where it does not exist (PointLaw::exists): mean gaps
/// are those of the points that are over something, at the others the gap is infinite.
///
/// The unknown r_i is the multiplier as a length: P_i = p_i int psi_i dA = s_i r_i with s_i the body's
/// stiffness there. The row of r_i reads -s_i g_i = 0 where the condition is active and s_i r_i = 0 where it
/// is free, so the graph of the tangent never changes and, where the law is symmetric, the tangent is: an
/// active condition couples r and u by -s grad g, a free one adds s to the diagonal. Event functions: g of a
/// free condition, r of an active one.
///
/// A condition all of whose nodes are held by supports is never active; its multiplier stays zero.
///
/// Throws std::logic_error for a law with data that has no search to keep them up to date.
std::unique_ptr<EventTerm> unilateralTerm(std::unique_ptr<PointLaw> law, const UnilateralPoints& faces,
                                          const std::vector<double>& data = {}, PieceSearch search = {});

}  // namespace atrapos::fem
