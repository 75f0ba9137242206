#pragma once

#include <memory>
#include <vector>

#include "atrapos/fem/EventTerm.hpp"

namespace atrapos::fem {

/// The terms of a model that change at events, as one list of event functions: those of the first such term,
/// then those of the next.
class EventTerms {
 public:
  EventTerms() = default;
  explicit EventTerms(const std::vector<std::unique_ptr<Term>>& terms);

  bool empty() const { return terms_.empty(); }
  int count() const;
  void order(int k, const ConstField& Uk, double lambdaK, std::vector<double>& g) const;
  std::vector<int> at(const ConstField& u, double lambda) const;
  void apply(const std::vector<int>& indices);
  std::vector<int> conditions() const;
  void setConditions(const std::vector<int>& conditions);
  int constraintPivots() const;
  void setStiffness(const std::vector<double>& ofNodes);

 private:
  std::vector<EventTerm*> terms_;
};

}  // namespace atrapos::fem
