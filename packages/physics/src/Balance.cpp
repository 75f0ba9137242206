#include "atrapos/physics/Balance.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "FormulaInputs.hpp"
#include "atrapos/formula/Parse.hpp"
#include "atrapos/physics/BalanceLaw.hpp"
#include "atrapos/physics/ContactInflow.hpp"
#include "atrapos/physics/FieldTerm.hpp"

namespace atrapos::physics {
namespace {

using detail::Layout, detail::layoutOf, detail::symbols;
using formula::Builder;
using formula::Operation;
using formula::Symbols;

void requireNumber(const std::vector<std::string>& fields) {
  if (fields.empty() || static_cast<int>(fields.size()) > mostFields)
    throw std::invalid_argument("between 1 and " + std::to_string(mostFields) +
                                " scalar fields can meet, here are " + std::to_string(fields.size()));
}

/// The formulas of a law together: for each field the sums of what is said of it.
struct Formulas {
  Builder builder;
  Layout layout;
  Symbols known;
  std::vector<int> results;

  Formulas(const std::vector<std::string>& fields, const Constants& constants, Place place, int each)
      : layout(layoutOf(fields, place)),
        known(symbols(fields, constants, layout, builder)),
        results(fields.size() * each, builder.number(0)) {
    requireNumber(fields);
  }
  void add(int result, const std::string& text) {
    results[result] = builder.binary(Operation::add, results[result], formula::parse(text, known, builder));
  }
  formula::Program program() const { return builder.program(results); }
  /// The same with the size of what they are the sums of in place of these results.
  formula::Program magnitudes(const std::vector<int>& of) {
    std::vector<int> sizes = results;
    for (const int r : of) sizes[r] = builder.magnitude(results[r]);
    return builder.program(sizes);
  }
  /// Whether a result depends on fields other than this one; -1: on any.
  bool dependsOnOthers(int result, int field) const {
    const std::vector<int> inputs = builder.inputsOf(results[result]);
    return std::any_of(inputs.begin(), inputs.end(), [&](int input) {
      const int of = layout.fieldOf(input);
      return of >= 0 && (of != field || input != layout.value(of));
    });
  }
};

int positionOf(const std::string& field, const std::vector<std::string>& fields) {
  const auto at = std::find(fields.begin(), fields.end(), field);
  if (at == fields.end()) throw std::logic_error("physics: a balance of a field that is not there");
  return static_cast<int>(at - fields.begin());
}

/// The programs of a law, and whether its tangent is symmetric.
struct Programs {
  formula::Program values, magnitudes;
  bool symmetric = true;
};

template <class Law>
std::unique_ptr<fem::PointLaw> lawOf(const Programs& programs) {
  Law law;
  law.symmetric = programs.symmetric;
  law.program = programs.values;
  law.magnitudes = programs.magnitudes;
  return fem::pointLaw(law);
}
template <template <int> class Law>
std::unique_ptr<fem::PointLaw> lawOf(int fields, const Programs& programs) {
  static_assert(mostFields == 4);
  return fields == 1   ? lawOf<Law<1>>(programs)
         : fields == 2 ? lawOf<Law<2>>(programs)
         : fields == 3 ? lawOf<Law<3>>(programs)
                       : lawOf<Law<4>>(programs);
}

}  // namespace

fem::Field scalarField(const std::string& name) { return {name, {""}, fem::Role::primal, name}; }

std::unique_ptr<fem::Term> balanceTerm(const fem::Mesh& mesh, const fem::Block& block,
                                       const std::vector<std::string>& fields,
                                       const std::vector<Balance>& balances, const Constants& constants,
                                       const std::optional<solid::PlaneSection>& plane,
                                       const solid::ShellElements* shells) {
  const int count = static_cast<int>(fields.size());
  Formulas formulas(fields, constants, Place::body, 2), stored(fields, constants, Place::body, 1);
  std::vector<char> isSaid(count, 0);
  for (const Balance& b : balances) {
    const int f = positionOf(b.field, fields);
    formulas.add(2 * f, b.conductivity);
    formulas.add(2 * f + 1, b.source);
    if (b.capacity.empty()) continue;
    stored.add(f, b.capacity);
    isSaid[f] = 1;
  }
  for (const Balance& b : balances)
    if (const int f = positionOf(b.field, fields); !isSaid[f]) {
      stored.add(f, "1");
      isSaid[f] = 1;
    }
  Programs programs;
  std::vector<int> sources;
  for (int f = 0; f < count; ++f) {
    programs.symmetric =
        programs.symmetric && !formulas.dependsOnOthers(2 * f, -1) && !formulas.dependsOnOthers(2 * f + 1, f);
    sources.push_back(2 * f + 1);
  }
  programs.values = formulas.program();
  programs.magnitudes = formulas.magnitudes(sources);
  auto law = lawOf<BalanceLaw>(count, programs);

  const auto capacity = [program = stored.program()](const double* in, const double* data, double* c) {
    formula::evaluate<double>(program, in, data, c);
  };
  return fieldTerm(mesh, block, fields, std::move(law), capacity, plane, shells);
}

std::vector<std::unique_ptr<fem::Term>> inflowTerms(const fem::Mesh& mesh, const fem::SideSet& set,
                                                    const std::vector<std::string>& fields,
                                                    const std::vector<Inflow>& inflows,
                                                    const Constants& constants,
                                                    const std::optional<solid::PlaneSection>& plane) {
  const int count = static_cast<int>(fields.size());
  Formulas formulas(fields, constants, Place::surface, 1);
  for (const Inflow& inflow : inflows) formulas.add(positionOf(inflow.field, fields), inflow.amount);
  Programs programs;
  std::vector<int> all;
  for (int f = 0; f < count; ++f) {
    programs.symmetric = programs.symmetric && !formulas.dependsOnOthers(f, f);
    all.push_back(f);
  }
  programs.values = formulas.program();
  programs.magnitudes = formulas.magnitudes(all);

  return sideTerms(
      mesh, set, fields, [&] { return lawOf<InflowLaw>(count, programs); }, plane);
}

std::unique_ptr<fem::PointLaw> contactInflow(const std::string& amount,
                                             const std::vector<std::string>& fields,
                                             const Constants& constants) {
  requireNumber(fields);
  Builder builder;
  const int q =
      formula::parse(amount, symbols(fields, constants, layoutOf(fields, Place::contact), builder), builder);
  ContactInflow law;
  law.program = builder.program({q});
  law.magnitudes = builder.program({builder.magnitude(q)});
  return fem::pointLaw(law);
}

}  // namespace atrapos::physics
