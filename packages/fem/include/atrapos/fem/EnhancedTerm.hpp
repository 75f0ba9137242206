#pragma once

#include <memory>
#include <vector>

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/Term.hpp"

namespace atrapos::fem {

/// Points at which a law with an enhanced strain acts: the maps B of a PointSet, and e = sum_j mode_j beta_j
/// with parameters beta of each element.
struct EnhancedPoints {
  PointSet points;
  int numParameters = 0;       ///< at most kMaxParameters
  std::vector<double> modes;   ///< [point of an element][parameter], the same for all elements
  std::vector<double> data;    ///< the law's passive data, [entity][point][datum]
  std::vector<double> strain;  ///< [entity][point] strain per unit of e: says when beta is known well enough
};

/// Most enhanced parameters of an element.
constexpr int kMaxParameters = 8;

/// A law of h = B u and of an enhanced strain e, paper (32)-(35), whose element parameters are condensed
/// inside the element at every order (docs/theory/shell.md, "Condensation"). Inputs (h, e) with h as in
/// lawTerm, outputs their work conjugates (f, s). A law with one input more reads the load factor before e.
///
/// beta follows from the displacements alone. Where an element has none, its forces are NaN and beginSeries
/// throws taylor::DomainError with the element (from 1 within the whole term) and the reason.
/// Throws std::logic_error where law, points and data do not fit.
std::unique_ptr<Term> enhancedTerm(std::unique_ptr<PointLaw> law, const EnhancedPoints& points);

}  // namespace atrapos::fem
