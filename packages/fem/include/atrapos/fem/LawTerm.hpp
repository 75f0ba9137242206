#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/fem/PointPieces.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/Term.hpp"

namespace atrapos::fem {

/// Brings passive data of all points of a term up to date before the law reads them: which piece of a surface
/// a point is over, a table's cell, ...
///
/// in: [point][law input] (with values of shape functions the place, and the load factor where the law reads
/// it). data: [point][datum], on entry those that the term was made with, whatever was evaluated before: the
/// result is a function of `in` alone, so that a residual, a tangent and a path do not depend on what came
/// before them. Called on the host, once a loop for all points.
using DataUpdate = std::function<void(int numPoints, const double* in, double* data)>;

/// A law at the points of a PointSet: gather, B, law, B^T, scatter.
///
/// The inputs are those of the points' shape functions with C components (PointSet::shapeComponents): the C
/// sums over nodes of u_i N_c, [i][c]. C = 3, gradients: H_ij = du_i/dX_j (solids in total-Lagrangian form).
/// C = 1, values: the current place x = X + u (contact, forces that depend on the place). A law with one
/// input more reads the load factor as its last. The outputs are the work conjugates of the inputs: the
/// virtual work of the term is the sum over points of weight * out . d(in).
///
/// `data`: the law's passive numbers, [entity][point][datum]. With an `update` they are brought up to date at
/// every state that is evaluated; a series keeps those of its start.
/// Throws std::logic_error where law, points and data do not fit, std::invalid_argument where an entity has
/// more nodes or points than the loops take.
std::unique_ptr<Term> lawTerm(std::unique_ptr<PointLaw> law, const PointSet& points,
                              const std::vector<double>& data = {}, DataUpdate update = {});

/// What is stored at the points of a batch: outputs grow by C d(in)/dt where the inputs have rates, which a
/// path does not. C: [point][output][input][lane], zero on entry. Called where Hopf points are looked for,
/// once a step.
using Capacity = std::function<void(const PointBatch& points, const double* in, double* C)>;

/// A law at points that store something (Term::addCapacity).
std::unique_ptr<Term> storingTerm(std::unique_ptr<PointLaw> law, const PointSet& points,
                                  const std::vector<double>& data, Capacity capacity);

/// A law that is analytic piece by piece: which piece a point is on is part of its data.
std::unique_ptr<Term> lawTerm(std::unique_ptr<PointLaw> law, const PointSet& points,
                              const std::vector<double>& data, PieceSearch search);

/// A law whose tangent is not symmetric at a point, while the sum over the points is, on all dofs that the
/// supports leave free (a pressure that follows edges whose ends are held): the term counts as symmetric.
std::unique_ptr<Term> symmetricSumTerm(std::unique_ptr<PointLaw> law, const PointSet& points,
                                       const std::vector<double>& data);

}  // namespace atrapos::fem
