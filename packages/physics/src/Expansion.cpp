#include "atrapos/physics/Expansion.hpp"

#include "atrapos/formula/Parse.hpp"

namespace atrapos::physics {

Expansion expansionOf(const std::string& text, const std::vector<std::string>& fields,
                      const Constants& constants) {
  formula::Builder builder;
  const int lambda = static_cast<int>(fields.size());
  formula::Symbols symbols;
  for (int i = 0; i < 3; ++i) symbols.scalars[std::string(1, "xyz"[i])] = builder.datum(i);
  for (const auto& [name, value] : constants) symbols.scalars[name] = builder.number(value);
  for (int f = 0; f < lambda; ++f) symbols.scalars[fields[f]] = builder.input(f);
  symbols.scalars["lambda"] = builder.input(lambda);
  const int result = formula::parse(text, symbols, builder);

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

}  // namespace atrapos::physics
