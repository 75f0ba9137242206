#include "atrapos/physics/Expansion.hpp"

#include "FormulaInputs.hpp"
#include "atrapos/physics/GrowthStage.hpp"

namespace atrapos::physics {

Expansion expansionOf(const std::string& text, const std::vector<std::string>& fields,
                      const Constants& constants) {
  formula::Builder builder;
  // Values and no gradients, as on a surface.
  const detail::Layout layout = detail::layoutOf(fields, Place::surface);
  const int lambda = layout.loadFactor();
  const int result = formula::parse(text, detail::symbols(fields, constants, layout, builder), builder);

  Expansion expansion;
  for (const int input : builder.inputsOf(result)) {
    if (input == lambda) continue;
    if (!expansion.field.empty())
      throw formula::FormulaError("depends on the fields " + expansion.field + " and " + fields[input] +
                                  "; an expansion depends on one at most");
    expansion.field = fields[input];
  }
  expansion.program = builder.program({result});
  // The law's inputs behind H: the field if there is one, and the load factor.
  for (int n = 0; n < expansion.program.numSteps; ++n) {
    formula::Step& step = expansion.program.steps[n];
    if (step.operation == formula::Operation::input)
      step.a = step.a == lambda && !expansion.field.empty() ? 1 : 0;
  }
  return expansion;
}

std::unique_ptr<fem::PointLaw> shellExpansion(const std::string& text, const Constants& constants) {
  formula::Builder builder;
  const detail::Layout layout = detail::layoutOf({}, Place::shell);
  const int result = formula::parse(text, detail::symbols({}, constants, layout, builder), builder);
  return fem::pointLaw(GrowthStage{builder.program({result})});
}

}  // namespace atrapos::physics
