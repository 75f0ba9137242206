#pragma once

#include <map>
#include <string>
#include <vector>

#include "atrapos/formula/Builder.hpp"

namespace atrapos::formula {

/// What the names in a formula stand for: steps of a builder.
struct Symbols {
  std::map<std::string, int> scalars;
  /// Gradients of fields, one step a direction; read as grad(name), which stands in dot(grad(a), grad(b))
  /// alone.
  std::map<std::string, std::vector<int>> gradients;
};

/// Reads a formula: numbers, names, + - * / ^ (or **), parentheses, and the functions exp, log, log10, sqrt,
/// sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, erf, pow(a, b) and dot(grad(a), grad(b)); pi is known.
/// -a^2 is -(a^2), a^b^c is a^(b^c). Returns the step that is its value. Throws FormulaError, which says
/// where it cannot be read, or which name is not known and which are.
int parse(const std::string& text, const Symbols& symbols, Builder& builder);

/// Whether a name can stand in a formula for something of one's own: letters, digits and _, no digit in
/// front, and no function's name, nor pi.
bool isName(const std::string& name);

}  // namespace atrapos::formula
