#include "atrapos/physics/Expansion.hpp"

#include "FormulaInputs.hpp"
#include "atrapos/physics/GrowthStage.hpp"

namespace atrapos::physics {

using formula::Builder;

Expansion expansionOf(const std::string& text, const std::vector<std::string>& fields,
                      const Constants& constants) {
  Builder builder;
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

ShellExpansion shellExpansion(const std::string& text, const std::vector<std::string>& fields,
                              const Constants& constants) {
  const auto readWith = [&](const std::vector<std::string>& known, Builder& builder) {
    return formula::parse(
        text, detail::symbols(known, constants, detail::layoutOf(known, Place::shell), builder), builder);
  };
  ShellExpansion expansion;
  Builder all;
  for (const int input : all.inputsOf(readWith(fields, all)))
    if (input < static_cast<int>(fields.size())) expansion.fields.push_back(fields[input]);
  if (static_cast<int>(expansion.fields.size()) > mostFields)
    throw formula::FormulaError("depends on more than " + std::to_string(mostFields) + " fields");
  Builder own;
  const int e = readWith(expansion.fields, own);
  expansion.stage = fem::pointLaw(GrowthStage{own.program({e})});
  return expansion;
}

}  // namespace atrapos::physics
