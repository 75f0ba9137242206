#pragma once

#include "atrapos/contact/Cone.hpp"
#include "atrapos/contact/Cylinder.hpp"
#include "atrapos/contact/Plane.hpp"
#include "atrapos/contact/Roll.hpp"
#include "atrapos/contact/RollProfiles.hpp"
#include "atrapos/contact/Sphere.hpp"
#include "atrapos/contact/Torus.hpp"

/// Rigid tools. A tool is one struct whose templated operator is proj(h, n, x) = 0, paper (10)-(13): the gap
/// h (a length, positive when free) and the unit normal n (from the tool to the body) of a material point
/// that is now at x. Unknowns y = (h, n_x, n_y, n_z); x and h in the user's unit of length.
///
///     static constexpr int numUnknowns;
///     static constexpr bool symmetric;   // n = grad h: the contact tangent is symmetric
///
///     // g = proj, numUnknowns entries
///     template <class T> void operator()(const T* x, const T* y, T* g) const;
///
///     // guess for Newton's method
///     void start(const double* x, double* y) const;
///
///     // throws std::invalid_argument, one line, where the tool's own numbers make no surface
///     void validate() const;
///
///     // why the point at x has no unique projection, as the end of "the point ..."; empty where it has one
///     std::string ambiguity(const double* x) const;
///
/// The law itself gives NaN where dg/dy is singular. `validate` and `ambiguity` are called on the host only.
