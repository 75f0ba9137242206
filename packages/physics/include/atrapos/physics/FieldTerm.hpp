#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/fem/Term.hpp"
#include "atrapos/solid/PlaneBody.hpp"
#include "atrapos/solid/ShellPoints.hpp"

/// Terms of any law for scalar fields. `plane`: of plane cells, about an axis per full turn. `shells`: of the
/// elements of a block of shells, through whose thickness fields are the same.
namespace atrapos::physics {

/// The same maps for a scalar field of the same nodes.
fem::Interpolation mapsOf(const std::string& field, fem::Interpolation same);

/// What each field stores at a point by its value, c in c du/dt; `in` and `data` as a law in the block that
/// reads the load factor and the place has them; what the law does not read is zero.
using FieldCapacity = std::function<void(const double* in, const double* data, double* c)>;

/// A law at the points of a block, whose nodes have these fields. in: for each field its gradient (3, also in
/// planes) and its value, then the load factor where there is one input more; out: their work conjugates, so
/// that the sum over points of weight out . d(in) vanishes; data: the place x, y, z, or none. Throws
/// std::invalid_argument for laws of other shapes, std::runtime_error for cells as the points do.
std::unique_ptr<fem::Term> fieldTerm(const fem::Mesh& mesh, const fem::Block& block,
                                     const std::vector<std::string>& fields,
                                     std::unique_ptr<fem::PointLaw> law, const FieldCapacity& capacity,
                                     const std::optional<solid::PlaneSection>& plane,
                                     const solid::ShellElements* shells = nullptr);

/// The same on the sides of a set, of values alone: a term for each kind of side, each with a law of its own.
std::vector<std::unique_ptr<fem::Term>> sideTerms(const fem::Mesh& mesh, const fem::SideSet& set,
                                                  const std::vector<std::string>& fields,
                                                  const std::function<std::unique_ptr<fem::PointLaw>()>& law,
                                                  const std::optional<solid::PlaneSection>& plane);

/// Throws std::invalid_argument, one line, where a law is not one of so many fields with `each` inputs and
/// outputs: 4 in bodies, 1 on sides.
void requireFieldLaw(const fem::PointLaw& law, int fields, int each);

}  // namespace atrapos::physics
