#include "atrapos/physics/Balance.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "FormulaInputs.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/ReducedLaw.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/formula/Parse.hpp"
#include "atrapos/physics/BalanceLaw.hpp"

namespace atrapos::physics {
namespace {

using detail::Layout, detail::layoutOf, detail::symbols;
using formula::Builder;
using formula::Operation;
using formula::Symbols;

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
    if (fields.empty() || static_cast<int>(fields.size()) > mostFields)
      throw std::invalid_argument("between 1 and " + std::to_string(mostFields) +
                                  " scalar fields can meet, here are " + std::to_string(fields.size()));
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

/// A law in space at points of a plane.
std::unique_ptr<fem::PointLaw> inPlane(std::unique_ptr<fem::PointLaw> law, int fields) {
  fem::Reduction r;
  for (int f = 0; f < fields; ++f) {
    for (const int i : {3 * f, 3 * f + 1, -1, 3 * f + 2}) r.inputs.push_back(i);
    for (const int o : {4 * f, 4 * f + 1, 4 * f + 3}) r.outputs.push_back(o);
  }
  r.inputs.push_back(3 * fields);
  r.numInputs = 3 * fields + 1;
  return fem::reducedLaw(std::move(law), std::move(r));
}

/// Quadratic cells in full: a source is a quadratic function at least.
fem::Tabulation cellOf(fem::Topology topology) {
  switch (topology) {
    case fem::Topology::Quad8:
    case fem::Topology::Quad9:
    case fem::Topology::Hex20:
    case fem::Topology::Hex27:
      return fem::tabulate(topology, 5);
    case fem::Topology::Tri6:
    case fem::Topology::Tet10:
    case fem::Topology::Wedge15:
      return fem::tabulate(topology, 4);
    default:
      return fem::tabulate(topology, 2);
  }
}

fem::PointSet gradientPoints(const fem::Mesh& mesh, const fem::Block& block, const fem::Tabulation& cell,
                             const std::optional<solid::PlaneSection>& plane) {
  if (!plane) return fem::volumePoints(mesh, block, cell);
  const bool ring = plane->kind == solid::PlaneSection::Kind::axisymmetric;
  // A scalar has no part of its gradient around the axis.
  fem::PointSet points =
      solid::planePoints(mesh, block, cell, {solid::PlaneSection::Kind::strain, ring ? 1 : plane->thickness});
  if (!ring) return points;
  for (int p = 0; p < points.numPoints(); ++p) {
    const double radius = points.positions[3 * static_cast<std::size_t>(p)];
    if (!(radius > 0))
      throw std::runtime_error("block '" + block.name + "', element " +
                               std::to_string(p / points.pointsPerEntity + 1) +
                               " (of the block): the radius x is not positive; the axis is x = 0");
    points.weights[p] *= 2 * std::acos(-1.0) * radius;
  }
  return points;
}

}  // namespace

fem::Field scalarField(const std::string& name) { return {name, {""}, fem::Role::primal, name}; }

bool isFreeName(const std::string& name) {
  return formula::isName(name) && name != "lambda" && name != "x" && name != "y" && name != "z";
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
    double value = 0;
    formula::evaluate<double>(program, nullptr, position, &value);
    return value;
  };
}

std::unique_ptr<fem::Term> balanceTerm(const fem::Mesh& mesh, const fem::Block& block,
                                       const std::vector<std::string>& fields,
                                       const std::vector<Balance>& balances, const Constants& constants,
                                       const std::optional<solid::PlaneSection>& plane) {
  const int count = static_cast<int>(fields.size());
  Formulas formulas(fields, constants, Place::body, 2);
  for (const Balance& b : balances) {
    const int f = positionOf(b.field, fields);
    formulas.add(2 * f, b.conductivity);
    formulas.add(2 * f + 1, b.source);
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

  const fem::Tabulation cell = cellOf(block.topology);
  fem::PointSet points = gradientPoints(mesh, block, cell, plane);
  points.components = 1;
  points.field = fields[0];
  for (int f = 0; f < count; ++f) {
    if (f > 0) points.more.push_back(fem::gradientsOf(scalarField(fields[f]), points, cell));
    points.more.push_back(fem::valuesOf(scalarField(fields[f]), points, cell));
  }
  return fem::lawTerm(plane ? inPlane(std::move(law), count) : std::move(law), points, points.positions);
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

  constexpr int degree = 5;  // three points along an edge of degree 2
  std::vector<std::unique_ptr<fem::Term>> terms;
  for (fem::PointSet& points :
       plane ? solid::planeEdgePoints(mesh, set, *plane, degree) : fem::facePoints(mesh, set, degree)) {
    points.components = 1;
    points.field = fields[0];
    for (int f = 1; f < count; ++f) {
      fem::Interpolation of = points;
      of.field = fields[f];
      points.more.push_back(std::move(of));
    }
    terms.push_back(fem::lawTerm(lawOf<InflowLaw>(count, programs), points, points.positions));
  }
  return terms;
}

}  // namespace atrapos::physics
