#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "atrapos/formula/Parse.hpp"
#include "atrapos/physics/Formulas.hpp"

/// The inputs of laws as formulas know them.
namespace atrapos::physics::detail {

/// Where the inputs of the laws are.
struct Layout {
  Place place;
  int fields;
  int value(int f) const { return place == Place::body ? 4 * f + 3 : f; }
  int gradient(int f, int i) const { return 4 * f + i; }
  int loadFactor() const {
    if (place == Place::body) return 4 * fields;
    // Of stages, whose fields are as many everywhere.
    return place == Place::contact || place == Place::shell ? std::max(fields, mostFields) : fields;
  }
  int contactPressure() const { return loadFactor() + 1; }
  int contactGap() const { return loadFactor() + 2; }
  /// The field that an input belongs to; -1: the load factor.
  int fieldOf(int input) const {
    return input == loadFactor() ? -1 : place == Place::body ? input / 4 : input;
  }
};

/// What formulas of such a law know.
inline formula::Symbols symbols(const std::vector<std::string>& fields, const Constants& constants,
                                const Layout& layout, formula::Builder& builder) {
  formula::Symbols s;
  for (int i = 0; i < 3; ++i) s.scalars[std::string(1, "xyz"[i])] = builder.datum(i);
  if (layout.place == Place::shell) s.scalars["zeta"] = builder.datum(3);
  for (const auto& [name, value] : constants) s.scalars[name] = builder.number(value);
  // Those of the place are the axes: dot(grad(T), grad(x)) is dT/dx.
  if (layout.place == Place::body)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) s.gradients[std::string(1, "xyz"[i])].push_back(builder.number(i == j));
  if (layout.place == Place::reference) return s;
  s.scalars["lambda"] = builder.input(layout.loadFactor());
  if (layout.place == Place::contact) {
    s.scalars["contact_pressure"] = builder.input(layout.contactPressure());
    s.scalars["contact_gap"] = builder.input(layout.contactGap());
  }
  for (int f = 0; f < layout.fields; ++f) {
    s.scalars[fields[f]] = builder.input(layout.value(f));
    if (layout.place == Place::body)
      for (int i = 0; i < 3; ++i) s.gradients[fields[f]].push_back(builder.input(layout.gradient(f, i)));
  }
  return s;
}

/// Of a law at a place whose points have these fields.
inline Layout layoutOf(const std::vector<std::string>& fields, Place place) {
  return {place, static_cast<int>(fields.size())};
}

}  // namespace atrapos::physics::detail
