#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "atrapos/formula/FormulaError.hpp"

/// Formulas of coefficients and amounts know the fields by their names, the load factor as `lambda`, the
/// place as x, y, z, and constants; those of a body also dot(grad(a), grad(b)) of two fields. What cannot be
/// read throws formula::FormulaError.
namespace atrapos::physics {

using Constants = std::map<std::string, double>;

/// How many scalar fields can meet at a point.
constexpr int mostFields = 4;

/// Whether a formula may call something of one's own so: no function, and none of the names that mean
/// something by themselves.
bool isFreeName(const std::string& name);

/// Where a formula stands, which says what it may refer to. `shell`: to zeta besides, from -1 at the bottom
/// to 1 at the top of a shell, and to values of fields as on a surface. `contact`: a surface that a tool
/// touches, to contact_pressure and contact_gap besides.
enum class Place { body, surface, contact, shell, reference };

/// Throws formula::FormulaError where a formula cannot be read; `reference`: of the place and constants
/// alone.
void checkFormula(const std::string& text, const std::vector<std::string>& fields, const Constants& constants,
                  Place place);

/// The values of a formula of the place and constants, by position.
std::function<double(const double*)> ofPlace(const std::string& text, const Constants& constants);

/// Whether a formula depends on the load factor.
bool dependsOnLoadFactor(const std::string& text, const std::vector<std::string>& fields,
                         const Constants& constants, Place place);

}  // namespace atrapos::physics
