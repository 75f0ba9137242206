#pragma once

#include <vector>

namespace atrapos::path {

/// How far each field of a path, in its own units, and the load factor have moved in one step at most: what
/// fields are measured by in the path parameter (docs/theory/path.md, "Fields of different units").
class FieldSizes {
 public:
  FieldSizes() = default;
  /// As sizes() gives them.
  explicit FieldSizes(std::vector<double> sizes) : sizes_(std::move(sizes)) {}

  /// A step has moved the fields and the load factor by these; empty: the fields have one unit, and all this
  /// is nothing.
  void moved(std::vector<double> fields, double lambda);

  /// Factors of the fields in Problem::inner, with which all that have moved count alike, and together as the
  /// load factor does, w the weight of the path parameter. Empty where one field at most has moved.
  std::vector<double> factors(double w) const;

  /// The same for a path without branches: fields that have not moved do not count. Empty where none has.
  std::vector<double> factorsOfMoved(double w) const;

  /// Of the fields, last the load factor's; empty: nothing has moved.
  const std::vector<double>& sizes() const { return sizes_; }

 private:
  std::vector<double> factors(double w, double atRest) const;
  long numMoved() const;

  std::vector<double> sizes_;
};

}  // namespace atrapos::path
