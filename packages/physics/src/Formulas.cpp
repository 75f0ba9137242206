// Formulas by themselves: what is wrong with them, what they depend on, their values.
#include <algorithm>
#include <set>

#include "FormulaInputs.hpp"
#include "atrapos/formula/Parse.hpp"
#include "atrapos/physics/Formulas.hpp"

namespace atrapos::physics {

using detail::Layout, detail::layoutOf, detail::symbols;
using formula::Builder;

bool isFreeName(const std::string& name) {
  static const std::set<std::string> taken{"lambda",           "x",          "y", "z", "zeta",
                                           "contact_pressure", "contact_gap"};
  return formula::isName(name) && taken.count(name) == 0;
}

void checkFormula(const std::string& text, const std::vector<std::string>& fields, const Constants& constants,
                  Place place) {
  Builder builder;
  builder.program(
      {formula::parse(text, symbols(fields, constants, layoutOf(fields, place), builder), builder)});
}

bool dependsOnLoadFactor(const std::string& text, const std::vector<std::string>& fields,
                         const Constants& constants, Place place) {
  Builder builder;
  const Layout layout = layoutOf(fields, place);
  const auto inputs =
      builder.inputsOf(formula::parse(text, symbols(fields, constants, layout, builder), builder));
  return std::find(inputs.begin(), inputs.end(), layout.loadFactor()) != inputs.end();
}

std::function<double(const double*)> ofPlace(const std::string& text, const Constants& constants) {
  Builder builder;
  const Layout layout{Place::reference, 0};
  const auto program =
      builder.program({formula::parse(text, symbols({}, constants, layout, builder), builder)});
  return [program](const double* position) {
    const double noInput = 0;
    double value = 0;
    formula::evaluate<double>(program, &noInput, position, &value);
    return value;
  };
}

}  // namespace atrapos::physics
